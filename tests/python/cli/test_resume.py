"""`ninedof resume`: a run that was interrupted or killed goes on with the command and the study that it had."""

import json
import os
import shlex
import shutil
import signal
import socket
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest
from killing import COMMANDS, Killer
from sweep_work import finished

import ninedof as nd
from ninedof import _core
from ninedof.chunks import Store
from ninedof.cli.app import main
from ninedof.cli.commands import certify
from ninedof.runs.command_file import read_command
from ninedof.support.lock import FolderLock
from ninedof.support.seal import sealed, unsealed
from ninedof.sweep.grid import GridWork

LONG = "NINEDOF_LONG" in os.environ
STUDY = """
[variables]
zp = [1.0, 6.0]
[constraints]
radius_ratio = { max = 2.0 }
[objective.region]
box = [0.4, 0.0, 0.0]
[solver]
starts = 2
"""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run(line):
    with pytest.raises(SystemExit) as ended:
        main(shlex.split(line))
    return ended.value.code or 0


def interrupted(monkeypatch, line, piece=0, number=signal.SIGTERM):
    """Run a command that a signal ends as it keeps a piece; the piece is lost."""
    write = Store.write

    def ending(store, k, arrays):
        if k == piece:
            signal.raise_signal(number)
        write(store, k, arrays)

    values = GridWork.values

    def ending_chunk(work, first, last):
        if first // work.chunk == piece:
            signal.raise_signal(number)
        return values(work, first, last)

    with monkeypatch.context() as patch:
        patch.setattr(Store, "write", ending)
        patch.setattr(GridWork, "values", ending_chunk)
        return run(line)


@pytest.mark.parametrize("kind", COMMANDS if LONG else ["sweep"])
def test_killed_at_random_moments(kind, tmp_path):
    killer = Killer(tmp_path, seed=5)
    whole, seconds = killer.undisturbed(kind)
    got, kills = killer.killed(kind, seconds, 20 if LONG else 3)
    assert got == whole
    assert kills == killer.kills


@pytest.mark.parametrize(
    ("line", "piece"),
    [
        ("sweep --over x_p=-1:1:40 --chunk 10", 2),
        ("pareto --against radius_ratio --value 2 --value 3 --starts 4", 1),
        ("optimize study.toml", 0),  # a study over a region is one piece
        ("optimize --starts 4 --certify", 1),
        ("workspace design.toml --legs 2.5 6.5 --tolerance 0.1 --certify --gap 0.5", 1),
    ],
)
def test_what_a_signal_ended_goes_on_to_the_same_record(monkeypatch, tmp_path, capsys, line, piece):
    (tmp_path / "study.toml").write_text(STUDY)
    published = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    nd.save(nd.Design(published, nd.Configuration.neutral(3.9828, 2.4432)), "design.toml")
    assert run(f"{line} --no-figures --out whole") == 0
    assert interrupted(monkeypatch, f"{line} --no-figures --out run", piece) == 143
    said = capsys.readouterr()
    assert "`ninedof resume run` continues the run" in said.err
    assert (said.out + said.err).count("--resume") == 0  # one hint is enough
    for file in ("study.toml", "design.toml"):  # the run has its own
        (tmp_path / file).write_text("something = else")
    kept = {file: file.stat().st_mtime_ns for file in (tmp_path / "run" / "chunks").glob("chunk-*")}
    assert len(kept or finished(tmp_path / "run" / "chunks")) == piece
    assert run("resume run") == 0
    assert kept.items() <= {file: file.stat().st_mtime_ns for file in kept}.items()
    records = [json.loads((tmp_path / name / "record.json").read_text()) for name in ("whole", "run")]
    assert records[1]["command"] == f"ninedof {line} --no-figures --out run"
    assert [untimed(record) for record in records[:1]] == [untimed(record) for record in records[1:]]
    assert run("resume run") == 0
    assert "the run has ended, there is nothing to resume" in capsys.readouterr().out


def untimed(value):
    if isinstance(value, dict):
        return {k: untimed(v) for k, v in value.items() if k not in ("seconds", "created", "command", "digest")}
    return [untimed(v) for v in value] if isinstance(value, list) else value


def test_a_certificate_goes_on_where_its_run_now_lies(monkeypatch, tmp_path, capsys):
    assert run("optimize --starts 2 --no-figures --out made") == 0
    assert run("certify made --gap 0.3") == 0
    whole = json.loads((tmp_path / "made" / "certify.json").read_text())
    for file in (tmp_path / "made").glob("certify*"):
        file.unlink()
    with monkeypatch.context() as patch:
        patch.setattr(nd.Result, "certify", lambda *_, **__: signal.raise_signal(signal.SIGTERM))
        assert run("certify made --gap 0.3") == 143
    shutil.move("made", "moved")
    assert run("resume moved") == 0
    got = json.loads((tmp_path / "moved" / "certify.json").read_text())
    assert untimed(whole | {"seal": ""}) == untimed(got | {"seal": ""})
    assert run("resume moved") == 0
    assert "nothing to resume" in capsys.readouterr().out


KILLED = """
import os, signal, sys
from functools import partial
sys.path[:] = {path}
from ninedof.cli.app import main
from ninedof.cli.commands import certify
from ninedof import _core
_core.ConditionSettings = partial(_core.ConditionSettings, slice_seconds=0.01, least_seconds=0.01)
def save(made, file, write=certify.save_certificate):
    write(made, file)
    if made.left_count < 10000:
        os.kill(os.getpid(), signal.SIGKILL)
certify.save_certificate = save
main(["certify", "solved", "--gap", "1e-4"])
"""


def fixed():
    """A run that takes no time, with a region that takes half a second to be proved."""
    variables = {"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4, "theta_z": 0.0}
    made = nd.optimize(nd.Study(variables=variables, objective={"region": {"box": [0.03] * 3, "tilt_deg": 0.6}}))
    nd.save(made, "solved")


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
def test_a_killed_certificate_goes_on_where_it_was(tmp_path, capsys):
    fixed()
    killed = subprocess.run([sys.executable, "-c", KILLED.format(path=sys.path)], check=False, capture_output=True)
    assert killed.returncode == -signal.SIGKILL, killed.stderr
    begun = nd.load_certificate(tmp_path / "solved" / "certify.begun.json")
    assert begun.interrupted
    assert begun.left_count
    assert run("resume solved") == 0
    made = nd.load_certificate("solved")
    assert made.condition[1] <= made.condition[0] * 1.0001 * (1.0 + 1e-9)
    assert made.condition_boxes > begun.condition_boxes
    assert not (tmp_path / "solved" / "certify.begun.json").exists()
    assert run("resume solved") == 0
    assert "nothing to resume" in capsys.readouterr().out


def test_a_certificate_whose_time_was_over_goes_on_and_one_that_time_does_not_help_says_so(monkeypatch, capsys):
    fixed()
    settings = _core.ConditionSettings
    with monkeypatch.context() as patch:
        patch.setattr(_core, "ConditionSettings", partial(settings, least_seconds=1e-9))
        assert run("certify solved --gap 1e-3 --time 0") == 3
        assert nd.load_certificate("solved").left_count
    monkeypatch.setattr(_core, "ConditionSettings", partial(settings, least_seconds=100.0))
    assert run("resume solved") == 0
    assert not nd.load_certificate("solved").left_count
    assert run("certify solved --condition 1.5") == 3
    capsys.readouterr()
    before = nd.load_certificate("solved")
    assert run("resume solved") == 0
    assert "nothing to resume (not proved, and no matter of time: condition number violated)" in capsys.readouterr().out
    assert nd.load_certificate("solved") == before


def test_a_certificate_that_is_gone_is_made_anew():
    fixed()
    assert run("certify solved --condition 1.5") == 3
    Path("solved/certify.json").unlink()
    assert run("resume solved") == 3
    assert nd.load_certificate("solved").limits[-1].answer == "violated"


def test_an_earlier_certificate_is_read_when_the_folder_is_locked(monkeypatch):
    fixed()
    assert run("certify solved") == 0
    read = []

    def locked(file):
        with pytest.raises(ValueError, match="another run is using"):
            FolderLock(Path("solved"))
        read.append(file)
        return nd.load_certificate(file)

    monkeypatch.setattr(certify, "load_certificate", locked)
    assert run("certify solved --resume") == 0
    assert [file.name for file in read] == ["certify.json"]


def edited(**entries):
    """By somebody who knows how the file is sealed."""
    return lambda text: json.dumps(sealed(unsealed(json.loads(text), "file") | entries))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: text[: len(text) // 2], "not a JSON file"),
        (lambda text: text.replace("x_p", "y_p"), "got a file that was changed or damaged"),
        (lambda _: "[]", "got no whole 'ninedof-command-1' file"),
        (edited(format="else"), "got no whole"),
        (edited(arguments=[]), "got no whole"),
        (edited(arguments=["sweep", 3]), "got no whole"),
        (edited(arguments="sweep"), "got no whole"),
        (edited(input={"name": "a"}), "got no whole"),
        *(
            (edited(input={"name": name, "text": "", "point": ""}), "got no whole")
            for name in ("..", "../../elsewhere", "", "a/b", 300 * "a")
        ),
        (edited(input={"name": "a.toml", "text": "\ud800", "point": ""}), "got no whole"),
        (edited(status="ended"), "got no whole"),
        (edited(arguments=["view", "--port", "1"]), "got the command 'view', expected one that can be resumed"),
        (edited(arguments=["resume", "run"]), "got the command 'resume', expected one that can be resumed"),
        (edited(arguments=["rm\x1b[2J", "-rf"]), "expected one that can be resumed"),
    ],
)
def test_a_foreign_or_damaged_command_is_one_line(monkeypatch, tmp_path, capsys, change, words):
    interrupted(monkeypatch, "sweep --over x_p=-1:1:40 --no-figures --out run")
    file = tmp_path / "run" / "command.json"
    file.write_text(change(file.read_text()))
    capsys.readouterr()
    assert run("resume run") == 2
    said = capsys.readouterr().err.strip()
    assert said.startswith("ninedof: run/command.json: ")
    assert words in said
    assert len(said.splitlines()) == 1


def test_a_remembered_command_writes_into_its_own_folder_alone(monkeypatch, tmp_path):
    interrupted(monkeypatch, "sweep --over x_p=-1:1:40 --no-figures --out run")
    file = tmp_path / "run" / "command.json"
    arguments = [*json.loads(file.read_text())["arguments"], "--out", "elsewhere", "--out=elsewhere"]
    file.write_text(edited(arguments=arguments)(file.read_text()))
    assert run("resume run") == 0
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["run"]
    assert isinstance(nd.load("run"), nd.SweepResult)


@pytest.mark.parametrize("words", [["--scheduler", "{address}"], ["--scheduler={address}"]])
def test_a_remembered_command_calls_nobody(monkeypatch, capsys, words):
    """A scheduler runs code in what connects to it."""
    interrupted(monkeypatch, "sweep --over x_p=-1:1:40 --no-figures --out run")
    file = Path("run/command.json")
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(0.0)
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        arguments = json.loads(file.read_text())["arguments"] + [word.format(address=address) for word in words]
        file.write_text(edited(arguments=arguments)(file.read_text()))
        assert run("resume run") == 0
        with pytest.raises(BlockingIOError):
            server.accept()
    assert "the run was on a cluster: it goes on here" in capsys.readouterr().err


def test_a_refused_command_does_not_take_the_place_of_the_remembered_one(monkeypatch, capsys):
    interrupted(monkeypatch, "sweep --over x_p=-1:1:40 --no-figures --out run", 1)
    file = Path("run/command.json")
    before = file.read_bytes()
    assert run("sweep --over x_p=-1:1:41 --no-figures --out run --resume") == 2
    assert "another question" in capsys.readouterr().err
    assert file.read_bytes() == before
    assert run("resume run") == 0
    assert len(nd.load("run")["condition_number"]) == 40


def test_a_refused_certificate_leaves_nothing_to_resume(capsys):
    Path("none.toml").write_text("[constraints]\nleg_ratio = { max = 0.5 }\n")
    assert run("optimize none.toml --starts 2 --no-figures --out none") == 3
    assert run("certify none") == 2
    assert not list(Path("none").glob("certify*"))
    capsys.readouterr()
    assert run("resume none") == 0
    assert "nothing to resume" in capsys.readouterr().out


def test_resuming_with_another_study_remembers_that_one(monkeypatch, tmp_path, capsys):
    """The folder of a run that was killed before it kept anything takes another; the same one keeps its own."""
    (tmp_path / "a.toml").write_text(STUDY)
    (tmp_path / "b.toml").write_text(STUDY.replace("2.0", "2.5"))
    kill = {"piece": 0, "number": signal.SIGTERM}
    assert interrupted(monkeypatch, "optimize a.toml --no-figures --out run", **kill) == 143
    shutil.rmtree(tmp_path / "run" / "chunks")
    assert interrupted(monkeypatch, "optimize b.toml --no-figures --out run --resume", **kill) == 143
    assert "2.5" in read_command(tmp_path / "run" / "command.json").input.text
    assert run("resume run") == 0
    assert nd.load("run").study.constraints["radius_ratio"][1] == 2.5


def test_the_name_of_a_run_that_has_ended_does_not_act_on_the_terminal(tmp_path, capsys):
    assert run("sweep --over x_p=-1:1:4 --no-figures --out plain") == 0
    (tmp_path / "plain").rename(tmp_path / "a\x1b]0;owned\x07b")
    capsys.readouterr()
    run(shlex.join(["resume", "a\x1b]0;owned\x07b"]))
    said = capsys.readouterr()
    assert "\x1b" not in said.out + said.err


def test_a_folder_without_a_command_is_named(tmp_path, capsys):
    (tmp_path / "empty").mkdir()
    for name, words in (("empty", "a folder without command.json"), ("none", "no folder")):
        assert run(f"resume {name}") == 2
        assert (
            capsys.readouterr().err == f"ninedof: run: got {name}, {words}, expected the folder of an interrupted run\n"
        )


def test_bad_input_leaves_no_folder(tmp_path):
    assert run("pareto --against radius_ratio --value -1 --out run") == 2
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "killed").mkdir()
    (tmp_path / "killed" / ".part-command.json-0a1b2c3d").write_text("{")  # of a run killed as it began
    assert run("sweep --over x_p=-1:1:4 --no-figures --out killed") == 0
    assert not list((tmp_path / "killed").glob(".part-*"))
