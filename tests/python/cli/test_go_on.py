"""The same command with the same --out goes on; after Ctrl-C and the end of --time the line to type is printed."""

import json
import os
import shlex
import signal
import subprocess
import sys
from functools import partial

import pytest

import ninedof as nd
from ninedof import _core
from ninedof.cli.app import main
from ninedof.support.kept.store import Store

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


def interrupted(monkeypatch, line, piece, ending_signal):
    """Run a command that a signal ends as it keeps a piece; the piece is lost."""
    keep = Store.keep

    def ending(store, k, arrays):
        if k == piece:
            signal.raise_signal(ending_signal)
        keep(store, k, arrays)

    with monkeypatch.context() as patch:
        patch.setattr(Store, "keep", ending)
        return run(line)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize(
    ("line", "piece", "number"),
    [
        ("pareto --against radius_ratio --value 2 --value 3 --starts 4", 1, signal.SIGTERM),
        ("optimize study.toml", 0, signal.SIGTERM),  # a study over a region is one piece
        ("optimize --starts 4 --certify", 1, signal.SIGTERM),
        ("workspace --legs 2.5 6.5 --tolerance 0.1 --certify --gap 0.5", 1, signal.SIGTERM),
        ("sweep figure-7 --points 5", 3, signal.SIGINT),
    ],
)
def test_what_a_signal_ended_goes_on_to_the_same_record(monkeypatch, tmp_path, capsys, line, piece, number):
    (tmp_path / "study.toml").write_text(STUDY)
    assert run(f"{line} --no-figures --out whole") == 0
    capsys.readouterr()
    assert interrupted(monkeypatch, f"{line} --no-figures", piece, number) == 128 + number
    aim = "to go on" if piece else "to begin anew"
    _, again = capsys.readouterr().err.strip().split(f"ninedof: interrupted; {aim}, type: ninedof ")
    (folder,) = (tmp_path / "runs").iterdir()
    assert again == f"{line} --no-figures --out runs/{folder.name}"
    files = {file: file.stat().st_mtime_ns for file in (folder / "pieces").iterdir()}
    assert len(files) == piece
    for _ in range(2):
        assert run(again) == 0
    assert files.items() <= {file: file.stat().st_mtime_ns for file in files}.items()
    records = [json.loads((place / "record.json").read_text()) for place in (tmp_path / "whole", folder)]
    assert untimed(records[0]) == untimed(records[1])
    assert "type" not in capsys.readouterr().err


def untimed(value):
    if isinstance(value, dict):
        return {k: untimed(v) for k, v in value.items() if k not in ("seconds", "created", "command", "digest")}
    return [untimed(v) for v in value] if isinstance(value, list) else value


def test_another_question_is_refused_with_both_named_before_the_work(tmp_path, capsys):
    (tmp_path / "study.toml").write_text(STUDY)
    assert run("optimize study.toml --no-figures --out run") == 0
    (tmp_path / "study.toml").write_text(STUDY.replace("2.0", "2.5"))
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    capsys.readouterr()
    for line, words in (
        ("optimize study.toml", "study.constraints.radius_ratio.max is 2.0 there and 2.5 here; "),
        ("sweep --over x_p=-1:1:4", "kind is 'optimize' there and 'sweep' here; "),
        ("path --circle 0.2", "kind is 'optimize' there and 'motion' here; "),
        ("paper --figures", "kind is 'optimize' there and 'paper' here; "),
    ):
        assert run(f"{line} --out run") == 2
        message = f"which holds the run of another question: {words}expected a new folder or the question there\n"
        assert capsys.readouterr().err.splitlines(keepends=True)[-1] == f"ninedof: --out: got run, {message}"
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize("name", ["optimize", "pareto", "sweep --over x_p=-1:1:3", "atlas", "path --circle 0.2"])
def test_a_folder_of_something_else_is_refused_before_the_work(tmp_path, capsys, name):
    (tmp_path / "thesis").write_text("mine")
    assert run(f"{name} --out .") == 2
    assert "which holds 'thesis' but no question.json" in capsys.readouterr().err
    assert [path.read_text() for path in tmp_path.iterdir()] == ["mine"]


@pytest.mark.parametrize("time", ["--time 1e-9", "--time=1e-9"])
def test_the_end_of_the_time_is_followed_by_the_line_without_it(tmp_path, capsys, time):
    (tmp_path / "study.toml").write_text(STUDY)
    assert run(f"optimize study.toml --no-figures {time} --out run") in (0, 3)
    line = "ninedof: the time is over; to begin anew, type: ninedof optimize study.toml --no-figures --out run\n"
    assert capsys.readouterr().err.endswith(line)


KILLED = """
import os, signal, sys
from functools import partial
sys.path[:] = {path}
from ninedof.cli.app import main
from ninedof.cli.commands.runs import certify
from ninedof import _core
_core.ConditionSettings = partial(_core.ConditionSettings, slice_seconds=1e-9, least_seconds=1e-9)
def save(made, file, write=certify.save_certificate):
    write(made, file)
    if made.left_count:
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
def test_a_killed_certificate_goes_on_where_it_was():
    fixed()
    killed = subprocess.run([sys.executable, "-c", KILLED.format(path=sys.path)], check=False, capture_output=True)
    assert killed.returncode == -signal.SIGKILL, killed.stderr
    begun = nd.load_certificate("solved")
    assert begun.interrupted
    assert begun.left_count
    assert run("certify solved --gap 1e-4") == 0
    made = nd.load_certificate("solved")
    assert made.condition[1] <= made.condition[0] * 1.0001 * (1.0 + 1e-9)
    assert made.condition_boxes > begun.condition_boxes


def test_a_certificate_whose_time_was_over_goes_on(monkeypatch, capsys):
    fixed()
    settings = _core.ConditionSettings
    with monkeypatch.context() as patch:
        patch.setattr(_core, "ConditionSettings", partial(settings, least_seconds=1e-9))
        assert run("certify solved --gap 1e-3 --time 0") == 3
    assert nd.load_certificate("solved").left_count
    line = "ninedof: the time is over; to go on, type: ninedof certify solved --gap 1e-3 --time 0\n"
    assert capsys.readouterr().err.endswith(line)
    monkeypatch.setattr(_core, "ConditionSettings", partial(settings, least_seconds=100.0))
    assert run("certify solved --gap 1e-3 --time 0") == 0
    assert not nd.load_certificate("solved").left_count


def test_an_interrupted_certificate_leaves_the_one_that_is_there(monkeypatch, capsys):
    fixed()
    assert run("certify solved") == 0
    before = nd.load_certificate("solved")
    monkeypatch.setattr(nd.Result, "certify", lambda *_, **__: signal.raise_signal(signal.SIGINT))
    assert run("certify solved") == 130
    assert capsys.readouterr().err.endswith("ninedof: interrupted; to go on, type: ninedof certify solved\n")
    assert nd.load_certificate("solved") == before


FULL = OSError(28, "No space left on device")
KEPT = {
    "optimize --starts 1 --no-figures": "condition number",
    "pareto --value 2 --starts 1 --no-figures": "objective",
    "sweep --over x_p=-1:1:3 --no-figures": "greatest",
    "workspace --condition 6 --resolution 4 --tolerance 0.2 --no-figures": "volume",
    "path --circle 0.2 --points 11 --no-figures": "Legs along the path",
}


@pytest.mark.parametrize("line", KEPT)
def test_a_full_disk_loses_no_result(tmp_path, monkeypatch, capsys, line):
    """At the record: the words come all the same, one line names the file, and the run goes on when there is room."""
    real = os.replace

    def full(part, path):
        if "/pieces/" not in str(path) and "question" not in str(path):
            raise FULL
        real(part, path)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", full)
        assert run(f"{line} --out run") == 1
    message = capsys.readouterr()
    assert KEPT[line] in message.out
    (words,) = [one for one in message.err.splitlines() if one.startswith("ninedof: ")]
    assert words.startswith("ninedof: run/")
    assert words.endswith(": No space left on device")
    assert not list(tmp_path.rglob(".part-*"))
    assert run(f"{line} --out run") == 0


@pytest.mark.parametrize("call", [lambda out: nd.sweep_figure("6", 5, out=out), lambda out: nd.atlas(1000, out=out)])
def test_pieces_that_cannot_be_kept_lose_no_result(tmp_path, monkeypatch, caplog, call):
    expected, real = call(None), os.replace

    def full(part, path):
        if "/pieces/" in str(path) and path.suffix == ".npz":
            raise FULL
        real(part, path)

    monkeypatch.setattr(os, "replace", full)
    result = call(tmp_path)
    (record,) = caplog.records
    assert "00000000.npz" in record.getMessage()
    assert record.getMessage().endswith("; the run goes on, but what cannot be written is lost if it ends early")
    assert all(result[name].tobytes() == expected[name].tobytes() for name in expected)
