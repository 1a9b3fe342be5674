#!/usr/bin/env python3
"""Runs clang-tidy (checks: .clang-tidy) over lib/ and apps/, as many files at a time as there are
processors. Fails when it finds anything. A file that was clean is looked at again only when it, a
header that it includes, its command line, the checks or clang-tidy have changed.

Nearly all time goes into the headers of others, so sources with the same command line are looked at
some at a time, as one. Where such a group shows anything, be it names that clash, each of its files
is looked at alone, and only that counts.

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
GROUP_SIZE = 10
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


def names_of(path):
    """What a source defines in its first column, more or less."""
    definition = r"^(?!namespace|using namespace)[\w:<][^;={}()]*?\b(\w+)(?=\(| = |\{| \{|;)"
    further = r"^(?:inline )?constexpr [^;(]*;"  # more constants of the same line
    text = path.read_text()
    constants = {name for line in re.findall(further, text, re.M)
                 for name in re.findall(r"\b(k\w+)(?= = |\{)", line)}
    return constants | set(re.findall(definition, text, re.M))


def grouped(due):
    """(stamp, entry) in groups that compile as one source: one command line, no name twice."""
    groups = []  # (command line, names, members)
    for stamp, entry in due.items():
        path = pathlib.Path(entry["file"])
        line, names = entry["command"].split(" -o ")[0], names_of(path)
        alone = "foreach_target" in path.read_text()  # includes itself several times
        for common, taken, members in groups:
            if not alone and common == line and len(members) < GROUP_SIZE and not taken & names:
                members.append((stamp, entry))
                taken |= names
                break
        else:
            groups.append((None if alone else line, names, [(stamp, entry)]))
    return sorted((members for _, _, members in groups), key=len, reverse=True)


def group_entry(number, members, stamps):
    path, (_, first) = stamps / f"group_{number}.cpp", members[0]
    path.write_text("".join(f'#include "{entry["file"]}"\n' for _, entry in members))
    return {**first, "file": str(path), "command": first["command"].replace(first["file"], str(path))}


def run_tidy(entry, stamps, options):
    done = subprocess.run(["clang-tidy", "-p", str(stamps), *options, entry["file"]],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return done.returncode, done.stdout


def look_at(group, members, stamps, options):
    """The findings, and whether the group was looked at one by one."""
    if group and run_tidy(group, stamps, [*options, GROUP_OPTION])[0] == 0:
        for stamp, _ in members:
            stamp.touch()
        return [], False
    found = []
    for stamp, entry in members:
        code, text = run_tidy(entry, stamps, options)
        if code == 0:
            stamp.touch()
        else:
            found.append(text or f"{entry['file']}: clang-tidy ended with {code}")
    return found, group is not None


def main():
    names = "--names" in sys.argv
    folders = [word for word in sys.argv[1:] if word != "--names"]
    build = pathlib.Path(folders[0] if folders else ROOT / "build/ci").resolve()
    options = OPTIONS if names else OPTIONS + WITHOUT_NAMES
    stamps = build / "tidy"
    stamps.mkdir(exist_ok=True)
    common = output_of("clang-tidy", "--version") + (ROOT / ".clang-tidy").read_text() + str(options)
    headers = headers_of_objects(build)
    due = {}
    commands = json.loads((build / "compile_commands.json").read_text())
    entries = [without_precompiled(entry) for entry in commands]
    for entry in entries:
        path = pathlib.Path(entry["file"])
        if not any(path.is_relative_to(ROOT / folder) for folder in ("lib", "apps")):
            continue
        if object_of(entry) not in headers:
            sys.exit(f"{path} is not built")
        stamp = stamps / key_of(entry, headers, common)
        if not stamp.exists():
            due[stamp] = entry
    groups = [(group_entry(number, members, stamps) if len(members) > 1 else None, members)
              for number, members in enumerate(grouped(due))]
    entries += [group for group, _ in groups if group]
    (stamps / "compile_commands.json").write_text(json.dumps(entries))
    found, split, begin = 0, 0, time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        looks = [pool.submit(look_at, *group, stamps, options) for group in groups]
        for look in concurrent.futures.as_completed(looks):
            texts, alone = look.result()
            found += len(texts)
            split += alone
            for text in texts:
                print(text, flush=True)
    processor = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"clang-tidy: {len(due)} files in {len(groups)} groups ({split} of them file by file) "
          f"in {time.monotonic() - begin:.0f} s, "
          f"{processor.ru_utime + processor.ru_stime:.0f} s of processor time, "
          f"{found} with findings")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
