#!/usr/bin/env python3
"""Compares the #includes below lib/ with the module graph declared in lib/CMakeLists.txt.

A module may include its own headers and those of the modules that it names in DEPS, directly or
through them. It also keeps OpenCV, yaml-cpp and Boost inside the modules meant for them, every source of
a module in the module's inline namespace, headers' names apart from each other, every source beside
a header of its name, and folders small.
"""
import itertools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALLOWED_OUTSIDE = {
    "opencv2": {"observation", "io"},
    "yaml-cpp": {"io"},
    "boost": set(),
    "libavformat": {"io"},
    "libavcodec": {"io"},
    "libavutil": {"io"},
    "libswscale": {"io"},
    "toml++": {"io"},
    "nlohmann": {"io", "jobs"},
}
# A job passes images along as observation/image.h calls them; it neither looks into them nor draws.
NAMES_NO_OPENCV = {"jobs"}

# Sources without a header of their name: what they implement is declared in these.
SHARED_HEADERS = {
    "gait/prior/shipped_prior.cpp.in": "prior_file.h",  # a table
    "observation/pose_net/no_pose_net.cpp": "pose_net.h",  # builds without OpenCV's networks
    "walker/linkage/linkage_events.cpp": "linkage_walker.h",  # the events of that class
}
MOST_FILES = 24  # of a folder


def declared_graph():
    text = re.sub(r"#.*", "", (ROOT / "lib/CMakeLists.txt").read_text())
    graph = {}
    for body in re.findall(r"walktrack_module\(([^)]*)\)", text):
        words = body.split()
        name, deps, take = words[0], [], False
        for word in words[1:]:
            if word.isupper():
                take = word == "DEPS"
            elif take:
                deps.append(word)
        graph[name] = deps
    return graph


def reachable(graph, name):
    seen, todo = {name}, [name]
    while todo:
        for dep in graph[todo.pop()]:
            if dep not in seen:
                seen.add(dep)
                todo.append(dep)
    return seen


def violations(graph):
    for module in sorted(graph):
        allowed = reachable(graph, module)
        for path in sorted((ROOT / "lib" / module).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            for number, line in enumerate(path.read_text().splitlines(), 1):
                if module in NAMES_NO_OPENCV and re.search(r"\bcv::", line.split("//")[0]):
                    yield f"{path.relative_to(ROOT)}:{number}: {module} may not name OpenCV, see observation/image.h"
                found = re.match(r'\s*#\s*include\s*[<"]([^/>"]+)/', line)
                if not found:
                    continue
                first = found.group(1)
                if first in graph and first not in allowed:
                    yield f"{path.relative_to(ROOT)}:{number}: {module} may not include {first}"
                if module not in ALLOWED_OUTSIDE.get(first, {module}):
                    yield f"{path.relative_to(ROOT)}:{number}: {first} is not for {module}"


def strays(graph):
    """Namespaces that are not their module's, and headers of one name."""
    headers = {}
    for module in sorted(graph):
        for path in sorted((ROOT / "lib" / module).rglob("*")):
            if path.suffix not in (".h", ".cpp", ".in"):
                continue
            where = path.relative_to(ROOT)
            for outer, inner in itertools.pairwise(path.read_text().splitlines()):
                if outer.startswith("namespace walktrack") and inner != f"inline namespace {module} {{":
                    yield f"{where}: '{outer}' is not followed by 'inline namespace {module} {{'"
            if path.suffix == ".h" and (first := headers.setdefault(path.name, where)) != where:
                yield f"{where}: {first} has the same name"


def unpaired(sources, headers):
    """Sources that have no header of their name beside them, paths below lib/."""
    for source in sources:
        place, name = source.rsplit("/", 1)
        header = SHARED_HEADERS.get(source, name.split(".")[0] + ".h")
        if f"{place}/{header}" not in headers:
            yield f"lib/{source}: {header} does not exist beside it"


def crowded(files):
    """Folders with too many files."""
    folders = [file.rsplit("/", 1)[0] for file in files]
    for folder in sorted(set(folders)):
        if (count := folders.count(folder)) > MOST_FILES:
            yield f"lib/{folder}: {count} files, {MOST_FILES} are allowed: split it by subject"


def not_noticed():
    """Planted faults that the checks of pairs and folders overlook."""
    if len(list(unpaired(["a/b/c.cpp", "a/b/d.cpp"], {"a/b/c.h", "a/d.h"}))) != 1:
        yield "a source without a header is not noticed"
    if len(list(crowded(["a/b/c.h"] * MOST_FILES + ["a/d/c.h"] * (MOST_FILES + 1)))) != 1:
        yield "a crowded folder is not noticed"


def main():
    graph = declared_graph()
    if "core" not in graph:
        sys.exit("no module found in lib/CMakeLists.txt")
    files = [str(path.relative_to(ROOT / "lib")) for path in sorted((ROOT / "lib").rglob("*"))
             if path.suffix in (".h", ".cpp", ".in")]
    sources = [file for file in files if not file.endswith(".h")]
    found = [*violations(graph), *strays(graph), *unpaired(sources, set(files)), *crowded(files), *not_noticed()]
    print("\n".join(found) or f"{len(graph)} modules respect their layers")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
