#!/usr/bin/env bash
# Installs what is missing, builds, tracks the shipped demo, measures it against its truth and names
# the report to open. With a Debian package of walktrack, or where walktrack is installed already
# from this very commit, nothing is built.
#   scripts/demo.sh [PACKAGE.deb]
set -euo pipefail
cd "$(dirname "$0")/.."

# Whether walktrack is on the PATH, built from the commit that is checked out.
installed_from_here() {
  command -v walktrack >/dev/null || return 1
  local commit
  commit=$(git rev-parse HEAD 2>/dev/null) && [ -z "$(git status --porcelain -- lib apps configs)" ] || return 1
  local built
  built=$(walktrack --version | sed -n 's/^commit //p')
  [ -n "$built" ] && [[ $commit == "$built"* ]]
}

walktrack=build/release/walktrack
if [ $# -gt 0 ]; then
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
  if "${as_root[@]}" apt-get install -y -qq --no-install-recommends "$(realpath "$1")"; then
    walktrack=$(command -v walktrack)
  else
    echo "demo: $1 cannot be installed here, so the program is built" >&2
  fi
elif installed_from_here; then
  walktrack=$(command -v walktrack)
fi
if [ "$walktrack" = build/release/walktrack ]; then
  scripts/setup.sh
  cmake --preset release -DWALKTRACK_TESTS=OFF
  cmake --build --preset release --target walktrack
fi
"$walktrack" track data/demo/scene.yaml -o out/demo -y
"$walktrack" evaluate data/demo/truth.csv out/demo
echo
echo "Open the report: $PWD/out/demo/report.html"
[ "$walktrack" = build/release/walktrack ] || exit 0
echo "The program is build/release/walktrack. In every folder of this shell, and for good:"
echo "  export PATH=\"$PWD/build/release:\$PATH\""
echo "  cmake --install \"$PWD/build/release\" --prefix ~/.local    # then ~/.local/bin has to be on the PATH"
