#!/usr/bin/env python3
"""Measures what 90 % bands hold, on the runs of scripts/measure_results.py, and whether their sizes were fitted on those
videos (tests/figures/figures.toml lists what constants were fitted on).

    scripts/measure_bands.py WALKTRACK OUT_OF_MEASURE_RESULTS

Prints a Markdown table; runs that failed a quality check count. Standard library only.
"""
import json
import pathlib
import statistics
import sys

from measure_gates import run
from measure_results import OLD, ONE, PATIENTS, RENDERED, STRAIGHT, THREE, TURN

QUOTED = ("SubjectA11_Cycle1", "SubjectB11_Cycle1", "SubjectD4_Cycle1")
FITTED = ("SubjectA1_Cycle1", "SubjectA2_Cycle1", "SubjectC12_Cycle1")
GROUPS = [
    ("three patients, three cameras", [PATIENTS / s / THREE for s in QUOTED], "no"),
    ("the same, the side camera alone", [PATIENTS / s / ONE for s in QUOTED], "no"),
    ("the patients of the fit, the side camera alone", [PATIENTS / s / ONE for s in FITTED], "yes"),
    ("motion capture, three cameras", [RENDERED / s / THREE for s in (OLD, TURN, *STRAIGHT)], "no"),
    ("motion capture, the side camera alone", [RENDERED / s / ONE for s in (OLD, TURN, *STRAIGHT)], "no"),
]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    walktrack, out = sys.argv[1], pathlib.Path(sys.argv[2])
    print("| video | coordinates that 90 % bands hold, by video | mean width | calibration error | sizes fitted on it |\n|---|---|---:|---:|---|")
    for what, scenes, fitted in GROUPS:
        held, widths, errors = [], [], []
        for scene in scenes:
            results = sorted((out / f"{scene.parent.name}_{scene.stem}").glob("*/run.json"))
            scores = [json.loads(run(walktrack, "evaluate", scene.parent / "truth.csv", result.parent, "--json").stdout)
                      ["estimates"][0] for result in results]
            if not scores:
                sys.exit(f"no results of {scene} in {out}: scripts/measure_results.py makes them")
            held.append(f"{statistics.median(s['coverage90_percent'] for s in scores):.0f}")
            widths += [s["interval_width_mm"] for s in scores]
            errors += [s["calibration_error"] for s in scores]
        print(f"| {what} | {' '.join(held)} % | {statistics.mean(widths):.0f} mm | {statistics.mean(errors):.2f} | {fitted} |")


if __name__ == "__main__":
    main()
