#!/usr/bin/env bash
# Which lines and branches the fast tests run through, by module: builds without optimisation across
# functions, runs the test programs of the modules named (none: all), and puts what all programs that
# have run since lib/ or apps/ changed run through into tests/coverage.csv and tests/coverage.md. Rows
# of modules whose programs have not run stay. Needs Debian's gcovr. An hour or two of CPU for all
# modules; what is done already is not done again after an interruption, nor if it failed.
#   scripts/coverage.sh                  all programs
#   scripts/coverage.sh --of core io ... these alone
#   scripts/coverage.sh --measure        none: measures what has run so far
# `apps` is the program itself; `regression` has no module, it adds to what others' rows hold.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=build/coverage
done_file=$folder/programs_run
all=(core camera mechanics filter body metrics walker gait kinetics observation synth io tracker jobs apps regression)
programs=("${all[@]}")
if [ "${1:-}" = --of ]; then shift; programs=("$@"); fi
if [ "${1:-}" = --measure ]; then programs=(); fi
command -v gcovr >/dev/null || { echo "gcovr is missing: apt-get install gcovr" >&2; exit 1; }

build() {
  cmake --preset ci -B "$folder" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="--coverage -fprofile-update=atomic -O1 -DNDEBUG" >/dev/null
  cmake --build "$folder" -j 2 --target walktrack "${programs[@]/%/_tests}"
}

# Counts of other sources are worth nothing.
begin_anew_if_sources_changed() {
  local sources; sources=$(cat $(git ls-files lib apps | grep '\.\(h\|cpp\)$') | sha256sum | cut -c1-16)
  [ "$(head -1 "$done_file" 2>/dev/null)" != "$sources" ] || return 0
  find "$folder" -name '*.gcda' -delete
  echo "$sources" >"$done_file"
}

# A process writes its counts when it ends: a long program is run in parts. A test that fails is not
# this script's matter: ctest --preset ci says so.
run_program() {
  local program=$1 parts=1
  case $program in jobs | apps) parts=8 ;; esac
  for ((part = 0; part < parts; ++part)); do
    grep -qx "$program $part of $parts" "$done_file" && continue
    RC_PARAMS=seed=1 GTEST_TOTAL_SHARDS=$parts GTEST_SHARD_INDEX=$part \
      "$folder/${program}_tests" --gtest_filter='-*FullRegression*:*clip_*:RealClips*' >"$folder/$program.$part.log" 2>&1 || true
    echo "$program $part of $parts" >>"$done_file"
  done
  [ "$program" != jobs ] || python3 tests/bids/motion_bids_test.py "$folder/walktrack" . >"$folder/bids.log" 2>&1 || true
}

# Each program that has run, once; of one that has not run all its parts, how many.
programs_run() {
  awk 'NR > 1 { seen[$1]++; parts[$1] = $4 }
       END { for (name in seen) print name (seen[name] < parts[name] ? ":" seen[name] "/" parts[name] : "") }' "$done_file" | sort
}

if [ ${#programs[@]} -gt 0 ]; then
  build
  begin_anew_if_sources_changed
  for program in "${programs[@]}"; do run_program "$program"; done
fi
gcovr -r . "$folder" --filter lib/ --filter apps/ --exclude-throw-branches --exclude-unreachable-branches \
  --gcov-ignore-parse-errors --json-summary "$folder/coverage.json" -j 2
scripts/coverage_table.py "$folder/coverage.json" --by $(programs_run)
