"""A sweep whose result is a file is summed up and saved in pieces, with the same numbers."""

import tracemalloc
from importlib import import_module

import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.sweep_job import describe
from ninedof.support import arrays as pieces
from ninedof.support.arrays import blocks
from ninedof.sweep.result import SweepResult

SIDE, LEAST_SAVED = 1024, 2**21  # 8 MB; less than this is held at a time
KAPPA = "condition_number.npy"


@pytest.fixture
def mapped(tmp_path, monkeypatch):
    """A result that is a file, with infinite and missing values, its extremes twice, in several pieces."""
    monkeypatch.setattr(pieces, "BLOCK", 2**14)
    values = np.random.default_rng(7).normal(size=(SIDE, SIDE))
    values[3, 5] = values[900, 2] = 9.0
    values[700, 1] = values[12, 12] = -9.5
    values[1, 1:4], values[1000, 7] = np.inf, np.nan
    np.save(tmp_path / "values.npy", values)
    found = np.load(tmp_path / "values.npy", mmap_mode="r")
    axis = np.linspace(0.0, 1.0, SIDE)
    dims = {"condition_number": ("x_p", "y_p"), "singularity_margins": ("x_p", "y_p")}
    return SweepResult({"condition_number": found, "singularity_margins": found}, dims, {"x_p": axis, "y_p": axis})


def peak(work):
    """Return what the work allocates at most, and what it returns."""
    tracemalloc.start()
    try:
        return work(), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_extremes_are_those_of_the_whole_array(mapped):
    for name, size in (("condition_number", np.asarray), ("singularity_margins", np.abs)):
        found, held = peak(lambda name=name: describe(mapped, name))
        assert held < LEAST_SAVED
        values = np.array(mapped[name])
        known = np.where(np.isfinite(values), size(values), np.nan)
        assert (found["points"], found["infinite"], found["missing"]) == (SIDE**2, 3, 1)
        for word, pick in (("least", np.nanargmin), ("greatest", np.nanargmax)):
            place = np.unravel_index(int(pick(known)), values.shape)
            assert found[word] == {"value": values[place], "at": mapped.at(name, place)}


def test_nothing_finite_has_no_extremes():
    none = SweepResult({"a": np.full(3, np.nan)}, {"a": ("x",)}, {"x": np.arange(3.0)})
    assert describe(none, "a") == {"points": 3, "infinite": 0, "missing": 3}


def test_a_result_is_saved_in_pieces(mapped, tmp_path):
    np.lib.format.open_memmap(tmp_path / "large.npy", "w+", shape=(8 * SIDE, SIDE)).flush()
    large = SweepResult({"a": np.load(tmp_path / "large.npy", mmap_mode="r")}, {"a": ("x", "y")}, {"x": np.arange(9.0)})
    _, held = peak(lambda: large.save(tmp_path / "large.npz"))
    assert held < large["a"].nbytes / 1.5
    file = mapped.save(tmp_path / "sweep.npz")
    found = SweepResult.load(file)
    for name in mapped:
        assert found[name].tobytes() == mapped[name].tobytes()
    with np.load(file) as by_numpy:
        assert by_numpy["arrays.singularity_margins"].shape == (SIDE, SIDE)


def test_pieces_are_the_array_in_order(monkeypatch):
    monkeypatch.setattr(pieces, "BLOCK", 4)
    array = np.arange(30.0).reshape(5, 6)
    for one in (array, array.T, array[::2], np.empty((0, 3)), np.array(2.0)):
        assert np.concatenate([np.empty(0), *(piece for _, piece in blocks(one))]).tolist() == one.ravel().tolist()
        assert all(first % 4 == 0 for first, _ in blocks(one))


def test_a_report_does_not_read_the_arrays_again(run, tmp_path, monkeypatch):
    assert run(f"sweep --over x_p=-1:1:31 --over z_p=-1:1:21 --out {tmp_path} --no-figures")[0] == 0
    assert nd.load(tmp_path)["condition_number"].tobytes() == np.load(tmp_path / "pieces" / KAPPA).tobytes()
    monkeypatch.setattr(import_module("ninedof.report.whole"), "load", None)
    assert nd.report(tmp_path).is_file()
