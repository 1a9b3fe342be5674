#!/usr/bin/env bash
# Installs what is missing, builds, measures kernels and whole programs several times and prints
# medians as ratios to peers, limits and the release before (tests/bench/README.md).
#   scripts/bench.sh [--micro] [--repetitions N] [--store]
# --micro leaves the whole programs out, --store makes this the release that others compare with.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh bench
cmake --preset release
cmake --build --preset release --target walktrack micro_bench
tests/bench/ratios.py build/release . "$@"
