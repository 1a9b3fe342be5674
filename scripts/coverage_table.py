#!/usr/bin/env python3
"""Puts the rows of some modules of gcovr's summary into tests/coverage.csv, and the whole table into tests/coverage.md
between its marks.

    scripts/coverage_table.py SUMMARY.json --by PROGRAM ...

--by: the test programs whose runs the summary counts; the rows are those of their modules. jobs:3/8 has run three of
its eight parts.
"""
import argparse
import collections
import csv
import datetime
import json
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
DATA, DOCUMENT = ROOT / "tests/coverage.csv", ROOT / "tests/coverage.md"
MARKED = re.compile(r"(<!-- table -->\n).*?(<!-- end of table -->)", re.DOTALL)
LEAST_LINES = 20  # of a file that is named for what it lacks
COUNTS = {"lines": "line_total", "run": "line_covered", "branches": "branch_total", "taken": "branch_covered"}
COLUMNS = ["module", *COUNTS, "least run", "by", "commit", "date"]


def module_of(name):
    parts = name.split("/")
    return parts[1] if parts[0] == "lib" else parts[0]


def percent(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else "–"


def least_run(files):
    """The two files of which the smallest share is run."""
    share = lambda f: f["line_covered"] / f["line_total"]
    least = sorted((f for f in files if f["line_total"] >= LEAST_LINES), key=share)[:2]
    return "; ".join(f"{pathlib.Path(f['filename']).name} {percent(f['line_covered'], f['line_total'])}"
                     for f in least if share(f) < 0.95)


def rows_of(files, by):
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, check=True, text=True,
                            stdout=subprocess.PIPE).stdout.strip()
    for module in (program.split(":")[0] for program in by):
        inside = [f for f in files if module_of(f["filename"]) == module]
        if inside:
            counts = {name: sum(f[key] for f in inside) for name, key in COUNTS.items()}
            yield {"module": module, **counts, "least run": least_run(inside), "by": " ".join(by), "commit": commit,
                   "date": str(datetime.date.today())}


def table(rows):
    lines = ["| module | lines | run | branches | taken | least run | commit |", "|---|---:|---:|---:|---:|---|---|"]
    total = collections.Counter()
    for row in rows:
        total.update({name: int(row[name]) for name in COUNTS})
    for row in [*rows, {"module": "all", **total, "least run": "", "commit": ""}]:
        numbers = {name: int(row[name]) for name in COUNTS}
        part = next((f" ({of.split(':')[1]} of its tests)" for of in row.get("by", "").split()
                     if of.startswith(row["module"] + ":")), "")
        lines.append(f"| {row['module']}{part} | {numbers['lines']} | {percent(numbers['run'], numbers['lines'])} | "
                     f"{numbers['branches']} | {percent(numbers['taken'], numbers['branches'])} | {row['least run']} | "
                     f"{row['commit']} |")
    return "\n".join([*lines, ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("summary", type=pathlib.Path)
    parser.add_argument("--by", nargs="+", required=True)
    given = parser.parse_args()
    files = json.loads(given.summary.read_text())["files"]
    known = {row["module"]: row for row in csv.DictReader(DATA.open())} if DATA.exists() else {}
    known.update({row["module"]: row for row in rows_of(files, given.by)})
    rows = [known[module] for module in sorted(known)]
    with DATA.open("w") as file:
        out = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        out.writeheader()
        out.writerows(rows)
    text, count = MARKED.subn(lambda found: f"{found[1]}{table(rows)}{found[2]}", DOCUMENT.read_text())
    if count != 1:
        raise SystemExit(f"{DOCUMENT}: found {count} places for the table, wanted 1")
    DOCUMENT.write_text(text)


if __name__ == "__main__":
    main()
