"""The comparison of bench/python/comparison.py: every method gives the same numbers, and a wrong one is noticed."""

import importlib
import subprocess
import sys
from concurrent.futures import Future
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import numpy as np
import pytest
from sizes import size

BENCH = Path(__file__).resolve().parents[3] / "bench" / "python"


@pytest.fixture(scope="module")
def compare():
    sys.path.insert(0, str(BENCH))
    yield pytest.importorskip("compare")
    sys.path.remove(str(BENCH))


@pytest.fixture(scope="module")
def poses(compare, tmp_path_factory):
    from compare import data

    path = tmp_path_factory.mktemp("poses") / "poses.bin"
    data.write(path, 40)
    return data.read(path)


@pytest.mark.parametrize("module", ["with_ninedof", "with_numpy", "with_scipy"])
def test_a_method_agrees_with_extended_precision(poses, module):
    from compare import exact

    assert exact.worst_error(*poses, importlib.import_module(f"compare.{module}").prepare(*poses)()) < 1e-11


def test_a_wrong_number_ends_the_program(compare):
    from compare.runner import require_agreement

    ours = np.array([4.0, 5.0])
    assert require_agreement("same", ours.copy(), ours, 1) == 0.0
    for wrong in ([4.0, 5.0 + 1e-8], [4.0, np.nan], [4.0]):
        with pytest.raises(SystemExit, match="wrong one"):
            require_agreement("wrong one", np.array(wrong), ours, 1)


class Here:
    """In place of a pool of one process: work is done here, at once."""

    def __init__(self, *_, **__):
        pass

    def submit(self, function, *arguments):
        future = Future()
        future.set_result(function(*arguments))
        return future

    def shutdown(self):
        pass


def printed_by_every_level(folder):
    command = [sys.executable, str(BENCH / "comparison.py"), "--poses", "200", "--rounds", "1"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, cwd=folder)
    assert done.returncode == 0, done.stderr
    return done.stdout


def printed_by_one_level(folder):
    """Every method has a process of its own, one for each level of instructions: one level, in this one, will do."""
    comparison = importlib.import_module("comparison")
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(StringIO()) as out:
        patch.chdir(folder)
        patch.setattr(comparison.runner, "ProcessPoolExecutor", Here)
        patch.delattr("os.sched_setaffinity", raising=False)  # it would hold for all tests that follow
        patch.setattr(comparison, "available_levels", lambda: ["base"])
        assert comparison.main(["--poses", "40", "--rounds", "1"]) == 0
    return out.getvalue()


@pytest.mark.slow
def test_the_script_runs_without_its_cpp_programs(compare, tmp_path):
    printed = size(printed_by_one_level, printed_by_every_level)(tmp_path)
    rows = {cells[1].strip(): cells for cells in (line.split("|") for line in printed.splitlines()) if len(cells) > 7}
    assert float(rows["numpy"][7]) < 1e-9
    assert rows["plain Eigen, base"][3].strip() == "not built"
    assert list(tmp_path.iterdir()) == []
