"""Finished chunks survive SIGKILL, Ctrl-C and a full disk; names and links lead nowhere else.

What every run that is kept in pieces promises is in optimize/test_pieces.py.
"""

import errno
import os
import signal
from pathlib import Path

import numpy as np
import pytest
import sweep_work as work
from sweep_work import GRID, HOME, G, finished

import ninedof as nd


def condition_numbers(folder=None, **options):
    return nd.sweep(G, HOME, GRID, out=folder, **({"chunk": 20} | options))["condition_number"]


@pytest.fixture(scope="module")
def expected():
    return condition_numbers()


@pytest.fixture
def child(forks, tmp_path):
    """Starts a sweep in another process; `errors` is the file of its standard error."""

    def start(folder, notes, before=list):
        process = forks.Process(target=work.main, args=(folder, notes, errors, before))
        process.start()
        return process

    errors = start.errors = tmp_path / "stderr"
    return start


# --- Killed at any moment ---------------------------------------------------------------------------------------------


def test_killed_in_the_middle_of_a_write(child, tmp_path, expected, monkeypatch):
    out, notes, later = (tmp_path / name for name in ("out", "notes", "later"))
    notes.mkdir()
    later.mkdir()
    process = child(out, notes, work.killed_in_a_write)
    process.join(60)
    assert process.exitcode == -signal.SIGKILL, child.errors.read_text()
    assert finished(out) == {0, 1}
    monkeypatch.setenv("NINEDOF_TEST_NOTES", str(later))
    assert nd.sweep(G, HOME, GRID, work.noted, out=out)["noted"].tobytes() == expected.tobytes()
    assert len(list(later.iterdir())) == 18


# --- Folders ---------------------------------------------------------------------------------------------------------


def test_a_link_in_the_place_of_values_is_not_written_through(tmp_path, expected):
    (tmp_path / "mine").write_text("kept")
    condition_numbers(tmp_path / "out")
    for name in ("condition_number.npy", "00000003.npz"):
        (tmp_path / "out" / "pieces" / name).unlink()
        (tmp_path / "out" / "pieces" / name).symlink_to(tmp_path / "mine")
    assert condition_numbers(tmp_path / "out").tobytes() == expected.tobytes()
    assert (tmp_path / "mine").read_text() == "kept"


def test_a_run_goes_on_in_the_chunks_of_its_folder_and_counts_from_there(tmp_path, expected):
    condition_numbers(tmp_path)
    for k in range(5, 20):
        (tmp_path / "pieces" / f"{k:08d}.npz").unlink()
    seen = []
    assert condition_numbers(tmp_path, chunk=64, progress=lambda *a: seen.append(a)).tobytes() == expected.tobytes()
    assert seen == [(done, 391, None) for done in [*range(100, 391, 20), 391]]
    assert finished(tmp_path) == set(range(20))


def test_an_index_without_a_name_cannot_be_kept(tmp_path):
    with pytest.raises(ValueError, match=r"index: got <function .*expected a function with a name of its own"):
        nd.sweep(G, HOME, GRID, lambda g, c, lc: nd.condition_number(g, c, lc), out=tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["../../evil", "a/b", "a\\b", "", ".hidden", "x" * 300, "a\0b", "a\nb", 5])
def test_the_name_of_an_index_does_not_lead_outside(tmp_path, name):
    index = type("Own", (), {"__call__": lambda self, *a: nd.condition_number(*a), "__qualname__": "Own"})()
    index.__name__ = name
    with pytest.raises(ValueError, match=r"^index: got a function of the name .*, expected a name"):
        nd.sweep(G, HOME, GRID, index, out=tmp_path / "deep" / "out")
    assert not list(tmp_path.iterdir())


# --- The disk ---------------------------------------------------------------------------------------------------------


def test_arrays_are_read_from_their_files(tmp_path, expected):
    result = nd.sweep(G, HOME, GRID, ["condition_number", "leg_lengths"], out=tmp_path, chunk=20)
    assert isinstance(result["condition_number"], np.memmap)
    assert not result["condition_number"].flags.writeable
    assert result["condition_number"].tobytes() == expected.tobytes()
    assert result["leg_lengths"].tobytes() == nd.sweep(G, HOME, GRID, "leg_lengths")["leg_lengths"].tobytes()
    assert np.load(tmp_path / "pieces" / "leg_lengths.npy").shape == (23, 17, 9)


def test_a_disk_without_room_for_the_arrays_leaves_those_of_a_finished_run(tmp_path, expected, monkeypatch):
    condition_numbers(tmp_path)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*.np*")}

    class Full:
        """An open file of a disk that is full."""

        __enter__, __exit__, seek = lambda self: self, lambda *_: None, lambda *_: None

        def write(self, _):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    plain = Path.open

    def opened(path, mode="r", *arguments, **options):
        return Full() if mode == "r+b" else plain(path, mode, *arguments, **options)

    monkeypatch.setattr(Path, "open", opened)
    with pytest.raises(OSError, match=r"No space left on device: .*condition_number\.npy") as caught:
        condition_numbers(tmp_path)
    assert caught.value.__notes__ == [f"Finished pieces are kept in {tmp_path}: the same call goes on from there."]
    assert {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file() and ".np" in p.name} == before
    monkeypatch.undo()
    assert condition_numbers(tmp_path).tobytes() == expected.tobytes()


def test_a_call_that_is_refused_leaves_the_arrays_of_a_finished_run(tmp_path, expected):
    condition_numbers(tmp_path)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*.np*")}
    with pytest.raises(ValueError, match="progress: got 5"):
        condition_numbers(tmp_path, progress=5)

    def stop(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        condition_numbers(tmp_path, progress=stop)
    assert {p: p.read_bytes() for p in tmp_path.rglob("*.np*")} == before
