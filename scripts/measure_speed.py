#!/usr/bin/env python3
"""Measures how fast whole commands are, where their time goes, and how it grows.

    scripts/measure_speed.py WALKTRACK OUT [--repetitions N]

Tracks the demo, rendered walks and, where they are present, real videos beside the checkout, with every output, and
prints two Markdown tables: frames a second and time by stage for each video and preset, and the exponents with which
CPU time grows (least squares of logarithms). Medians of N runs (default 3). Renders are kept in OUT, runs are not.
Standard library only.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import sys

from measure_gait import make_scenes, one_camera, run

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared/data"
STAGES = ("checks", "background", "decode", "evidence", "filter", "appearance", "output")


def pictures(width, height=None):
    """A walk of two seconds before one camera whose pictures are so wide, by default 4:3; the person grows with them."""
    return f"""seed: 5
frame_rate: 30
duration: 2
walk: {{speed: 1.25, start: [-1.2, 0], phase: 0.2, person: 0}}
subject: {{height: 1.75, mass: 70}}
setting: room
sensor: {{noise: 0.008}}
background_frames: 6
cameras:
  - {{name: side, azimuth_deg: -90, distance: 5.6, height: 1.2, size: [{width}, {height or width * 3 // 4}], focal_px: {0.97 * width:.0f}}}
"""


def rendered(walktrack, out, name, options):
    folder = out / "scenes" / name
    if not (folder / "scene.yaml").exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "options.yaml").write_text(options)
        run(walktrack, "render", "--options", folder / "options.yaml", "-o", folder, "-y")
    return folder / "scene.yaml"


def side_of_demo(out):
    demo, file = ROOT / "data/demo", out / "scenes" / "demo_side.yaml"
    file.parent.mkdir(parents=True, exist_ok=True)
    text = one_camera((demo / "scene.yaml").read_text())
    for name in ("side.mp4", "side.yaml", "side_background.mp4", "truth.csv"):
        text = text.replace(f" {name}", f" {demo}/{name}")
    file.write_text(text)
    return file


def timed(walktrack, out, scene, *options):
    """The timing of one run, with its frames, peak memory in MB, and the seconds until the stride."""
    folder = out / "run"
    shutil.rmtree(folder, ignore_errors=True)
    command = [walktrack, "track", scene, "-o", folder, "--quiet", *options]
    child = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 4):
        sys.exit(f"{scene}: exit {child.returncode}")
    record = json.loads((folder / "run.json").read_text())
    timing = record["timing"]
    frames, stages = record["numbers"]["frames"], timing["stage_seconds"]
    followed = sum(stages.get(stage, 0) for stage in ("decode", "evidence", "filter", "appearance"))
    stride = timing.get("stride_frames_per_second")
    return {"frames": frames, "seconds": timing["seconds"], "cpu": timing["cpu_seconds"], "stride": stride,
            "start": max(0.0, followed - frames / stride) if stride else followed, "mb": usage.ru_maxrss / 1024, **stages}


def median_run(walktrack, out, scene, repetitions, *options):
    runs = [timed(walktrack, out, scene, *options) for _ in range(repetitions)]
    present = {key for each in runs for key in each}
    return {key: statistics.median([each[key] for each in runs if each.get(key) is not None] or [0]) for key in present}


def stage_table(walktrack, out, repetitions):
    walk = next(iter(make_scenes(walktrack, out, 1)))
    videos = [("the demo, two cameras, 640x480", ROOT / "data/demo/scene.yaml", {}),
              ("its side camera alone", side_of_demo(out), {"balanced": 100, "fast": 250}),
              ("a rendered walk, three cameras, 640x480", walk / "scene.yaml", {"balanced": 45, "fast": 90}),
              ("a rendered walk, one camera, 3840x2880", rendered(walktrack, out, "wide3840", pictures(3840)), {}),
              ("the same walk, one camera, 7680x4320", rendered(walktrack, out, "wide7680", pictures(7680, 4320)), {}),
              ("the real side view, 1768x994", SHARED / "sports2d_side/scene.yaml", {"balanced": 50}),
              ("two real telephones, 720x1280, 60 Hz", SHARED / "opencap_two_phones/scene.yaml", {"balanced": 50})]
    print("| video | preset | frames/s of the command (wanted) | in the stride | search and start, s | ms a frame: "
          + " | ".join(STAGES) + " | output, % | MB |")
    print("|---|---|---:|---:|---:|" + "---:|" * (len(STAGES) + 2))
    for name, scene, wanted in videos:
        if not scene.exists():
            print(f"{name}: left out, {scene} is not there", file=sys.stderr)
            continue
        for preset in ("balanced", "fast"):
            t = median_run(walktrack, out, scene, repetitions, "-c", preset)
            each = " | ".join(f"{1000 * t.get(stage, 0) / t['frames']:.1f}" for stage in STAGES)
            aim = f" ({wanted[preset]})" if preset in wanted else ""
            stride = f"{t['stride']:.0f}" if t.get("stride") else "-"
            print(f"| {name} | {preset} | {t['frames'] / t['seconds']:.0f}{aim} | {stride} | {t['start']:.1f} | {each} "
                  f"| {100 * t['output'] / t['seconds']:.0f} | {t['mb']:.0f} |", flush=True)


def exponent(pairs):
    """Slope of the least-squares line through the logarithms."""
    points = [(math.log(x), math.log(y)) for x, y in pairs]
    mean_x, mean_y = (statistics.mean(column) for column in zip(*points))
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)


def fewer_cameras(out, scene, count):
    """The scene with its first cameras only."""
    lines, seen = [], 0
    for line in scene.read_text().splitlines():
        seen += line.startswith("  - ")
        if not (line.startswith(("  - ", "    ")) and seen > count):
            lines.append(line)
    file = scene.parent / f"scene_{count}.yaml"
    file.write_text("\n".join(lines) + "\n")
    return file


def growth_table(walktrack, out, repetitions):
    demo, three = ROOT / "data/demo/scene.yaml", next(iter(make_scenes(walktrack, out, 1))) / "scene.yaml"
    one = lambda scene, *options: median_run(walktrack, out, scene, repetitions, "--no-overlay", *options)
    settings = {
        "particles (the demo)": {n: (demo, "--set", f"filter.particles={n}", "--set", f"start.particles={3 * n // 4}")
                                 for n in (50, 100, 200, 400, 800, 1600)},
        "height of the person, px (the demo)": {n: (demo, "--set", f"observation.person_px={n}") for n in (60, 120, 240)},
        "cameras (a rendered walk)": {n: (fewer_cameras(out, three, n), "--set", "motion.turning_yaw_rate_sd=0")
                                      for n in (1, 2, 3)},
        "width of the pictures, px (one camera)": {n: (rendered(walktrack, out, f"wide{n}", pictures(n)),)
                                                   for n in (640, 1280, 2560, 3840)},
    }
    print("| what grows | CPU s of the command | exponent | of the particles' part |\n|---|---|---:|---:|")
    for name, values in settings.items():
        runs = {value: one(*words) for value, words in values.items()}
        listed = ", ".join(f"{value}: {t['cpu']:.1f}" for value, t in runs.items())
        print(f"| {name} | {listed} | {exponent([(v, t['cpu']) for v, t in runs.items()]):.2f} "
              f"| {exponent([(v, t['filter']) for v, t in runs.items()]):.2f} |", flush=True)
    print("\n| threads | seconds of the command | of the particles | the same, 1,600 particles |\n|---|---:|---:|---:|")
    for threads in (1, 2, 4, 16, 64):
        t = one(demo, "--threads", threads)
        many = one(demo, "--threads", threads, "--set", "filter.particles=1600")
        print(f"| {threads} | {t['seconds']:.2f} | {t['filter']:.2f} | {many['filter']:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("walktrack", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--repetitions", type=int, default=3)
    arguments = parser.parse_args()
    stage_table(arguments.walktrack, arguments.out, arguments.repetitions)
    print()
    growth_table(arguments.walktrack, arguments.out, arguments.repetitions)


if __name__ == "__main__":
    main()
