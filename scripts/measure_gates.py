#!/usr/bin/env python3
"""Measures how often green results are right: tracks scenes whose truth is known, and compares each run's verdict and
quality measures with its error.

    scripts/measure_gates.py WALKTRACK OUT FOLDER [FOLDER ...] [--render FILE ...] [--seeds N] [--columns NAME ...] [-- OPTIONS OF TRACK ...]

Below each FOLDER every scene with a truth is taken, and every scene named scene*.yaml. The truth of x/scene*.yaml is
x/truth.csv (joints), x/footplants.csv (plants along the walk; `walktrack evaluate` says of what form) or
x/toe_plants.csv (side,on_frame,toe_x_m,toe_y_m: where toes land); that of x/NAME.yaml is x/NAME_ground.csv. A scene
named scene*.yaml without any of them shows somebody who does not walk: a run that reports a walk there is wrong.
FILEs are options of `walktrack render`, whose scenes are rendered into OUT first.

The error of a run is the mean joint error, the mean error of the plants or the median error on the ground. Above 100 mm,
or with a plant on the wrong side, a run is wrong; below 60 mm, with all plants on their side, it is right. Green is exit
0, red exit 4. Prints a Markdown table with one row a run and the measures of run.json named by --columns (default: those
with a limit), those that failed in bold, and how many of the wrong runs were green and of the right ones red. What OUT
holds already is not done again; every run's figures are in OUT/runs.csv. Standard library only.
"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys

WRONG_MM, RIGHT_MM = 100, 60
SETTLED, MEAN_OF = 6, 8  # frames after a toe has landed, and so many frames are its place
TRUTHS = ("truth.csv", "footplants.csv", "toe_plants.csv")


def run(*words, allowed=(0,)):
    result = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if result.returncode not in allowed:
        raise RuntimeError(f"{' '.join(map(str, words))}: exit {result.returncode}: {result.stderr.strip()[-300:]}")
    return result


def truth_of(scene):
    """The file that says what is true of a scene; None where nobody walks."""
    beside = scene.with_name(scene.stem + "_ground.csv")
    candidates = [beside, *(scene.with_name(name) for name in TRUTHS)]
    return next((file for file in candidates if file.exists()), None)


def scenes_below(folder):
    for file in sorted(folder.rglob("*.yaml")):
        is_scene = any(line.startswith("cameras:") for line in file.read_text(errors="replace").splitlines())
        if is_scene and (file.stem.startswith("scene") or file.with_name(file.stem + "_ground.csv").exists()):
            yield f"{file.parent.name}/{file.stem}", file


def rendered(walktrack, out, options):
    """The scene of each file of render options; a scene that says where it starts also as one that does not."""
    for file in options:
        folder = out / "scenes" / file.stem
        if not (folder / "scene.yaml").exists():
            run(walktrack, "render", "--options", file, "-o", folder, "-y")
        yield f"made/{file.stem}", folder / "scene.yaml"


def rows_of(file):
    with file.open() as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def toe_errors(truth, joints):
    """(mm, on its side) of each plant that was tracked when it landed."""
    found = rows_of(joints)
    for plant in rows_of(truth):
        first = int(plant["on_frame"]) + SETTLED
        frames = [row for row in found[first:first + MEAN_OF] if row["ltoe_x"] not in ("", "nan")]
        if not frames:
            continue
        away = {side: math.dist([statistics.mean(float(row[f"{side[0]}toe_{axis}"]) for row in frames) for axis in "xy"],
                                (float(plant["toe_x_m"]), float(plant["toe_y_m"]))) for side in ("left", "right")}
        other = "right" if plant["side"] == "left" else "left"
        yield 1000 * away[plant["side"]], away[plant["side"]] <= away[other]


def error_of(walktrack, truth, result):
    """(mm, all plants on their side); mm is None where nothing can be compared."""
    if truth.name == "toe_plants.csv":
        plants = list(toe_errors(truth, result / "joints.csv"))
        return (statistics.mean(mm for mm, _ in plants), all(right for _, right in plants)) if plants else (None, True)
    scored = json.loads(run(walktrack, "evaluate", truth, result, "--json").stdout)["estimates"][0]
    if truth.name == "footplants.csv":
        errors = [scored[f"plant{i}_error_mm"] for i in range(int(scored["plants"]))]
        return scored["plant_error_mean_mm"], all(error is not None for error in errors[1:-1])
    return scored.get("joint_error_mean_mm", scored.get("ground_error_median_mm")), True


def measured(walktrack, scene, seed, result, options):
    if not (result / "run.json").exists():
        run(walktrack, "track", scene, "-o", result, "-y", "--seed", seed, "--no-overlay", *options, allowed=(0, 4))
    record = json.loads((result / "run.json").read_text())
    truth = truth_of(scene)
    mm, sides = error_of(walktrack, truth, result) if truth and record["numbers"]["tracked_frames"] else (None, True)
    green = record["status"] == "tracked"
    walks = truth is not None
    wrong = green if not walks else mm is not None and (mm > WRONG_MM or not sides)
    right = walks and mm is not None and mm < RIGHT_MM and sides
    measures = {q["name"]: q for q in record["quality"]}
    return {"status": record["status"], "green": green, "mm": mm, "sides": sides, "walks": walks, "wrong": wrong, "right": right, "measures": measures}


def cell(measure):
    if measure is None:
        return ""
    text = f"{measure['value']:.{measure['digits']}f}" if measure["value"] is not None else "-"
    return text if measure["passed"] else f"**{text}**"


def print_table(rows, columns):
    print("| scene | seed | error, mm | truth | verdict |", " | ".join(columns), "|")
    print("|---|---:|---:|---|---|" + "---:|" * len(columns))
    for row in rows:
        mm = "-" if row["mm"] is None else f"{row['mm']:.0f}"
        word = "wrong" if row["wrong"] else "right" if row["right"] else "no walk" if not row["walks"] else ""
        if not row["sides"]:
            word += ", sides"
        print(f"| {row['scene']} | {row['seed']} | {mm} | {word} | {'green' if row['green'] else 'red'} |",
              " | ".join(cell(row["measures"].get(name)) for name in columns), "|")


def print_summary(rows):
    def of(name, chosen, colour):
        hits = [row for row in chosen if row["green"] == (colour == "green")]
        share = f" ({100 * len(hits) / len(chosen):.0f} %)" if chosen else ""
        print(f"{name} and {colour}: {len(hits)} of {len(chosen)}{share}")
        for row in hits:
            print(f"  {row['scene']} seed {row['seed']}: {'-' if row['mm'] is None else round(row['mm'])} mm")
    print()
    of("wrong", [row for row in rows if row["wrong"] and row["walks"]], "green")
    of("right", [row for row in rows if row["right"]], "red")
    of("nobody walks", [row for row in rows if not row["walks"]], "green")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("folders", nargs="*", type=pathlib.Path)
    parser.add_argument("--render", nargs="+", type=pathlib.Path, default=[])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--columns", nargs="+")
    words, options = sys.argv[1:], []
    if "--" in words:
        words, options = words[:words.index("--")], words[words.index("--") + 1:]
    arguments = parser.parse_args(words)
    walktrack, rows = arguments.walktrack.resolve(), []
    scenes = [*rendered(walktrack, arguments.out, arguments.render), *(s for folder in arguments.folders for s in scenes_below(folder))]
    for seed in range(1, arguments.seeds + 1):
        for name, scene in scenes:
            result = arguments.out / "results" / name.replace("/", "_") / str(seed)
            row = {"scene": name, "seed": seed, **measured(walktrack, scene, seed, result, options)}
            rows.append(row)
            print(f"{name} seed {seed}: {row['mm'] and round(row['mm'])} mm, {row['status']}", file=sys.stderr, flush=True)
    rows.sort(key=lambda row: (row["scene"], row["seed"]))
    limited = dict.fromkeys(name for row in rows for name, q in row["measures"].items() if q["gate"] is not None)
    all_measures = dict.fromkeys(name for row in rows for name in row["measures"])
    with (arguments.out / "runs.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["scene", "seed", "mm", "sides", "walks", "status", *all_measures])
        for row in rows:
            writer.writerow([row["scene"], row["seed"], row["mm"], row["sides"], row["walks"], row["status"],
                             *(row["measures"].get(name, {}).get("value", "") for name in all_measures)])
    print_table(rows, arguments.columns or list(limited))
    print_summary(rows)


if __name__ == "__main__":
    main()
