#!/usr/bin/env bash
# The last job of slurm.sh: one summary of what all workers did. Fails where a sequence has failed.
set -euo pipefail
where=("$1")
[ -d "$1" ] || where=(--manifest "$1")
exec "${WALKTRACK:-walktrack}" batch "${where[@]}" -o "$2" --report
