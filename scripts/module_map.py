#!/usr/bin/env python3
"""Draws the modules of lib/ and what they include of each other, from lib/CMakeLists.txt: layer by layer from the bottom,
without what follows through others.

    module_map.py             text, as CONTRIBUTING.md shows it
    module_map.py --dot       for Graphviz
    module_map.py --check     fails where CONTRIBUTING.md shows another map
"""
import pathlib
import sys

from check_layers import declared_graph, reachable

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "CONTRIBUTING.md"
FENCE = "```modules\n"


def direct(graph, name):
    """What the module names and does not get through another one."""
    through = set()
    for dep in graph[name]:
        through |= reachable(graph, dep) - {dep}
    return sorted(dep for dep in graph[name] if dep not in through)


def layers(graph):
    height = {}

    def of(name):
        if name not in height:
            height[name] = 1 + max((of(dep) for dep in graph[name]), default=-1)
        return height[name]

    rows = {}
    for name in graph:
        rows.setdefault(of(name), []).append(name)
    return [sorted(rows[level]) for level in sorted(rows)]


def as_text(graph):
    width = max(map(len, graph)) + 2
    lines = []
    for level, names in reversed(list(enumerate(layers(graph)))):
        for name in names:
            deps = ", ".join(direct(graph, name))
            lines.append(f"{level}  {name:<{width}}{'<- ' + deps if deps else ''}".rstrip())
    return "\n".join(lines) + "\n"


def as_dot(graph):
    edges = [f"  {dep} -> {name};" for name in graph for dep in direct(graph, name)]
    ranks = ["  {rank=same; " + "; ".join(names) + ";}" for names in layers(graph)]
    return "\n".join(["digraph modules {", "  rankdir=BT;", *ranks, *edges, "}"]) + "\n"


def shown():
    text = DOCUMENT.read_text()
    begin = text.index(FENCE) + len(FENCE)
    return text[begin:text.index("```", begin)]


def main():
    graph = declared_graph()
    if "--check" in sys.argv[1:]:
        if shown() != as_text(graph):
            sys.exit("CONTRIBUTING.md shows another map of modules than lib/CMakeLists.txt; paste this one:\n" + as_text(graph))
    else:
        print(as_dot(graph) if "--dot" in sys.argv[1:] else as_text(graph), end="")


main()
