#!/usr/bin/env bash
# Which lines and branches the fast tests run through, by module: builds without optimisation across
# functions, runs fast tests, and puts a table into tests/coverage.md. Needs Debian's gcovr.
# Some forty minutes of CPU for all modules.
#   scripts/coverage.sh                      builds, runs, measures
#   scripts/coverage.sh --of core io ...     these modules alone, by their own test programs
#   scripts/coverage.sh --measure [--of ...] measures what the last run left
set -euo pipefail
cd "$(dirname "$0")/.."
folder=build/coverage
command="scripts/coverage.sh${*:+ $*}"
command -v gcovr >/dev/null || { echo "gcovr is missing: apt-get install gcovr" >&2; exit 1; }

run=true
if [ "${1:-}" = --measure ]; then run=false; shift; fi
programs=(core camera mechanics filter body metrics walker gait kinetics observation synth io tracker jobs apps regression)
searched=("$folder")
filters=(--filter lib/ --filter apps/)
if [ "${1:-}" = --of ]; then
  shift
  programs=("$@")
  searched=()
  filters=()
  for module in "$@"; do
    searched+=("$folder/lib/CMakeFiles/walktrack_$module.dir" "$folder/tests/CMakeFiles/${module}_tests.dir")
    filters+=(--filter "lib/$module/")
  done
fi

if $run; then
  cmake --preset ci -B "$folder" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="--coverage -fprofile-update=atomic -O1 -DNDEBUG" >/dev/null
  cmake --build "$folder" -j 2 --target walktrack "${programs[@]/%/_tests}"
  find "$folder" -name '*.gcda' -delete
  # A test that fails is not this script's matter: ctest --preset ci says so.
  ctest --test-dir "$folder" -LE 'slow|instructions' -R "^($(IFS='|'; echo "${programs[*]}"))_tests\$" -j 2 >"$folder/ctest.log" || true
fi
gcovr -r . "${searched[@]}" "${filters[@]}" --exclude-throw-branches --exclude-unreachable-branches \
  --gcov-ignore-parse-errors --json-summary "$folder/coverage.json" -j 2
scripts/coverage_table.py "$folder/coverage.json" tests/coverage.md "$command"
