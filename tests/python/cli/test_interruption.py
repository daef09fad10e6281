"""Ctrl-C at any time: exit status 130, no traceback, and what is finished stays."""

import os
import shlex
import signal
import subprocess
import sys

import pytest

import ninedof as nd
from ninedof.cli.app import main
from ninedof.cli.ending import interruptible

LOADING = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # inherited as ignored by a job in the background
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # and by one of nohup
sys.argv = {argv}
class Loaded:
    def find_spec(self, name, path=None, target=None):
        if name == {name!r}:
            signal.raise_signal({number})
sys.meta_path.insert(0, Loaded())
{code}
"""


@pytest.fixture(autouse=True)
def _heard():
    """Under nohup the tests themselves begin with SIGHUP ignored, and so would what they start."""
    before = signal.signal(signal.SIGHUP, signal.SIG_DFL) if hasattr(signal, "SIGHUP") else None
    yield
    if before is not None:
        signal.signal(signal.SIGHUP, before)


SIGNALS = [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]


@pytest.mark.parametrize("name", ["ninedof._core", "ninedof.cli.commands.runs.optimize"])
def test_an_interruption_while_the_command_is_loaded(name):
    """As the installed script does: it has its own name and imports `main`."""
    code = "from ninedof.cli.app import main; main()"
    code = f"sys.path[:] = {sys.path}\n{code}"
    script = LOADING.format(argv=["/usr/bin/ninedof", "--version"], name=name, number=2, code=code)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def test_a_program_that_uses_the_package_keeps_its_handler():
    script = LOADING.format(argv=["plan.py"], name="none", number=2, code=f"sys.path[:] = {sys.path}\nimport ninedof")
    script += "assert signal.getsignal(signal.SIGINT) is signal.default_int_handler"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


def test_an_interruption_while_drawing_leaves_the_record(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("ninedof.plot.save", lambda *_: signal.raise_signal(signal.SIGINT))
    for line, kind in (("optimize --starts 2", nd.Result), ("path --circle 0.2 --points 9", nd.Followed)):
        with pytest.raises(SystemExit) as ended:
            main(shlex.split(f"{line} --out run-{kind.__name__}"))
        said = capsys.readouterr()
        assert ended.value.code == 130
        assert f"interrupted; run folder run-{kind.__name__} has the record" in said.out
        assert "Traceback" not in said.err
        assert isinstance(nd.load(f"run-{kind.__name__}"), kind)


@pytest.mark.parametrize(("number", "status"), SIGNALS)
def test_every_signal_ends_a_command_alike(tmp_path, monkeypatch, capsys, number, status):
    """The end of a job and a closed terminal: what is finished stays, nothing half-written does."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("ninedof.support.kept.files.os.replace", _replace_and(number, ".svg"))
    before = signal.getsignal(number)
    with pytest.raises(SystemExit) as ended:
        main(shlex.split("sweep --over x_p=-1:1:9 --out run"))
    assert ended.value.code == status
    assert signal.getsignal(number) is before
    line = "ninedof: interrupted; to go on, type: ninedof sweep --over x_p=-1:1:9 --out run"
    assert line in capsys.readouterr().err
    assert isinstance(nd.load("run"), nd.SweepResult)
    assert not [file for file in (tmp_path / "run").iterdir() if file.name.startswith(".part-")]


def _replace_and(number, suffix):
    """Return os.replace that first sends a signal for files of a suffix."""
    replace = os.replace

    def replaced(part, path):
        if str(path).endswith(suffix):
            signal.raise_signal(number)
        replace(part, path)

    return replaced


def test_a_second_ctrl_c_ends_at_once_and_an_echo_of_the_first_does_not():
    script = LOADING.format(argv=["plan.py"], name="none", number=2, code=f"sys.path[:] = {sys.path}") + SECOND
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "saving\n", "")


SECOND = """
import time
from ninedof.cli import ending
with ending.interruptible():
    try:
        signal.raise_signal(signal.SIGINT)
    except KeyboardInterrupt:
        ending.ONE_PRESS = 1000.0
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGTERM)
        print("saving", flush=True)
        ending.ONE_PRESS = -1.0
        signal.raise_signal(signal.SIGINT)
        print("still here")
"""


def test_a_job_of_nohup_does_not_hear_its_terminal():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with interruptible():
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
            signal.raise_signal(signal.SIGHUP)
    finally:
        signal.signal(signal.SIGHUP, before)
