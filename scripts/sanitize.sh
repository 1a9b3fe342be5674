#!/usr/bin/env bash
# Builds the fast test programs with sanitizers and runs them: address and undefined behaviour over
# all, threads over core, filter, observation, tracker and jobs (TBB's own: tests/tsan.supp). Writes
# what came out to tests/sanitizers.csv, where rows of programs that were not run stay. Exit code 1:
# there is a finding, whose log it names.
#   scripts/sanitize.sh                           both, half an hour to an hour on two cores
#   scripts/sanitize.sh address [core camera …]   one of them, or some programs
set -uo pipefail
cd "$(dirname "$0")/.."

all=(core camera mechanics filter body metrics walker gait kinetics observation synth io tracker jobs apps regression)
threaded=(core filter observation tracker jobs)
table=tests/sanitizers.csv
# Stacks are remembered as long as can be (history_size), or a suppression cannot tell whose a race is.
# Of jobs, the thread sanitizer sees the tests in which threads meet: whole runs with several of them,
# frames prepared and overlays drawn beside tracking, checkpoints, workers, rendering. All of them
# would take it half a day.
meetings='Track.SameSeed*:*ThreadsDoNotMatter:NextFrame*:OverlayVideo*:Resume.AfterAKill*:Resume.With*'
meetings+=':BatchTest*:CheckTest.Names*:Render.*:ParticleBudget*:Sweep.Measures*:DroppedFrames*'
meetings+=':Init.KnowsDistance*:Calibrate.FindsTheLens*'
jobs=${SANITIZE_JOBS:-2}

record() {  # sanitizer, program, tests, seconds, result
  local commit; commit=$(git rev-parse --short HEAD)
  { grep '^#' "$table" 2>/dev/null || true
    echo "sanitizer,program,tests,cpu_s,result,commit,date"
    { grep -v "^#\|^sanitizer,\|^$1,$2," "$table" 2>/dev/null || true
      echo "$1,$2,$3,$4,$5,$commit,$(date -u +%F)"; } | sort; } >"$table.new"
  mv "$table.new" "$table"
}

run_program() {  # sanitizer, build folder, program
  local sanitizer=$1 folder=$2 program=$3 log=$2/$3.log code=0
  local filter='-*FullRegression*:*clip_*:RealClips.*'
  [ "$sanitizer $program" != 'thread jobs' ] || filter=$meetings
  local targets=("${program}_tests")
  case $program in jobs | apps | regression) targets+=(walktrack) ;; esac  # their tests run it
  if ! cmake --build "$folder" -j "$jobs" --target "${targets[@]}" >"$folder/$program.build.log" 2>&1; then
    tail -20 "$folder/$program.build.log"
    return 1
  fi
  TIMEFORMAT='%U'
  local seconds
  seconds=$({ time env RC_PARAMS=seed=1 UBSAN_OPTIONS=print_stacktrace=1 \
    TSAN_OPTIONS="history_size=7 suppressions=$PWD/tests/tsan.supp" ASAN_OPTIONS=detect_stack_use_after_return=1 \
    timeout 9000 "$folder/${program}_tests" --gtest_filter="${SANITIZE_FILTER:-$filter}" >"$log" 2>&1; } 2>&1) || code=$?
  local tests; tests=$(sed -n 's/^\[  PASSED  \] \([0-9]*\) tests\?.*/\1/p' "$log")
  local result=clean
  if grep -qE 'ERROR: (Address|Leak)Sanitizer|runtime error:|WARNING: ThreadSanitizer' "$log"; then
    result=finding
  elif [ $code -eq 124 ]; then
    result=out_of_time
  elif [ $code -ne 0 ]; then
    result=failed
  fi
  record "$sanitizer" "$program" "${tests:-0}" "${seconds%.*}" "$result"
  printf '%-8s %-12s %5s tests %6s s  %s\n' "$sanitizer" "$program" "${tests:-0}" "${seconds%.*}" "$result"
  [ $result = clean ] || { echo "  see $log"; return 1; }
}

sanitize() {  # sanitizer, preset, programs
  local sanitizer=$1 preset=$2 found=0
  shift 2
  # Sources compiled together: a third of the time, and the same code.
  cmake --preset "$preset" -DCMAKE_UNITY_BUILD=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=OFF >/dev/null || exit 1
  for program in "$@"; do run_program "$sanitizer" "build/$preset" "$program" || found=1; done
  return $found
}

which=${1:-both}
shift || true
found=0
case "$which" in
  both) sanitize address asan "${all[@]}" || found=1
        sanitize thread tsan "${threaded[@]}" || found=1 ;;
  address) sanitize address asan "${@:-${all[@]}}" || found=1 ;;
  thread) sanitize thread tsan "${@:-${threaded[@]}}" || found=1 ;;
  *) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac
exit $found
