#!/usr/bin/env bash
# The headers of lib/ as HTML, with Debian's doxygen. Warnings are errors. Skipped (77) where there is no doxygen.
#   scripts/api_documentation.sh [FOLDER]      default: build/api; open FOLDER/html/index.html
set -euo pipefail
cd "$(dirname "$0")/.."
command -v doxygen >/dev/null || { echo "no doxygen here: skipped" >&2; exit 77; }
WALKTRACK_VERSION=$(sed -n 's/^project(walktrack VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
WALKTRACK_API_FOLDER=${1:-build/api}
export WALKTRACK_VERSION WALKTRACK_API_FOLDER
mkdir -p "$WALKTRACK_API_FOLDER"
doxygen scripts/Doxyfile
