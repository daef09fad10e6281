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
