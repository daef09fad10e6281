"""A disk that is full at any file of any command: one line that names the file, the results, and no rubbish."""

import errno
import json
import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.cli.app import main
from ninedof.runs.folder import load_record
from ninedof.support.lock import LOCK

FULL = OSError(errno.ENOSPC, "No space left on device")
PLAIN = ["--no-figures", "--no-report"]
# The arguments of a small run, and how many files it writes while it computes.
RUNS = {
    "optimize": (["--starts", "1", *PLAIN], 2),
    "pareto": (["--value", "2", "--starts", "1", *PLAIN], 2),
    "sweep": (["--over", "x_p=-1:1:3", *PLAIN], 1),
    "atlas": (["--designs", "1000", *PLAIN], 1),
    "workspace": (["--condition", "6", "--resolution", "4", "--tolerance", "0.2", *PLAIN], 2),
    "path": (["--circle", "0.2", "--points", "11", *PLAIN], 0),
}
SAID = {
    "optimize": "condition number",
    "pareto": "objective",
    "sweep": "greatest",
    "atlas": "radius ratio",
    "workspace": "volume",
    "path": "Legs along the path",
}


class Disk:
    """Full at one file: the write of it fails, and every later one."""

    def __init__(self, monkeypatch):
        self.files, self.full_at, self._real = 0, None, os.fsync
        monkeypatch.setattr(os, "fsync", self)

    def __call__(self, file):
        if stat.S_ISREG(os.fstat(file).st_mode):
            self.files += 1
            if self.full_at is not None and self.files >= self.full_at:
                raise OSError(*FULL.args)
        self._real(file)


@pytest.fixture
def disk(monkeypatch):
    return Disk(monkeypatch)


def ran(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        main(list(arguments))
    return end.value.code or 0, capsys.readouterr()


def one_line(said, folder):
    (line,) = [line for line in said.err.splitlines() if line.startswith("ninedof: ")]
    assert "No space left on device" in line
    assert str(folder) in line
    assert ".part-" not in line
    assert "Traceback" not in said.err
    return line


def no_rubbish(folder):
    names = [path.name for path in folder.rglob("*")]
    assert not [name for name in names if name.startswith(".part-") or name == LOCK]
    if "record.json" in names:
        load_record(folder)


@pytest.mark.parametrize("name", RUNS)
def test_the_disk_is_full_at_any_file_of_a_run(tmp_path, capsys, disk, name):
    arguments, computing = RUNS[name]
    for at in range(1, 20):
        out = tmp_path / str(at)
        disk.files, disk.full_at = 0, at
        code, said = ran(capsys, name, *arguments, "--out", str(out))
        assert (SAID[name] in said.out) == (at > computing), said.out
        no_rubbish(out)
        if code == 0:
            break
        assert code == 1, said.err
        one_line(said, out)
    # What is last, how the run ended, is noted in command.json if there is room.
    assert at - (name == "path") == disk.files > computing


@pytest.mark.parametrize("name", ["sweep", "atlas", "pareto"])
def test_the_run_goes_on_when_there_is_room(tmp_path, capsys, disk, name):
    arguments, computing = RUNS[name]
    disk.full_at = computing + 1
    out = ["--out", str(tmp_path / "out")]
    assert ran(capsys, name, *arguments, *out)[0] == 1
    disk.full_at = None
    code, said = ran(capsys, name, *arguments, *out, "--resume")
    assert code == 0, said.err
    load_record(tmp_path / "out")


@pytest.mark.parametrize("name", ["optimize", "sweep", "path"])
def test_json_comes_all_the_same(tmp_path, capsys, disk, name):
    arguments, computing = RUNS[name]
    disk.full_at = computing + 1
    code, said = ran(capsys, name, *arguments, "--json", "--out", str(tmp_path / "out"))
    assert code == 1
    one_line(said, tmp_path / "out")
    assert json.loads(said.out)


def test_the_disk_is_full_at_a_figure(tmp_path, capsys, disk):
    """Record and words are there."""
    arguments = ["sweep", "--over", "x_p=-1:1:3", "--out"]
    for at in (6, 8, 9):  # figures, the report; the record with their names is the next
        disk.files, disk.full_at = 0, at
        code, said = ran(capsys, *arguments, str(tmp_path / str(at)))
        assert code == 1
        one_line(said, tmp_path / str(at))
        no_rubbish(tmp_path / str(at))
        assert "greatest" in said.out
        assert ("the report could not be written: " in said.out) == (at == 9)
        assert (tmp_path / str(at) / "record.json").is_file()


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run") / "run"
    nd.save(nd.optimize(nd.Study.paper(), starts=1), folder)
    return folder


@pytest.mark.parametrize(
    ("arguments", "at", "file", "words"),
    [
        (["report", "RUN"], 4, "report.html", None),
        (["report", "RUN", "--out", "TMP/r.html"], 4, "r.html", None),
        (["export", "RUN", "--to", "csv", "--out", "TMP/e.csv"], 1, "e.csv", None),
        (["export", "RUN", "--to", "urdf", "--out", "TMP/e.urdf"], 1, "e.urdf", None),
        (["sheet", "RUN", "--csv", "TMP/s.csv"], 1, "s.csv", "shortest"),
        (["certify", "RUN", "--time", "0"], 2, "certify.json", "condition number"),
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)
def test_the_disk_is_full_at_a_file_of_another_command(tmp_path, capsys, disk, run, arguments, at, file, words):
    disk.full_at = at  # after the figure of the report, which is drawn elsewhere
    own = [word.replace("RUN", str(run)).replace("TMP", str(tmp_path)) for word in arguments]
    code, said = ran(capsys, *own)
    assert code == 1, said.err
    assert file in one_line(said, run if "--out" not in arguments and "--csv" not in arguments else tmp_path)
    assert words is None or words in said.out
    assert not list(tmp_path.iterdir())
    assert {path.name for path in run.iterdir()} <= {"record.json", "certify.command.json"}


@pytest.mark.parametrize("save", [lambda found, path: nd.save(found, path), lambda found, path: found.save(path)])
def test_a_result_is_not_saved_for_python(tmp_path, disk, save):
    found = nd.atlas(1000)
    disk.full_at = 1
    with pytest.raises(OSError, match="No space left on device") as caught:
        save(found, tmp_path / "out")
    assert Path(caught.value.filename).is_relative_to(tmp_path)
    assert not list(tmp_path.rglob("*"))


@pytest.mark.parametrize("asked", [lambda out: nd.sweep_figure("6", 5, out=out), lambda out: nd.atlas(1000, out=out)])
def test_the_chunks_are_not_kept_for_python(tmp_path, disk, caplog, asked):
    """The result comes all the same."""
    expected = asked(None)
    disk.full_at = 1
    found = asked(tmp_path)
    (line,) = caplog.messages
    assert "No space left on device" in line
    assert "finished.npz'; the run goes on" in line
    assert not list(tmp_path.iterdir())
    assert all(found[name].tobytes() == expected[name].tobytes() for name in expected)


@pytest.fixture
def tiny(tmp_path):
    """A file system of 32 kilobytes."""
    place = tmp_path / "tiny"
    place.mkdir()
    mount, umount = shutil.which("mount"), shutil.which("umount")
    if not (mount and umount and hasattr(os, "geteuid") and os.geteuid() == 0):
        pytest.skip("no file system can be mounted here")
    command = [mount, "-t", "tmpfs", "-o", "size=32k", "tmpfs", str(place)]
    if subprocess.run(command, capture_output=True, check=False).returncode:
        pytest.skip("no file system can be mounted here")
    yield place
    subprocess.run([umount, str(place)], check=True)


def ran_in_another_process(*arguments):
    path = os.pathsep.join([str(Path(nd.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    command = [sys.executable, "-m", "ninedof", *arguments, *PLAIN]
    env = os.environ | {"PYTHONPATH": path}
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, env=env)


def test_a_disk_that_is_really_full(tiny):
    """Neither the result of some hundred kilobytes nor its folder is lost."""
    ended = ran_in_another_process("atlas", "--designs", "100000", "--out", str(tiny / "out"))
    assert ended.returncode == 1
    assert SAID["atlas"] in ended.stdout
    last = ended.stderr.splitlines()[-1]
    file = tiny / "out" / "atlas.npz"
    assert last == f"ninedof: {file}: No space left on device. Nothing is kept of what was computed."
    assert "Traceback" not in ended.stderr
    assert (tiny / "out" / "command.json").is_file()
    no_rubbish(tiny / "out")


def test_a_disk_without_room_for_the_values_is_refused_before_the_work(tiny):
    ended = ran_in_another_process("sweep", "--over", "x_p=-1:1:20001", "--out", str(tiny / "out"))
    assert ended.returncode == 2
    assert "got 20001 points, expected fewer: their values take 0.00016 GB" in ended.stderr
    assert not list(tiny.iterdir())
