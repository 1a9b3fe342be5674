#!/usr/bin/env bash
# Builds the fuzz targets and runs each for some seconds or executions; prints executions and
# coverage. Stops at the first finding, whose input it names.
#   scripts/fuzz.sh                       3 s each
#   scripts/fuzz.sh --runs 1000000        so many executions each
#   scripts/fuzz.sh --seconds 60 scene    one target
# FUZZ_SEED=1 makes a run repeatable. What is new in coverage stays in build/fuzz/corpus for the next
# run.
set -euo pipefail
cd "$(dirname "$0")/.."

limit=-max_total_time=3
case "${1:-}" in
  --runs) limit=-runs=$2; shift 2 ;;
  --seconds) limit=-max_total_time=$2; shift 2 ;;
esac
if ! command -v clang++ >/dev/null; then
  echo "fuzz: SKIPPED, there is no clang++"
  exit 0
fi

targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for corpus in tests/fuzz/corpus/*/; do targets+=("$(basename "$corpus")"); done
fi
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}"
for target in "${targets[@]}"; do
  log=build/fuzz/$target.log
  if ! build/fuzz/fuzz_"$target" $limit -max_len=4096 -timeout=60 -seed="${FUZZ_SEED:-0}" -print_final_stats=1 \
      -artifact_prefix=build/fuzz/ -dict=tests/fuzz/words.dict \
      build/fuzz/corpus/"$target" tests/fuzz/corpus/"$target" >"$log" 2>&1; then
    tail -40 "$log"
    echo "fuzz: $target has a finding, see $log"
    exit 1
  fi
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  coverage=$(grep -o 'cov: [0-9]* ft: [0-9]*' "$log" | tail -1)
  printf '%-20s %10d executions  %s\n' "$target" "$executions" "$coverage"
done
