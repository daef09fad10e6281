#!/usr/bin/env bash
# The core and its C++ tests for 64-bit Arm, compiled here and run by qemu-user, on Debian:
#   packaging/aarch64.sh [SUITE]...
# Without a name all suites are run; qemu is some twenty times slower than the processor.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
place=$PWD/build/aarch64
mkdir -p "$place"
for program in aarch64-linux-gnu-g++ qemu-aarch64-static cmake ninja; do
  command -v "$program" >/dev/null || {
    echo "no $program: apt-get install g++-aarch64-linux-gnu qemu-user-static cmake ninja-build doctest-dev libeigen3-dev" >&2
    exit 1
  }
done
toolchain=$PWD/packaging/aarch64.cmake
export CMAKE_GENERATOR=Ninja
if [[ ! -d $place/nlopt/licenses ]]; then packaging/nlopt.sh "$place/nlopt" "-DCMAKE_TOOLCHAIN_FILE=$toolchain"; fi
# Headers of this machine in a folder of their own: in /usr/include lie those of its own C library too.
mkdir -p "$place"/headers/{include,lib/cmake,share/eigen3}
cp -r /usr/include/doctest /usr/include/eigen3 "$place/headers/include"
cp -r /usr/lib/cmake/doctest "$place/headers/lib/cmake"
cp -r /usr/share/eigen3/cmake "$place/headers/share/eigen3"

cmake -S . -B "$place/build" -DCMAKE_TOOLCHAIN_FILE="$toolchain" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
  -DNINEDOF_TESTS=ON -DNINEDOF_WERROR=ON -Ddoctest_DIR="$place/headers/lib/cmake/doctest" \
  -DEigen3_DIR="$place/headers/share/eigen3/cmake" -DNLopt_DIR="$place/nlopt/lib/cmake/nlopt"
cmake --build "$place/build"
if (($#)); then
  names=$(IFS='|' && echo "$*")
  chosen=(-R "^cpp\.($names)\$")
else
  chosen=()
fi
ctest --test-dir "$place/build" --output-on-failure --no-tests=error "${chosen[@]}"
