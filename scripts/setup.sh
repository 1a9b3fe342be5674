#!/usr/bin/env bash
# Installs what building and running walktrack needs, from Debian's packages alone; with "tests" or
# "bench" what testing or benchmarks need as well. Does nothing when everything is there.
#   scripts/setup.sh [tests|bench]
set -euo pipefail

packages=(
  cmake ninja-build g++ ccache git
  libeigen3-dev libboost-program-options-dev libyaml-cpp-dev libfmt-dev
  libtbb-dev libhwy-dev nlohmann-json3-dev libtomlplusplus-dev libnlopt-cxx-dev
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev
  libopencv-video-dev libopencv-videoio-dev libopencv-calib3d-dev libopencv-ml-dev libopencv-dnn-dev
  libavformat-dev libswscale-dev
)
if [ "${1:-}" = tests ]; then
  packages+=(
    python3 libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev clang-format clang-tidy
    valgrind                     # counts instructions
    clang libclang-rt-dev        # for fuzzing
    libsimbody-dev               # independent engine behind some tests
    chromium fonts-dejavu-core   # opens the reports
  )
fi
if [ "${1:-}" = bench ]; then
  packages+=(
    python3 libgtest-dev libgmock-dev libbenchmark-dev
    libmujoco-dev                # a peer
  )
fi

# Not needed; slow tests are skipped without them: of scripts/cluster slurmctld slurmd slurm-client munge
# parallel, of the headers as HTML doxygen

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
echo "installing: ${missing[*]}" >&2
"${as_root[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
