#!/usr/bin/env bash
# Installs the library to a temporary prefix, then builds and runs the project in this folder against it.
# Usage: tests/outside/run.sh [BUILD]    BUILD: a finished build folder to install from; default: a fresh one.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build=${1:-$work/library}
if [[ ! -f $build/CMakeCache.txt ]]; then
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON
  cmake --build "$build" --parallel 2
fi
cmake --install "$build" --component cpp --prefix "$work/prefix"

# A copy of the sources, so that nothing of this repository is reachable by a relative path.
cp -r "$here" "$work/outside"
cmake -S "$work/outside" -B "$work/outside/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release
cmake --build "$work/outside/build"
"$work/outside/build/outside"
"$work/outside/build/certify"
"$work/outside/build/optimize"
