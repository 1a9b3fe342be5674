#!/usr/bin/env python3
"""Compares documents, help texts, the configuration's comments and those of sources and scripts with the project's
words (tests/words.txt), and checks that links between documents lead to files that exist.

    words_test.py WALKTRACK SOURCE_FOLDER
"""
import pathlib
import re
import subprocess
import sys

WORDS_LEFT_OUT = {"CHANGELOG.md", "tests/words_test.py"}  # they name old words
GENERATED = {"build", "out", ".git"}
SOURCES = ["apps", "lib", "tests", "scripts"]
CPP, SCRIPTS = {".cpp", ".h", ".in"}, {".cmake", ".py", ".sh", ".txt"}
PLANTED = ["int i = 0;  // whoever says nothing", "// the film\n// of the walker", 'f("//");  // legs exchanged']
PLANTED_SCRIPTS = ["x = 1  # whoever says nothing", '"""Which legs\nare exchanged."""']


def rules(source):
    for line in (source / "tests/words.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            pattern, preferred = line.split("\t")
            # A phrase may go on in the next line.
            yield re.compile(pattern.replace(" ", r"[ \n]"), re.IGNORECASE), preferred


def without_code(text):
    """The same lines with code blanked."""
    blank = lambda found: re.sub(r"[^\n]", " ", found.group(0))
    text = re.sub(r"^```.*?^```", blank, text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^    .*$", blank, text, flags=re.MULTILINE)
    return re.sub(r"`[^`\n]*`|\]\([^)]*\)", blank, text)


def documents(source):
    for file in sorted(source.rglob("*.md")):
        place = file.relative_to(source)
        if not GENERATED.intersection(place.parts):
            yield str(place), file


def comments(source):
    """The sources with everything blanked except comments."""
    for folder in SOURCES:
        for file in sorted((source / folder).rglob("*")):
            place = file.relative_to(source)
            if str(place) in WORDS_LEFT_OUT:
                continue
            if file.suffix in CPP:
                yield str(place), comments_of(file.read_text())
            elif file.suffix in SCRIPTS and (file.suffix != ".txt" or file.name == "CMakeLists.txt"):
                yield str(place), script_comments(file.read_text())


def comments_of(text):
    found = (re.match(r"""(?:[^"'/]|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])+'|'|/(?!/))*//(.*)""", line) for line in text.splitlines())
    joined = "\n".join(line.group(1).strip() if line else "" for line in found)
    return re.sub(r"`[^`\n]*`", "", joined)


def script_comments(text):
    """The comments and docstrings of Python, shell and CMake, in their lines."""
    lines, docstring = [], False
    for line in text.splitlines():
        comment = re.search(r"(?<!\S)#(.*)", line)
        quotes = line.count('"""')
        lines.append(line if docstring or quotes else comment.group(1).strip() if comment else "")
        docstring ^= quotes == 1
    return re.sub(r"`[^`\n]*`", "", "\n".join(line.strip() for line in lines))


def help_texts(walktrack):
    text = lambda *words: subprocess.run([walktrack, *words], capture_output=True, text=True, check=True).stdout
    yield "walktrack --help", text("--help")
    for name in text("--help-words").split():
        if not name.startswith("--"):
            yield f"walktrack {name} --help", text(name, "--help")
    yield "walktrack config", text("config")


def unwanted(place, text, words):
    for pattern, preferred in words:
        for found in pattern.finditer(text):
            line = text.count("\n", 0, found.start()) + 1
            yield f"{place}:{line}: '{found.group(0)}' is called: {preferred}"


def anchors(text):
    """What headings are called in links."""
    for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        yield re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def broken_links(place, file):
    text = file.read_text()
    for path, anchor in re.findall(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)", text):
        if "://" in path:
            continue
        target = file.parent / path if path else file
        if not target.exists():
            yield f"{place}: leads nowhere: {path}"
        elif anchor and anchor not in anchors(target.read_text()):
            yield f"{place}: leads to no heading: {path}#{anchor}"


def main():
    walktrack, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    words = list(rules(source))
    problems, looked_at = [], 0
    for place, file in documents(source):
        problems += broken_links(place, file)
        if place not in WORDS_LEFT_OUT:
            problems += unwanted(place, without_code(file.read_text()), words)
        looked_at += 1
    for place, text in help_texts(str(walktrack)):
        problems += unwanted(place, text, words)
        looked_at += 1
    sources = 0
    for place, text in comments(source):
        problems += unwanted(place, text, words)
        sources += 1
    for read, planted in [(comments_of, PLANTED), (script_comments, PLANTED_SCRIPTS)]:
        problems += [f"not noticed: {text}" for text in planted if not list(unwanted("", read(text), words))]
    print("\n".join(problems))
    print(f"{looked_at} documents and help texts, {sources} sources, {len(words)} words, {len(problems)} problems")
    sys.exit(1 if problems or looked_at < 20 or sources < 500 else 0)


main()
