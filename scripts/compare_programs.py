#!/usr/bin/env python3
"""Compares programs, or settings of one, on rendered videos with truth: errors, angles, feet, bands and time, side by side.

    scripts/compare_programs.py OUT NAME=WALKTRACK[,OPTION,...] [NAME=...] [--walks N] [--seeds N] [--only WORD]

Videos: motion capture and patients by another renderer, where they are present beside the checkout, and N made walks
(default 40), each with all cameras and with the side camera alone. The first program renders, and reads all results
with the same eyes (`walktrack evaluate`). A row is the median over the runs of one kind (default 5 seeds each); bands
and swapped legs are means. What OUT holds already is not done again. Standard library only.
"""
import argparse
import json
import pathlib
import resource
import statistics
import sys

from measure_gait import make_scenes, run
from measure_results import PATIENTS, RENDERED

GROUPS = ("pelvis", "hips", "knees", "ankles", "toes")
ANGLES = ("knee_flexion", "hip_flexion", "ankle_dorsiflexion")
MEDIANS = ("joint_error_mean_mm", *ANGLES, "angle_heading_rms_deg", "foot_slide_worst_mm", "penetration_mm", "jitter_m_s3",
           "interval_width_mm", "cpu")
MEANS = ("swapped_percent", *(f"coverage90_{group}_{way}_percent" for way in ("level", "up") for group in GROUPS))


def rendered(folder):
    return sorted(path.parent for path in folder.glob("*/truth.csv"))


def kinds(reader, out, walks):
    yield "motion capture", rendered(RENDERED)
    yield "patients", rendered(PATIENTS)
    yield "made walks", make_scenes(reader, out, walks)


def scored(reader, program, options, folder, scene, seed, result):
    """What `evaluate` says of a run, with its CPU time; nothing where nobody was found."""
    if not (result / "run.json").exists():
        result.mkdir(parents=True, exist_ok=True)
        before = children_seconds()
        run(program, "track", folder / scene, "-o", result, "-y", "--no-overlay", "--threads", 1, "--seed", seed, *options, allowed=(0, 4))
        (result / "cpu").write_text(f"{children_seconds() - before:.2f}")
    if not json.loads((result / "run.json").read_text())["numbers"]["tracked_frames"]:
        return None
    values = json.loads(run(reader, "evaluate", folder / "truth.csv", result, "--json"))["estimates"][0]
    for angle in ANGLES:
        values[angle] = (values[f"angle_l{angle}_rms_deg"] + values[f"angle_r{angle}_rms_deg"]) / 2
    return {**values, "cpu": float((result / "cpu").read_text())}


def children_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def row(runs):
    known = [each for each in runs if each]
    of = lambda middle, name: middle([each[name] for each in known if each[name] is not None] or [float("nan")])
    middle = {name: of(statistics.median, name) for name in MEDIANS} | {name: of(statistics.mean, name) for name in MEANS}
    worst = max((each["joint_error_mean_mm"] for each in known), default=float("nan"))
    bands = " / ".join(" ".join(f"{middle[f'coverage90_{group}_{way}_percent']:.0f}" for group in GROUPS) for way in ("level", "up"))
    return (f"{middle['joint_error_mean_mm']:.0f} ({worst:.0f}) | {len(runs) - len(known)} | {middle['swapped_percent']:.1f} | "
            + ", ".join(f"{middle[angle]:.1f}" for angle in ANGLES)
            + f" | {middle['angle_heading_rms_deg']:.0f} | {middle['foot_slide_worst_mm']:.0f} | {middle['penetration_mm']:.0f} | "
            f"{middle['jitter_m_s3']:.0f} | {bands} | {middle['interval_width_mm']:.0f} | {middle['cpu']:.1f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("programs", nargs="+", metavar="NAME=WALKTRACK[,OPTION,...]")
    parser.add_argument("--walks", type=int, default=40)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    programs = []
    for name, command in (each.split("=", 1) for each in arguments.programs):
        program, *options = command.split(",")
        programs.append((name, pathlib.Path(program).resolve(), options))
    reader = programs[0][1]
    print("| videos | cameras | program | error, mm (worst) | nobody found | swapped, % | knee, hip, ankle, ° | heading, ° | slide, mm | "
          "sunk, mm | jitter, m/s³ | truth in 90 % bands, %: pelvis, hips, knees, ankles, toes over the ground / upwards | width, mm | CPU, s |")
    print("|---|---|---|---:|---:|---:|---|---:|---:|---:|---:|---|---:|---:|")
    for kind, folders in kinds(reader, arguments.out, arguments.walks):
        if arguments.only not in kind:
            continue
        folders = list(folders)
        for cameras, scene in (("all", "scene.yaml"), ("one", "scene_one_camera.yaml")):
            for name, program, options in programs:
                runs = [scored(reader, program, options, folder, scene, seed,
                               arguments.out / name / f"{folder.name}_{cameras}_{seed}")
                        for folder in folders for seed in range(1, arguments.seeds + 1)]
                if runs:
                    print(f"| {len(folders)} {kind} | {cameras} | {name} | {row(runs)} |", flush=True)
                else:
                    print(f"skipped, not there: {kind}", file=sys.stderr)


if __name__ == "__main__":
    main()
