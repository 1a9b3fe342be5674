#!/usr/bin/env bash
# Tracks every sequence below FOLDER with an array of Slurm tasks that share one output folder, then
# makes the summary of all. Prints the number of the last job; it ends when everything has.
#   scripts/cluster/slurm.sh FOLDER|MANIFEST OUT WORKERS [OPTIONS of walktrack batch]
# CPUS (1) is how many CPUs each task gets, and how many sequences it does at a time; WALKTRACK names
# the program where it is not on the PATH; SBATCH_* are Slurm's own (partition, time limit).
# Submitted again after a failure it does what is not complete.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
folder=$(realpath "$1")
out=$(realpath -m "$2")
workers=$3
export WALKTRACK=${WALKTRACK:-$(command -v walktrack)}
mkdir -p "$out"

array=$(sbatch --parsable --array="1-$workers" --cpus-per-task="${CPUS:-1}" --output="$out/slurm_%a.log" \
  "$here/slurm_array.sh" "$folder" "$out" "${@:4}")
# A worker that failed has left its reasons: the summary is made anyway.
sbatch --parsable --dependency="afterany:$array" --job-name=walktrack-summary \
  --output="$out/slurm_summary.log" "$here/slurm_summary.sh" "$folder" "$out"
