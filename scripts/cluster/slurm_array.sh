#!/usr/bin/env bash
# One worker of a Slurm array: its share of the sequences below FOLDER. Submitted by slurm.sh.
#   sbatch --array=1-8 scripts/cluster/slurm_array.sh FOLDER OUT [OPTIONS of walktrack batch]
#SBATCH --job-name=walktrack
set -euo pipefail

worker=$((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN + 1))
exec "${WALKTRACK:-walktrack}" batch "$1" -o "$2" --shard "$worker/$SLURM_ARRAY_TASK_COUNT" \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" --quiet "${@:3}"
