#!/usr/bin/env bash
# Known vulnerabilities of the packages that are installed with this one, extras included, and of those that build it:
#   packaging/audit.sh [PYTHON]
# Needs the database of advisories on the network, and is not silent where a package is not found in it. The status is 1
# where a vulnerability is known or a package was skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
"${1:-python3}" -m venv "$room/venv"
"$room/venv/bin/pip" install -q 'pip-audit>=2.9,<3'
"$room/venv/bin/python" - >"$room/requirements.txt" <<'PY'
import tomllib
with open("pyproject.toml", "rb") as file:
    settings = tomllib.load(file)
project = settings["project"]
wanted = project["dependencies"] + settings["build-system"]["requires"]
for extra in ("cad", "cluster", "sweep", "viewer"):
    wanted += project["optional-dependencies"][extra]
print(*wanted, sep="\n")
PY
"$room/venv/bin/pip-audit" --requirement "$room/requirements.txt" --strict --progress-spinner off
