#!/usr/bin/env python3
"""The program has what Debian's hardening flags leave in it.

usage: hardening_test.py PROGRAM
"""
import subprocess
import sys

WANTED = {
    "position independent": ("-h", "DYN (Position-Independent Executable file)"),
    "read-only relocations": ("-lW", "GNU_RELRO"),
    "bound at the start": ("-d", "BIND_NOW"),
    "stack protector": ("--dyn-syms", "__stack_chk_fail"),
    "checked libc calls": ("--dyn-syms", "_chk@GLIBC"),
    "a stack that is not executable": ("-lW", "GNU_STACK"),
}


def main():
    missing = []
    for name, (option, text) in WANTED.items():
        shown = subprocess.run(["readelf", option, "-W", sys.argv[1]], capture_output=True, text=True, check=True).stdout
        lines = [line for line in shown.splitlines() if text in line]
        if not lines or (text == "GNU_STACK" and " RWE " in lines[0]):
            missing.append(name)
    if missing:
        sys.exit(f"{sys.argv[1]}: not there: {', '.join(missing)}")
    print(f"{len(WANTED)} marks of hardening found")


if __name__ == "__main__":
    main()
