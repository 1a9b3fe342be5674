#!/usr/bin/env python3
"""Measures accuracy and speed of the presets, and of the plain bootstrap filter, over several scenes.

    scripts/measure_presets.py WALKTRACK OUT [--walks N] [--scenes FOLDER ...] [--seeds N] [--over PARAMETERS] [--picture FILE]

Renders N walks (default 4; those of measure_gait.py, with one camera and with three) or takes FOLDERs of scenes
(scene.yaml and, for one camera, scene_one_camera.yaml, with a truth), sweeps each (`walktrack sweep`) over the
presets and over bootstrap filters (no layers, no moves, many particles), or whatever `--over` says, and prints one
row a setting: the median over scenes of error, lost frames and speed, and error and CPU time relative to the first
setting in the same scene. --picture draws error beside speed, with the speed of the pose network alone if `micro_bench`
was built beside WALKTRACK. What OUT holds already is not done again. Standard library only.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys

from measure_gait import make_scenes, run

PRESETS = ("balanced", "fast", "accurate")
BOOTSTRAP = (1000, 2000, 4000)  # particles: about as slow as the presets


def with_bootstrap(out):
    """What is swept over: presets, and files with the settings of bootstrap filters."""
    out.mkdir(parents=True, exist_ok=True)
    files = []
    for particles in BOOTSTRAP:
        files.append(out / f"bootstrap_{particles}.yaml")
        files[-1].write_text(f"filter: {{particles: {particles}, max_layers: 1, moves: 0}}\n")
    return "config=" + ":".join([*PRESETS, *map(str, files)])


def rendered(walktrack, out, count):
    """Scene files of rendered walks: all three cameras, and the side camera alone."""
    for folder in make_scenes(walktrack, out, count):
        yield from (folder / "scene.yaml", folder / "scene_one_camera.yaml")


def swept(walktrack, scene, out, arguments):
    folder = out / "sweeps" / f"{scene.parent.name}_{scene.stem}"
    run(walktrack, "sweep", scene, "-o", folder, "--over", arguments.over, "--seeds", arguments.seeds, "--quiet", *arguments.options)
    return json.loads((folder / "sweep.json").read_text())["settings"]


def name_of(setting):
    return " ".join(f"{parameter}={pathlib.Path(str(value)).stem}" for parameter, value in setting.items())


def table(title, sweeps):
    print(f"\n{title}, {len(sweeps)} scene(s)\n")
    print("| setting | error, mm | relative | lost, % | CPU ms/frame | relative | frames/s |\n|---|---:|---:|---:|---:|---:|---:|")
    found = {}
    for row in range(len(sweeps[0])):
        rows = [sweep[row] for sweep in sweeps]
        median = lambda values: statistics.median([v for v in values if v is not None] or [float("nan")])
        ratio = lambda key: median([r[key] / s[0][key] for r, s in zip(rows, sweeps) if r[key] and s[0][key]])
        name = name_of(rows[0]["setting"])
        print(f"| {name} | {median([r['error_mm'] for r in rows]):.1f} | {ratio('error_mm'):.2f} "
              f"| {100 * statistics.mean(r['lost_share'] for r in rows):.1f} | {1000 * median([r['cpu_seconds_per_frame'] for r in rows]):.1f} "
              f"| {ratio('cpu_seconds_per_frame'):.2f} | {median([r['frames_per_second'] for r in rows]):.0f} |")
        found[name] = (median([r["frames_per_second"] for r in rows]), median([r["error_mm"] for r in rows]))
    return found


def speed_of_network(walktrack):
    """Pictures a second of the pose network alone, on one thread; None where it cannot be measured."""
    bench = pathlib.Path(walktrack).parent / "micro_bench"
    if not bench.exists():
        return None
    output = subprocess.run([bench, "--benchmark_filter=^pose_network$", "--benchmark_format=json"], capture_output=True, text=True, check=True)
    times = [each["s_each"] for each in json.loads(output.stdout)["benchmarks"]]
    return 1 / statistics.median(times) if times else None


WIDTH, HEIGHT, LEFT, TOP = 400, 290, 52, 34  # of a panel, px, and its margins
BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#555555"


def panel(title, found, network, x0):
    """Error beside speed, both on logarithmic axes."""
    shown = [value for value in found.values() if all(map(math.isfinite, value))]
    speeds, errors = [s for s, _ in shown] + ([network] if network else []), [e for _, e in shown]
    low, high = 0.7 * min(speeds), 1.4 * max(speeds)
    bottom, top = 0.75 * min(errors), 1.35 * max(errors)
    right, floor = x0 + WIDTH - 12, HEIGHT - 44
    x = lambda speed: x0 + LEFT + (right - x0 - LEFT) * math.log(speed / low) / math.log(high / low)
    y = lambda error: floor - (floor - TOP) * math.log(error / bottom) / math.log(top / bottom)
    ticks = [digit * 10 ** power for power in range(4) for digit in (1, 1.5, 2, 3, 5, 7)]
    out = [f'<text x="{x0 + LEFT}" y="20" font-weight="bold">{title}</text>',
           f'<path d="M{x0 + LEFT} {TOP}V{floor}H{right}" fill="none" stroke="{GREY}"/>',
           f'<text x="{(x0 + LEFT + right) / 2:.0f}" y="{HEIGHT - 8}" text-anchor="middle">frames/s of the whole command</text>',
           f'<text x="{x0 + 14}" y="{(TOP + floor) / 2:.0f}" text-anchor="middle" transform="rotate(-90 {x0 + 14} {(TOP + floor) / 2:.0f})">joint error, mm</text>']
    out += [f'<path d="M{x(t):.1f} {floor}v5" stroke="{GREY}"/><text x="{x(t):.1f}" y="{floor + 18}" text-anchor="middle">{t:g}</text>'
            for t in ticks if low <= t <= high]
    out += [f'<path d="M{x0 + LEFT} {y(t):.1f}h-5" stroke="{GREY}"/><text x="{x0 + LEFT - 8}" y="{y(t) + 4:.1f}" text-anchor="end">{t:g}</text>'
            for t in ticks if bottom <= t <= top]
    if network:
        out.append(f'<path d="M{x(network):.1f} {TOP}V{floor}" stroke="{GREY}" stroke-dasharray="2 4"/><text x="{x(network) - 4:.1f}" y="{TOP + 12}"'
                   f' text-anchor="end" fill="{GREY}">pose network alone</text>')
    for word, colour, dash in (("bootstrap", ORANGE, "5 4"), ("", BLUE, "none")):
        points = sorted((x(s), y(e), name.split("=")[-1]) for name, (s, e) in found.items()
                        if ("bootstrap" in name) == bool(word) and math.isfinite(s) and math.isfinite(e))
        line = "M" + "L".join(f"{px:.1f} {py:.1f}" for px, py, _ in points)
        out.append(f'<path d="{line}" fill="none" stroke="{colour}" stroke-dasharray="{dash}"/>')
        out += [f'<circle cx="{px:.1f}" cy="{py:.1f}" r="4" fill="{colour}"/><text x="{px:.1f}" y="{py + (18 if not word else -9):.1f}" text-anchor="middle" fill="{colour}">'
                f'{name.replace("bootstrap_", "")}</text>' for px, py, name in points]
    return out


def picture(found, network):
    width = WIDTH * len(found)
    panels = [line for i, (title, values) in enumerate(found.items()) for line in panel(title, values, network, i * WIDTH)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{HEIGHT}" viewBox="0 0 {width} {HEIGHT}" font-family="sans-serif" font-size="12">\n'
            f'<rect width="{width}" height="{HEIGHT}" fill="white"/>\n' + "\n".join(panels) + "\n</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--walks", type=int, default=4)
    parser.add_argument("--scenes", nargs="+", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--over")
    parser.add_argument("--picture", type=pathlib.Path)
    parser.add_argument("options", nargs="*", help="of walktrack sweep, after --")
    arguments = parser.parse_args()
    arguments.over = arguments.over or with_bootstrap(arguments.out)
    scenes = ([folder / name for folder in arguments.scenes for name in ("scene.yaml", "scene_one_camera.yaml") if (folder / name).exists()]
              if arguments.scenes else list(rendered(arguments.walktrack, arguments.out, arguments.walks)))
    groups = {"Three cameras": [], "One camera": []}
    for number, scene in enumerate(scenes, 1):
        print(f"{number}/{len(scenes)} {scene}", file=sys.stderr)
        groups["One camera" if "one_camera" in scene.stem else "Three cameras"].append(swept(arguments.walktrack, scene, arguments.out, arguments))
    found = {title: table(title, sweeps) for title, sweeps in groups.items() if sweeps}
    if arguments.picture:
        network = speed_of_network(arguments.walktrack)
        if network is None:
            print("the pose network is left out of the picture: there is no micro_bench beside walktrack", file=sys.stderr)
        arguments.picture.write_text(picture(found, network))


if __name__ == "__main__":
    main()
