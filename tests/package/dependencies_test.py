#!/usr/bin/env python3
"""dependencies.spdx lists what is linked and shipped: the libraries of scripts/setup.sh (OpenCV's parts
count as one), the libraries inside report pages, the pose network, each with a licence."""
import hashlib
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def packages(text):
    """One dictionary of lists for each PackageName."""
    out = []
    for line in text.splitlines():
        tag, _, value = line.partition(": ")
        if tag == "PackageName":
            out.append({})
        if out and tag.startswith(("Package", "External", "SPDXID")):
            out[-1].setdefault(tag, []).append(value)
    return out


def main():
    listed = packages((ROOT / "dependencies.spdx").read_text())
    wrong = [f"{p['PackageName'][0]}: no licence" for p in listed
             if not re.fullmatch(r"[A-Za-z0-9.-]+", p.get("PackageLicenseConcluded", [""])[0])]
    names = {ref.rsplit("/", 1)[1] for p in listed for ref in p.get("ExternalRef", [])}
    wanted = set(re.findall(r"\blib[\w+-]+-dev\b|\bnlohmann-json3-dev\b", (ROOT / "scripts/setup.sh").read_text()))
    wanted = {"libopencv-core-dev" if w.startswith("libopencv") else w for w in wanted}
    wanted -= {"libgmock-dev", "libclang-rt-dev"}  # of GoogleTest; of the compiler
    wrong += [f"{name}: in scripts/setup.sh and not in dependencies.spdx" for name in sorted(wanted - names)]
    wrong += [f"{name}: in dependencies.spdx and not in scripts/setup.sh" for name in sorted(names - wanted)]
    shipped = {p["PackageFileName"][0]: p["PackageChecksum"][0].split()[-1] for p in listed if "PackageFileName" in p}
    for file in [*ROOT.glob("data/report/libraries/*.js"), *ROOT.glob("data/pose_net/*.onnx")]:
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        if shipped.get(str(file.relative_to(ROOT))) != digest:
            wrong.append(f"{file.name}: shipped, and dependencies.spdx does not know it or another digest")
    print("\n".join(wrong) or f"{len(listed)} packages")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
