#!/usr/bin/env python3
"""Measures the tables of the documents and puts them there. tests/figures/figures.toml lists them: name, command,
document. What a command prints is kept in tests/figures/NAME.md with commit, date, machine and command, and
stands in the document between `<!-- figures: NAME -->` and `<!-- end of figures -->`. tests/figures/figures_test.py sees
to it that documents say what was measured, and not too long ago.

    scripts/figures.py WALKTRACK OUT [NAME ...]     measures all tables, or some, in OUT/COMMIT
    scripts/figures.py --insert                     puts the kept ones into the documents again
"""
import datetime
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEPT = ROOT / "tests/figures"


def tables():
    return tomllib.loads((KEPT / "figures.toml").read_text())["table"]


def output_of(*words):
    return subprocess.run(words, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return os.uname().machine


def measure(table, walktrack, out):
    if output_of("git", "status", "--porcelain", "lib", "configs"):
        sys.exit("lib/ or configs/ differ from the last commit: commit first, then measure")
    commit = output_of("git", "rev-parse", "--short", "HEAD").strip()
    results = out / commit  # the scripts measure what is not there yet: never what another commit has left
    command = shlex.split(table["command"].format(walktrack=walktrack, out=results / table["name"], all=results))
    printed = output_of(*command).strip()
    head = (f"Measured on {datetime.date.today()} at commit {commit} with {len(os.sched_getaffinity(0))} cores of "
            f"{processor()}: `scripts/figures.sh {table['name']}`.")
    (KEPT / f"{table['name']}.md").write_text(f"{head}\n\n{printed}\n")


def insert(table):
    document = ROOT / table["document"]
    block = (KEPT / f"{table['name']}.md").read_text()
    marked = re.compile(rf"(<!-- figures: {table['name']} -->\n).*?(<!-- end of figures -->)", re.DOTALL)
    text, count = marked.subn(lambda found: f"{found[1]}{block}{found[2]}", document.read_text())
    if count != 1:
        sys.exit(f"{table['document']}: found {count} marks of the figures '{table['name']}', wanted 1")
    document.write_text(text)


def main():
    words = sys.argv[1:]
    if not words or words[0].startswith("-") and words != ["--insert"]:
        sys.exit(__doc__)
    known = tables()
    if words != ["--insert"]:
        walktrack, out, names = pathlib.Path(words[0]).resolve(), pathlib.Path(words[1]).resolve(), words[2:]
        unknown = set(names) - {table["name"] for table in known}
        if unknown:
            sys.exit(f"no tables of these names: {', '.join(sorted(unknown))}; there are "
                     f"{', '.join(table['name'] for table in known)}")
        known = [table for table in known if not names or table["name"] in names]
        for table in known:
            measure(table, walktrack, out)
    for table in known:
        insert(table)


if __name__ == "__main__":
    main()
