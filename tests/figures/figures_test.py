#!/usr/bin/env python3
"""Documents state what was measured: every marked table of a document is the kept one, of a commit of this history
that is not too old, the fit sets of constants and the sets on which they are quoted are disjoint, and README.md and
the modules' pages state no measured figure outside of such a table without its source: a link to a dated report, the
commit, or "by hand"."""
import pathlib
import re
import subprocess
import sys
import tomllib

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent
FIGURE = re.compile(r"\b\d+(?:[.,]\d+)?\s?(?:mm|cm|degrees|frames/s|ms a frame|nats)(?!\w)")
REPORT = re.compile(r"\]\((?:lib|reports|\.\./\w+/reports)/|`lib/\w+/reports/")
OTHER_SOURCE = re.compile(r"at commit [0-9a-f]{7}|by hand")  # on the page of a module
MEASURED = re.compile(r"^Measured on \d{4}-\d\d-\d\d at commit ([0-9a-f]{7,}) ")


def git(*words):
    return subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True)


def commits_since(commit):
    """To the code that is measured, documents left out; None where the history does not say."""
    if git("cat-file", "-e", f"{commit}^{{commit}}").returncode != 0:
        return None
    counted = git("rev-list", "--count", f"{commit}..HEAD", "--", "lib", "configs", ":!*.md")
    return int(counted.stdout) if counted.returncode == 0 else None


def faults_of(table, most_commits):
    kept = (FOLDER / f"{table['name']}.md").read_text()
    block = f"<!-- figures: {table['name']} -->\n{kept}<!-- end of figures -->"
    if block not in (ROOT / table["document"]).read_text():
        yield f"{table['document']}: the figures '{table['name']}' are not the measured ones: scripts/figures.py --insert"
    measured = MEASURED.match(kept)
    if not measured:
        yield f"{table['name']}.md: its first line says not when it was measured"
        return
    age = commits_since(measured[1])
    if age is None:
        print(f"SKIPPED: the age of the figures '{table['name']}': commit {measured[1]} is not in this history")
    elif age > most_commits:
        yield f"{table['name']}: measured {age} commits ago, at most {most_commits}: scripts/figures.sh {table['name']}"


def rows_of(name):
    for line in (FOLDER / f"{name}.md").read_text().splitlines():
        if line.startswith("| ") and not line.startswith("| video"):
            yield [cell.strip() for cell in line.strip("|").split("|")]


def mixed_sets(fit):
    for row in rows_of(fit["quoted_in"]):
        named = [video for video in fit["videos"] if video in row[0]]
        if bool(named) != (row[-1] == "yes"):
            yield f"{fit['quoted_in']}: '{row[0]}' says '{row[-1]}', and {fit['constants']} were fitted on {fit['videos']}"


def wrong_quotes(quote):
    text = " ".join((ROOT / quote["text"]).read_text().split())
    kept = (FOLDER / f"{quote['table']}.md").read_text()
    for phrase in quote["phrases"]:
        if phrase not in text:
            yield f"{quote['text']}: does not say '{phrase}', as figures.toml has it"
        if phrase not in kept:
            yield f"{quote['text']}: '{phrase}' is not what {quote['table']}.md has measured"


def figures_without_source(place):
    text = (ROOT / place).read_text()
    text = re.sub(r"<!-- figures: .*?<!-- end of figures -->", "", text, flags=re.DOTALL)
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    for paragraph in re.split(r"\n\s*\n|\n(?=- )|\n(?=\|)", text):
        sourced = REPORT.search(paragraph) or (place != "README.md" and OTHER_SOURCE.search(paragraph))
        if FIGURE.search(paragraph) and not sourced:
            yield f"{place}: a figure without its table or report: {' '.join(paragraph.split())[:100]}"


def main():
    spec = tomllib.loads((FOLDER / "figures.toml").read_text())
    wrong = [fault for table in spec["table"] for fault in faults_of(table, spec["most_commits"])]
    wrong += [fault for fit in spec["fit"] for fault in mixed_sets(fit)]
    wrong += [fault for quote in spec["quote"] for fault in wrong_quotes(quote)]
    pages = ["README.md", *sorted(str(page.relative_to(ROOT)) for page in ROOT.glob("lib/*/README.md"))]
    wrong += [fault for page in pages for fault in figures_without_source(page)]
    print("\n".join(wrong) or f"{len(spec['table'])} tables are as they were measured")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
