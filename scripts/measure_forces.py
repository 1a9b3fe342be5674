#!/usr/bin/env python3
"""Compares ground reactions with force plates: those of motion capture, and those of a video rendered of it and
tracked.

    scripts/measure_forces.py WALKTRACK OUT MOTION.csv PLATES.mot [MOTION.csv PLATES.mot ...] [--from S]

MOTION: joint centres (joints.csv); PLATES: columns ground_force_1_vy (right foot) and ground_force_2_vy (left),
equal times. Body weight is what the plates carry. Before --from (default 0.15 s) a foot stands off the plates.
Prints a Markdown table. Standard library only.
"""
import argparse
import bisect
import json
import math
import pathlib
import subprocess

GRAVITY = 9.80665
LOADED = 20  # N, the usual threshold of contact
OPTIONS = """frame_rate: 60
subject: {{height: {height:.3f}, mass: {mass:.2f}}}
setting: room
sensor: {{noise: 0.008, flicker: 0.005}}
background_frames: 20
cameras:
  - {{name: side, azimuth_deg: -90, distance: 4, height: 1.2, focal_px: 620}}
  - {{name: front, azimuth_deg: -25, distance: 5, height: 1.8, focal_px: 680}}
  - {{name: back, azimuth_deg: 150, distance: 5, height: 1.8, focal_px: 680}}
"""


def run(walktrack, *words, allowed=(0,)):
    result = subprocess.run([walktrack, *map(str, words)], capture_output=True, text=True, check=False)
    if result.returncode not in allowed:
        raise RuntimeError(f"{words[0]}: exit {result.returncode}: {result.stderr.strip()[-300:]}")


def storage(path):
    """Columns of an OpenSim storage file by name."""
    lines = path.read_text().split("endheader\n", 1)[1].splitlines()
    columns = zip(*([float(cell) for cell in line.split("\t")] for line in lines[1:] if line))
    return dict(zip(lines[0].split("\t"), columns))


def at(table, column, time):
    """Between its rows; None outside them and in gaps longer than 0.1 s."""
    times = table["time"]
    i = bisect.bisect_left(times, time)
    if i < len(times) and abs(times[i] - time) < 1e-6:
        return table[column][i]
    if i == 0 or i == len(times) or times[i] - times[i - 1] > 0.1:
        return None
    share = (time - times[i - 1]) / (times[i] - times[i - 1])
    return table[column][i - 1] + share * (table[column][i] - table[column][i - 1])


def pairs(plates, reaction, first, feet=("r", "l")):
    """(plates, estimate) of the vertical force of the feet together, where both are known."""
    number = {"r": 1, "l": 2}
    for i, time in enumerate(plates["time"]):
        estimate = [at(reaction, f"ground_force_{foot}_vy", time) for foot in feet]
        if time >= first and None not in estimate:
            yield sum(plates[f"ground_force_{number[foot]}_vy"][i] for foot in feet), sum(estimate)


def rmse(values, weight):
    values = list(values)
    return 100 * math.sqrt(sum((a - b) ** 2 for a, b in values) / len(values)) / weight


def changes(table, column, first=-math.inf):
    """(time, whether the foot was put down) of each crossing of the threshold, between the rows."""
    force, times = table[column], table["time"]
    for i in range(1, len(force)):
        if (force[i] > LOADED) != (force[i - 1] > LOADED) and times[i] >= first:
            share = (LOADED - force[i - 1]) / (force[i] - force[i - 1])
            yield times[i - 1] + share * (times[i] - times[i - 1]), force[i] > LOADED


def late(plates, reaction, first):
    """Mean |lateness| of contacts put down and lifted, s, and how many of how many were found within 0.2 s."""
    found, count = [], 0
    for foot, number in (("r", 1), ("l", 2)):
        ours = list(changes(reaction, f"ground_force_{foot}_vy"))
        for time, down in changes(plates, f"ground_force_{number}_vy", first):
            count += 1
            near = [abs(t - time) for t, d in ours if d == down and abs(t - time) < 0.2]
            found += [min(near)] if near else []
    return (f"{1000 * sum(found) / len(found):.0f} ms" if found else "–") + f" ({len(found)} of {count})"


def measure(walktrack, out, motion, plates, first):
    """The subject's mass and the table's rows."""
    folder = out / motion.stem
    run(walktrack, "analyse", motion, "-o", folder / "captured", "-y", "--mass", 70)
    numbers = json.loads((folder / "captured/run.json").read_text())["numbers"]
    together = list(pairs(plates, storage(folder / "captured/ground_reaction.mot"), first))
    mass = 70 * sum(a for a, _ in together) / sum(b for _, b in together)
    run(walktrack, "analyse", motion, "-o", folder / "captured", "-y", "--mass", mass)
    if not (folder / "scene/scene.yaml").exists():
        folder.joinpath("options.yaml").write_text(OPTIONS.format(height=numbers["height_m"], mass=mass))
        run(walktrack, "render", motion, "--options", folder / "options.yaml", "-o", folder / "scene", "-y", "--threads", 1)
    if not (folder / "tracked/run.json").exists():
        run(walktrack, "track", folder / "scene/scene.yaml", "-o", folder / "tracked", "-y", "--no-overlay", "--threads", 1, allowed=(0, 4))
    rows = []
    for name, result in (("motion capture", "captured"), ("tracked video", "tracked")):
        reaction, weight = storage(folder / result / "ground_reaction.mot"), mass * GRAVITY
        whole = list(pairs(plates, reaction, first))
        feet = [rmse(pairs(plates, reaction, first, foot), weight) for foot in ("r", "l")]
        rows.append(f"| {motion.stem}, {name} | {rmse(whole, weight):.1f} | {feet[0]:.1f}, {feet[1]:.1f} | {late(plates, reaction, first)} "
              f"| {len(whole)} of {sum(t >= first for t in plates['time'])} |")
    return mass, rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("trials", type=pathlib.Path, nargs="+", metavar="MOTION.csv PLATES.mot")
    parser.add_argument("--from", dest="first", type=float, default=0.15)
    arguments = parser.parse_args()
    print("| | vertical force, RMSE, % of body weight | right, left foot | contact on and off, mean error | rows compared |")
    print("|---|---|---|---|---|")
    for motion, plates in zip(arguments.trials[::2], arguments.trials[1::2]):
        (arguments.out / motion.stem).mkdir(parents=True, exist_ok=True)
        print(*measure(arguments.walktrack.resolve(), arguments.out, motion, storage(plates), arguments.first)[1], sep="\n")


if __name__ == "__main__":
    main()
