#!/usr/bin/env python3
"""Runs every command of the documents as a reader would, in a copy of the source tree.

    documents_test.py WALKTRACK SOURCE_FOLDER [--quick]

Commands stand in fenced blocks of the kind `sh`; those marked `slow` are left out with --quick. Blocks marked `motion`
run a second time with measured motion capture in the place of the demo's truth; where that is absent, it is said.
So does the example at the end of every command's --help, `track` first, whose result another one reads. Each command has to end with 0, or with 4 (tracked, a quality check failed). A backslash joins lines. Links between documents
must lead somewhere.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

DOCUMENTS = ["README.md", "apps/guide/README.md", "apps/guide/speed.md", "apps/guide/quality.md", "apps/guide/programs.md", "apps/guide/formats.md", "apps/guide/features.md", "scripts/cluster/README.md", "lib/synth/README.md"]
# These build the program and run the tests, this one included.
RUN_BY_OTHERS = ("scripts/demo.sh", "scripts/test.sh")
SLOW_EXAMPLES = {"batch", "evaluate", "prior", "render", "selftest", "sweep", "track"}
STAND_IN, CAPTURE = "data/demo/truth.csv", "data/mocap/cmu_02_01.csv"


def blocks(text):
    """(line, words after the fence, content) of every fenced block."""
    for found in re.finditer(r"^```(\S*) ?(.*)\n((?:.*\n)*?)^```$", text, re.MULTILINE):
        yield text.count("\n", 0, found.start()) + 2, found.group(1), found.group(2).split(), found.group(3)


def versions(content, words, capture, place):
    """The block as it is and, if it is about any motion, with motion capture."""
    yield content
    if "motion" not in words:
        return
    if not capture.exists():
        print(f"{place}: with motion capture: skipped, {capture} is absent")
        return
    yield content.replace(STAND_IN, str(capture)).replace("out/", "out/captured_")


def commands(document, quick, capture):
    for line, kind, words, content in blocks(document.read_text()):
        if kind != "sh" or (quick and "slow" in words):
            continue
        for version in versions(content, words, capture, f"{document.name}:{line}"):
            for number, command in enumerate(version.replace("\\\n", "").splitlines(), line):
                if command.strip() and not command.startswith(("#",) + RUN_BY_OTHERS):
                    yield number, command


def examples(walktrack, quick):
    """The example of every command's help."""
    text = lambda *words: subprocess.run([walktrack, *words], capture_output=True, text=True, check=True).stdout
    names = [name for name in text("--help-words").split() if not name.startswith("--")]
    for name in sorted(names, key=lambda name: name != "track"):
        if not (quick and name in SLOW_EXAMPLES):
            yield f"{name} --help", text(name, "--help").split("\nExample:\n  ")[1].strip()


def broken_links(document):
    for link in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", document.read_text()):
        if "://" not in link and not (document.parent / link).exists():
            yield f"{document}: leads nowhere: {link}"


def main():
    walktrack, source, quick = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), "--quick" in sys.argv
    capture = source.parent / "shared" / CAPTURE
    failures = [problem for name in DOCUMENTS for problem in broken_links(source / name)]
    print("\n".join(failures), flush=True)
    passed = 0
    with tempfile.TemporaryDirectory() as temporary:
        tree = pathlib.Path(temporary) / "walktrack"
        shutil.copytree(source, tree, ignore=shutil.ignore_patterns("build", "out", ".git"))
        (tree / "bin").mkdir()
        for place in ("bin", "build/release"):
            (tree / place).mkdir(parents=True, exist_ok=True)
            (tree / place / "walktrack").symlink_to(walktrack)
        environment = os.environ | {"PATH": f"{tree / 'bin'}:{os.environ['PATH']}"}
        documents = {name: list(commands(source / name, quick, capture)) for name in DOCUMENTS}
        for name, found in {**documents, "the program": list(examples(walktrack, quick))}.items():
            # Readers of one document have not read the others: nothing is there to be overwritten.
            shutil.rmtree(tree / "out", ignore_errors=True)
            (tree / "out").mkdir()
            for place, command in found:
                result = subprocess.run(["bash", "-c", command], cwd=tree, env=environment, capture_output=True, text=True, check=False)
                if result.returncode in (0, 4):
                    passed += 1
                else:
                    failures.append(f"{name}:{place}: {command}\n  exit {result.returncode}: {result.stderr[-400:]}")
                    print(failures[-1], flush=True)
    print(f"{passed} passed, {len(failures)} failed")
    sys.exit(1 if failures or passed == 0 else 0)


main()
