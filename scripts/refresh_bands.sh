#!/usr/bin/env bash
# Measures the regression suite anew, writes tests/regression/bands.csv and prints what changed as a
# Markdown table for the review. Arguments name the scenes to refresh; none: all (some minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset ci > /dev/null
cmake --build --preset ci --target refresh_bands >&2
build/ci/refresh_bands "$@"
