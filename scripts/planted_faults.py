#!/usr/bin/env python3
"""Measures whether tests notice faults. Plants the faults of tests/faults/faults.toml into copies of single
sources, one at a time, links the test programs that are named for each and runs them until one fails. Writes
tests/faults/caught.csv: which test caught which fault, at which commit. The working tree does not
change. The test programs are built first, as for every other test; sources that are compiled together with
the faulty one are compiled with it again.

  scripts/planted_faults.py [--build build/ci] [--jobs 1] [--only WORD] [--new]

--only: faults whose area or description holds the word; --new: only those without a row. Exit code 1
if a fault was not caught."""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "tests/faults/caught.csv"
COLUMNS = ["area", "fault", "caught by", "commit"]
LONGEST = 900  # s, of a test program; slower than the slowest when two run at a time


def program_of(test):
    return test.split(":")[0]


class Build:
    def __init__(self, folder, programs):
        self.folder = folder
        subprocess.run(["cmake", "--preset", "ci", "-B", folder], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["ninja", "-C", folder, *programs], check=True, stdout=subprocess.DEVNULL)
        self.commands = {
            program: subprocess.run(["ninja", "-C", folder, "-t", "commands", program], check=True,
                                    capture_output=True, text=True).stdout.splitlines()
            for program in programs}

    # The command that compiles a source, by itself or within a file that includes it and others.
    def command_for(self, source):
        for line in {line for lines in self.commands.values() for line in lines}:
            compiled = re.search(r" -c (\S+)$", line)
            if not compiled:
                continue
            unit = pathlib.Path(self.folder, compiled[1])
            if unit == ROOT / source or (unit.parent.name == "Unity" and f'"{ROOT / source}"' in unit.read_text()):
                return shlex.split(line), unit
        raise RuntimeError(f"no command compiles {source}")

    def compile(self, source, faulty, obj):
        words, unit = self.command_for(source)
        if unit != ROOT / source:
            together = obj.with_suffix(".cxx")
            together.write_text(unit.read_text().replace(f'"{ROOT / source}"', f'"{faulty}"'))
            faulty = together
        words[words.index("-c") + 1] = str(faulty)
        words[words.index("-o") + 1] = str(obj)
        words[words.index("-MF") + 1] = str(obj) + ".d"
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True)

    # The object comes before the archives, whose member of that name then is not wanted any more.
    def link(self, program, obj, out):
        line = next(l for l in reversed(self.commands[program]) if f" -o {program} " in l)
        line = line.replace(f" -o {program} ", f" {shlex.quote(str(obj))} -o {shlex.quote(str(out))} ")
        subprocess.run(line, shell=True, cwd=self.folder, check=True, capture_output=True)


def first_failure(program, pattern):
    command = [str(program), "--gtest_fail_fast", "--gtest_brief=1"]
    if pattern:
        command.append("--gtest_filter=" + pattern)
    try:
        run = subprocess.run(command, capture_output=True, text=True, errors="replace",
                             timeout=LONGEST, env={**os.environ, "RC_PARAMS": "seed=1"})
    except subprocess.TimeoutExpired:
        return "no end"
    if run.returncode == 0:
        return None
    failed = re.findall(r"^\[  FAILED  \] ([\w/.]+)", run.stdout, re.M)
    return failed[0] if failed else f"ends with {run.returncode}"


def plant(build, fault):
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        source = "lib/" + fault["file"]
        text = (ROOT / source).read_text()
        if text.count(fault["was"]) != 1:
            return f"NOT PLANTED: {source} has the text {text.count(fault['was'])} times"
        faulty = scratch / pathlib.Path(source).name
        faulty.write_text(text.replace(fault["was"], fault["is"]))
        built = build.compile(source, faulty, scratch / "faulty.o")
        if built.returncode != 0:
            return "NOT PLANTED: does not compile: " + built.stderr.strip().splitlines()[-1]
        for test in fault["tests"]:
            program, _, pattern = test.partition(":")
            build.link(program, scratch / "faulty.o", scratch / program)
            failed = first_failure(scratch / program, pattern)
            if failed:
                return f"{program} {failed}"
            (scratch / program).unlink()
    return "NOT CAUGHT"


def read_table():
    if not TABLE.exists():
        return {}
    with TABLE.open() as file:
        return {row["fault"]: row for row in csv.DictReader(file)}


def write_table(faults, rows):
    with TABLE.open("w") as file:
        out = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        out.writeheader()
        for fault in faults:
            if fault["what"] in rows:
                out.writerow(rows[fault["what"]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--build", default="build/ci")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="", metavar="WORD")
    parser.add_argument("--new", action="store_true")
    given = parser.parse_args()
    faults = tomllib.loads((ROOT / "tests/faults/faults.toml").read_text())["fault"]
    rows = read_table()
    wanted = [f for f in faults if given.only in f["area"] + " " + f["what"]
              and not (given.new and f["what"] in rows)]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.strip()
    build = Build((ROOT / given.build).resolve(),
                  sorted({program_of(test) for f in wanted for test in f["tests"]}))
    missed = 0
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for fault, caught in zip(wanted, pool.map(lambda f: plant(build, f), wanted)):
            print(f"{fault['area']}: {fault['what']}: {caught}", flush=True)
            missed += caught.startswith("NOT")
            rows = read_table()  # another run may have written since
            rows[fault["what"]] = dict(zip(COLUMNS, [fault["area"], fault["what"], caught, commit]))
            write_table(faults, rows)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
