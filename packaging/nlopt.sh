#!/usr/bin/env bash
# NLopt as a static library, for wheels:
#   packaging/nlopt.sh PREFIX [CMAKE OPTION]...
# Without Luksan's solvers, the one part of NLopt under the LGPL, and without its C++ parts: what is left is under the MIT
# and BSD licences, whose texts are put into PREFIX/licenses. This package calls SLSQP only.
# NLOPT_SOURCE names an archive that is already here. Else Debian's source package is taken, or the release of NLopt's
# authors: the same file, byte for byte, and its digest is checked in any case.
set -euo pipefail
version=2.7.1
digest=db88232fa5cef0ff6e39943fc63ab6074208831dc0031cf1545f6ecd31ae2a1a

if (($# < 1)); then
  echo "usage: packaging/nlopt.sh PREFIX [CMAKE OPTION]..." >&2
  exit 2
fi
mkdir -p "$1"
prefix=$(cd "$1" && pwd)
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Debian's source package, with lists of our own: the machine's settings stay as they are, and "deb-src" need not be on.
from_debian() (
  mkdir -p "$work"/apt/{sources,lists/partial,cache/archives/partial}
  cd "$work/apt"
  for file in /etc/apt/sources.list.d/*.sources; do
    if [[ -f $file ]]; then sed 's/^Types:.*/Types: deb-src/' "$file" >"sources/${file##*/}"; fi
  done
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    if [[ -f $file ]]; then sed -n 's/^deb /deb-src /p' "$file" >"sources/${file##*/}.list"; fi
  done
  own=(-qq -o APT::Sandbox::User=root -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$PWD/sources"
    -o "Dir::State::lists=$PWD/lists" -o "Dir::Cache=$PWD/cache")
  apt-get "${own[@]}" update
  apt-get "${own[@]}" source --download-only nlopt >/dev/null
  mv "nlopt_$version.orig.tar.gz" "$work/nlopt.tar.gz"
)
from_authors() {
  curl -fsSL -o "$work/nlopt.tar.gz" "https://github.com/stevengj/nlopt/archive/v$version.tar.gz"
}

if [[ -n ${NLOPT_SOURCE:-} ]]; then
  cp "$NLOPT_SOURCE" "$work/nlopt.tar.gz"
elif ! { command -v apt-get >/dev/null && from_debian; }; then
  from_authors
fi
if command -v sha256sum >/dev/null; then sums=(sha256sum); else sums=(shasum -a 256); fi
read -r found _ < <("${sums[@]}" "$work/nlopt.tar.gz")
if [[ $found != "$digest" ]]; then
  echo "NLopt $version: the archive has the SHA-256 digest $found, expected $digest" >&2
  exit 1
fi
tar -xzf "$work/nlopt.tar.gz" -C "$work"
source=$work/nlopt-$version

# CMake 4 refuses what asks for a CMake older than 3.5.
for file in "$source"/cmake/generate-*.cmake; do
  sed 's/^cmake_minimum_required.*/cmake_minimum_required (VERSION 3.5...3.25)/' "$file" >"$work/script"
  mv "$work/script" "$file"
done

# 2.7 has no switch for Luksan's solvers: their sources go, and what would call them is told that the arguments are bad.
sed -e '/^ *src\/algs\/luksan\//d' -e 's|src/api/deprecated.c|& src/api/no_luksan.c|' "$source/CMakeLists.txt" >"$work/lists"
mv "$work/lists" "$source/CMakeLists.txt"
rm "$source"/src/algs/luksan/*.c
cat >"$source/src/api/no_luksan.c" <<'C'
#include "luksan.h"
nlopt_result luksan_plis(int n, nlopt_func f, void* data, const double* low, const double* high, double* x,
                         double* least, nlopt_stopping* stop, int rank) {
  (void)n, (void)f, (void)data, (void)low, (void)high, (void)x, (void)least, (void)stop, (void)rank;
  return NLOPT_INVALID_ARGS;
}
nlopt_result luksan_plip(int n, nlopt_func f, void* data, const double* low, const double* high, double* x,
                         double* least, nlopt_stopping* stop, int rank, int method) {
  (void)n, (void)f, (void)data, (void)low, (void)high, (void)x, (void)least, (void)stop, (void)rank, (void)method;
  return NLOPT_INVALID_ARGS;
}
nlopt_result luksan_pnet(int n, nlopt_func f, void* data, const double* low, const double* high, double* x,
                         double* least, nlopt_stopping* stop, int rank, int first, int second) {
  (void)n, (void)f, (void)data, (void)low, (void)high, (void)x, (void)least, (void)stop, (void)rank, (void)first;
  (void)second;
  return NLOPT_INVALID_ARGS;
}
C

# No contraction, as in our own code: the same bits on every processor. Nothing of it is visible outside the extension:
# another NLopt in the same process is not met.
flags='-ffp-contract=off -fvisibility=hidden'
case $(uname -s) in MINGW* | MSYS* | CYGWIN*) flags= ;; esac
cmake -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_POLICY_VERSION_MINIMUM=3.5 -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
  -DCMAKE_C_FLAGS="$flags" -DBUILD_SHARED_LIBS=OFF -DNLOPT_CXX=OFF -DNLOPT_PYTHON=OFF -DNLOPT_OCTAVE=OFF \
  -DNLOPT_MATLAB=OFF -DNLOPT_GUILE=OFF -DNLOPT_SWIG=OFF -DNLOPT_TESTS=OFF "$@" >"$work/log" 2>&1 &&
  cmake --build "$work/build" --config Release >>"$work/log" 2>&1 &&
  cmake --install "$work/build" --config Release >>"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }

mkdir -p "$prefix/licenses"
cp "$source/COPYING" "$prefix/licenses/NLopt.txt"
cp "$source/src/algs/slsqp/COPYRIGHT" "$prefix/licenses/NLopt-SLSQP.txt"
echo "NLopt $version in $prefix"
