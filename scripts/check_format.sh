#!/usr/bin/env bash
# Fails, naming the files, when a C++ source differs from what clang-format would write.
set -euo pipefail
cd "$(dirname "$0")/.."
find lib apps tests -name '*.h' -o -name '*.cpp' | sort | xargs clang-format --dry-run --Werror
