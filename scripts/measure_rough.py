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
    """Of the vertical load, % of body weight: tracked, and taken for the weight."""
    plates = measure_forces.storage(DATA / f"grf/{trial}.mot")
    folder = out / trial
    folder.mkdir(parents=True, exist_ok=True)
    mass, _ = measure_forces.measure(walktrack, out, DATA / f"mocap/{trial}.csv", plates, FIRST_S)
    weight = mass * measure_forces.GRAVITY
    whole = list(measure_forces.pairs(plates, measure_forces.storage(folder / "tracked/ground_reaction.mot"), FIRST_S))
    return measure_forces.rmse(whole, weight), measure_forces.rmse([(a, weight) for a, _ in whole], weight)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    walktrack, out, results = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    found = [(walktrack, results, RENDERED / name / scene) for name in (*STRAIGHT, OLD, TURN) for scene in (THREE, ONE)]
    angles = [angle for words in found for angle in ankles(*words)]
    tracked, still = zip(*(loads(walktrack, out, trial) for trial in TRIALS))
    print("| what | of | off by, rms |\n|---|---|---:|")
    print(f"| ankle angle | four walks of motion capture, three cameras and one | {min(angles):.0f} to {max(angles):.0f}° |")
    print(f"| vertical load | two trials on force plates, three cameras | {min(tracked):.0f} to {max(tracked):.0f} % of body weight |")
    print(f"| the weight for the load | the same | {min(still):.0f} to {max(still):.0f} % of body weight |")


if __name__ == "__main__":
    main()
