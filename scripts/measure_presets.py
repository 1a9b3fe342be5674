#!/usr/bin/env python3
"""Measures accuracy and speed of the presets over several scenes.

    scripts/measure_presets.py WALKTRACK OUT [--walks N] [--scenes FOLDER ...] [--seeds N] [--over PARAMETERS]

Renders N walks (default 4; those of measure_gait.py, with one camera and with three) or takes FOLDERs of scenes
(scene.yaml and, for one camera, scene_one_camera.yaml, with a truth), sweeps each (`walktrack sweep`) over the
presets, or whatever `--over` says, and prints one row a setting: the median over scenes of error, lost frames and
speed, and error and CPU time relative to the first setting in the same scene. What OUT holds already is not done again. Standard library only.
"""
import argparse
import json
import pathlib
import statistics
import sys

from measure_gait import make_scenes, run

PRESETS = "config=balanced:fast:accurate"


def rendered(walktrack, out, count):
    """Scene files of rendered walks: all three cameras, and the side camera alone."""
    for folder in make_scenes(walktrack, out, count):
        yield from (folder / "scene.yaml", folder / "scene_one_camera.yaml")


def swept(walktrack, scene, out, arguments):
    folder = out / "sweeps" / f"{scene.parent.name}_{scene.stem}"
    run(walktrack, "sweep", scene, "-o", folder, "--over", arguments.over, "--seeds", arguments.seeds, "--quiet", *arguments.options)
    return json.loads((folder / "sweep.json").read_text())["settings"]


def table(title, sweeps):
    print(f"\n{title}, {len(sweeps)} scene(s)\n")
    print("| setting | error, mm | relative | lost, % | CPU ms/frame | relative | frames/s |\n|---|---:|---:|---:|---:|---:|---:|")
    for row in range(len(sweeps[0])):
        rows = [sweep[row] for sweep in sweeps]
        median = lambda values: statistics.median([v for v in values if v is not None] or [float("nan")])
        ratio = lambda key: median([r[key] / s[0][key] for r, s in zip(rows, sweeps) if r[key] and s[0][key]])
        name = " ".join(f"{parameter}={value}" for parameter, value in rows[0]["setting"].items())
        print(f"| {name} | {median([r['error_mm'] for r in rows]):.1f} | {ratio('error_mm'):.2f} "
              f"| {100 * statistics.mean(r['lost_share'] for r in rows):.1f} | {1000 * median([r['cpu_seconds_per_frame'] for r in rows]):.1f} "
              f"| {ratio('cpu_seconds_per_frame'):.2f} | {median([r['frames_per_second'] for r in rows]):.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--walks", type=int, default=4)
    parser.add_argument("--scenes", nargs="+", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--over", default=PRESETS)
    parser.add_argument("options", nargs="*", help="of walktrack sweep, after --")
    arguments = parser.parse_args()
    scenes = ([folder / name for folder in arguments.scenes for name in ("scene.yaml", "scene_one_camera.yaml") if (folder / name).exists()]
              if arguments.scenes else list(rendered(arguments.walktrack, arguments.out, arguments.walks)))
    groups = {"Three cameras": [], "One camera": []}
    for number, scene in enumerate(scenes, 1):
        print(f"{number}/{len(scenes)} {scene}", file=sys.stderr)
        groups["One camera" if "one_camera" in scene.stem else "Three cameras"].append(swept(arguments.walktrack, scene, arguments.out, arguments))
    for title, sweeps in groups.items():
        if sweeps:
            table(title, sweeps)


main()
