#!/usr/bin/env python3
"""Measures what the report draws grey: ankle angles of tracked videos, on the runs of scripts/measure_results.py, and
vertical loads, on two trials with force plates (scripts/measure_forces.py).

    scripts/measure_rough.py WALKTRACK OUT OUT_OF_MEASURE_RESULTS

Prints a Markdown table. Standard library only.
"""
import json
import pathlib
import sys

import measure_forces
from measure_gates import run
from measure_results import OLD, ONE, RENDERED, STRAIGHT, THREE, TURN

TRIALS = ("opencapS4_walking1", "opencapS4_walkingTS1")
DATA = RENDERED.parent
SEEDS = range(1, 7)  # six, as the table says
FIRST_S = 0.15  # before, a foot stands off the plates


def ankles(walktrack, results, scene):
    """Rms of both ankles against the truth, by seed, degrees."""
    runs = sorted((results / f"{scene.parent.name}_{scene.stem}").glob("*/run.json"))
    if not runs:
        sys.exit(f"no results of {scene} in {results}: scripts/measure_results.py makes them")
    for each in runs:
        score = json.loads(run(walktrack, "evaluate", scene.parent / "truth.csv", each.parent, "--json").stdout)["estimates"][0]
        yield from (score[f"angle_{side}ankle_dorsiflexion_rms_deg"] for side in "lr")


def loads(walktrack, out, trial):
    """Of the vertical load, % of body weight: tracked, by seed, and taken for the weight."""
    plates = measure_forces.storage(DATA / f"grf/{trial}.mot")
    folder = out / trial
    folder.mkdir(parents=True, exist_ok=True)
    mass, _ = measure_forces.measure(walktrack, out, DATA / f"mocap/{trial}.csv", plates, FIRST_S)
    weight = mass * measure_forces.GRAVITY
    tracked = []
    for seed in SEEDS:
        result = folder / f"seed_{seed}"
        if not (result / "run.json").exists():
            run(walktrack, "track", folder / "scene/scene.yaml", "-o", result, "-y", "--no-overlay", "--seed", seed, "--threads", 1, allowed=(0, 4))
        whole = list(measure_forces.pairs(plates, measure_forces.storage(result / "ground_reaction.mot"), FIRST_S))
        tracked.append(measure_forces.rmse(whole, weight))
    return tracked, measure_forces.rmse([(a, weight) for a, _ in whole], weight)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    walktrack, out, results = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    found = [(walktrack, results, RENDERED / name / scene) for name in (*STRAIGHT, OLD, TURN) for scene in (THREE, ONE)]
    angles = [angle for words in found for angle in ankles(*words)]
    by_trial, still = zip(*(loads(walktrack, out, trial) for trial in TRIALS))
    tracked = [load for trial in by_trial for load in trial]
    print("| what | of | off by, rms |\n|---|---|---:|")
    print(f"| ankle angle | four walks of motion capture, three cameras and one | {min(angles):.0f} to {max(angles):.0f}° |")
    print(f"| vertical load | two trials on force plates, three cameras, six seeds | {min(tracked):.0f} to {max(tracked):.0f} % of body weight |")
    print(f"| the same, mean | | {sum(tracked) / len(tracked):.0f} % |")
    print(f"| the weight for the load | the same | {min(still):.0f} to {max(still):.0f} % of body weight |")


if __name__ == "__main__":
    main()
