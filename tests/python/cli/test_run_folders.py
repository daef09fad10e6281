"""A run folder belongs to one command at a time; what cannot be written is told before the work."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.cli import long_run
from ninedof.cli.app import main
from ninedof.runs.command_file import Asked
from ninedof.support.lock import FolderLock

PLAIN = ["--no-figures", "--no-report"]
SMALL = {
    "optimize": ["--starts", "1"],
    "pareto": ["--value", "2", "--starts", "1"],
    "sweep": ["--over", "x_p=-1:1:3"],
    "atlas": ["--designs", "1000"],
    "workspace": ["--condition", "6", "--resolution", "4", "--tolerance", "0.2"],
    "path": ["--circle", "0.2", "--points", "11"],
    "paper": ["--figures"],
}


def ran(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        main(list(arguments))
    return end.value.code, capsys.readouterr()


@pytest.mark.parametrize("name", SMALL)
def test_a_folder_in_use_is_refused_before_the_work(tmp_path, capsys, name):
    out = tmp_path / "out"
    out.mkdir()
    with FolderLock(out):
        code, said = ran(capsys, name, *SMALL[name], "--out", str(out))
    assert code == 2
    (line,) = [line for line in said.err.splitlines() if line.startswith("ninedof: ")]
    assert line == f"ninedof: --out: got {out}, which another run is using, expected another folder"
    assert not list(out.iterdir())


@pytest.mark.parametrize("name", SMALL)
def test_a_part_of_somebody_else_is_not_deleted(tmp_path, capsys, name):
    foreign = tmp_path / ".part-thesis-cafebabe"
    foreign.write_text("thesis")
    code, said = ran(capsys, name, *SMALL[name], "--out", str(tmp_path))
    assert code == 2
    assert "exists and is not an empty folder" in said.err
    assert [path.read_text() for path in tmp_path.iterdir()] == ["thesis"]


@pytest.mark.parametrize("arguments", [["pareto", "--against", "nonsense"], ["sweep", "--over", "x_p=-1:1:3", *PLAIN]])
def test_a_part_of_somebody_else_that_comes_meanwhile_is_not_deleted(tmp_path, capsys, monkeypatch, arguments):
    """Whether the run ends at once or goes on to its end."""
    real = long_run.remember

    def remember(directory, *more, **options):
        (directory / ".part-thesis-cafebabe").write_text("thesis")
        (directory / ".part-record.json-cafebabe").write_text("of a run that was killed")
        real(directory, *more, **options)

    monkeypatch.setattr(long_run, "remember", remember)
    code, _ = ran(capsys, *arguments, "--out", str(tmp_path))
    assert code == (2 if "nonsense" in arguments else 0)
    assert (tmp_path / ".part-thesis-cafebabe").read_text() == "thesis"
    assert (tmp_path / ".part-record.json-cafebabe").exists() == (code == 2)


@pytest.mark.parametrize("name", ["sweep", "atlas", "pareto"])
def test_a_folder_in_use_is_not_resumed(tmp_path, capsys, name):
    out = tmp_path / "out"
    (out / "chunks").mkdir(parents=True)
    with FolderLock(out):
        code, said = ran(capsys, name, *SMALL[name], "--out", str(out), "--resume")
    assert code == 2
    assert "which another run is using" in said.err


@pytest.mark.parametrize("name", ["optimize", "pareto", "workspace"])
@pytest.mark.parametrize("command", ["--resume", "resume"])
def test_a_link_in_the_place_of_chunks_is_refused(tmp_path, capsys, name, command):
    """It was written to where the link leads. The run folder itself may be a link."""
    run, outside, link = (tmp_path / place for place in ("run", "outside", "link"))
    asked = [name, *SMALL[name], *PLAIN, "--out"]
    assert ran(capsys, *asked, str(run))[0] in (None, 0)
    (run / "command.json").unlink()
    (run / "chunks").rename(outside)
    link.symlink_to(run)
    for target in (outside, tmp_path / "nothing"):
        (run / "chunks").symlink_to(target)
        if command == "resume":
            Asked(tuple(asked[:-1]), str(tmp_path)).write(run / "command.json")
        (outside / "chunk-00000000").unlink(missing_ok=True)
        before = {path: path.stat().st_mtime_ns for path in (*tmp_path.rglob("*"), run) if path.exists()}
        code, said = ran(capsys, *(["resume", str(run)] if command == "resume" else [*asked, str(run), command]))
        assert code == 2
        said_of = f"--resume: got --out {run}, in which chunks is a link, expected a folder in its place"
        assert said.err == f"ninedof: {said_of}\n"
        assert {path: path.stat().st_mtime_ns for path in (*tmp_path.rglob("*"), run) if path.exists()} == before
        (run / "chunks").unlink()
    outside.rename(run / "chunks")
    assert ran(capsys, *asked, str(link), "--resume")[0] in (None, 0)
    assert (run / "chunks" / "chunk-00000000").is_file()


def test_a_folder_of_chunks_that_is_refused_is_that_of_the_folder_that_was_typed(tmp_path, capsys):
    out = tmp_path / "out"
    sweep = ["sweep", *PLAIN, "--out", str(out)]
    assert ran(capsys, *sweep, "--over", "x_p=-1:1:3")[0] in (None, 0)
    code, said = ran(capsys, *sweep, "--over", "x_p=-1:1:4", "--resume")
    assert code == 2
    assert said.err.startswith(f"ninedof: --out: got {out}, whose folder chunks holds the chunks of another question (")
    (out / "chunks" / "finished.npz").unlink()
    code, said = ran(capsys, *sweep, "--over", "x_p=-1:1:3", "--resume")
    assert code == 2
    assert said.err == (
        f"ninedof: --out: got {out}, whose folder chunks holds 'condition_number.npy' but no finished.npz, "
        "expected it empty\n"
    )


def test_two_commands_with_one_folder_one_is_refused(tmp_path):
    """Both ended with status 0, and one record was lost."""
    path = os.pathsep.join([str(Path(nd.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    command = [
        sys.executable,
        "-m",
        "ninedof",
        "optimize",
        "--starts",
        "2",
        "--no-figures",
        "--no-report",
        "--out",
        "oo",
    ]
    both = [
        subprocess.Popen(
            [*command, "--seed", str(seed)],
            cwd=tmp_path,
            env=os.environ | {"PYTHONPATH": path},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        for seed in (1, 2)
    ]
    errors = [process.communicate(timeout=120)[1] for process in both]
    codes = [process.returncode for process in both]
    assert sorted(codes) == [0, 2], errors
    refused = [line for line in errors[codes.index(2)].splitlines() if line.startswith("ninedof: ")]
    assert len(refused) == 1
    assert refused[0].startswith("ninedof: --out: got oo, which")
    record = json.loads((tmp_path / "oo" / "record.json").read_text())
    assert record["study"]["solver"]["seed"] == 1 + codes.index(0)
    assert [p.name for p in (tmp_path / "oo").iterdir() if p.name.startswith(".")] == []


def test_a_backend_of_matplotlib_that_is_not_there_does_not_matter(tmp_path):
    """It was found out after the work."""
    path = os.pathsep.join([str(Path(nd.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    code = "import os, ninedof.plot as p; from matplotlib.figure import Figure; p.save(Figure(), '.', 'f'); "
    code += "assert os.environ['MPLBACKEND'] == 'weird'"
    environment = os.environ | {"PYTHONPATH": path, "MPLBACKEND": "weird"}
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True, timeout=60)
    assert (tmp_path / "f.png").read_bytes()[1:4] == b"PNG"
    chosen = "import ninedof.plot, matplotlib; assert matplotlib.rcParams['backend'] == 'svg'"
    environment = os.environ | {"PYTHONPATH": path, "MPLBACKEND": "svg"}
    subprocess.run([sys.executable, "-c", chosen], env=environment, check=True, timeout=60)


@pytest.mark.parametrize("arguments", [["--against", "foo"], ["--value", "-1"], ["--points", "1"], ["--starts", "0"]])
def test_rejected_arguments_of_pareto_leave_no_folder(tmp_path, capsys, arguments):
    code, said = ran(capsys, "pareto", *arguments, "--out", str(tmp_path / "a" / "b"))
    assert code == 2
    assert sum(line.startswith("ninedof: ") for line in said.err.splitlines()) == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("value", ["-3", "0", "nan", "inf"])
def test_a_value_of_pareto_is_refused_by_its_own_name(tmp_path, capsys, value):
    code, said = ran(capsys, "pareto", "--value", "2", f"--value={value}", "--out", str(tmp_path / "out"))
    assert code == 2
    assert said.err == f"ninedof: --value: got {value}, expected a finite number above 0\n"
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("link.csv", "it is a link to nothing"),
        ("n" * 252 + ".csv", "File name too long"),
        ("folder.csv", "it is a folder"),
        ("pipe.csv", "was not written by ninedof"),
        ("mine.csv", "was not written by ninedof"),
        ("none/s.csv", "expected a file in a folder that exists"),
    ],
)
def test_a_file_that_cannot_be_written_is_told_before_the_work(tmp_path, capsys, monkeypatch, place, words):
    (tmp_path / "link.csv").symlink_to(tmp_path / "nothing")
    (tmp_path / "folder.csv").mkdir()
    os.mkfifo(tmp_path / "pipe.csv")
    (tmp_path / "mine.csv").write_text("mine")
    before = sorted(tmp_path.iterdir())
    (tmp_path / "design.toml").write_text("")
    code, said = ran(capsys, "sheet", str(tmp_path / "design.toml"), "--csv", str(tmp_path / place))
    assert code == 2
    assert said.err.startswith(f"ninedof: --csv: got {tmp_path / place}, ")
    assert words in said.err
    (tmp_path / "design.toml").unlink()
    assert sorted(tmp_path.iterdir()) == before
    assert (tmp_path / "mine.csv").read_text() == "mine"
    assert not (tmp_path / "nothing").exists()


def test_a_name_of_the_full_length_is_written(tmp_path):
    """The name of the part that is written first is not longer."""
    path = tmp_path / ("ü" * 125 + ".npz")
    found = nd.atlas(100)
    assert nd.SweepResult.load(found.save(path))["histogram"].sum() == 100
    assert [p.name for p in tmp_path.iterdir()] == [path.name]
