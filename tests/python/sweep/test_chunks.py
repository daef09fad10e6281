"""Finished chunks survive kills, damaged files, other questions and other runs."""

import errno
import os
import shutil
import signal
import time
from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest
import sweep_work as work
from sweep_work import GRID, HOME, G, finished

import ninedof as nd


def asked(folder=None, **options):
    return nd.sweep(G, HOME, GRID, out=folder, **({"chunk": 20} | options))["condition_number"]


@pytest.fixture(scope="module")
def expected():
    return asked()


@pytest.fixture
def child(forks, tmp_path):
    """Starts a sweep in another process; `errors` is the file of its standard error."""

    def start(folder, notes, before=list):
        process = forks.Process(target=work.main, args=(folder, notes, errors, before))
        process.start()
        return process

    errors = start.errors = tmp_path / "stderr"
    return start


def until_a_chunk_is_kept(folder):
    deadline = time.monotonic() + 60.0
    while not finished(folder) and time.monotonic() < deadline:
        time.sleep(0.002)


# --- Killed at any moment ---------------------------------------------------------------------------------------------


def firsts():
    """Position of the platform at the first point of each chunk."""
    x = np.repeat(nd.sweep(G, HOME, GRID)["x_p"], 17)[::20]
    return [[float(v), 0.0, 3.9828] for v in x]


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


@pytest.mark.parametrize("after", [100, 0])
def test_an_interruption_leaves_what_was_finished(tmp_path, expected, after):
    def stop(done, *_):
        if done >= after:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        asked(tmp_path, progress=stop)
    assert finished(tmp_path) == set(range(after // 20))
    assert not list(tmp_path.rglob("*.npy"))
    seen = []
    assert asked(tmp_path, progress=lambda *a: seen.append(a)).tobytes() == expected.tobytes()
    assert seen == [(done, 391, None) for done in [*range(after, 391, 20), 391]]


def test_control_c_ends_a_run_at_the_next_chunk(child, tmp_path):
    notes = tmp_path / "notes"
    notes.mkdir()
    process = child(tmp_path / "out", notes)
    try:
        until_a_chunk_is_kept(tmp_path / "out")
        os.kill(process.pid, signal.SIGINT)
        process.join(30)
        assert process.exitcode == 1
    finally:
        process.kill()
    assert "KeyboardInterrupt" in child.errors.read_text()
    assert 1 <= len(finished(tmp_path / "out")) < 20
    assert not list((tmp_path / "out").glob(".part-*"))


# --- Damage -----------------------------------------------------------------------------------------------------------


def one_bit(path):
    data = bytearray(path.read_bytes())
    data[200] ^= 4
    path.write_bytes(data)


def of_its_neighbour(path):
    shutil.copy(path.with_name("00000008.npz"), path)


def shorter(path):
    path.write_bytes(path.read_bytes()[:-7])


def other_numbers(path):
    np.savez(path, noted=np.zeros(20, np.float32))


@pytest.mark.parametrize("damage", [one_bit, of_its_neighbour, shorter, other_numbers, os.unlink])
def test_a_damaged_chunk_is_computed_again_and_no_other(tmp_path, damage, expected, monkeypatch):
    out, notes = tmp_path / "out", tmp_path / "notes"
    notes.mkdir()
    monkeypatch.setenv("NINEDOF_TEST_NOTES", str(notes))
    nd.sweep(G, HOME, GRID, work.noted, out=out, chunk=20)
    for path in notes.iterdir():
        path.unlink()
    damage(out / "pieces" / "00000007.npz")
    assert nd.sweep(G, HOME, GRID, work.noted, out=out)["noted"].tobytes() == expected.tobytes()
    assert [p.read_text() for p in notes.iterdir()] == [repr(firsts()[7])]


def test_a_link_in_the_place_of_values_is_not_written_through(tmp_path, expected):
    (tmp_path / "mine").write_text("kept")
    asked(tmp_path / "out")
    for name in ("condition_number.npy", "00000003.npz"):
        (tmp_path / "out" / "pieces" / name).unlink()
        (tmp_path / "out" / "pieces" / name).symlink_to(tmp_path / "mine")
    assert asked(tmp_path / "out").tobytes() == expected.tobytes()
    assert (tmp_path / "mine").read_text() == "kept"


# --- Other questions --------------------------------------------------------------------------------------------------

OTHERS = {
    r"over\[0\].high is 1.0 there and 1.000000000000001 here": {"over": {**GRID, "x_p": (-1.0, 1.0 + 1e-15, 23)}},
    r"over\[0\].name is .* there": {"over": dict(reversed(GRID.items()))},
    r"index\[0\] is 'condition_number' there and 'manipulability' here": {"index": "manipulability"},
    "home.internal_point.* is .*2.4435.* there and .*2.4436.* here": {"home": nd.Configuration.neutral(3.9828, 2.4436)},
    "geometry.": {"geometry": nd.Geometry.hexagonal(0.0, 5.8125, 2.9062, 0.0)},
    "relative is True there and False here": {"relative": False},
    "internal_point is 'held' there and 'carried' here": {"internal_point": "carried"},
    "characteristic_length is 1.0 there and 'optimal' here": {"characteristic_length": "optimal"},
}


@pytest.mark.parametrize("words", OTHERS)
def test_a_folder_refuses_another_question(tmp_path, words, expected):
    asked(tmp_path)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*.*")}
    with pytest.raises(ValueError, match=rf"out: got .*another question: {words}.*; expected a new folder"):
        nd.sweep(**({"geometry": G, "home": HOME, "over": GRID} | OTHERS[words]), out=tmp_path)
    assert {p: p.read_bytes() for p in tmp_path.rglob("*.*")} == before
    assert asked(tmp_path).tobytes() == expected.tobytes()


def test_the_chunk_size_of_a_folder_is_kept(tmp_path, expected):
    asked(tmp_path)
    assert asked(tmp_path, chunk=64).tobytes() == expected.tobytes()
    assert len(finished(tmp_path)) == 20


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

HUGE = 10**11  # points, 800 GB, twice


def test_arrays_are_read_from_their_files(tmp_path, expected):
    found = nd.sweep(G, HOME, GRID, ["condition_number", "leg_lengths"], out=tmp_path, chunk=20)
    assert isinstance(found["condition_number"], np.memmap)
    assert not found["condition_number"].flags.writeable
    assert found["condition_number"].tobytes() == expected.tobytes()
    assert found["leg_lengths"].tobytes() == nd.sweep(G, HOME, GRID, "leg_lengths")["leg_lengths"].tobytes()
    assert np.load(tmp_path / "pieces" / "leg_lengths.npy").shape == (23, 17, 9)


def test_arrays_for_which_the_disk_has_no_room_are_refused_before_the_work(run, tmp_path, monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(total=10**12, free=31 * 10**9))
    room = "their values take 1600 GB, and 31 GB are free on the disk of out"
    with pytest.raises(ValueError, match=f"^over: got {HUGE} points, expected fewer: {room}$"):
        nd.sweep(G, HOME, {"x_p": (-1.0, 1.0, HUGE)}, out=tmp_path / "out")
    assert not (tmp_path / "out").exists()
    status, _, said = run(f"sweep --over x_p=-1:1:{HUGE} --out {tmp_path / 'run'}")
    assert status == 2
    assert said.startswith(f"ninedof: --over: got {HUGE} points, expected fewer: ")
    assert said.count("\n") == 1
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("usage", [OSError(), SimpleNamespace(total=0, free=0)])
def test_a_disk_that_does_not_say_what_is_free_is_tried(tmp_path, expected, monkeypatch, usage):
    def disk(_):
        if isinstance(usage, OSError):
            raise usage
        return usage

    monkeypatch.setattr(shutil, "disk_usage", disk)
    assert asked(tmp_path).tobytes() == expected.tobytes()


def test_a_disk_without_room_for_the_arrays_ends_the_run_before_the_work(tmp_path, expected, monkeypatch):
    asked(tmp_path)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*.np*")}

    def full(_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(import_module("ninedof.sweep.grid"), "blocks", full)
    with pytest.raises(OSError, match="No space left on device") as caught:
        asked(tmp_path)
    assert caught.value.filename == str(tmp_path / "pieces" / "condition_number.npy")
    assert caught.value.__notes__ == [f"Finished pieces are kept in {tmp_path}: the same call goes on from there."]
    assert {p: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file() and ".np" in p.name} == before
    monkeypatch.undo()
    assert asked(tmp_path).tobytes() == expected.tobytes()


def test_the_room_of_the_arrays_is_taken_before_the_work(tmp_path):
    taken = []

    def progress(*_):
        taken.extend(path.stat().st_blocks * 512 for path in (tmp_path / "pieces").glob(".part-condition*"))
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        nd.sweep(G, HOME, {"x_p": (-1.0, 1.0, 100_000)}, out=tmp_path, progress=progress)
    assert len(taken) == 1
    assert taken[0] >= 800_000


def test_a_call_that_is_refused_leaves_the_arrays_of_a_finished_run(tmp_path, expected):
    asked(tmp_path)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*.np*")}
    with pytest.raises(ValueError, match="progress: got 5"):
        asked(tmp_path, progress=5)

    def stop(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        asked(tmp_path, progress=stop)
    assert {p: p.read_bytes() for p in tmp_path.rglob("*.np*")} == before
