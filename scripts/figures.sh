#!/usr/bin/env bash
# Installs what is missing, builds, measures the tables of the documents and puts them there
# (tests/figures/README.md). Some forty minutes on two quiet cores; with ../shared/data, real videos, too.
#   scripts/figures.sh [NAME ...]
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh bench
cmake --preset release >/dev/null
cmake --build --preset release --target walktrack micro_bench
scripts/figures.py build/release/walktrack out/figures "$@"
