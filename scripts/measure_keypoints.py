#!/usr/bin/env python3
"""Measures what keypoints are worth on real videos whose foot plants are known and on renders: from the built-in network,
from files, from files alone, with labels swapped for 0.3 s, without the subject for half a second.

    scripts/measure_keypoints.py WALKTRACK OUT [--seeds N] [--renders N] [--mirrored FOLDER] [--only WORD]

Takes ../shared/data beside the checkout: sports2d_side, opencap_two_phones, rendered. FOLDER holds the side view mirrored,
video/ with images and background.png; without it the mirrored points alone are measured. Scenes with other keypoint files are
written to OUT/scenes. N seeds of every real scene (default 10), and of every render (default 3).

A run has its names right if every plant that was tracked is nearer to the foot of its side than to the other one. The side
view's error is that of `walktrack evaluate` (along the walk); a telephone's is that of the toe over 8 frames from 6 after
landing, of our toe joint, the ball of the foot, and of the tip that our foot implies: farther along the line from the ankle
to the ball by TIP_AHEAD of the foot's length. Prints Markdown tables; what OUT holds is not done again. Standard library
only.
"""
import argparse
import json
import math
import pathlib
import shutil
import statistics
import sys

from measure_gates import MEAN_OF, SETTLED, rows_of, run

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared/data"
SIDE, PHONES, RENDERED = SHARED / "sports2d_side", SHARED / "opencap_two_phones", SHARED / "rendered"
FOOT = 0.152  # of the stature (lib/body/subject.cpp)
TIP_AHEAD = 0.77 - 0.49  # of the foot ahead of the ankle: the tip (body.cpp) and the ball (kBallForward of subject.cpp)
PHONES_HEIGHT = 1.80  # m, of its scene
SETS_OFF, STANDS_AGAIN = 125, 310  # frames of the telephones
ON_ROOF_PX = 400  # the man on the roof is above that row of the side view, the walker below
SWAPPED, MISSING = range(40, 49), range(40, 55)  # frames of the side view: 0.3 and 0.5 s
LEGS = (11, 13, 15)  # left hip, knee, ankle of COCO; the right one is the next
COCO_POINTS = 17  # the nose, then left and right in turn
NETWORK = ("observation.keypoints.enabled=on", "observation.keypoints.every=1")
OFF = ("observation.keypoints.enabled=off",)
DOUBT = ("observation.keypoints.enabled=on", "observation.keypoints.every=1", "observation.keypoints.in_doubt_only=true")


def person_y(person):
    points = person["pose_keypoints_2d"]
    seen = [points[i + 1] for i in range(0, len(points), 3) if points[i + 2] > 0]
    return statistics.mean(seen) if seen else math.inf


def write_points(folder, change):
    """The side view's keypoints with each frame's people changed."""
    if folder.exists():
        return folder
    folder.mkdir(parents=True)
    for frame, file in enumerate(sorted((SIDE / "keypoints").glob("*.json"))):
        text = json.loads(file.read_text())
        text["people"] = change(frame, text["people"])
        (folder / file.name).write_text(json.dumps(text))
    return folder


def swapped(frame, people):
    for person in people if frame in SWAPPED else []:
        points = person["pose_keypoints_2d"]
        for left in LEGS:
            a, b = slice(3 * left, 3 * left + 3), slice(3 * left + 3, 3 * left + 6)
            points[a], points[b] = points[b], points[a]
    return people


def missing(frame, people):
    return [p for p in people if frame not in MISSING or person_y(p) < ON_ROOF_PX]


def mirrored(_, people, width=1768):
    for person in people:
        points = person["pose_keypoints_2d"]
        for i in range(0, len(points), 3):
            points[i] = width - 1 - points[i] if points[i + 2] > 0 else points[i]
        for left in range(1, COCO_POINTS, 2):
            a, b = slice(3 * left, 3 * left + 3), slice(3 * left + 3, 3 * left + 6)
            points[a], points[b] = points[b], points[a]
    return people


def mirrored_calibration(text):
    """The side view's camera in a world whose x points the other way."""
    text = text.replace("884., 0.", "883., 0.")
    rotation = text.index("rotation")
    head, tail = text[:rotation], text[rotation:]
    for number in ("1.3400610959468096e-03", "-1.3400610959466985e-03", "-3.5101035219922330e+00"):
        tail = tail.replace(number, number[1:] if number.startswith("-") else "-" + number, 1)
    return head + tail


def camera(name, calibration, **files):
    return "{" + ", ".join(f"{k}: {v}" for k, v in {"name": name, "calibration": calibration, **files}.items()) + "}"


def write_scene(file, cameras, rate, subject):
    file.parent.mkdir(parents=True, exist_ok=True)
    lines = "\n".join(f"  - {each}" for each in cameras)
    file.write_text(f"cameras:\n{lines}\nframe_rate: {rate}\nsubject: {subject}\n")
    return file


def side_scene(out, name, video=True, points=None, mirror=None):
    folder = out / "scenes" / name
    pictures = SIDE if mirror is None else mirror
    calibration = SIDE / "side.yaml"
    if name.startswith("mirrored"):
        folder.mkdir(parents=True, exist_ok=True)
        calibration = folder / "side.yaml"
        calibration.write_text(mirrored_calibration((SIDE / "side.yaml").read_text()))
        plants = [f"{s},{'r' if side == 'l' else 'l'},{on},{off},{-float(x):.3f}" for s, side, on, off, x in
                  ((row["stance"], row["side"], row["on_frame"], row["off_frame"], row["x_m"]) for row in rows_of(SIDE / "footplants.csv"))]
        (folder / "footplants.csv").write_text("stance,side,on_frame,off_frame,x_m\n" + "\n".join(plants) + "\n")
    else:
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(SIDE / "footplants.csv", folder)
    files = {"video": pictures / ("video.mp4" if mirror is None else "video"), "background": pictures / "background.png"} if video else {}
    if points:
        files["keypoints"] = points
    return write_scene(folder / "scene.yaml", [camera("side", calibration, **files)], 30, "{height: 1.65, mass: 55}")


def phones_scene(out, name, cameras=(0, 1), plates=True, video=True, points=False):
    def files(i):
        chosen = {"video": PHONES / f"cam{i}.mp4"} if video else {}
        if video and plates:
            chosen["background"] = PHONES / f"cam{i}_background.mp4"
        if points:
            chosen["keypoints"] = PHONES / f"keypoints_cam{i}"
        return chosen
    return write_scene(out / "scenes" / name / "scene.yaml", [camera(f"cam{i}", PHONES / f"cam{i}.yaml", **files(i)) for i in cameras],
                       60, f"{{height: {PHONES_HEIGHT}, mass: 100}}")


def tracked(walktrack, scene, seed, result, settings):
    if not (result / "run.json").exists():
        words = [word for setting in settings for word in ("--set", setting)]
        run(walktrack, "track", scene, "-o", result, "-y", "--seed", seed, "--no-overlay", *words, allowed=(0, 4))
    return json.loads((result / "run.json").read_text())


def side_figures(walktrack, scene, result):
    scored = json.loads(run(walktrack, "evaluate", scene.with_name("footplants.csv"), result, "--json").stdout)["estimates"][0]
    joints = rows_of(result / "joints.csv")
    plants = rows_of(scene.with_name("footplants.csv"))
    errors, right, astray = [], True, 0
    for i, plant in enumerate(plants[:-1]):  # the last one is cut by the video's end
        if scored.get(f"plant{i}_error_mm") is None:
            continue
        errors.append(scored[f"plant{i}_error_mm"])
        own, other = (mean_foot(joints, side, plant) for side in (plant["side"], "r" if plant["side"] == "l" else "l"))
        right = right and own <= other
        astray = max(astray, mean_foot(joints, "pelvis", plant))
    return {"mm": errors, "right": right, "speed": scored.get("speed_m_s"), "step": scored.get("step_length_m"), "pelvis_m": astray}


def mean_foot(joints, side, plant):
    """How far a foot, or the pelvis, is from a plant along the walk, mean over the plant's frames, m."""
    names = ("pelvis",) if side == "pelvis" else (f"{side}ankle", f"{side}toe")
    frames = [row for row in joints[int(plant["on_frame"]) + 4:int(plant["off_frame"]) - 3] if row["pelvis_x"] not in ("", "nan")]
    if not frames:
        return math.nan
    return statistics.mean(abs(statistics.mean(float(row[f"{n}_x"]) for n in names) - float(plant["x_m"])) for row in frames)


def toe_figures(result):
    joints, errors, tips, right = rows_of(result / "joints.csv"), [], [], 0
    for plant in rows_of(PHONES / "toe_plants.csv"):
        first = int(plant["on_frame"]) + SETTLED
        frames = [row for row in joints[first:first + MEAN_OF] if row["ltoe_x"] not in ("", "nan")]
        if not frames:
            continue
        place = (float(plant["toe_x_m"]), float(plant["toe_y_m"]))
        mean = lambda joint: [statistics.mean(float(row[f"{joint}_{axis}"]) for row in frames) for axis in "xy"]
        balls, ankles = {s: mean(f"{s}toe") for s in "lr"}, {s: mean(f"{s}ankle") for s in "lr"}
        own, other = plant["side"][0], "r" if plant["side"] == "left" else "l"
        along = [balls[own][k] - ankles[own][k] for k in (0, 1)]
        ahead = TIP_AHEAD * FOOT * PHONES_HEIGHT / math.hypot(*along)
        errors.append(1000 * math.dist(balls[own], place))
        tips.append(1000 * math.dist([balls[own][k] + ahead * along[k] for k in (0, 1)], place))
        right += math.dist(balls[own], place) <= math.dist(balls[other], place)
    events = json.loads((result / "gait.json").read_text()).get("events", []) if errors else []
    stray = sum(not SETS_OFF <= 60 * e["time_s"]["value"] <= STANDS_AGAIN for e in events)
    return {"mm": tips, "ball": errors, "right": right, "stray": stray}


def median_worst(values, digits=0):
    return f"{statistics.median(values):.{digits}f}, {max(values):.{digits}f}" if values else "-"


def speeds(records):
    return f"{statistics.median(r['timing']['frames_per_second'] for r in records):.0f}"


def side_row(name, runs):
    figures = [f for f, _ in runs]
    errors = [e for f in figures for e in f["mm"]]
    per_run = [statistics.mean(f["mm"]) for f in figures if f["mm"]]
    step = [f["step"] for f in figures if f["step"]]
    speed = [f["speed"] for f in figures if f["speed"]]
    mean = lambda values, digits: f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})" if values else "-"
    used = [r["numbers"]["keypoint_used_share"] for _, r in runs if "keypoint_used_share" in r["numbers"]]
    cells = [name, len(runs), sum(f["right"] and len(f["mm"]) > 2 for f in figures), median_worst(errors), median_worst(per_run),
             mean(step, 2), mean(speed, 2), f"{100 * statistics.mean(used):.0f} %" if used else "-",
             f"{max((f['pelvis_m'] for f in figures), default=math.nan):.2f}", sum(r["status"] == "tracked" for _, r in runs),
             speeds([r for _, r in runs])]
    print("|", " | ".join(map(str, cells)), "|", flush=True)


def phones_row(name, runs):
    figures = [f for f, _ in runs]
    tips, balls = ([e for f in figures for e in f[key]] for key in ("mm", "ball"))
    cells = [name, len(runs), sum(f["right"] == len(f["mm"]) for f in figures),
             f"{sum(f['right'] for f in figures)} of {len(balls)}", median_worst(tips), median_worst(balls),
             sum(f["stray"] > 0 for f in figures), sum(r["status"] == "tracked" for _, r in runs), speeds([r for _, r in runs])]
    print("|", " | ".join(map(str, cells)), "|", flush=True)


def side_rows(out, mirror):
    files, points = SIDE / "keypoints", out / "points"
    default = side_scene(out, "side")
    with_files = side_scene(out, "side_files", points=files)
    yield "network, every third frame (default)", default, ()
    yield "network, every frame", default, NETWORK
    yield "network while names are in doubt", default, DOUBT
    yield "off", default, OFF
    yield "files, the man on the roof in them", with_files, ()
    yield "files, labels swapped for 0.3 s", side_scene(out, "side_swapped", points=write_points(points / "swapped", swapped)), ()
    yield "files, half a second of the man on the roof alone", side_scene(out, "side_missing", points=write_points(points / "missing", missing)), ()
    yield "files alone, no video", side_scene(out, "side_alone", video=False, points=files), ()
    flipped = write_points(points / "mirrored", mirrored)
    if mirror:
        both = side_scene(out, "mirrored", mirror=mirror)
        yield "mirrored: network, every third frame (default)", both, ()
        yield "mirrored: network, every frame", both, NETWORK
        yield "mirrored: off", both, OFF
        yield "mirrored: files", side_scene(out, "mirrored_files", points=flipped, mirror=mirror), ()
    yield "mirrored: files alone, no video", side_scene(out, "mirrored_alone", video=False, points=flipped), ()


def phone_rows(out):
    yield "both, plates (default: outlines)", phones_scene(out, "phones_plates"), ()
    yield "both, plates, files", phones_scene(out, "phones_plates_files", points=True), ()
    yield "both, no plates (default: network)", phones_scene(out, "phones", plates=False), ()
    yield "both, no plates, files", phones_scene(out, "phones_files", plates=False, points=True), ()
    yield "both, files alone, no video", phones_scene(out, "phones_alone", video=False, points=True), ()
    for i in (0, 1):
        yield f"telephone {i}, plate (default: network)", phones_scene(out, f"phone{i}", (i,)), ()
        yield f"telephone {i}, plate, files", phones_scene(out, f"phone{i}_files", (i,), points=True), ()
        yield f"telephone {i}, files alone, no video", phones_scene(out, f"phone{i}_alone", (i,), video=False, points=True), ()


def runs_of(walktrack, out, group, name, scene, settings, seeds, figures):
    runs = []
    for seed in range(1, seeds + 1):
        result = out / "results" / group / name.replace(" ", "_").replace(":", "").replace(",", "") / str(seed)
        record = tracked(walktrack, scene, seed, result, settings)
        runs.append((figures(scene, result) if record["numbers"]["tracked_frames"] else None, record))
    print(f"{group}: {name}", file=sys.stderr, flush=True)
    lost = sum(f is None for f, _ in runs)
    if lost:
        print(f"{group}: {name}: nobody found with {lost} of {seeds} seeds", file=sys.stderr, flush=True)
    return [(f, r) for f, r in runs if f is not None]


def measure_side(walktrack, out, seeds, mirror, only):
    print("\n| side view | runs | names right | plants, mm: median, worst | mean of a run, mm: median, worst | step, m "
          "| speed, m/s | points used | pelvis to plant, m, most | green | frames/s |")
    print("|---|" + "---:|" * 10)
    for name, scene, settings in side_rows(out, mirror):
        if only in name:
            side_row(name, runs_of(walktrack, out, "side", name, scene, settings, seeds, lambda s, r: side_figures(walktrack, s, r)))


def measure_phones(walktrack, out, seeds, only):
    print("\n| two telephones | runs | all names right | plants on their side | tip of the toe, mm: median, worst "
          "| ball, mm: median, worst | runs with a contact while he stands | green | frames/s |")
    print("|---|" + "---:|" * 8)
    for name, scene, settings in phone_rows(out):
        if only in name:
            phones_row(name, runs_of(walktrack, out, "phones", name, scene, settings, seeds, lambda _, r: toe_figures(r)))


def measure_renders(walktrack, out, seeds, only):
    print("\n| render | joints, mm: network off | on, every third frame | share of the frames with points on the subject |")
    print("|---|---:|---:|---:|")
    for folder in sorted(RENDERED.iterdir()):
        for file in ("scene_one_camera.yaml", "scene.yaml"):
            name = f"{folder.name}, {'one camera' if 'one' in file else 'three cameras'}"
            if only not in name or not (folder / file).exists():
                continue
            def error(_, result):
                scored = json.loads(run(walktrack, "evaluate", folder / "truth.csv", result, "--json").stdout)["estimates"][0]
                return scored["joint_error_mean_mm"]
            off = runs_of(walktrack, out, "off", name, folder / file, OFF, seeds, error)
            on = runs_of(walktrack, out, "on", name, folder / file, NETWORK[:1], seeds, error)
            used = [r["numbers"].get("keypoint_used_share", 0) for _, r in on]
            cells = [name, *(" ".join(f"{e:.0f}" for e, _ in runs) for runs in (off, on)), f"{100 * statistics.mean(used):.0f} %"]
            print("|", " | ".join(cells), "|", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--renders", type=int, default=3)
    parser.add_argument("--mirrored", type=pathlib.Path)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    walktrack, out = arguments.walktrack.resolve(), arguments.out.resolve()
    mirror = arguments.mirrored.resolve() if arguments.mirrored else None
    measure_side(walktrack, out, arguments.seeds, mirror, arguments.only)
    measure_phones(walktrack, out, arguments.seeds, arguments.only)
    measure_renders(walktrack, out, arguments.renders, arguments.only)


if __name__ == "__main__":
    main()
