#!/usr/bin/env python3
"""Puts gcovr's summary, by module, into a document between its marks.

    scripts/coverage_table.py SUMMARY.json DOCUMENT.md COMMAND
"""
import collections
import datetime
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MARKED = re.compile(r"(<!-- table -->\n).*?(<!-- end of table -->)", re.DOTALL)
LEAST_LINES = 20  # of a file that is named for what it lacks


def module_of(name):
    parts = name.split("/")
    return "/".join(parts[:2]) if parts[0] == "lib" else parts[0]


def table(files):
    modules = collections.defaultdict(collections.Counter)
    for each in files:
        for place in (module_of(each["filename"]), "all"):
            for key in ("line_total", "line_covered", "branch_total", "branch_covered"):
                modules[place][key] += each[key]
    rows = ["| module | lines | run | branches | taken | least run |", "|---|---:|---:|---:|---:|---|"]
    for name in [*sorted(set(modules) - {"all"}), "all"]:
        of = modules[name]
        inside = [f for f in files if module_of(f["filename"]) == name and f["line_total"] >= LEAST_LINES]
        least = sorted(inside, key=lambda f: f["line_covered"] / f["line_total"])[:2]
        worst = ", ".join(f"{pathlib.Path(f['filename']).name} {percent(f, 'line')}" for f in least
                          if f["line_covered"] < 0.95 * f["line_total"])
        rows.append(f"| {name} | {of['line_total']} | {percent(of, 'line')} | {of['branch_total']} | "
                    f"{percent(of, 'branch')} | {worst} |")
    return rows


def percent(counts, what):
    total = counts[f"{what}_total"]
    return f"{100 * counts[f'{what}_covered'] / total:.1f} %" if total else "–"


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    files = json.loads(pathlib.Path(sys.argv[1]).read_text())["files"]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, check=True, text=True,
                            stdout=subprocess.PIPE).stdout.strip()
    head = f"Measured on {datetime.date.today()} at commit {commit}: `{sys.argv[3]}`."
    document = pathlib.Path(sys.argv[2])
    block = "\n".join([head, "", *table(files), ""])
    text, count = MARKED.subn(lambda found: f"{found[1]}{block}{found[2]}", document.read_text())
    if count != 1:
        sys.exit(f"{document}: found {count} places for the table, wanted 1")
    document.write_text(text)


if __name__ == "__main__":
    main()
