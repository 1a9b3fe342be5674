#!/usr/bin/env python3
"""Runs clang-tidy (checks: .clang-tidy) over lib/ and apps/, as many files at a time as there are
processors. Fails when it finds anything. A file that was clean is looked at again only when it, a
header that it includes, its command line, the checks or clang-tidy have changed.

Nearly all time goes into the headers of others, so sources that are compiled as one (a unity build) are
looked at as one. Where such a group shows anything each of its files is looked at alone, and only
that counts.

usage: check_tidy.py [--names] [BUILD_FOLDER]
  BUILD_FOLDER  build/ci unless told, configured with Ninja and built
  --names       the names too: as long again as half of all other checks together
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The command lines are those of g++: its warnings are its own business.
OPTIONS = ["--quiet", "--extra-arg=-w", f"--config-file={ROOT}/.clang-tidy"]
GROUP_OPTION = "--header-filter=(lib|apps)/.*\\.(h|cpp)$"
WITHOUT_NAMES = ["--checks=-readability-identifier-naming"]


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def headers_of_objects(build):
    """Object file -> the files it was compiled from, as Ninja noted them."""
    headers, current = {}, None
    for line in output_of("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line.startswith("    "):
            headers[current].append((build / line.strip()).resolve())
        elif ": #deps" in line:
            current = line.split(": #deps")[0]
            headers[current] = []
    return headers


def object_of(entry):
    words = shlex.split(entry["command"])
    return words[words.index("-o") + 1]


def without_precompiled(entry):
    """As clang reads it: without what GCC alone can read."""
    words = shlex.split(entry["command"])
    while "-include" in words:
        at = words.index("-include")
        del words[at:at + 2]
    words = [word for word in words if word != "-Winvalid-pch"]
    return {**entry, "command": shlex.join(words)}


def key_of(entry, headers, common):
    """Changes when the outcome may change. Files of the system count by name only."""
    digest = hashlib.sha256((common + entry["command"]).encode())
    for path in sorted(headers[object_of(entry)]):
        digest.update(str(path).encode())
        if path.suffix != ".gch" and path.is_relative_to(ROOT) and path.is_file():
            digest.update(path.read_bytes())
    return digest.hexdigest()


def sources_of(path):
    """The sources that a unity file includes; a file that is none is its own."""
    found = re.findall(r'^#include "([^"]+)"', path.read_text(), re.M) if "Unity" in path.parts else []
    return [pathlib.Path(source) for source in found] or [path]


def alone(entry, source):
    return {**entry, "file": str(source), "command": entry["command"].replace(entry["file"], str(source))}


def run_tidy(entry, stamps, options):
    done = subprocess.run(["clang-tidy", "-p", str(stamps), *options, entry["file"]],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return done.returncode, done.stdout


def look_at(stamp, entry, sources, stamps, options):
    """The findings, and whether the sources were looked at one by one."""
    several = len(sources) > 1
    if several and run_tidy(entry, stamps, [*options, GROUP_OPTION])[0] == 0:
        stamp.touch()
        return [], False
    found = []
    for source in sources:
        code, text = run_tidy(alone(entry, source), stamps, options)
        if code != 0:
            found.append(text or f"{source}: clang-tidy ended with {code}")
    if not found:
        stamp.touch()
    return found, several


def main():
    names = "--names" in sys.argv
    folders = [word for word in sys.argv[1:] if word != "--names"]
    build = pathlib.Path(folders[0] if folders else ROOT / "build/ci").resolve()
    options = OPTIONS if names else OPTIONS + WITHOUT_NAMES
    stamps = build / "tidy"
    stamps.mkdir(exist_ok=True)
    common = output_of("clang-tidy", "--version") + (ROOT / ".clang-tidy").read_text() + str(options)
    headers = headers_of_objects(build)
    due = []  # (stamp, entry, sources)
    commands = json.loads((build / "compile_commands.json").read_text())
    for entry in map(without_precompiled, commands):
        path = pathlib.Path(entry["file"])
        sources = sources_of(path)
        if not any(source.is_relative_to(ROOT / folder) for source in sources for folder in ("lib", "apps")):
            continue
        if object_of(entry) not in headers:
            sys.exit(f"{path} is not built")
        stamp = stamps / key_of(entry, headers, common)
        if not stamp.exists():
            due.append((stamp, entry, sources))
    due.sort(key=lambda group: -len(group[2]))
    known = [entry for _, entry, _ in due]
    known += [alone(entry, source) for _, entry, sources in due for source in sources if len(sources) > 1]
    (stamps / "compile_commands.json").write_text(json.dumps(known))
    found, split, begin = 0, 0, time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        looks = [pool.submit(look_at, *group, stamps, options) for group in due]
        for look in concurrent.futures.as_completed(looks):
            texts, one_by_one = look.result()
            found += len(texts)
            split += one_by_one
            for text in texts:
                print(text, flush=True)
    processor = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"clang-tidy: {sum(len(sources) for _, _, sources in due)} files in {len(due)} groups ({split} of them file by file) "
          f"in {time.monotonic() - begin:.0f} s, "
          f"{processor.ru_utime + processor.ru_stime:.0f} s of processor time, "
          f"{found} with findings")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
