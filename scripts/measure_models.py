#!/usr/bin/env python3
"""Measures what physics is worth: the same filter with each motion model, on walks whose legs are seen throughout
and on the same walks with the legs hidden from all cameras for a while.

    scripts/measure_models.py WALKTRACK OUT [--walks N] [--seeds K] [--hidden S ...] [--scenes FOLDER ...]
                              [-- OPTIONS OF TRACK ...]

Renders N walks on footprints (default 2; those of measure_gait.py are others) and takes FOLDERs of other origin:
scene.yaml and truth.csv. Legs are hidden by occluders from the hips down, in every camera, from FROM s on: later
than what a walker is found by. Errors are means over the seven scored joints, in the hidden stretch or, for walks
that are clear, over all frames; a lost frame is one without an estimate after the first. What OUT holds already is
not done again. Prints a Markdown table; every run's figures are in OUT/runs.csv. Standard library only.
"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import sys

from fit_model_error import cameras_of, table
from measure_gait import OTHERS, SIDE, rendered_walks, run

# Each with the noise that did best on the shipped demo, if that is not the default's.
MODELS = {"kneed": (), "anthropomorphic": ("--set", "motion.aim_drift=0.03"), "markov": ()}
JOINTS = ("pelvis", "lhip", "lknee", "lankle", "rhip", "rknee", "rankle")
FROM = 1.35  # s; a walker is found in a window of 1.2 s
FIGURES = {"slide_mm": "foot_slide_mean_mm", "swapped_percent": "swapped_percent"}


def walk_options(i, count):
    spread = lambda step, low, high: low + (high - low) * (i * step % 1)
    speed = 1.0 + 0.5 * (i + 0.5) / count
    duration = 3.0
    start = -speed * duration / 2
    return f"""seed: {100 + i}
frame_rate: 30
duration: {duration}
walk: {{speed: {speed:.3f}, start: [{start:.2f}, 0], heading_deg: {spread(0.618, -6, 6):.1f}, phase: {spread(0.414, 0, 1):.3f}}}
subject: {{height: {spread(0.37, 1.62, 1.86):.3f}, mass: 70, clothes: {i + 3}}}
setting: {("field", "room", "studio")[i % 3]}
sensor: {{noise: 0.008, flicker: 0.005}}
background_frames: 15
cameras:
  - {SIDE}
  - {OTHERS[0]}
  - {OTHERS[1]}
"""


def hip_row(camera, rows):
    """The uppermost pixel row of a hip."""
    focal, _, cy, rotation, translation, *_ = camera
    highest = math.inf
    for row in rows:
        for hip in ("lhip", "rhip"):
            point = [row[f"{hip}_{axis}"] for axis in "xyz"]
            y, z = (sum(rotation[3 * r + k] * point[k] for k in range(3)) + translation[r] for r in (1, 2))
            highest = min(highest, focal * y / z + cy)
    return highest


def hide_legs(folder, out, seconds):
    """A scene file like the folder's, with the legs hidden; absolute paths."""
    scene = folder / "scene.yaml"
    if not seconds:
        return scene
    text = scene.read_text()
    truth = table(folder / "truth.csv")
    rows = [row for t, row in truth.items() if FROM - 1e-3 <= t / 1000 <= FROM + seconds + 1e-3 and row["lhip_x"] is not None]
    lines = ["occluders:"]
    names = [line.split("name: ")[1].split(",")[0] for line in text.splitlines() if line.startswith("  - {name: ")]
    for name, camera in zip(names, cameras_of(scene)):
        width, height, top = camera[5], camera[6], hip_row(camera, rows)
        corners = f"[[-1, {top:.0f}], [{width}, {top:.0f}], [{width}, {height}], [-1, {height}]]"
        lines.append(f"  {name}: [{{polygon: {corners}, from: {FROM - 0.001}, to: {FROM + seconds + 0.001:.3f}}}]")
    hidden = folder.resolve()
    for key in ("video: ", "calibration: ", "background: ", "truth: "):
        text = text.replace(key, f"{key}{hidden}/")
    path = out / "hidden" / f"{folder.name}_{seconds:g}.yaml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text + "\n".join(lines) + "\n")
    return path


def error_mm(truth, estimate, begin, end):
    errors = []
    for t, row in truth.items():
        other = estimate.get(t)
        if not begin <= t / 1000 <= end or other is None or other["pelvis_x"] is None or row["pelvis_x"] is None:
            continue
        errors.append(statistics.mean(math.dist([row[f"{j}_{a}"] for a in "xyz"], [other[f"{j}_{a}"] for a in "xyz"])
                                      for j in JOINTS))
    return 1000 * statistics.mean(errors) if errors else math.nan


def measure(walktrack, folder, scene, seconds, result, options):
    if not (result / "run.json").exists():
        run(walktrack, "track", scene, "-o", result, "--no-overlay", "--threads", 1, "-y", *options, allowed=(0, 4))
    truth, estimate = table(folder / "truth.csv"), table(result / "joints.csv")
    found = [t for t, row in estimate.items() if row["pelvis_x"] is not None]
    after = [row for t, row in estimate.items() if found and t >= found[0]]
    scored = json.loads(run(walktrack, "evaluate", folder / "truth.csv", result, "--json"))["estimates"][0] if found else {}
    span = (FROM - 1e-3, FROM + seconds + 1e-3) if seconds else (0, math.inf)
    return {"error_mm": error_mm(truth, estimate, *span),
            "lost_percent": 100 * statistics.mean(row["pelvis_x"] is None for row in after) if after else 100,
            **{name: scored.get(key) for name, key in FIGURES.items()}}


def middle(rows, column):
    values = [row[column] for row in rows if row.get(column) is not None and not math.isnan(row[column])]
    return (f"{statistics.median(values):.0f}", f"{statistics.mean(values):.0f}") if values else ("–", "–")


def print_table(rows, hidden):
    print("Joint error, mm: median (mean) over scenes and seeds")
    print("| model | clear |", " | ".join(f"legs hidden {s:g} s" for s in hidden), "| slide, clear, mm | legs exchanged, clear | lost frames, clear and hidden |")
    print("|---" * (5 + len(hidden)) + "|")
    for model in MODELS:
        mine = [row for row in rows if row["model"] == model]
        if not mine:
            continue
        of = lambda seconds: [row for row in mine if row["hidden"] == seconds]
        cells = ["{} ({})".format(*middle(of(s), "error_mm")) for s in (0, *hidden)]
        lost = statistics.mean(row["lost_percent"] for row in mine)
        print(f"| {model} |", " | ".join(cells), f"| {middle(of(0), 'slide_mm')[0]} | {middle(of(0), 'swapped_percent')[1]} % | {lost:.1f} % |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--walks", type=int, default=2)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--hidden", type=float, nargs="*", default=[0.3, 0.5, 1.0])
    parser.add_argument("--scenes", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--models", nargs="*", default=list(MODELS))
    words, options = sys.argv[1:], []
    if "--" in words:
        words, options = words[:words.index("--")], words[words.index("--") + 1:]
    arguments = parser.parse_args(words)
    walktrack, rows = arguments.walktrack.resolve(), []
    texts = (walk_options(i, arguments.walks) for i in range(arguments.walks))
    folders = [*rendered_walks(walktrack, arguments.out, texts), *arguments.scenes]
    for seed in range(1, arguments.seeds + 1):
        for folder in folders:
            for seconds in (0, *arguments.hidden):
                scene = hide_legs(folder, arguments.out, seconds)
                for model in arguments.models:
                    result = arguments.out / "results" / folder.name / f"{model}_{seconds:g}_{seed}"
                    figures = measure(walktrack, folder, scene, seconds, result,
                                      [*options, "--set", f"motion.model={model}", *MODELS[model], "--seed", seed])
                    rows.append({"scene": folder.name, "model": model, "hidden": seconds, "seed": seed, **figures})
        print(f"{seed} of {arguments.seeds} seeds", file=sys.stderr)
        with (arguments.out / "runs.csv").open("w", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    print_table(rows, arguments.hidden)


if __name__ == "__main__":
    main()
