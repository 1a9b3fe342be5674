#!/usr/bin/env bash
# The last job of slurm.sh: one summary of what all workers did. Fails where a sequence has failed.
set -euo pipefail
exec "${WALKTRACK:-walktrack}" batch "$1" -o "$2" --report
