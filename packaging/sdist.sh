#!/usr/bin/env bash
# The source archive, and a wheel built from it alone in an empty folder, installed in a new environment:
#   packaging/sdist.sh [PYTHON]
# The archive is put into dist/. Needs what the README's first line installs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=${1:-python3}
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore

"$python" -m venv "$room/venv"
"$room/venv/bin/pip" install -q build
rm -f dist/ninedof-*.tar.gz
"$room/venv/bin/python" -m build --sdist --outdir dist . >"$room/log" 2>&1 || { cat "$room/log" >&2; exit 1; }
archive=$(realpath dist/ninedof-*.tar.gz)
tar -tzf "$archive" >"$room/names" # not through a pipe: grep -q leaves it early
for part in LICENSE licenses/NLopt.txt licenses/README.md packaging/nlopt.sh cpp/CMakeLists.txt; do
  grep -q "^ninedof-[^/]*/$part\$" "$room/names" || { echo "the archive lacks $part" >&2; exit 1; }
done
cd "$room"
venv/bin/pip install -q "$archive"
venv/bin/ninedof >out
for figure in 3.9110 3.762659; do
  grep -q -F "$figure" out || { echo "the main job did not print $figure" >&2; exit 1; }
done
ls -l "$archive"
