#!/usr/bin/env bash
# Tracks every sequence below FOLDER with GNU parallel: so many workers on this machine or, with
# PARALLEL_OPTIONS="--sshlogin a,b", on others that see the same folders. Then makes the summary.
#   scripts/cluster/parallel.sh FOLDER|MANIFEST OUT WORKERS [OPTIONS of walktrack batch]
# WALKTRACK names the program where it is not on the PATH. Fails where a sequence has failed.
set -euo pipefail

where=("$(realpath "$1")")
[ -d "$1" ] || where=(--manifest "${where[0]}")
out=$(realpath -m "$2")
workers=$3
walktrack=${WALKTRACK:-$(command -v walktrack)}

# A worker that failed has left its reasons: the summary is made anyway.
seq "$workers" | parallel --will-cite -q -j "$workers" ${PARALLEL_OPTIONS:-} \
  "$walktrack" batch "${where[@]}" -o "$out" --shard "{}/$workers" --steal --quiet "${@:4}" || true
exec "$walktrack" batch "${where[@]}" -o "$out" --report
