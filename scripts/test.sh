#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors (benchmarks too) and runs every test that
# is not slow and, where there is clang, a little fuzzing. Slow ones, clang-tidy among them:
# ctest --test-dir build/ci -L slow
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh tests
cmake --preset ci
cmake --build --preset ci
cmake --build --preset ci --target micro_bench  # built only
ctest --preset ci
FUZZ_SEED=1 scripts/fuzz.sh --runs 2000
