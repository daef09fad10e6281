"""Arrays too large for memory, in files of the folder of chunks."""

import errno

import numpy as np
import pytest
from sweep_work import GRID, HOME, G

import ninedof as nd
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
