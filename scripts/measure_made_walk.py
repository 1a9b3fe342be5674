#!/usr/bin/env python3
"""Measures how the walks of lib/synth/walk/made_walk.h walk: hip, knee and ankle over the stride, stance, clearance.

    scripts/measure_made_walk.py WALKTRACK OUT [--speeds 0.7 1.3 ...] [--walk 'lean_deg: 18, ...'] [--norms FILE]
    scripts/measure_made_walk.py WALKTRACK OUT --motion JOINTS.csv ... [--norms FILE]

Renders a walk of 8 s (subject of 1.75 m) for every speed and reads its truth, or reads motions with joint centres. FILE
holds mean and standard deviation of healthy people (percent, HipAngles_X_mean, HipAngles_X_sd, KneeAngles_..., ...): the
share of the stride within one of them is printed, as it is and after a constant was taken off (definitions of the
zero differ). Strikes and toe-offs are those of `walktrack analyse`. Prints Markdown. Standard library only.
"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess

POINTS = range(0, 101)
SHOWN = range(0, 100, 10)
ANGLES = {"hip": ("hip_flexion", "HipAngles"), "knee": ("knee_angle", "KneeAngles"), "ankle": ("ankle_angle", "AnkleAngles")}
HEEL, TIP, BALL = .23, .77, .49  # of the foot's length from the ankle: lib/body/subject.cpp, body.cpp


def table(path):
    with path.open(newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [{k: float(v) if v else math.nan for k, v in row.items()} for row in rows]


def run(*words):
    subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True)


def rendered(walktrack, folder, speed, options):
    folder.mkdir(parents=True, exist_ok=True)
    walk = ", ".join(filter(None, (f"speed: {speed}, start: [{-4 * speed}, 0]", options or "person: 0")))
    (folder / "options.yaml").write_text(f"""frame_rate: 100
duration: 8
images: true
walk: {{{walk}}}
subject: {{height: 1.75, mass: 70}}
cameras:
  - {{name: a, azimuth_deg: -90, distance: 9, height: 1, size: [16, 16], focal_px: 10}}
""")
    run(walktrack, "render", "--options", folder / "options.yaml", "-o", folder, "-y")
    return folder / "truth.csv"


def events(path):
    """(time, side, kind), in order of time, of gait.json."""
    found = []
    for row in json.loads(path.read_text())["contacts"]:
        for kind, column in (("strike", "foot_strike_s"), ("toe_off", "toe_off_s")):
            if row[column]["value"] is not None:
                found.append((row[column]["value"], row["side"][0], kind))
    return sorted(found)


def at(times, values, time):
    i = min(max(1, next((k for k, t in enumerate(times) if t >= time), len(times) - 1)), len(times) - 1)
    share = (time - times[i - 1]) / (times[i] - times[i - 1])
    return values[i - 1] + share * (values[i] - values[i - 1])


def strides(found, side):
    strikes = [t for t, s, kind in found if s == side and kind == "strike"]
    return list(zip(strikes, strikes[1:]))


def curve(times, values, cut):
    """Mean over the strides at every per cent."""
    return [statistics.mean(at(times, values, a + (b - a) * p / 100) for a, b in cut) for p in POINTS]


def lowest_sole(row, side, foot, ankle_height):
    """Height of the rigid foot's lowest point, heel or tip of the toes, from ankle and ball."""
    ahead = math.hypot(row[f"{side}toe_x"] - row[f"{side}ankle_x"], row[f"{side}toe_y"] - row[f"{side}ankle_y"])
    up = row[f"{side}toe_z"] - row[f"{side}ankle_z"]
    ball_height = .0125 / .039 * ankle_height
    pitch = math.atan2(ball_height - ankle_height, BALL * foot) - math.atan2(up, ahead)
    sole = row[f"{side}ankle_z"] - ankle_height * math.cos(pitch)
    return min(sole + HEEL * foot * math.sin(pitch), sole - TIP * foot * math.sin(pitch))


def measure(walktrack, truth, out):
    run(walktrack, "analyse", truth, "-o", out, "-y")
    rows, angles, found = table(truth), table(out / "angles.csv"), events(out / "gait.json")
    times = [row["t"] for row in rows]
    curves, shares, doubles, clear = {}, [], [], []
    for side in "lr":
        cut = strides(found, side)
        for name, (column, _) in ANGLES.items():
            of_side = curve([row["t"] for row in angles], [row[f"{column}_{side}_deg"] for row in angles], cut)
            curves[name] = [(a + b) / 2 for a, b in zip(curves[name], of_side)] if name in curves else of_side
        for a, b in cut:
            off = next(t for t, s, kind in found if s == side and kind == "toe_off" and t > a)
            others = [(t - a) / (b - a) for t, s, kind in found if s != side and a < t < b]
            shares.append((off - a) / (b - a))
            if len(others) == 2:
                doubles.append(others[0] + shares[-1] - others[1])
            middle = [row for row in rows if a + (b - a) * .75 < row["t"] < a + (b - a) * .90]
            clear.append(min(lowest_sole(row, side, .152 * 1.75, .039 * 1.75) for row in middle))
    leg = statistics.median(math.dist([r[f"lhip_{c}"] for c in "xyz"], [r[f"lknee_{c}"] for c in "xyz"])
                            + math.dist([r[f"lknee_{c}"] for c in "xyz"], [r[f"lankle_{c}"] for c in "xyz"])
                            for r in rows) + .039 * 1.75
    heights = [row["pelvis_z"] / leg for row in rows]
    way = math.hypot(rows[-1]["pelvis_x"] - rows[0]["pelvis_x"], rows[-1]["pelvis_y"] - rows[0]["pelvis_y"])
    return {"curves": curves, "stance": statistics.mean(shares), "double": statistics.mean(doubles), "clearance": min(clear),
            "low": min(heights), "high": max(heights), "speed": way / (times[-1] - times[0])}


def within(values, norms, columns):
    """Shares of the stride within one standard deviation: as it is, and best after a constant, which comes last."""
    mean = [row[f"{columns}_X_mean"] for row in norms]
    sd = [row[f"{columns}_X_sd"] for row in norms]
    share = lambda offset: sum(abs(v - offset - m) <= s for v, m, s in zip(values, mean, sd)) / len(mean)
    best = max((k / 4 for k in range(-80, 81)), key=lambda offset: (share(offset), -abs(offset)))
    return share(0), share(best), best


def show(name, figures, norms):
    print(f"\n{name}: {figures['speed']:.2f} m/s, stance {100 * figures['stance']:.1f} %, double support"
          f" {100 * figures['double']:.1f} %, pelvis {figures['low']:.3f} to {figures['high']:.3f} legs high, least height"
          f" of the sole in swing {1000 * figures['clearance']:.0f} mm\n")
    knee, ankle = figures["curves"]["knee"], figures["curves"]["ankle"]
    print(f"Knee: loaded {max(knee[5:31]):.0f}, least {min(knee[25:51]):.0f}, swing {max(knee[50:96]):.0f}; ankle: least"
          f" {min(ankle[:21]):.0f}, most {max(ankle[20:56]):.0f}, toe-off {min(ankle[50:81]):.0f}.\n")
    print("| % of the stride |", " | ".join(map(str, SHOWN)), "| least, at | most, at | within 1 SD |\n|---" + "|---:" * 12 + "|---|")
    for angle, values in figures["curves"].items():
        low, high = min(POINTS, key=values.__getitem__), max(POINTS, key=values.__getitem__)
        held = "" if norms is None else "{:.0%}; {:.0%} after {:+.1f}".format(*within(values, norms, ANGLES[angle][1]))
        print(f"| {angle} |", " | ".join(f"{values[p]:.0f}" for p in SHOWN),
              f"| {values[low]:.1f}, {low} | {values[high]:.1f}, {high} | {held} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--speeds", type=float, nargs="*", default=[0.6, 1.0, 1.3, 1.8])
    parser.add_argument("--walk", default="")
    parser.add_argument("--motion", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--norms", type=pathlib.Path)
    arguments = parser.parse_args()
    norms = table(arguments.norms) if arguments.norms else None
    if norms:
        for columns in ("HipAngles", "KneeAngles", "AnkleAngles"):
            print(f"norm, {columns}:", " ".join(f"{norms[p][columns + '_X_mean']:.0f}" for p in SHOWN))
    walktrack = arguments.walktrack.resolve()
    for motion in arguments.motion:
        show(motion.stem, measure(walktrack, motion, arguments.out / motion.stem), norms)
    for speed in arguments.speeds if not arguments.motion else []:
        folder = arguments.out / f"speed{speed}"
        show(f"made walk, {speed} m/s", measure(walktrack, rendered(walktrack, folder, speed, arguments.walk), folder / "analysed"), norms)


if __name__ == "__main__":
    main()
