#!/usr/bin/env python3
"""Counts instructions of fixed work under callgrind and compares them with a stored table.

    count_instructions.py PROGRAM COMPILER TABLE.csv [--store]

The table has, for every group of work and for every function with at least 3 % of its group, how
many instructions there were. A rise beyond 10 % of a group fails, and so does one of a function whose
group has grown with it (the compiler may move work from one function into another); the function is
named. Counts repeat to the instruction on any machine with AVX2 (callgrind shows programs the same processor everywhere), for one
compiler: with another, or without callgrind, the test is skipped (exit code 77).
"""
import csv
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RISE, GROWN, SHARE, SKIPPED = 1.10, 1.01, 0.03, 77


def counted(dump: Path) -> tuple[str, dict[str, int]]:
    """The group that a dump is of, and every function's own instructions."""
    group, functions, function, called = "", {}, "", False
    for line in dump.read_text().splitlines():
        if match := re.match(r"desc: Trigger: Client Request: (.*)", line):
            group = match[1]
        elif line.startswith("fn="):
            function = line[3:]
        elif line.startswith("calls="):
            called = True  # the next line holds what the callee cost
        elif re.match(r"[+*\-\d]", line):
            if not called:
                functions[function] = functions.get(function, 0) + int(line.split()[1])
            called = False
    return group, functions


def short(name: str) -> str:
    """Without parameter lists, template arguments and our namespace: names the function, no more."""
    name = re.sub(r"\(anonymous namespace\)::|walktrack::(?:[a-z]+::)?|\[clone[^]]*\]|'\d+$", "", name)
    while (bare := re.sub(r"<[^<>]*>|\([^()]*\)", "", name)) != name:
        name = bare
    return (name.removesuffix(" const").split() or ["?"])[-1]


def table_of(program: str) -> dict[tuple[str, str], int]:
    table: dict[tuple[str, str], int] = {}
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            ["valgrind", "--tool=callgrind", "--instr-atstart=no", "--compress-strings=no",
             f"--callgrind-out-file={folder}/out", program],
            check=True, capture_output=True, timeout=300)
        for dump in sorted(Path(folder).glob("out.*")):
            group, functions = counted(dump)
            if not group:
                continue
            total = sum(functions.values())
            table[group, ""] = total
            for name, own in functions.items():
                key = (group, short(name))
                table[key] = table.get(key, 0) + own
            for key in [k for k in table if k[0] == group and table[k] < SHARE * total]:
                del table[key]
    return table


def main() -> int:
    program, compiler, path = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    if not shutil.which("valgrind"):
        print("skipped: no valgrind")
        return SKIPPED
    processor = Path("/proc/cpuinfo").read_text()
    if "avx2" not in processor:
        print("skipped: this processor has no AVX2, libraries take other ways")
        return SKIPPED
    if "rdtscp" not in processor:
        print("skipped: this processor has no RDTSCP, but valgrind says that it has, and libraries use it")
        return SKIPPED
    if "--store" in sys.argv:
        with path.open("w") as file:
            print(f"# {compiler}", file=file)
            print("group,function,instructions", file=file)
            for (group, function), number in sorted(table_of(program).items()):
                print(f"{group},{function},{number}", file=file)
        return 0
    lines = path.read_text().splitlines()
    if lines[0] != f"# {compiler}":
        print(f"skipped: the table was counted with {lines[0][2:]}, this is {compiler}")
        return SKIPPED
    stored = {(r["group"], r["function"]): int(r["instructions"]) for r in csv.DictReader(lines[1:])}
    now, failed = table_of(program), False
    for key, number in sorted(stored.items()):
        if key not in now and not key[1]:
            print(f"{key[0]}: is not counted any more")
            failed = True
        elif now.get(key, 0) > RISE * number and now[key[0], ""] > GROWN * stored[key[0], ""]:
            rise = 100 * (now[key] / number - 1)
            print(f"{' '.join(key)}: {number} -> {now[key]} instructions, +{rise:.0f} %")
            failed = True
    for key in sorted(now.keys() - stored.keys()):
        if not key[1]:
            print(f"{key[0]}: is not in the table")
            failed = True
    if failed:
        print("if it is meant to be so: cmake --build --preset ci --target store_instructions")
    else:
        print(f"{len(stored)} counts, none more than 10 % above the table")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
