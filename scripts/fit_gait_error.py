#!/usr/bin/env python3
"""Fits the sizes of lib/metrics/gait_error.cpp to walks with truth, and says what bands hold with them.

    scripts/measure_gait.py WALKTRACK OUT -- --set track.model_error=0
    scripts/fit_gait_error.py OUT

Reads what measure_gait.py left: gait.json of rendered walks and of their tracks, whose bands are the particles' alone.
For each number of a step and each mean of a walk prints the standard deviation that, added to the particles' band and
to what the cameras leave open, makes 90 % bands hold the truth 90 % of the time: the mean over walks, all cameras and
the side camera counting alike. Fitted are the walks made of footprints (even numbers) that did not fail; the share
held by the others, gaits of the kneed walker, stands beside it. Standard library only.
"""
import argparse
import json
import math
import pathlib
import statistics

from fit_model_error import KINDS, QUANTILE, cameras_of, errors_of, figure_variance, point, table
from measure_gait import SAME_CONTACT

FIGURE = 0.02  # kFigureError of lib/tracker/model_error.cpp, m
ACROSS_TO_WIDTH = 0.57  # kAcrossToWidth of lib/metrics/gait_error.cpp
SHARING_SCALE = ("step_length_m", "stride_length_m", "speed_m_s")


def figure_error(scene, joints):
    """(scale, across) of FigureError in lib/metrics/gait_error.h."""
    rows = [row for _, row in sorted(table(joints).items()) if point(row, "pelvis")]
    cameras, middle = cameras_of(scene), rows[len(rows) // 2]
    feet = [0.5 * (a + b) for a, b in zip(point(middle, "lankle"), point(middle, "rankle"))]
    variance = figure_variance(cameras, (point(middle, "head"), feet), FIGURE)  # axes taken for independent
    scales = []
    for _, _, _, rotation, translation, _, _ in cameras:
        centre = [-sum(rotation[3 * k + i] * translation[k] for k in range(3)) for i in range(3)]
        ray = [p - c for p, c in zip(point(middle, "pelvis"), centre)]
        distance = math.hypot(*ray)
        scales.append(math.sqrt(sum((r / distance) ** 2 * v for r, v in zip(ray, variance))) / distance)
    way = [b - a for a, b in zip(point(rows[0], "pelvis"), point(rows[-1], "pelvis"))]
    across = math.sqrt((way[1] ** 2 * variance[0] + way[0] ** 2 * variance[1]) / (way[0] ** 2 + way[1] ** 2))
    return min(scales), across


def known_part(column, value, scale, across):
    """What the cameras leave open of a number."""
    if column in SHARING_SCALE:
        return scale * value
    return ACROSS_TO_WIDTH * across if column == "step_width_m" else 0


def same_contact(contacts, wanted):
    for event in ("foot_strike_s", "toe_off_s"):
        time = wanted[event]["value"]
        near = [(abs(row[event]["value"] - time), k) for k, row in enumerate(contacts) if time is not None
                and row["side"] == wanted["side"] and row[event]["value"] is not None]
        if near and min(near)[0] < SAME_CONTACT:
            return contacts[min(near)[1]]
    return None


def pairs(truth, estimate):
    """(kind of number, column, true value, band)."""
    for row in truth["contacts"]:
        other = same_contact(estimate["contacts"], row)
        for column in (k for k in row if other and isinstance(row[k], dict)):
            yield "step", column, row[column]["value"], other[column]
    for column, band in truth["summary"]["both"].items():
        yield "mean", column, band["value"], estimate["summary"]["both"][column]


def errors_of_walk(scene, result):
    """{(kind, column): [(error, reach down, reach up, known part)]}"""
    truth, estimate = (json.loads((folder / "gait.json").read_text()) for folder in (result / "truth", result))
    scale, across = figure_error(scene, result / "joints.csv")
    out = {}
    for kind, column, true, band in pairs(truth, estimate):
        if None in (true, band["value"], band["p05"]):
            continue
        reach = (band["value"] - band["p05"], band["p95"] - band["value"])
        out.setdefault((kind, column), []).append((band["value"] - true, *reach, known_part(column, band["value"], scale, across)))
    return out


def held(rows, sd):
    reach = lambda side, known: math.hypot(side, QUANTILE * math.hypot(sd, known))
    return statistics.mean(-reach(up, known) <= error <= reach(down, known) for error, down, up, known in rows)


def mean_held(walks, sd):
    return statistics.mean(statistics.mean(held(rows, sd) for rows in of) for of in walks.values()) if walks else math.nan


def fitted(walks):
    low, high = 0.0, 30.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mean_held(walks, middle) < 0.9 else (low, middle)
    return high


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    out = parser.parse_args().out
    fit, unseen = {}, {}
    for number, folder in enumerate(sorted((out / "scenes").iterdir())):
        for kind in KINDS:
            scene, result = folder / f"{kind}.yaml", out / "results" / folder.name / kind
            if number % 2 == 0 and errors_of(folder, scene, result, FIGURE) is None:
                continue
            for key, rows in errors_of_walk(scene, result).items():
                (unseen if number % 2 else fit).setdefault(key, {}).setdefault(kind, []).append(rows)
    for key, walks in fit.items():
        sd, others = fitted(walks), unseen.get(key, {})
        print(f"{' '.join(key)}: {sd:.4f}; held {100 * mean_held(walks, sd):.0f} % (without {100 * mean_held(walks, 0):.0f} %), "
              f"unseen {100 * mean_held(others, sd):.0f} % ({100 * mean_held(others, 0):.0f} %)")


if __name__ == "__main__":
    main()
