#!/usr/bin/env bash
# Installs what is missing, builds, tracks the shipped demo, measures it against its truth and names
# the report to open.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
cmake --preset release -DWALKTRACK_TESTS=OFF
cmake --build --preset release --target walktrack
build/release/walktrack track data/demo/scene.yaml -o out/demo -y
build/release/walktrack evaluate data/demo/truth.csv out/demo
echo
echo "Open the report: $PWD/out/demo/report.html"
echo "The program is build/release/walktrack. In every folder of this shell, and for good:"
echo "  export PATH=\"$PWD/build/release:\$PATH\""
echo "  cmake --install \"$PWD/build/release\" --prefix ~/.local    # then ~/.local/bin has to be on the PATH"
