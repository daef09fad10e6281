#!/usr/bin/env bash
# A wheel where nothing else is: installed and run without a compiler, without CMake and without the system's NLopt.
#   packaging/bare.sh WHEEL [PYTHON]
# PYTHON, python3 unless named, is the interpreter. bubblewrap hides what the system has of compilers and of NLopt from all
# that runs. Prints the times and sizes; ends with 1 if the main job does not print what it should.
set -euo pipefail
if (($# < 1 || $# > 2)); then
  echo "usage: packaging/bare.sh WHEEL [PYTHON]" >&2
  exit 2
fi
wheel=$(realpath "$1")
python=$("${2:-python3}" -c 'import sys; print(sys.executable)')
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT

hidden=()
shopt -s nullglob
for file in /usr/bin/{cc,c++,c89*,c99*,gcc*,g++*,clang*,cpp*,cmake*,ninja*,make,ld,ld.*,gold,as,*-linux-gnu-*} \
  /usr/lib/*/libnlopt* /usr/lib/libnlopt* /usr/local/lib/libnlopt* /usr/local/bin/{cc,c++,gcc*,g++*,clang*,cmake,ninja}; do
  if [[ -f $file && ! -L $file ]]; then hidden+=(--ro-bind /dev/null "$file"); fi
done
bare() {
  bwrap --dev-bind / / "${hidden[@]}" --chdir "$room" --clearenv --setenv PATH /usr/bin:/bin --setenv HOME "$room" \
    --setenv LANG C.UTF-8 --setenv COLUMNS 100 --setenv MPLBACKEND agg "${settings[@]}" "$@"
}
# Which index pip asks, and with which certificates, is a matter of the machine.
settings=()
while IFS='=' read -r name value; do settings+=(--setenv "$name" "$value"); done < <(
  env | grep -E '^(PIP_[A-Z_]+|SSL_CERT_[A-Z]+|https?_proxy|no_proxy|HTTPS?_PROXY|NO_PROXY)=' || true)

bare "$python" -m venv "$room/venv"
if bare sh -c 'cc --version || c++ --version || gcc --version' >/dev/null 2>&1; then
  echo "a compiler is still to be seen" >&2
  exit 1
fi
start=$(date +%s.%N)
bare venv/bin/pip install -q --only-binary :all: "$wheel"
installed=$(date +%s.%N)
bare venv/bin/ninedof | tee "$room/out"
done=$(date +%s.%N)
for figure in 3.9110 3.762659; do
  grep -q -F "$figure" "$room/out" || { echo "the main job did not print $figure" >&2; exit 1; }
done
# What the extension is linked with, as the loader sees it there.
bare sh -c 'ldd venv/lib/python*/site-packages/ninedof/_core*.so' >"$room/ldd"
grep -q -F libc. "$room/ldd"
if grep -E 'nlopt|not found' "$room/ldd"; then
  echo "the wheel needs a library that it does not carry" >&2
  exit 1
fi
"$python" - "$start" "$installed" "$done" "$wheel" "$room/venv" <<'PY'
import pathlib, sys
start, installed, done = map(float, sys.argv[1:4])
site = next(pathlib.Path(sys.argv[5]).glob("lib/python*/site-packages"))
size = lambda folder: sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) / 1e6
print(f"install {installed - start:.1f} s, first run {done - installed:.1f} s, together {done - start:.1f} s; "
      f"wheel {pathlib.Path(sys.argv[4]).stat().st_size / 1e6:.2f} MB, "
      f"installed {size(site / 'ninedof'):.1f} MB, with all that it needs {size(site):.0f} MB")
PY
