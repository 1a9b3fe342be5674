#!/usr/bin/env python3
"""Measures how well gait and joint angles of rendered walks are found: with all cameras, and with the side
camera alone.

    scripts/measure_gait.py WALKTRACK OUT [--walks N] [--scenes FOLDER ...] [-- OPTIONS OF TRACK ...]

Renders N walks (default 20) of 0.8 to 1.7 m/s by people of 1.58 to 1.88 m, in turn footprints that people make
and gaits of the kneed walker, tracks each twice and reads truth and estimate with the same eyes (`walktrack
analyse`, `walktrack evaluate`). FOLDERs are rendered scenes of other
origin: scene.yaml, truth.csv and, for one camera, scene_one_camera.yaml. What OUT holds already is not done
again. Prints a Markdown table; each walk's figures are in OUT/walks.csv. Standard library only.
"""
import argparse
import csv
import itertools
import json
import math
import pathlib
import statistics
import subprocess
import sys

SAME_CONTACT = 0.25  # s; under half of the shortest usual stride
FIGURES = {  # column: (words, factor, unit, decimals)
    "step_length_m": ("mean step length", 100, "cm", 1),
    "step_time_s": ("mean step time", 1000, "ms", 0),
    "cadence": ("cadence", 1, "%", 1),
    "speed": ("speed", 1, "%", 1),
    "knee_deg": ("knee, rms", 1, "°", 1),
    "hip_deg": ("hip, rms", 1, "°", 1),
    "swapped_percent": ("frames with legs exchanged", 1, "%", 0),
}
SIDE = "{name: side, azimuth_deg: -90, distance: 5.6, height: 1.2, focal_px: 620, size: [640, 480], distortion: [-0.08, 0.01, 0, 0]}"
OTHERS = ("{name: front, azimuth_deg: -25, distance: 6.5, height: 1.8, focal_px: 680, size: [640, 480]}",
          "{name: back, azimuth_deg: 150, distance: 6.5, height: 1.8, focal_px: 680, size: [640, 480]}")


def run(walktrack, *words, allowed=(0,)):
    result = subprocess.run([walktrack, *map(str, words)], capture_output=True, text=True, check=False)
    if result.returncode not in allowed:
        raise RuntimeError(f"{words[0]}: exit {result.returncode}: {result.stderr.strip()[-300:]}")
    return result.stdout


def walk_options(i, count):
    """What `walktrack render --options` takes: speeds in order, everything else spread by its own stride."""
    spread = lambda step, low, high: low + (high - low) * (i * step % 1)
    speed = 0.8 + 0.9 * i / max(1, count - 1)
    duration = min(3.6, 4.2 / speed)
    start = -speed * duration / 2
    heading = spread(0.618, -8, 8)
    way = f"speed: {speed:.3f}, start: [{start:.2f}, {math.tan(math.radians(heading)) * start:.2f}], heading_deg: {heading:.1f}"
    walk = f"gait: {{{way}}}" if i % 2 else f"walk: {{{way}, phase: {spread(0.414, 0, 1):.3f}}}"
    return f"""seed: {i + 1}
frame_rate: 30
duration: {duration:.2f}
{walk}
subject: {{height: {spread(0.236, 1.58, 1.88):.3f}, mass: 70, clothes: {i}}}
setting: {("room", "field", "studio")[i % 3]}
sensor: {{noise: 0.008, flicker: 0.005}}
background_frames: 15
cameras:
  - {SIDE}
  - {OTHERS[0]}
  - {OTHERS[1]}
"""


def one_camera(text):
    """The scene with its first camera only; cameras are the list entries of scene.yaml."""
    lines, kept, seen = text.splitlines(), [], 0
    for line in lines:
        seen += line.startswith("  - ")
        if not (line.startswith(("  - ", "    ")) and seen > 1):
            kept.append(line)
    return "\n".join(kept) + "\n"


def rendered_walks(walktrack, out, texts):
    """The folder of each walk, which is rendered unless OUT holds it."""
    for i, text in enumerate(texts):
        folder = out / "scenes" / f"walk{i:02}"
        if not (folder / "scene.yaml").exists():
            folder.mkdir(parents=True, exist_ok=True)
            options = folder / "options.yaml"
            options.write_text(text)
            run(walktrack, "render", "--options", options, "-o", folder, "-y", "--threads", 1)
        yield folder


def make_scenes(walktrack, out, count):
    for folder in rendered_walks(walktrack, out, (walk_options(i, count) for i in range(count))):
        (folder / "scene_one_camera.yaml").write_text(one_camera((folder / "scene.yaml").read_text()))
        yield folder


def contacts(folder):
    """(side, strike, {column: value}) of gait.json."""
    gait = json.loads((folder / "gait.json").read_text())
    for row in gait["contacts"]:
        if row["foot_strike_s"]["value"] is not None:
            yield row["side"], row["foot_strike_s"]["value"], {k: v["value"] for k, v in row.items() if k != "side"}


def step_errors(truth, estimate):
    """Errors of the means over the steps that both have: a track may begin a step late."""
    pairs = {"step_length_m": [], "step_time_s": []}
    found = list(contacts(estimate))
    for side, strike, row in contacts(truth):
        near = [(abs(t - strike), other) for s, t, other in found if s == side and abs(t - strike) < SAME_CONTACT]
        if not near:
            continue
        other = min(near, key=lambda pair: pair[0])[1]
        for column, values in pairs.items():
            if row[column] is not None and other[column] is not None:
                values.append((row[column], other[column]))
    out = {}
    for column, values in pairs.items():
        if values:
            out[column] = abs(statistics.mean(b for _, b in values) - statistics.mean(a for a, _ in values))
    if pairs["step_time_s"]:
        expected, got = (statistics.mean(column) for column in zip(*pairs["step_time_s"]))
        out["cadence"] = 100 * abs(expected / got - 1)
    out["steps"] = len(pairs["step_length_m"])
    return out


def measure(walktrack, folder, scene, result, options):
    """The figures of one track; no figures where nobody was found."""
    if not (result / "run.json").exists():
        run(walktrack, "track", scene, "-o", result, "-y", "--no-overlay", "--threads", 1, *options, allowed=(0, 4))
    truth = result / "truth"
    if not (truth / "run.json").exists():
        run(walktrack, "analyse", folder / "truth.csv", "-o", truth)
    record = json.loads((result / "run.json").read_text())
    if not record["numbers"]["tracked_frames"]:
        return {"status": record["status"]}
    scored = json.loads(run(walktrack, "evaluate", folder / "truth.csv", result, "--json"))["estimates"][0]
    mean = lambda joint: (scored[f"angle_l{joint}_flexion_rms_deg"] + scored[f"angle_r{joint}_flexion_rms_deg"]) / 2
    return {"status": record["status"], **step_errors(truth, result),
            "speed": 100 * abs(scored["speed_m_s"] / scored["truth_speed_m_s"] - 1),
            "knee_deg": mean("knee"), "hip_deg": mean("hip"), "swapped_percent": scored["swapped_percent"],
            "joint_error_mm": scored["joint_error_mean_mm"]}


def cell(rows, column):
    """Median, and what nine in ten do not exceed."""
    _, factor, unit, decimals = FIGURES[column]
    values = sorted(factor * row[column] for row in rows if row.get(column) is not None)
    if not values:
        return "–"
    return f"{statistics.median(values):.{decimals}f} {unit} ({values[math.ceil(0.9 * len(values)) - 1]:.{decimals}f})"


def print_table(rows):
    kinds = list(dict.fromkeys((row["walks"], row["cameras"]) for row in rows))
    print("| error: median (nine in ten at most) |", " | ".join(f"{walks}, {cameras}" for walks, cameras in kinds), "|")
    print("|---" * (len(kinds) + 1) + "|")
    of = lambda kind: [row for row in rows if (row["walks"], row["cameras"]) == kind]
    print("| walks found |", " | ".join(f"{sum('knee_deg' in row for row in of(kind))} of {len(of(kind))}" for kind in kinds), "|")
    for column, (words, *_) in FIGURES.items():
        print(f"| {words} |", " | ".join(cell(of(kind), column) for kind in kinds), "|")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--walks", type=int, default=20)
    parser.add_argument("--scenes", type=pathlib.Path, nargs="*", default=[])
    words, options = sys.argv[1:], []
    if "--" in words:
        words, options = words[:words.index("--")], words[words.index("--") + 1:]
    arguments = parser.parse_args(words)
    walktrack, rows = arguments.walktrack.resolve(), []
    given = [("given", folder) for folder in arguments.scenes]
    made = (("gaits" if i % 2 else "footprints", folder)
            for i, folder in enumerate(make_scenes(walktrack, arguments.out, arguments.walks)))
    for kind, folder in itertools.chain(given, made):
        for cameras, scene in (("all cameras", "scene.yaml"), ("side camera", "scene_one_camera.yaml")):
            result = arguments.out / "results" / folder.name / pathlib.Path(scene).stem
            figures = measure(walktrack, folder, folder / scene, result, options)
            rows.append({"walks": kind, "walk": folder.name, "cameras": cameras, **figures})
            print(f"{folder.name}, {cameras}: {figures['status']}", file=sys.stderr)
    columns = ["walks", "walk", "cameras", "status", "steps", *FIGURES, "joint_error_mm"]
    with (arguments.out / "walks.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)
    print_table(rows + [{**row, "walks": "all"} for row in rows])


if __name__ == "__main__":
    main()
