"""A reader that goes away, a full device and a poor encoding lose no record."""

import os
import shlex
import subprocess
import sys

import pytest

import ninedof as nd

SWEEP = f"{shlex.quote(sys.executable)} -m ninedof sweep --over x_p=-1:1:9 --no-figures --out run"
HOW = {  # the end of a shell line to the status where the command alone ends with 0
    "| true": 0,
    "> /dev/full": 1,
    ">&-": 0,
}


def shell(line, tmp_path, **more):
    return subprocess.run(
        ["bash", "-c", f"set -o pipefail; {line}"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)} | more,
    )


@pytest.mark.slow(sanitized=True)
@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize(("redirected", "status"), HOW.items())
def test_what_nobody_reads_is_recorded(tmp_path, redirected, status):
    done = shell(f"{SWEEP} {redirected}", tmp_path)
    assert done.returncode == status, done.stderr
    assert "Exception ignored" not in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stderr.count("No space left on device") == status
    assert len(nd.load(tmp_path / "run")["condition_number"]) == 9


def test_an_encoding_without_the_letters_of_a_table(tmp_path):
    done = shell(SWEEP, tmp_path, PYTHONIOENCODING="ascii")
    assert done.returncode == 0
    assert r"\u2500" in done.stdout or "condition number" in done.stdout


@pytest.mark.slow(sanitized=True)
def test_no_columns_are_as_many_as_the_terminal_has(tmp_path):
    done = shell(f"{shlex.quote(sys.executable)} -m ninedof evaluate --help", tmp_path, COLUMNS="00")
    assert "--help" in done.stdout
