"""What cannot be written is told before the work."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import ninedof as nd


@pytest.mark.slow(sanitized=True)
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
def test_a_file_that_cannot_be_written_is_told_before_the_work(run, tmp_path, place, words):
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "mine.csv").write_text("mine")
    before = sorted(tmp_path.iterdir())
    (tmp_path / "design.toml").write_text("")
    code, _, err = run(f"sheet {tmp_path / 'design.toml'} --csv {tmp_path / place}")
    assert code == 2
    assert err.startswith(f"ninedof: --csv: got {tmp_path / place}, ")
    assert words in err
    (tmp_path / "design.toml").unlink()
    assert sorted(tmp_path.iterdir()) == before
    assert (tmp_path / "mine.csv").read_text() == "mine"
