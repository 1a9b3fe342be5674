#!/usr/bin/env python3
"""Runs every command of the documents as a reader would, in a copy of the source tree.

    documents_test.py WALKTRACK SOURCE_FOLDER [--quick]

Commands stand in fenced blocks of the kind `sh`; those of the kind `sh slow` are left out with --quick, and those
that read ../shared where that is absent, which is said. Each has to end with 0, or with 4 (tracked, below a gate).
A backslash joins lines. Links between documents must lead somewhere.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

DOCUMENTS = ["README.md", "apps/guide/README.md", "apps/guide/formats.md", "scripts/cluster/README.md"]
# These build the program and run the tests, this one included.
RUN_BY_OTHERS = ("scripts/demo.sh", "scripts/test.sh")


def blocks(text):
    """(line, words after the fence, content) of every fenced block."""
    for found in re.finditer(r"^```(\S*) ?(.*)\n((?:.*\n)*?)^```$", text, re.MULTILINE):
        yield text.count("\n", 0, found.start()) + 2, found.group(1), found.group(2).split(), found.group(3)


def commands(document, quick, shared):
    for line, kind, words, content in blocks(document.read_text()):
        if kind != "sh" or (quick and "slow" in words):
            continue
        if "../shared" in content and not shared.exists():
            print(f"{document.name}:{line}: skipped: {shared} is absent")
            continue
        for number, command in enumerate(content.replace("\\\n", "").splitlines(), line):
            if command.strip() and not command.startswith(("#",) + RUN_BY_OTHERS):
                yield number, command


def broken_links(document):
    for link in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", document.read_text()):
        if "://" not in link and not (document.parent / link).exists():
            yield f"{document}: leads nowhere: {link}"


def main():
    walktrack, source, quick = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), "--quick" in sys.argv
    shared = source.parent / "shared"
    failures = [problem for name in DOCUMENTS for problem in broken_links(source / name)]
    print("\n".join(failures), flush=True)
    passed = 0
    with tempfile.TemporaryDirectory() as temporary:
        tree = pathlib.Path(temporary) / "walktrack"
        shutil.copytree(source, tree, ignore=shutil.ignore_patterns("build", "out", ".git"))
        if shared.exists():
            (tree.parent / "shared").symlink_to(shared)
        (tree / "bin").mkdir()
        for place in ("bin", "build/release"):
            (tree / place).mkdir(parents=True, exist_ok=True)
            (tree / place / "walktrack").symlink_to(walktrack)
        environment = os.environ | {"PATH": f"{tree / 'bin'}:{os.environ['PATH']}"}
        for name in DOCUMENTS:
            # Readers of one document have not read the others: nothing is there to be overwritten.
            shutil.rmtree(tree / "out", ignore_errors=True)
            (tree / "out").mkdir()
            for line, command in commands(source / name, quick, shared):
                result = subprocess.run(["bash", "-c", command], cwd=tree, env=environment, capture_output=True, text=True, check=False)
                if result.returncode in (0, 4):
                    passed += 1
                else:
                    failures.append(f"{name}:{line}: {command}\n  exit {result.returncode}: {result.stderr[-400:]}")
                    print(failures[-1], flush=True)
    print(f"{passed} passed, {len(failures)} failed")
    sys.exit(1 if failures or passed == 0 else 0)


main()
