#!/usr/bin/env python3
"""Tests whether the program loses or damages files. It is killed at random moments, each of its writes
fails as on a full disk, rights and output folders are taken away, the clock jumps and renames take
long; the results are compared with those of an undisturbed run. Writes a Markdown table.

  tests/durability/losing_nothing.py BINARY [--kills 1000] [--out FILE.md] [--only WORD] [--seed 1]

Counted as lost: an input that changed, a result that says it is complete and is not the undisturbed
one, a run after the disturbance that does not end with the undisturbed bytes. Exit code 1 if there was
any."""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DEMO = ROOT / "data/demo"
MOST_WRITES = 60  # that are made to fail, of each command
OPTIONS = """frame_rate: 15
duration: 0.8
initial: true
background_frames: 5
walk: {speed: 1.2, start: [-0.5, 0]}
cameras: [{name: side, azimuth_deg: -90, distance: 4, size: [96, 72]}]
"""
QUICK = ["--threads", "1", "--set", "filter.particles=20", "--set", "start.particles=10", "--set",
         "start.seconds=0.1", "--set", "checkpoint.seconds=0", "-c", str(ROOT / "tests/any_quality.yaml")]


class Trials:
    def __init__(self, binary, folder, kills, seed):
        self.binary, self.folder, self.kills = str(pathlib.Path(binary).resolve()), folder, kills
        self.random = random.Random(seed)
        self.rows, self.lost = [], []
        (folder / "walk.yaml").write_text(OPTIONS)
        self.run(["render", "--options", str(folder / "walk.yaml"), "-o", str(folder / "one")])
        for name in "ab":
            shutil.copytree(folder / "one", folder / "in" / name)
        self.scene = str(folder / "in/a/scene.yaml")
        self.system = str(folder / "faulty_system.so")
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", str(ROOT / "tests/durability/faulty_system.c"), "-o",
                        self.system, "-ldl"], check=True)

    def run(self, words, environment=None, user=None):
        before = ["setpriv", f"--reuid={user}", "--clear-groups"] if user else []
        return subprocess.run([*before, self.binary, *words], capture_output=True, text=True,
                              env={**os.environ, **(environment or {})}, timeout=600)

    def command(self, name, out):
        """The words of a command that writes into `out`."""
        return {
            "track": ["track", self.scene, *QUICK, "-o", out],
            "batch": ["batch", str(self.folder / "in"), "--jobs", "2", *QUICK, "-o", out],
            "sweep": ["sweep", self.scene, *QUICK, "--over", "particles=10:20", "--seeds", "2", "-o", out],
            "calibrate": ["calibrate", "--camera", str(DEMO / "side.yaml"), "--points",
                          str(DEMO / "side_points.csv"), "--floor", str(DEMO / "side.mp4"), "-o", out],
            "render": ["render", "--options", str(self.folder / "walk.yaml"), "-o", out],
        }[name]

    def again(self, name, out):
        """As a user would: the same words, and what the refusal names where it is refused."""
        words = self.command(name, out)
        run = self.run([*words, "--resume"] if name == "track" else words)
        if run.returncode == 2 and ("-y" in run.stderr or "--yes" in run.stderr):
            run = self.run([*words, "-y"])
        return run

    def contents(self, out):
        """Digests of what may not depend on when and how often a program ran."""
        found = {}
        for path in sorted(pathlib.Path(out).rglob("*")):
            name = str(path.relative_to(out))
            if not path.is_file() or path.suffix == ".html" or path.name in ("log.txt", "sweep.svg"):
                continue
            data = path.read_bytes()
            if path.name.endswith("run.json"):
                data = json.dumps({**json.loads(data), "timing": None, "command_line": None}).encode()
            elif path.suffix in (".csv", ".json", ".md") and name.count("/") == 0 and path.name.startswith(
                    ("summary", "sweep")):
                data = b"table with times"
            found[name] = hashlib.sha256(data).hexdigest()
        return found

    def inputs(self):
        return self.contents(self.folder / "in") | {
            str(p): hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(DEMO.glob("side*"))}

    def reference(self, name):
        out = str(self.folder / f"sound_{name}")
        shutil.rmtree(out, ignore_errors=True)  # of an earlier kind of trial
        start = time.monotonic()
        run = self.run(self.command(name, out))
        if run.returncode != 0:
            sys.exit(f"{name}: {run.stderr}")
        return self.contents(out), time.monotonic() - start

    def complete_ones_differ(self, out, sound):
        """Files of folders that say they are complete, by run.json, and that are not the sound ones."""
        found = self.contents(out) if os.path.isdir(out) else {}
        whole = {str(pathlib.Path(f).parent) for f in found if f.endswith("run.json")}
        return [f for f in found if str(pathlib.Path(f).parent) in whole and sound.get(f) not in (None, found[f])
                and not f.endswith((".bin", "claim"))]

    def judge(self, trial, name, out, sound, inputs, half_removed=False):
        wrong = []
        if self.inputs() != inputs:
            wrong.append("an input changed")
        wrong += [f"complete and other: {f}" for f in self.complete_ones_differ(out, sound)]
        run = self.again(name, out)
        if half_removed and run.returncode in (1, 2) and "choose another" in run.stderr:
            shutil.rmtree(out)  # what is left has no marker: not ours, and left alone
            run = self.again(name, out)
        if run.returncode != 0:
            wrong.append(f"run again: exit {run.returncode}: {run.stderr.strip()[-200:]}")
        found = self.contents(out)
        # A marker that went with the folder only makes its files nobody's: they are left alone.
        wrong += [f"afterwards other: {f}" for f in sorted(set(found) | set(sound)) if found.get(f) != sound.get(f)
                  and not (half_removed and "/.walktrack_" in f"/{f}")]
        self.lost += [f"{trial}, {name}: {w}" for w in wrong]
        for w in wrong:
            print(f"  {trial}, {name}: {w}", flush=True)
        shutil.rmtree(out, ignore_errors=True)
        return not wrong

    def row(self, what, command, trials, disturbed, fine):
        self.rows.append((what, command, trials, disturbed, fine))
        print(f"{what}, {command}: {trials} trials, {disturbed} disturbed, {fine} lost nothing", flush=True)

    def killed(self, name):
        sound, seconds = self.reference(name)
        inputs, disturbed, fine = self.inputs(), 0, 0
        trials = self.kills // 5
        for k in range(trials):
            out = str(self.folder / f"killed_{name}")
            program = subprocess.Popen([self.binary, *self.command(name, out)], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL, start_new_session=True)
            time.sleep(seconds * self.random.random())
            # Every second time with its children, as an end of power does.
            (os.killpg if k % 2 else os.kill)(program.pid, signal.SIGKILL)
            disturbed += program.wait() == -signal.SIGKILL
            time.sleep(0 if k % 2 else 0.05)
            fine += self.judge(f"kill {k}", name, out, sound, inputs)
        self.row("killed at a random moment", name, trials, disturbed, fine)

    def full(self, name):
        sound, _ = self.reference(name)
        counted = self.folder / "writes"
        counted.unlink(missing_ok=True)
        out = str(self.folder / f"full_{name}")
        system = {"LD_PRELOAD": self.system}
        self.run(self.command(name, out), {**system, "COUNT_WRITES": str(counted)})
        shutil.rmtree(out)
        writes = max(int(line) for line in counted.read_text().split())
        inputs, disturbed, fine = self.inputs(), 0, 0
        every = max(1, writes // MOST_WRITES)
        for at in range(1, writes + 1, every):
            run = self.run(self.command(name, out), {**system, "FAIL_WRITE_AT": str(at)})
            said = run.returncode == 1 and bool(re.search(r"\w", run.stderr))
            disturbed += run.returncode != 0
            if run.returncode != 0 and not said:
                self.lost.append(f"write {at}, {name}: exit {run.returncode} without a word")
            fine += self.judge(f"write {at}", name, out, sound, inputs) and (said or run.returncode == 0)
        what = "every write" if every == 1 else f"every {every}th write"
        self.row(f"{what} fails, one after the other, and all that follow", name, len(range(1, writes + 1, every)),
                 disturbed, fine)

    def removed(self, name):
        sound, seconds = self.reference(name)
        inputs, disturbed, fine = self.inputs(), 0, 0
        for k in range(20):
            out = str(self.folder / f"removed_{name}")
            program = subprocess.Popen([self.binary, *self.command(name, out)], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
            time.sleep(seconds * self.random.random())
            shutil.rmtree(out, ignore_errors=True)
            said = program.communicate()[1].strip()
            disturbed += program.returncode != 0
            ended = program.returncode in (0, 1) and (program.returncode == 0 or said)
            if not ended:
                self.lost.append(f"folder removed, {name}: exit {program.returncode}: {said[-200:]}")
            fine += self.judge(f"removed {k}", name, out, sound, inputs, half_removed=True) and bool(ended)
        self.row("output folder removed at a random moment", name, 20, disturbed, fine)

    def read_only(self, name):
        if os.getuid() != 0:
            return
        parent = self.folder / "locked"
        parent.mkdir(mode=0o555)
        inputs = self.inputs()
        run = self.run(self.command(name, str(parent / "out")), user=65534)
        fine = run.returncode == 1 and "locked" in run.stderr and not list(parent.iterdir()) and \
            self.inputs() == inputs
        if not fine:
            self.lost.append(f"no right to write, {name}: exit {run.returncode}: {run.stderr.strip()[-200:]}")
        parent.rmdir()
        self.row("no right to write", name, 1, 1, int(fine))

    def two_workers(self, what, environment):
        sound, _ = self.reference("batch")
        inputs, fine, trials = self.inputs(), 0, 10
        for k in range(trials):
            out = str(self.folder / "shared")
            workers = [subprocess.Popen([self.binary, *self.command("batch", out)], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL,
                                        env={**os.environ, "LD_PRELOAD": self.system, **environment})
                       for _ in range(2)]
            codes = [worker.wait() for worker in workers]
            ended = all(code in (0, 1) for code in codes)
            if not ended:
                self.lost.append(f"{what}: exit codes {codes}")
            fine += self.judge(f"{what} {k}", "batch", out, sound, inputs) and ended
        self.row(what, "batch", trials, trials, fine)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--only", default="")
    parser.add_argument("--out")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    commands = ["track", "batch", "sweep", "calibrate", "render"]
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        trials = Trials(given.binary, pathlib.Path(folder), given.kills, given.seed)
        steps = [("killed", trials.killed), ("full", trials.full), ("removed", trials.removed),
                 ("read_only", trials.read_only)]
        for word, step in steps:
            for name in commands:
                if given.only in f"{word} {name}":
                    step(name)
        if given.only in "workers":
            trials.two_workers("two workers, renames and new folders take 0.1 s", {"SLOW_RENAMES_MS": "100"})
            trials.two_workers("two workers, the clock jumps by a day to and fro", {"CLOCK_STEPS_S": "86400"})
    lines = ["| what happens | to | trials | disturbed | lost nothing |", "|---|---|---:|---:|---:|"]
    lines += [f"| {what} | `{name}` | {n} | {disturbed} | {fine} |" for what, name, n, disturbed, fine in trials.rows]
    print("\n".join([*lines, "", *trials.lost]))
    if given.out:
        pathlib.Path(given.out).write_text("\n".join(lines) + "\n")
    return 1 if trials.lost else 0


if __name__ == "__main__":
    sys.exit(main())
