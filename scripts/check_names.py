#!/usr/bin/env python3
"""In a module, and in the tests of one, no two files define a type, a constant or a function of one name and one list
of parameters, unnamed namespaces included: a reader who looks for it finds one, and builds that compile several
sources as one (CMakePresets.json) keep working whichever sources come together. Looks at definitions in the first
column only; prints what is there twice."""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MODULES = [folder for part in ("lib", "tests") for folder in sorted((ROOT / part).iterdir())
           if folder.is_dir() and folder.name != "bench"]  # a folder of several programs
ALTERNATIVES = {"no_pose_net.cpp"}  # compiled in the place of another file
TYPE = re.compile(r"(?:struct|class|enum class|enum) (\w+)(?: final)?(?: : [^;]*)? \{")
ALIAS = re.compile(r"using (\w+) = (.*);")
CONSTANTS = re.compile(r"(?:inline )?(?:constexpr|const) [^()=]*?\b(?=k[A-Z])(.*)")
CONSTANT = re.compile(r"\b(k[A-Z]\w*)(?= = |\{|\(|\[)")
FUNCTION = re.compile(r"(?! )[\w:<>,*& ]+? [&*]?(\w+)\((.*)\)(?: const)? \{")


def parameter_types(parameters):
    """The list without names and defaults."""
    return re.sub(r" ?\b\w+(?=,|$)", "", re.sub(r" *= *[^,]*", "", parameters))


def definitions(path):
    """What a file defines: name -> what it is, where that makes a difference."""
    out = {}
    header = path.suffix == ".h"
    for line in path.read_text().splitlines():
        if match := TYPE.match(line):
            out[match[1]] = path.name
        elif match := ALIAS.match(line):
            out[match[1]] = match[2]
        elif match := CONSTANTS.match(line):
            out.update({name: path.name for name in CONSTANT.findall(match[1])})
        elif not header and (match := FUNCTION.match(line)):
            out[f"{match[1]}({parameter_types(match[2])})"] = path.name
    return out


def main():
    problems = 0
    for folder in MODULES:
        found = collections.defaultdict(dict)
        for path in sorted(folder.rglob("*.[hc]*")):
            if path.suffix in (".h", ".cpp") and not path.name.endswith("-inl.h") and path.name not in ALTERNATIVES:
                for name, what in definitions(path).items():
                    found[name][path.name] = what
        for name, places in sorted(found.items()):
            if len(set(places.values())) > 1:
                problems += 1
                print(f"{folder.relative_to(ROOT)}: {name} is defined in {', '.join(places)}")
    if problems:
        sys.exit(1)
    print("no name is defined twice in a module")


if __name__ == "__main__":
    main()
