#!/usr/bin/env python3
"""Measures the table of results of README.md: tracks the demo and, where they are present, real and rendered videos
beside the checkout, with the defaults, and prints a row a kind of video with one error a run.

    scripts/measure_results.py WALKTRACK OUT [--quick] [--only WORD]

Errors are those of scripts/measure_gates.py: mean joint error, mean error of foot plants or of toes, mm. What OUT holds
already is not done again. --quick: one seed. Standard library only.
"""
import argparse
import pathlib
import re
import shutil
import sys

from measure_gates import measured

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared/data"
RENDERED, PATIENTS = SHARED / "rendered", SHARED / "patients/rendered"
OLD, TURN, STRAIGHT = "bandai_1_walk_old_001", "bandai_2_walk-turn-left_normal_001", ("cmu_02_01", "cmu_02_02")
SEEN_PATIENTS = ("SubjectA11_Cycle1", "SubjectA1_Cycle1", "SubjectA2_Cycle1")
PATIENTS_UNSEEN = ("SubjectB11_Cycle1", "SubjectC12_Cycle1", "SubjectD4_Cycle1")
THREE, ONE = "scene.yaml", "scene_one_camera.yaml"
PAIR = "with cam0 and cam1"  # of scene.yaml: the side camera and the one in front

# Video, what is measured, scenes, seeds, and whether anything was ever chosen by that video.
ROWS = [
    ("the demo, two cameras", "joints", [ROOT / "data/demo" / THREE], 5, "yes"),
    ("motion capture by another renderer, three cameras: an old man; a turn", "joints",
     [RENDERED / OLD / THREE, RENDERED / TURN / THREE], 3, "yes"),
    ("the same: two straight walks", "joints", [RENDERED / s / THREE for s in STRAIGHT], 3, "by the trajectory's constants"),
    ("patients by another renderer, three cameras, three people", "joints",
     [PATIENTS / s / THREE for s in ("SubjectA11_Cycle1", "SubjectB11_Cycle1", "SubjectD4_Cycle1")], 3,
     "by the trajectory's constants"),
    ("the old man, the turn, the two straight walks, and three patients, two cameras: from the side and from the front", "joints",
     [RENDERED / s / PAIR for s in (OLD, TURN, *STRAIGHT)] + [PATIENTS / s / PAIR for s in PATIENTS_UNSEEN], 3, "not with two cameras"),
    ("the two straight walks (the floor of the second one climbs) and three patients, the side camera alone", "joints",
     [RENDERED / s / ONE for s in STRAIGHT] + [PATIENTS / s / ONE for s in PATIENTS_UNSEEN], 3, "by the trajectory's constants"),
    ("the old man, the turn, three other patients, the side camera alone", "joints",
     [RENDERED / OLD / ONE, RENDERED / TURN / ONE] + [PATIENTS / s / ONE for s in SEEN_PATIENTS], 3, "yes"),
    ("a real woman from the side, half hidden at first", "standing feet, along the walk",
     [SHARED / "sports2d_side" / THREE], 5, "yes"),
    ("a real man before two telephones, who stands, walks four steps and stands", "toes on the floor ¹",
     [SHARED / "opencap_two_phones/scene_plates.yaml"], 3, "his standing"),
    ("either telephone alone", "the same",
     [SHARED / "opencap_two_phones" / f"scene_cam{i}.yaml" for i in (0, 1)], 3, "yes"),
]
NOTE = """
¹ Some 75 mm of it lie between the tip of the toes, which was measured, and the ball of the foot, which is reported; all
plants of the video count, also those before the walk. A star: a foot on the wrong side. Brackets: a quality check failed."""


def cell(row):
    if row["mm"] is None:
        return "not found" if row["status"] != "tracked" else "-"
    text = f"{row['mm']:.0f}" + ("" if row["sides"] else "*")
    return text if row["green"] else f"({text})"


def pair_of(folder, out):
    """A scene with the first two cameras of FOLDER/scene.yaml, in OUT."""
    lines = (folder / THREE).read_text().splitlines(keepends=True)
    lines = [line for line in lines if "name: cam2" not in line]
    files = r"\b(video|calibration|background|truth): ([^\s,}]+)"
    text = "".join(re.sub(files, lambda found: f"{found[1]}: {folder / found[2]}", line) for line in lines)
    out.mkdir(parents=True, exist_ok=True)
    (out / THREE).write_text(text)
    shutil.copyfile(folder / "truth.csv", out / "truth.csv")
    return out / THREE


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    walktrack = arguments.walktrack.resolve()
    print("| video | what is measured | error, mm, by video and seed | seen |\n|---|---|---|---|")
    for video, what, scenes, seeds, seen in ROWS:
        if arguments.only not in video:
            continue
        cells = []
        for scene in scenes:
            if scene.name == PAIR and scene.parent.exists():
                scene = pair_of(scene.parent, arguments.out / "pairs" / f"{scene.parent.name}_pair")
            if not scene.exists():
                print(f"skipped, not there: {scene}", file=sys.stderr)
                continue
            name = f"{scene.parent.name}_{scene.stem}"
            runs = [measured(walktrack, scene, seed, arguments.out / name / str(seed), [])
                    for seed in range(1, (1 if arguments.quick else seeds) + 1)]
            cells.append(" ".join(cell(row) for row in runs))
            print(f"{name}: {cells[-1]}", file=sys.stderr, flush=True)
        if cells:
            print(f"| {video} | {what} | {'; '.join(cells)} | {seen} |")
    print(NOTE)


if __name__ == "__main__":
    main()
