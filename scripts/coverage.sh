#!/usr/bin/env bash
# Which lines and branches the fast tests run through, by module: builds without optimisation across
# functions, runs every fast test, and puts a table into tests/coverage.md. Needs Debian's gcovr.
# Some forty minutes of CPU.
#   scripts/coverage.sh             builds, runs, measures
#   scripts/coverage.sh --measure   measures what the last run left
set -euo pipefail
cd "$(dirname "$0")/.."
folder=build/coverage
command -v gcovr >/dev/null || { echo "gcovr is missing: apt-get install gcovr" >&2; exit 1; }

if [ "${1:-}" != --measure ]; then
  cmake --preset ci -B "$folder" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="--coverage -fprofile-update=atomic -O1 -DNDEBUG" >/dev/null
  programs=(core camera mechanics filter body metrics walker gait kinetics observation synth io tracker jobs apps regression)
  cmake --build "$folder" -j 2 --target walktrack "${programs[@]/%/_tests}"
  find "$folder" -name '*.gcda' -delete
  # A test that fails is not this script's matter: ctest --preset ci says so.
  ctest --test-dir "$folder" -LE 'slow|instructions' -R '_tests$' -j 2 >"$folder/ctest.log" || true
fi
gcovr -r . --object-directory "$folder" --filter 'lib/' --filter 'apps/' --exclude-throw-branches \
  --exclude-unreachable-branches --gcov-ignore-parse-errors --json-summary "$folder/coverage.json" -j 2
scripts/coverage_table.py "$folder/coverage.json" tests/coverage.md
