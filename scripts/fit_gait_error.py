#!/usr/bin/env python3
"""Fits the error sizes of lib/metrics/gait_error.cpp to people with truth, and prints the coverage of bands with and
without them.

    scripts/measure_gait.py WALKTRACK OUT --scenes FOLDER ...
    scripts/fit_gait_error.py OUT --scenes FOLDER ... [--others FOLDER ...]

Reads the output of measure_gait.py: gait.json of rendered walks and of their tracks. The present sizes are removed from
the bands first. For every size in gait_error.cpp the script prints the one with which 90 % bands contain the truth of the
FOLDERs 90 % of the time, where all cameras and the side camera count alike; and for every column the coverage of the
bands in the FOLDERs, the made walks and other folders, without sizes and with the present ones. Failed tracks are left out.
Standard library only.
"""
import argparse
import json
import math
import pathlib
import statistics

from fit_model_error import KINDS, QUANTILE, cameras_of, figure_variance, point, table
from measure_gait import SAME_CONTACT

LEGS = (("lknee", "rknee"), ("lankle", "rankle"))
FIGURE = 0.018  # kFigureError of lib/tracker/smooth/model_error.cpp, m
STRIKE, TOE_OFF, ACROSS_TO_WIDTH, LENGTH_NOISE, TIME_NOISE = 0.002, 0.006, 0.9, 0.02, 0.016  # lib/metrics/gait_error.cpp
CLEARANCE, PROGRESSION, ACROSS_TO_STRIKE, ACROSS_TO_BASE = 0.010, 0.21, 0.7, 0.8


def across_walk(scene, joints):
    """FigureError::across of lib/metrics/gait_error.h."""
    rows = [row for _, row in sorted(table(joints).items()) if point(row, "pelvis")]
    cameras, middle = cameras_of(scene), rows[len(rows) // 2]
    feet = [0.5 * (a + b) for a, b in zip(point(middle, "lankle"), point(middle, "rankle"))]
    variance = figure_variance(cameras, (point(middle, "head"), feet), FIGURE)  # axes taken for independent
    way = [b - a for a, b in zip(point(rows[0], "pelvis"), point(rows[-1], "pelvis"))]
    return math.sqrt((way[1] ** 2 * variance[0] + way[0] ** 2 * variance[1]) / (way[0] ** 2 + way[1] ** 2))


def unit_and_size(column, stride, across):
    """How much one unit of a size changes a column, and the size of today; None if it has none."""
    share = 100 / stride if stride else 0
    return {
        "foot_strike_s": (1, STRIKE), "toe_off_s": (1, TOE_OFF), "step_width_m": (across, ACROSS_TO_WIDTH),
        "toe_clearance_m": (1, CLEARANCE), "foot_progression_deg": (math.degrees(1), PROGRESSION),
        "width_at_strike_m": (across, ACROSS_TO_STRIKE), "walking_base_m": (across, ACROSS_TO_BASE),
        "stance_percent": (share, math.hypot(STRIKE, TOE_OFF)), "swing_percent": (share, math.hypot(STRIKE, TOE_OFF)),
        "double_support_percent": (2 * share, math.hypot(STRIKE, TOE_OFF)),
        "step_length_sd_m": (1, LENGTH_NOISE), "step_time_sd_s": (1, TIME_NOISE),
    }.get(column)


def same_contact(contacts, wanted):
    for event in ("foot_strike_s", "toe_off_s"):
        time = wanted[event]["value"]
        near = [(abs(row[event]["value"] - time), k) for k, row in enumerate(contacts) if time is not None
                and row["side"] == wanted["side"] and row[event]["value"] is not None]
        if near and min(near)[0] < SAME_CONTACT:
            return contacts[min(near)[1]]
    return None


def pairs(truth, estimate):
    """(kind of number, column, true value, band, stride time)."""
    for row in truth["contacts"]:
        other = same_contact(estimate["contacts"], row)
        for column in (k for k in row if other and isinstance(row[k], dict)):
            yield "step", column, row[column]["value"], other[column], other["stride_time_s"]["value"]
    for column, band in truth["summary"]["both"].items():
        both = estimate["summary"]["both"]
        yield "mean", column, band["value"], both[column], both["stride_time_s"]["value"]


def failed(folder, result):
    """Whether nobody was found, or left and right are swapped or half a metre off in more than one frame of twenty."""
    truth, joints = table(folder / "truth.csv"), table(result / "joints.csv")
    whole = lambda row: all(point(row, joint) for joint in ("pelvis", *sum(LEGS, ())))
    pairs = [(truth[t], row) for t, row in joints.items() if t in truth and whole(row) and whole(truth[t])]
    bad = 0
    for true, estimate in pairs:
        distance = lambda a, b: math.dist(point(estimate, a), point(true, b))
        same = sum(distance(l, l) + distance(r, r) for l, r in LEGS)
        crossed = sum(distance(l, r) + distance(r, l) for l, r in LEGS)
        bad += crossed < same or distance("pelvis", "pelvis") > 0.5
    return not pairs or bad > 0.05 * len(pairs)


def rows_of_walk(scene, result):
    """{(kind, column): [(error, reach down, reach up, unit)]}: without the sizes of today."""
    truth, estimate = (json.loads((folder / "gait.json").read_text()) for folder in (result / "truth", result))
    across = across_walk(scene, result / "joints.csv")
    out = {}
    for kind, column, true, band, stride in pairs(truth, estimate):
        if None in (true, band["value"], band["p05"]):
            continue
        unit, size = unit_and_size(column, stride, across) or (0, 0)
        less = (QUANTILE * unit * size) ** 2
        reach = (math.sqrt(max(0, (band["value"] - band[end]) ** 2 - less)) for end in ("p05", "p95"))
        out.setdefault((kind, column), []).append((band["value"] - true, *reach, unit))
    return out


def held(rows, size):
    return statistics.mean(-math.hypot(up, QUANTILE * unit * size) <= error <= math.hypot(down, QUANTILE * unit * size)
                           for error, down, up, unit in rows)


def mean_held(kinds, size):
    """kinds: {kind of cameras: [rows of all walks]}."""
    return statistics.mean(held(rows, size) for rows in kinds.values()) if kinds else math.nan


def fitted(kinds):
    low, high = 0.0, 3.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mean_held(kinds, middle) < 0.9 else (low, middle)
    return high


def rows_of(out, folders):
    """{(kind, column): {kind of cameras: rows}}"""
    all_rows = {}
    for folder in folders:
        for kind in KINDS:
            scene, result = folder / f"{kind}.yaml", out / "results" / folder.name / kind
            if not (result / "gait.json").exists() or failed(folder, result):
                print(f"left out: {folder.name}, {kind}")
                continue
            for key, rows in rows_of_walk(scene, result).items():
                all_rows.setdefault(key, {}).setdefault(kind, []).extend(rows)
    return all_rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scenes", type=pathlib.Path, nargs="*", required=True)
    parser.add_argument("--others", type=pathlib.Path, nargs="*", default=[])
    arguments = parser.parse_args()
    groups = {"fitted": rows_of(arguments.out, arguments.scenes),
              "made": rows_of(arguments.out, sorted((arguments.out / "scenes").iterdir())),
              "others": rows_of(arguments.out, arguments.others)}
    percent = lambda share: "-" if math.isnan(share) else f"{100 * share:.0f}"
    for kind, column in groups["fitted"]:
        unit_size = unit_and_size(column, 1, 1)
        size = unit_size[1] if unit_size else 0
        said = [f"{name}, {cameras} {percent(held(rows, size))} ({percent(held(rows, 0))})"
                for name, group in groups.items() for cameras, rows in sorted(group.get((kind, column), {}).items())]
        best = f"{fitted(groups['fitted'][kind, column]):.4f} of today {size}" if unit_size else "none"
        print(f"{kind} {column}: size {best}; held with it (without), %: " + "; ".join(said))


if __name__ == "__main__":
    main()
