#!/usr/bin/env python3
"""The planted faults can still be planted, and those that were are known to be caught by a test. Planting
them takes half an hour: scripts/planted_faults.py, see README.md."""
import csv
import pathlib
import sys
import tomllib

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent
LEAST = 233  # caught: all


def main():
    faults = tomllib.loads((FOLDER / "faults.toml").read_text())["fault"]
    rows = {row["fault"]: row["caught by"] for row in csv.DictReader((FOLDER / "caught.csv").open())}
    wrong, caught = [], 0
    for fault in faults:
        what, source = fault["what"], ROOT / "lib" / fault["file"]
        found = source.read_text().count(fault["was"]) if source.exists() else 0
        if found != 1:
            wrong.append(f"{what}: {fault['file']} has its text {found} times, not once")
        by = rows.pop(what, "not run yet")
        if by.startswith("NOT") and "open" not in fault:
            wrong.append(f"{what}: no test catches it")
        caught += not by.startswith(("not run", "NOT"))
    if caught < LEAST:
        wrong.append(f"{caught} faults are known to be caught, at least {LEAST} are wanted")
    wrong += [f"{what}: is in caught.csv and not in faults.toml" for what in rows]
    for fault in faults:
        if "open" in fault:
            print(f"OPEN: {fault['what']}: {fault['open']}")
    print("\n".join(wrong) or f"{len(faults)} faults, {caught} caught, {len(faults) - caught} open or not run yet")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
