#!/usr/bin/env python3
"""A batch of many short clips, a tenth of them broken in 20 ways, killed three times on the way. Says whether
every clip got the row that it deserves, whether equal clips have equal results, and how memory and
throughput went from the first tenth to the last. Writes a Markdown report.

  tests/durability/many_clips.py BINARY [--clips 10000] [--jobs 2] [--out FILE.md]

Ten thousand take about an hour on two cores. Exit code 1 if a row was wrong, results differed or a process
took more than 200 MB."""
import argparse
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BASES = 8
MOST_MB = 200
OPTIONS = """frame_rate: 15
duration: 0.8
initial: true
seed: {seed}
background_frames: 5
walk: {{speed: {speed}, start: [-0.5, 0]}}
cameras: [{{name: side, azimuth_deg: -90, distance: 4, size: [96, 72]}}]
"""


def put(name, data):
    def plant(folder):
        (folder / name).unlink()
        (folder / name).write_bytes(data)
    return plant


def edit(name, change):
    def plant(folder):
        text = (folder / name).read_text()
        (folder / name).unlink()
        (folder / name).write_text(change(text))
    return plant


def swap(name, was, now):
    def change(text):
        assert was in text, (name, was)
        return text.replace(was, now)
    return edit(name, change)


def more(text):
    return edit("scene.yaml", lambda scene: scene + text)


def gone(name):
    return lambda folder: (folder / name).unlink()


def empty_folder(folder):
    (folder / "side.mp4").unlink()
    (folder / "side.mp4").mkdir()


def cut_off(folder):
    data = (folder / "side.mp4").read_bytes()
    put("side.mp4", data[:len(data) // 2])(folder)


def changing_images(folder):
    empty_folder(folder)
    (folder / "side.mp4/1.ppm").write_bytes(b"P6 96 72 255\n" + b"x" * (96 * 72 * 3))
    (folder / "side.mp4/2.ppm").write_bytes(b"P6 96 71 255\n" + b"x" * (96 * 71 * 3))


FAULTS = [put("scene.yaml", b"cameras: ["), put("scene.yaml", b""), put("scene.yaml", b"[" * 100_000),
          more("subjekt: {height: 1.7}\n"), swap("scene.yaml", "height: 1.75", "height: 175"),
          more("gravity: [0, 0, 9.81]\n"), more("first_frame: 5000\n"),
          more("occluders: {side: [[[0, 0], [1, 1]]]}\n"), swap("scene.yaml", "name: side", "name: ../side"),
          gone("side.mp4"), put("side.mp4", b""), put("side.mp4", b"no video at all"), cut_off, empty_folder,
          gone("side.yaml"), put("side.yaml", b"image_width: 96\n"),
          swap("side.yaml", "image_width: 96", "image_width: 97"),
          swap("side.yaml", "image_width: 96", "image_width: .nan"),
          put("side_background.mp4", b"no video"), changing_images]


def make_clips(binary, folder, count):
    for b in range(BASES):
        options = folder / f"{b}.yaml"
        options.write_text(OPTIONS.format(seed=b + 1, speed=1 + 0.05 * b))
        subprocess.run([binary, "render", "--options", options, "-o", folder / "base" / str(b)], check=True,
                       capture_output=True)
    broken = {}
    for i in range(count):
        to = folder / "in" / f"c{i:05}"
        shutil.copytree(folder / "base" / str(i % BASES), to, copy_function=os.link)
        if i % 10 == 7:
            kind = i // 10 % len(FAULTS)
            FAULTS[kind](to)
            broken[to.name] = kind
    return broken


def processes(program):
    """Peak memory, MB, of the batch and of the largest of its workers."""
    own, workers = 0, 0
    for status in pathlib.Path("/proc").glob("[0-9]*/status"):
        try:
            lines = dict(line.split(":", 1) for line in status.read_text().splitlines() if ":" in line)
        except OSError:
            continue
        if "VmHWM" not in lines:
            continue
        peak = int(lines["VmHWM"].split()[0]) / 1024
        if int(status.parent.name) == program.pid:
            own = peak
        elif int(lines["PPid"]) == program.pid:
            workers = max(workers, peak)
    return own, workers


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--clips", type=int, default=10_000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out")
    given = parser.parse_args()
    binary = str(pathlib.Path(given.binary).resolve())
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        broken = make_clips(binary, folder, given.clips)
        out = folder / "out"
        words = [binary, "batch", str(folder / "in"), "-o", str(out), "--jobs", str(given.jobs), "--threads", "1",
                 "--set", "filter.particles=20", "--set", "start.particles=10", "--set", "start.seconds=0.1",
                 "--set", "overlay.width=64", "-c", str(ROOT / "tests/any_quality.yaml")]
        tenths, kills = [], [given.clips * k // 4 for k in (1, 2, 3)]
        done, began, last_time, last_done = 0, time.monotonic(), time.monotonic(), 0
        peak_batch = peak_worker = 0
        program = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        while program.poll() is None:
            time.sleep(1)
            own, worker = processes(program)
            peak_batch, peak_worker = max(peak_batch, own), max(peak_worker, worker)
            # Each sequence that is through has a result, or the reason why not.
            done = sum(1 for entry in os.scandir(out) if entry.is_dir() and (
                os.path.exists(entry.path + "/run.json") or os.path.exists(entry.path + "/failure.txt"))) \
                if out.exists() else 0
            if done >= (len(tenths) + 1) * given.clips / 10:
                now = time.monotonic()
                tenths.append((done, (done - last_done) / (now - last_time), peak_batch, peak_worker))
                print("done %d, %.1f clips/s, batch %.0f MB, largest worker %.0f MB" % tenths[-1], flush=True)
                last_time, last_done, peak_batch, peak_worker = now, done, 0, 0
            if kills and done >= kills[0]:
                kills.pop(0)
                os.killpg(program.pid, signal.SIGKILL)
                program.wait()
                program = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                           start_new_session=True)
        seconds = time.monotonic() - began
        rows = {row["sequence"]: row for row in csv.DictReader((out / "summary.csv").open())}
        wrong, digests = [], {}
        for i in range(given.clips):
            name = f"c{i:05}"
            status = rows.get(name, {}).get("state", "no row")
            if status != ("failed" if name in broken else "complete"):
                wrong.append(f"{name}: {status}, fault {broken.get(name, 'none')}")
            elif name not in broken:
                digests.setdefault(i % BASES, set()).add(json.loads((out / name / "run.json").read_text())["digest"])
        wrong += [f"clips of kind {b} have {len(d)} different results" for b, d in digests.items() if len(d) > 1]
        wrong += [f"{t[0]} clips: {max(t[2:]):.0f} MB" for t in tenths if max(t[2:]) > MOST_MB]
        complete = sum(row["state"] == "complete" for row in rows.values())
    lines = [f"{given.clips} clips of 0.8 s (12 frames of 96x72), {len(broken)} of them broken in {len(FAULTS)} ways, "
             f"`--jobs {given.jobs}`, killed with all its processes after a quarter, a half and three quarters: "
             f"{complete} complete, {len(rows) - complete} failed with their reason, {len(wrong)} not as it should be; "
             f"{seconds:.0f} s.", "", "| clips done | clips/s | peak memory of the batch, MB | of the largest worker, MB |",
             "|---:|---:|---:|---:|"]
    lines += ["| %d | %.1f | %.0f | %.0f |" % tenth for tenth in tenths]
    print("\n".join([*lines, "", *wrong[:20]]))
    if given.out:
        pathlib.Path(given.out).write_text("\n".join(lines) + "\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
