#!/usr/bin/env bash
# Renders data/demo anew from data/demo/demo.yaml. Needs a build: build/release or build/ci. What it
# replaces is listed in data/demo/.walktrack_render; other files there stay.
set -euo pipefail
cd "$(dirname "$0")/.."
for walktrack in build/release/walktrack build/ci/walktrack; do
  [ -x "$walktrack" ] && break
done
"$walktrack" render --options data/demo/demo.yaml -o data/demo -y
