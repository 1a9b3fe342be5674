#!/usr/bin/env python3
"""Measures what `walktrack optimise` gains: true joints with errors as other tools make them, before and after.

    scripts/measure_optimise.py WALKTRACK OUT SCENE_FOLDER [SCENE_FOLDER ...] [--draws N] [--cut S]

SCENE_FOLDER: truth.csv, scene.yaml (several cameras), scene_one_camera.yaml. The errors, on every axis of every joint:
30 mm, correlated over 0.1 s (a first-order process), and 12 mm without correlation; and a floor 40 mm too high. With
--cut the given motion lacks its first S seconds. Prints a Markdown table: errors of seven joints in mm, median over
the draws with the best and the worst. Standard library only.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import statistics
import subprocess

LASTING, PASSING, FLOOR = .030, .012, .040  # m
TIME = .1  # s


def with_errors(source, target, seed, cut):
    rows = list(csv.reader(line for line in source.read_text().splitlines() if not line.startswith("#")))
    names, rows = rows[0], [[float(cell) if cell else math.nan for cell in row] for row in rows[1:]]
    noise = random.Random(seed)
    keep = math.exp(-(rows[1][0] - rows[0][0]) / TIME)
    state = [noise.gauss(0, 1) for _ in names]
    with target.open("w", newline="") as file:
        out = csv.writer(file)
        out.writerow(names)
        for row in rows:
            state = [keep * s + math.sqrt(1 - keep * keep) * noise.gauss(0, 1) for s in state]
            moved = [value + LASTING * s + PASSING * noise.gauss(0, 1) + (FLOOR if name.endswith("_z") else 0)
                     for name, value, s in zip(names, row, state)]
            if row[0] >= cut:
                out.writerow([f"{row[0]:.6f}"] + ["" if math.isnan(v) else f"{v:.5f}" for v in moved[1:]])


def run(walktrack, *words):
    result = subprocess.run([walktrack, *map(str, words)], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise RuntimeError(f"{words[0]}: exit {result.returncode}: {result.stderr.strip()[-300:]}")
    return result.stdout


def joint_error(walktrack, truth, estimate):
    return json.loads(run(walktrack, "evaluate", truth, estimate, "--json"))["estimates"][0]["joint_error_mean_mm"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("walktrack")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--draws", type=int, default=10)
    parser.add_argument("--cut", type=float, default=0)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    print("| walk | given | without video | several cameras | one camera |\n|---|---|---|---|---|")
    for folder in args.folders:
        errors = [[] for _ in range(4)]
        for draw in range(1, args.draws + 1):
            given = args.out / f"{folder.name}_{draw}.csv"
            with_errors(folder / "truth.csv", given, draw, args.cut)
            made = [given]
            for kind, scene in [("none", []), ("several", [folder / "scene.yaml"]),
                                ("one", [folder / "scene_one_camera.yaml"])]:
                result = args.out / f"{folder.name}_{draw}_{kind}"
                run(args.walktrack, "optimise", given, *scene, "-o", result, "-y", "--no-overlay",
                    "--joint-sd-mm", 30)
                made.append(result)
            for values, result in zip(errors, made):
                values.append(joint_error(args.walktrack, folder / "truth.csv", result))
        cells = [f"{statistics.median(v):.0f} ({min(v):.0f} to {max(v):.0f})" for v in errors]
        print(f"| {folder.name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
