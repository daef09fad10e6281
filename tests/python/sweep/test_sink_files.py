"""Arrays too large for memory, in files of the folder of chunks."""

import errno
import shutil
from types import SimpleNamespace

import numpy as np
import pytest
from sweep_work import GRID, HOME, G

import ninedof as nd
from ninedof.cli.app import main
from ninedof.sweep import sink


@pytest.fixture(autouse=True)
def _small_memory(monkeypatch):
    monkeypatch.setattr(sink, "IN_MEMORY", 0)


def test_a_link_in_the_place_of_a_part_is_not_written_through(tmp_path):
    (tmp_path / "mine").write_text("kept")
    out = tmp_path / "out"
    nd.sweep(G, HOME, GRID, out=out, chunk=100)
    (out / ".part-condition_number.npy").symlink_to(tmp_path / "mine")
    found = nd.sweep(G, HOME, GRID, out=out)["condition_number"]
    assert (tmp_path / "mine").read_text() == "kept"
    assert np.load(out / "condition_number.npy").tobytes() == found.tobytes()


HUGE = {"x_p": (-1.0, 1.0, 10**11)}  # 800 GB


def test_arrays_for_which_the_disk_has_no_room_are_refused_before_the_work(tmp_path, monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(total=10**12, free=31 * 10**9))
    room = "their values take 800 GB, and 31 GB are free on the disk of out"
    with pytest.raises(ValueError, match=f"^over: got {10**11} points, expected fewer: {room}$"):
        nd.sweep(G, HOME, HUGE, out=tmp_path / "out")
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["manifest.json"]


def test_a_command_that_asks_for_too_much_room_leaves_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(total=10**12, free=0))
    with pytest.raises(SystemExit) as end:
        main(["sweep", "--over", f"x_p=-1:1:{10**11}", "--out", str(tmp_path / "out")])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert said.startswith(f"ninedof: --over: got {10**11} points, expected fewer: ")
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())


def unknown(_):
    raise OSError(errno.ENOSYS, "Function not implemented")


@pytest.mark.parametrize("usage", [unknown, lambda _: SimpleNamespace(total=0, free=0)])
def test_a_disk_that_does_not_say_what_is_free_is_tried(tmp_path, monkeypatch, usage):
    monkeypatch.setattr(shutil, "disk_usage", usage)
    found = nd.sweep(G, HOME, GRID, out=tmp_path)["condition_number"]
    assert np.load(tmp_path / "condition_number.npy").tobytes() == found.tobytes()


def test_a_full_disk_names_the_file(tmp_path, monkeypatch):
    real = sink._File.__init__

    class Full:
        def __init__(self, file):
            self._file = file

        def __getattr__(self, name):
            return getattr(self._file, name)

        def write(self, _):
            raise OSError(errno.ENOSPC, "No space left on device")

    def begin(self, path, shape):
        real(self, path, shape)
        self._file = Full(self._file)

    monkeypatch.setattr(sink._File, "__init__", begin)
    with pytest.raises(OSError, match="No space left on device") as caught:
        nd.sweep(G, HOME, GRID, out=tmp_path, chunk=100)
    assert caught.value.filename == str(tmp_path / "condition_number.npy")
    assert not list(tmp_path.glob(".part-*"))  # it would fill the disk for nothing
    monkeypatch.setattr(sink._File, "__init__", real)
    found = nd.sweep(G, HOME, GRID, out=tmp_path)["condition_number"]
    assert found.tobytes() == nd.sweep(G, HOME, GRID)["condition_number"].tobytes()
