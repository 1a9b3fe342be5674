#!/usr/bin/env python3
"""Fits the error sizes of lib/tracker/smooth/model_error.cpp to walks with truth.

    scripts/measure_gait.py WALKTRACK OUT --walks 40 [--scenes FOLDER ...] -- --set track.model_error=0
    scripts/fit_model_error.py OUT [--scenes FOLDER ...] [--figure 0.02]

Reads the output of measure_gait.py: rendered scenes with truth, and tracks whose bands are those of the trajectory alone.
For each joint, over the ground and upwards, and for each angle, prints the standard deviation with which, added to that
of the draws, 90 % bands contain the truth 90 % of the time: the mean over all cameras and the side camera alone, which
count alike. The sizes are fitted to the FOLDERs, which are of people. Made walks, whose body is the tracker's, are shown
beside them and are fitted only where there is no truth of people: angles, for a coverage of 94 %, because people deviate
more. Failed tracks count. Standard library only.
"""
import argparse
import csv
import math
import pathlib
import re
import statistics

JOINTS = ("pelvis", "neck", "head", "lhip", "lknee", "lankle", "ltoe", "rhip", "rknee", "rankle", "rtoe")
QUANTILE = 1.645
KINDS = {"scene": None, "scene_one_camera": 1}  # cameras used, in the scene's order


def table(path):
    """Rows as {column: number or None}, by time in ms."""
    with path.open(newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        read = [{k: float(v) if v else None for k, v in row.items()} for row in rows]
    return {round(1000 * row["t"]): row for row in read}


def cameras_of(scene):
    """(focal, cx, cy, rotation, translation, width, height) of each camera that scene.yaml lists."""
    out = []
    for name in re.findall(r"calibration: (\S+?\.yaml)", scene.read_text()):
        text = (scene.parent / name).read_text()
        data = lambda key: [float(x) for x in re.search(key + r":.*?data: \[(.*?)\]", text, re.S).group(1).split(",")]
        size = [int(re.search(rf"image_{side}: (\d+)", text).group(1)) for side in ("width", "height")]
        k = data("camera_matrix")
        out.append((k[0], k[2], k[5], data("rotation"), data("translation"), *size))
    return out


def inverse(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    rows = [[e * i - f * h, c * h - b * i, b * f - c * e], [f * g - d * i, a * i - c * g, c * d - a * f], [d * h - e * g, b * g - a * h, a * e - b * d]]
    return [[value / det for value in row] for row in rows]


def product(a, b):
    return [[sum(a[r][k] * b[k][c] for k in range(3)) for c in range(3)] for r in range(3)]


def summed(*matrices):
    return [[sum(m[r][c] for m in matrices) for c in range(3)] for r in range(3)]


def figure_variance(cameras, ends, figure):
    """The diagonal of figure_covariance() of lib/tracker/smooth/model_error.h; the lens' bending left out."""
    unseen = [[figure**2 * (r == c) for c in range(3)] for r in range(3)]
    seen = [[[0.0] * 3 for _ in range(3)] for _ in ends]
    for focal, cx, cy, rotation, translation, width, height in cameras:
        for info, end in zip(seen, ends):
            x, y, z = (sum(rotation[3 * r + k] * end[k] for k in range(3)) + translation[r] for r in range(3))
            if z < 0.01 or not (0 <= focal * x / z + cx < width and 0 <= focal * y / z + cy < height):
                continue
            rows = [[rotation[3 * r + k] - flat / z * rotation[6 + k] for k in range(3)] for r, flat in ((0, x), (1, y))]
            for r in range(3):
                for c in range(3):
                    info[r][c] += sum(row[r] * row[c] for row in rows)
    fitted = inverse(summed(unseen, *seen))
    covariance = product(product(fitted, summed(unseen, *(product(info, info) for info in seen))), fitted)
    return [figure**2 * covariance[k][k] for k in range(3)]


def point(row, joint):
    at = [row.get(f"{joint}_{axis}") for axis in "xyz"]
    return None if None in at else at


def group(name):
    """Left and right are one."""
    return re.sub(r"^[lr](?=hip|knee|ankle|toe)|_[lr](?=_deg)", "", name)


def errors_of(folder, scene, result, figure):
    """{(group, 'level' | 'upright' | 'angle'): [(error, down, up, variance)]}: down and up, how far the particles'
    band reaches; variance, of the figure as a whole."""
    truth, joints, bands = table(folder / "truth.csv"), table(result / "joints.csv"), table(result / "uncertainty.csv")
    times = [t for t, row in joints.items() if t in truth and point(row, "pelvis")]
    if not times:
        return None
    cameras, out = cameras_of(scene), {}
    for t in times:
        row, band = joints[t], bands[t]
        feet = [0.5 * (a + b) for a, b in zip(point(row, "lankle"), point(row, "rankle"))]
        common = figure_variance(cameras, (point(row, "head"), feet), figure)
        for joint in JOINTS:
            for axis, variance in zip("xyz", common):
                name = f"{joint}_{axis}"
                if truth[t].get(name) is not None:
                    rows = out.setdefault((group(joint), "upright" if axis == "z" else "level"), [])
                    rows.append((row[name] - truth[t][name], row[name] - band[name + "_p05"], band[name + "_p95"] - row[name], variance))
    if not (folder / "angles.csv").exists():  # truth of joints alone
        return out
    true_angles, angles = table(folder / "angles.csv"), table(result / "angles.csv")
    for t in times:
        for name in (k for k in true_angles[t] if k.endswith("_deg")):
            if true_angles[t][name] is not None and angles[t].get(name) is not None:
                off = (angles[t][name] - true_angles[t][name] + 180) % 360 - 180
                low, high = angles[t][name + "_p05"], angles[t][name + "_p95"]
                out.setdefault((group(name), "angle"), []).append((off, angles[t][name] - low, high - angles[t][name], 0))
    return out


def coverage(rows, sd):
    def holds(error, down, up, variance):
        added = QUANTILE * math.sqrt(variance + sd**2)
        return -math.hypot(max(0, up), added) <= error <= math.hypot(max(0, down), added)
    return sum(holds(*row) for row in rows) / len(rows)


def fitted(walks, held):
    """walks: {kind: [rows of one walk]}."""
    people = {kind: of for kind, of in walks.items() if kind[0] == "given"} or walks
    mean = lambda sd: statistics.mean(statistics.mean(coverage(rows, sd) for rows in of) for of in people.values())
    low, high = 0.0, 1.0 if mean(1.0) >= held else 90.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mean(middle) < held else (low, middle)
    return high, {kind: 100 * statistics.mean(coverage(rows, high) for rows in of) for kind, of in walks.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scenes", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--figure", type=float, default=0.018, help="kFigureError, m")
    arguments = parser.parse_args()
    walks, left_out = {}, []
    made = [("made", folder) for folder in sorted((arguments.out / "scenes").iterdir())]
    for origin, folder in [*made, *(("given", folder) for folder in arguments.scenes)]:
        for kind in KINDS:
            errors = errors_of(folder, folder / f"{kind}.yaml", arguments.out / "results" / folder.name / kind, arguments.figure)
            if errors is None:
                left_out.append(f"{folder.name} ({kind})")
                continue
            for key, rows in errors.items():
                walks.setdefault(key, {}).setdefault((origin, kind), []).append(rows)
    print("nobody found:", ", ".join(left_out) or "none")
    for (name, what), kinds in sorted(walks.items(), key=lambda item: (item[0][1] == "angle", item[0])):
        people = any(origin == "given" for origin, _ in kinds)
        sd, shares = fitted(kinds, 0.9 if people or not arguments.scenes else 0.94)
        size = f"{sd:.1f} deg" if what == "angle" else f"{1000 * sd:.0f} mm"
        print(f"{name} {what}: {size}; held", ", ".join(f"{origin}, {kind}: {s:.0f} %" for (origin, kind), s in shares.items()))


if __name__ == "__main__":
    main()
