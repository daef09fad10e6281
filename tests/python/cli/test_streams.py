"""A reader that goes away, a closed stream and a full device end no run: the record is written, the status stays."""

import io
import os
import shlex
import subprocess
import sys

import pytest

import ninedof as nd
from ninedof.cli.app import main
from ninedof.cli.streams import Steady
from ninedof.runs.folder import load_record

COMPUTING = {
    "optimize": "optimize --starts 2 --no-figures",
    "pareto": "pareto --value 2 --starts 2 --no-figures",
    "sweep": "sweep --over x_p=-1:1:9 --no-figures",
    "atlas": "atlas --designs 4096 --no-figures",
    "path": "path --circle 0.2 --points 9 --no-figures",
    "workspace": "workspace --legs 1.5 6.5 --tolerance 0.2 --no-figures",
    "paper": "paper --figures --no-report",
}
HOW = {  # the end of a shell line to the status where the command alone ends with 0
    "reader gone": ("| true", 0),
    "full device": ("> /dev/full", 1),
    "error full": ("2> /dev/full", 0),
    "output closed": (">&-", 0),
    "error closed": ("2>&-", 0),
    "all closed": ("<&- >&- 2>&-", 0),
}
FULL = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")


def shell(line, tmp_path, **more):
    return subprocess.run(
        ["bash", "-c", f"set -o pipefail; {line}"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)} | more,
    )


class Broken:
    """A stream that raises."""

    encoding = "utf-8"

    def __init__(self, error):
        self.error = error

    def write(self, text):
        raise self.error

    def flush(self):
        raise self.error

    def isatty(self):
        return False


@pytest.mark.parametrize(
    ("error", "status"),
    [(BrokenPipeError(32, "Broken pipe"), 0), (OSError(28, "No space left on device"), 1), (ValueError("closed"), 0)],
)
@pytest.mark.parametrize("command", COMPUTING)
def test_every_computing_command_records_what_nobody_reads(tmp_path, monkeypatch, capsys, command, error, status):
    monkeypatch.setattr("ninedof.plot.save", lambda *_: [])
    monkeypatch.setattr(sys, "stdout", Broken(error))
    with pytest.raises(SystemExit) as ended:
        main([*shlex.split(COMPUTING[command]), "--out", str(tmp_path / "run")])
    assert ended.value.code == status
    said = capsys.readouterr().err
    assert ("standard output: cannot be written (No space left on device)" in said) == (status == 1)
    assert load_record(tmp_path / "run").kind
    if command != "paper":
        nd.load(tmp_path / "run")


@FULL
@pytest.mark.parametrize(("redirected", "status"), HOW.values(), ids=HOW)
def test_streams_of_a_process(tmp_path, redirected, status):
    """The process ends with its own status, and Python adds nothing as it ends."""
    line = f"{shlex.quote(sys.executable)} -m ninedof sweep --over x_p=-1:1:9 --no-figures --json --out run"
    done = shell(f"{line} {redirected}", tmp_path)
    assert done.returncode == status
    assert "Exception ignored" not in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stderr.count("cannot be written") == status
    assert len(nd.load(tmp_path / "run")["condition_number"]) == 9


@pytest.mark.parametrize("columns", ["0", "00", ""])
def test_no_columns_are_as_many_as_the_terminal_has(tmp_path, columns):
    done = shell(f"{shlex.quote(sys.executable)} -m ninedof evaluate --help", tmp_path, COLUMNS=columns)
    assert "--help" in done.stdout


def test_a_run_whose_working_folder_is_gone(tmp_path):
    (tmp_path / "gone").mkdir()
    line = f"{shlex.quote(sys.executable)} -m ninedof optimize --starts 1 --no-figures --out {tmp_path / 'run'}"
    done = shell(f"cd gone && rmdir ../gone && {line}", tmp_path)
    assert done.returncode == 0
    assert nd.load(tmp_path / "run").condition_number > 3.7


def test_help_to_a_reader_that_went_away(tmp_path):
    done = shell(f"{shlex.quote(sys.executable)} -m ninedof --help | true", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


def test_an_encoding_without_the_letters_of_a_table(tmp_path):
    line = f"{shlex.quote(sys.executable)} -m ninedof workspace --archetype orientation --angle-deg 20 --legs 1.5 6.5"
    done = shell(f"{line} --tolerance 0.3 --no-figures --out run", tmp_path, PYTHONIOENCODING="ascii")
    assert done.returncode == 0
    assert r"rad\xb3" in done.stdout


def test_a_record_is_there_before_the_first_word(tmp_path, monkeypatch, capsys):
    """Whatever the console does, the record exists by then."""
    seen = []

    class Listening(Broken):
        def write(self, text):
            seen.append((tmp_path / "run" / "record.json").is_file())

        def flush(self):
            pass

    monkeypatch.setattr("ninedof.plot.save", lambda *_: [])
    for name, command in COMPUTING.items():
        monkeypatch.setattr(sys, "stdout", Listening(None))
        with pytest.raises(SystemExit):
            main([*shlex.split(command), "--out", str(tmp_path / "run")])
        assert seen, name
        assert all(seen), name
        seen.clear()
        (tmp_path / "run").rename(tmp_path / name)


def test_a_steady_stream_takes_text_only():
    stream = Steady(io.StringIO())
    with pytest.raises(TypeError, match="expected a str"):
        stream.write(b"")
    assert stream.write("taken") == 5
    stream.writelines(["a", "b"])
    stream.flush()
    assert stream.failure is None
