#!/usr/bin/env python3
"""Turns a header's plain comments into documentation for Doxygen, which reads the result: lines above a declaration
become a block, those behind a member ///<, the first block is the file's, and indented lines, which are formulas and
drawings, do not change.

    doxygen_filter.py HEADER
"""
import re
import sys

COMMENT = re.compile(r"^(\s*)//(?!/) ?(.*)$")
BEHIND = re.compile(r"^(.*[;,{})A-Za-z0-9]\s+)//(?!/) ?(.*)$")
FORMULA = re.compile(r"^( {2,}|.* {4,}\S)")


def escaped(text):
    """Of Doxygen's and HTML's signs none means anything in our comments."""
    return re.sub(r"([\\@&$#<>%\"])", r"\\\1", text)


def block(lines, indent, of_file):
    out, verbatim = [indent + "/**" + (" \\file" if of_file else "")], False
    for text in lines:
        formula = bool(FORMULA.match(text))
        if formula != verbatim and (formula or text):
            out.append("\\" + ("verbatim" if formula else "endverbatim"))
            verbatim = formula
        out.append((text if verbatim else escaped(text)).replace("*/", "* /").replace("/*", "/ *"))
    if verbatim:
        out.append("\\endverbatim")
    return [*out, indent + "*/"]


def documented(source):
    lines, at, out, first = source.splitlines(), 0, [], True
    while at < len(lines):
        found = COMMENT.match(lines[at])
        if not found:
            behind = BEHIND.match(lines[at])
            out.append(behind.group(1) + "///< " + escaped(behind.group(2)) if behind else lines[at])
            at += 1
            # A comment behind a member goes on in lines of its own, further to the right.
            while behind and at < len(lines) and (found := COMMENT.match(lines[at])) and \
                    len(found.group(1)) >= len(behind.group(1)) > 0:
                out.append(found.group(1) + "///< " + escaped(found.group(2)))
                at += 1
            continue
        indent, texts = found.group(1), []
        while at < len(lines) and (found := COMMENT.match(lines[at])):
            texts.append(found.group(2))
            at += 1
        out += block(texts, indent, first)
        first = False
    return "\n".join(out) + "\n"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        sys.stdout.write(documented(file.read()))


main()
