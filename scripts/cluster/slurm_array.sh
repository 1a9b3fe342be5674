#!/usr/bin/env bash
# One worker of a Slurm array: its share of the sequences, then what nobody has begun of the others'.
# As many sequences at a time as the task has CPUs, each with one thread. Submitted by slurm.sh.
#   sbatch --array=1-8 --cpus-per-task=4 scripts/cluster/slurm_array.sh FOLDER|MANIFEST OUT [OPTIONS of walktrack batch]
#SBATCH --job-name=walktrack
set -euo pipefail

where=("$1")
[ -d "$1" ] || where=(--manifest "$1")
cpus=(--jobs "${SLURM_CPUS_PER_TASK:-1}" --threads 1)
case " ${*:3} " in *" --jobs "* | *" -j "* | *" --threads "*) cpus=() ;; esac  # the options say it
exec "${WALKTRACK:-walktrack}" batch "${where[@]}" -o "$2" --shard auto --steal "${cpus[@]}" --quiet "${@:3}"
