"""What cannot be written is told before the work."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.cli.app import main


def ran(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        main(list(arguments))
    return end.value.code, capsys.readouterr()


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


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("folder.csv", "was not written by ninedof"),
        ("mine.csv", "was not written by ninedof"),
        ("none/s.csv", "expected a file in a folder that exists"),
    ],
)
def test_a_file_that_cannot_be_written_is_told_before_the_work(tmp_path, capsys, monkeypatch, place, words):
    (tmp_path / "folder.csv").mkdir()
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
