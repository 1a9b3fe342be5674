#!/usr/bin/env python3
"""Fits the sizes of lib/metrics/gait_error.cpp to walks with truth, and says what bands hold with them.

    scripts/measure_gait.py WALKTRACK OUT [--scenes FOLDER ...] -- --set track.model_error=0
    scripts/fit_gait_error.py OUT [--scenes FOLDER ...]

Reads what measure_gait.py left: gait.json of rendered walks and of their tracks, whose bands are the particles' alone.
For each number of a step and each mean of a walk prints the standard deviation that, added to the particles' band and
to what the cameras leave open, makes 90 % bands hold the truth 90 % of the time: the mean over walks, all cameras and
the side camera counting alike. Fitted are the walks made of footprints (even numbers) that did not fail. What is held
is said of halves of them fitted to the other half, and, fitted to all of them, of the walker's own gaits and of
FOLDERs, failures counted, with three cameras and with one. Standard library only.
"""
import argparse
import json
import math
import pathlib
import statistics

from fit_model_error import KINDS, QUANTILE, cameras_of, figure_variance, point, table
from measure_gait import SAME_CONTACT

LEGS = (("lknee", "rknee"), ("lankle", "rankle"))
FIGURE = 0.02  # kFigureError of lib/tracker/smooth/model_error.cpp, m
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


def failed(folder, result):
    """Nobody, or legs exchanged or half a metre off in more than one frame in twenty."""
    truth, joints = table(folder / "truth.csv"), table(result / "joints.csv")
    pairs = [(truth[t], row) for t, row in joints.items() if t in truth and point(row, "pelvis")]
    bad = 0
    for true, estimate in pairs:
        distance = lambda a, b: math.dist(point(estimate, a), point(true, b))
        same = sum(distance(l, l) + distance(r, r) for l, r in LEGS)
        crossed = sum(distance(l, r) + distance(r, l) for l, r in LEGS)
        bad += crossed < same or distance("pelvis", "pelvis") > 0.5
    return not pairs or bad > 0.05 * len(pairs)


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
    """Walks: {kind of cameras: [rows of one walk]}."""
    return statistics.mean(statistics.mean(held(rows, sd) for rows in of) for of in walks.values()) if walks else math.nan


def fitted(walks):
    low, high = 0.0, 30.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mean_held(walks, middle) < 0.9 else (low, middle)
    return high


def joined(*halves):
    return {kind: [rows for half in halves for rows in half.get(kind, [])] for kind in KINDS}


def crosswise(halves):
    """Mean share held of either half, fitted to the other."""
    return statistics.mean(mean_held(halves[1 - k], fitted(halves[k])) for k in (0, 1))


def groups_of(out, scenes):
    """{name of a group: {(kind, column): {cameras: [rows of one walk]}}}: halves 0 and 1, gaits, videos."""
    groups = {0: {}, 1: {}, "gaits": {}, "videos": {}}
    for folder in [*sorted((out / "scenes").iterdir()), *scenes]:
        number = -1 if folder in scenes else int(folder.name.removeprefix("walk"))
        group = "videos" if number < 0 else "gaits" if number % 2 else number // 2 % 2
        for kind in KINDS:
            scene, result = folder / f"{kind}.yaml", out / "results" / folder.name / kind
            if not (result / "gait.json").exists():
                continue
            if group in (0, 1) and failed(folder, result):
                print(f"left out: {folder.name}, {kind}")
                continue
            for key, rows in errors_of_walk(scene, result).items():
                groups[group].setdefault(key, {}).setdefault(kind, []).append(rows)
    return groups


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scenes", type=pathlib.Path, nargs="*", default=[])
    arguments = parser.parse_args()
    groups = groups_of(arguments.out, arguments.scenes)
    percent = lambda share: "-" if math.isnan(share) else f"{100 * share:.0f} %"
    shares = {}  # (kind of number, what): shares held of each column
    for key in groups[0]:
        halves = [groups[half].get(key, {}) for half in (0, 1)]
        if set(halves[0]) != set(halves[1]):
            continue
        both = joined(*halves)
        sd = fitted(both)
        said = {"footprints": (mean_held(both, 0), mean_held(both, sd)), "halves": (math.nan, crosswise(halves))}
        for group, kind in ((g, k) for g in ("videos", "gaits") for k in KINDS):
            rows = {kind: groups[group].get(key, {}).get(kind)}
            said[f"{group}, {kind}"] = (mean_held(rows, 0), mean_held(rows, sd)) if rows[kind] else (math.nan, math.nan)
        print(f"{' '.join(key)}: {sd:.4f}; " + "; ".join(f"{what} {percent(b)} ({percent(a)})" for what, (a, b) in said.items()))
        for what, pair in said.items():
            shares.setdefault((key[0], what), []).append(pair)
    for (kind, what), pairs in shares.items():
        mean = lambda values: statistics.mean(values) if values else math.nan
        a, b = (mean([pair[k] for pair in pairs if not math.isnan(pair[k])]) for k in (0, 1))
        print(f"numbers of a {kind}, {what}: {percent(b)} ({percent(a)})")


if __name__ == "__main__":
    main()
