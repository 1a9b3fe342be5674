#!/usr/bin/env python3
"""Runs micro_bench and whole programs several times and prints medians as ratios.

    ratios.py BUILD_FOLDER SOURCE_FOLDER [--repetitions N] [--store]

Times differ from machine to machine, ratios hardly: to peers and limits of the same run, and to the
release before in tests/bench/release.json, which holds every time as a multiple of the same run's
`dynamics_tmt_eigen`. --store writes that file anew.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

YARDSTICK = "dynamics_tmt_eigen"
# what, as a multiple of what, wanted: (at most | at least) how much
TARGETS = [
    ("silhouette_log_ratio", "silhouette_scanline_limit", "at most", 1.5),
    ("silhouette_per_pixel", "silhouette_log_ratio", "at least", 14),
    ("dynamics_batch", "dynamics_soa_limit", "at most", 2),
    ("dynamics_mujoco", "dynamics_batch", "at least", 50),
    ("dynamics_tmt_eigen", "dynamics_batch", "at least", 15),
    ("frame_batch", "dynamics_soa_limit", "at most", 150),  # 1.5 us where the limit is 10 ns
    ("legs_batch", "legs_soa_limit", "at most", 2),
    ("legs_scalar", "legs_batch", "", None),
    ("frame_scalar", "frame_batch", "", None),
    ("track_output_2", "track_all_2", "at most", 0.15),
    ("one_camera_network_always", "pose_network", "", None),
    ("one_camera_network_default", "pose_network", "", None),
    ("one_camera_network_off", "pose_network", "", None),
    ("dynamics_mujoco", "dynamics_scalar", "", None),
    ("dynamics_tmt_eigen", "dynamics_scalar", "", None),
    ("normal_ours", "normal_std", "", None),
]


def micro(build: Path, repetitions: int) -> dict[str, float]:
    """Median seconds for one item of every benchmark."""
    output = subprocess.run(
        [build / "micro_bench", f"--benchmark_repetitions={repetitions}", "--benchmark_format=json",
         "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.1"],
        check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    times: dict[str, list[float]] = {}
    for run in json.loads(output)["benchmarks"]:
        if run["run_type"] == "iteration":
            times.setdefault(run["name"].split("/")[0], []).append(run["s_each"])
    return {name: statistics.median(values) for name, values in times.items()}


def timed(build: Path, scene: Path, options: list[str], repetitions: int) -> dict[str, float]:
    """Seconds a frame of a whole run and of its stages, medians."""
    runs: dict[str, list[float]] = {}
    for _ in range(repetitions):
        with tempfile.TemporaryDirectory() as folder:
            command = [build / "walktrack", "track", scene, "-o", f"{folder}/out", "--quiet", *options]
            begin = time.perf_counter()
            if subprocess.run(command, stdout=subprocess.DEVNULL).returncode not in (0, 4):
                sys.exit("walktrack track failed")
            seconds = {"all": time.perf_counter() - begin}
            record = json.loads(Path(folder, "out/run.json").read_text())
            seconds |= record["timing"]["stage_seconds"]
        for stage, value in seconds.items():
            runs.setdefault(stage, []).append(value / record["numbers"]["frames"])
    return {stage: statistics.median(values) for stage, values in runs.items()}


def tracked(build: Path, source: Path, threads: int, repetitions: int) -> dict[str, float]:
    """The shipped demo, in all and by stage."""
    stages = timed(build, source / "data/demo/scene.yaml", ["--threads", str(threads)], repetitions)
    return {f"track_{stage}_{threads}": value for stage, value in stages.items()}


def with_network(build: Path, source: Path, repetitions: int) -> dict[str, float]:
    """The demo's side camera alone, every output, with the network in every frame, as by default, and without it."""
    demo = source.resolve() / "data/demo"
    settings = {"always": ["observation.keypoints.enabled=on", "observation.keypoints.every=1"],
                "default": [], "off": ["observation.keypoints.enabled=off"]}
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, "scene.yaml")
        scene.write_text(f"cameras:\n  - {{name: side, video: {demo}/side.mp4, calibration: {demo}/side.yaml, "
                         f"background: {demo}/side_background.mp4}}\nframe_rate: 30\nsubject: {{height: 1.75, mass: 70}}\n")
        return {f"one_camera_network_{name}":
                timed(build, scene, [word for each in chosen for word in ("--set", each)], repetitions)["all"]
                for name, chosen in settings.items()}


BENCH_PX = 450  # height of the figures of `silhouette_scanline_limit` (tests/bench/scenes.h)
EVALUATIONS = 4 * 17 + 1  # of the dynamics, for one walker and 1/30 s
PASSED = 0.57  # of the moves, by the first camera: the others are asked for these only (lib/jobs/plan/cost_model.h)


def limits_of_frame(build: Path, source: Path, times: dict[str, float]) -> tuple[dict[str, float], float]:
    """Seconds that a frame of the demo takes on one thread at the machine's limits, by what is computed, and the
    number of poses that are evaluated."""
    scene = source / "data/demo/scene.yaml"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([build / "walktrack", "track", scene, "-o", f"{folder}/out", "--quiet", "--no-overlay"], check=True)
        record = json.loads(Path(folder, "out/run.json").read_text())
    plan = json.loads(subprocess.run([build / "walktrack", "plan", scene, "--json"], check=True, capture_output=True, text=True).stdout)
    settings, cameras = record["config"]["filter"], plan["cameras"]
    layers = statistics.mean(n for n in record["by_frame"]["layers"] if n)
    moved = settings["particles"] * layers * settings["moves"]
    asked = [settings["particles"] + share * moved for share in [1] + [PASSED] * (len(cameras) - 1)]
    height = sum(poses * camera["rows"] for poses, camera in zip(asked, cameras))
    return {"decoding": len(cameras) * times["decoded_frame"],
            "converting": len(cameras) * (times["converted_frame"] - times["decoded_frame"]),
            "silhouettes": height / BENCH_PX * times["silhouette_scanline_limit"],
            "dynamics": settings["particles"] * EVALUATIONS * times["dynamics_soa_limit"]}, sum(asked)


def print_targets(times: dict[str, float]) -> None:
    print(f"\n{'ratio within this run':58} {'measured':>9}  wanted")
    for what, than, bound, wanted in TARGETS:
        if what not in times or than not in times:
            print(f"{what + ' / ' + than:58} {'-':>9}  not measured: a package is missing, or --micro")
            continue
        ratio = times[what] / times[than]
        verdict = ""
        if bound:
            met = ratio <= wanted if bound == "at most" else ratio >= wanted
            verdict = f"{bound} {wanted:g}: {'met' if met else 'NOT met'}"
        print(f"{what + ' / ' + than:58} {ratio:9.3g}  {verdict}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("source", type=Path)
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--micro", action="store_true", help="no whole programs")
    parser.add_argument("--store", action="store_true")
    options = parser.parse_args()

    times = micro(options.build, options.repetitions)
    if not options.micro:
        for threads in (1, 2):
            times |= tracked(options.build, options.source, threads, options.repetitions)
        times |= with_network(options.build, options.source, options.repetitions)
    path = options.source / "tests/bench/release.json"
    release = json.loads(path.read_text()) if path.exists() else {}
    print(f"{'median':34} {'time':>12} {'/ ' + YARDSTICK:>24} {'/ release before':>18}")
    relative = {name: value / times[YARDSTICK] for name, value in times.items()}
    for name, value in times.items():
        unit, scale = ("ns", 1e9) if value < 1e-6 else ("us", 1e6) if value < 1e-3 else ("ms", 1e3)
        change = f"{relative[name] / release[name]:.2f}" if name in release else "-"
        print(f"{name:34} {value * scale:9.4g} {unit} {relative[name]:24.4g} {change:>18}")
    print_targets(times)
    if "track_filter_2" in times:
        print(f"\nframes/s of the demo (two cameras, 640x480), 1 and 2 threads: "
              f"{1 / times['track_all_1']:.3g}, {1 / times['track_all_2']:.3g}; particles on 2 threads "
              f"{times['track_filter_1'] / times['track_filter_2']:.2f} x as fast; largest memory of "
              f"a run {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:.0f} MB")
        print("frames/s of its side camera alone, every output: "
              + ", ".join(f"network {name} {1 / times[f'one_camera_network_{name}']:.3g}" for name in ("always", "default", "off"))
              + (f"; the network alone {1 / times['pose_network']:.3g}" if "pose_network" in times else ""))
        limits, poses = limits_of_frame(options.build, options.source, times)
        listed = ", ".join(f"{what} {1e3 * seconds:.2g}" for what, seconds in limits.items())
        print(f"ms of a frame of the demo on one thread at the machine's limits: {listed} ({poses:.0f} poses are evaluated); together "
              f"{1e3 * sum(limits.values()):.3g}, and the whole command takes {1e3 * times['track_all_1']:.3g}")
        print(f"processors {os.cpu_count()}, load average {os.getloadavg()[0]:.1f}: with others at "
              "work, trust the micro benchmarks only")
    if options.store:
        path.write_text(json.dumps({n: float(f"{v:.4g}") for n, v in relative.items()}, indent=1) + "\n")


if __name__ == "__main__":
    main()
