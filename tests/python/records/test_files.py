"""Every file that is kept appears whole or not at all, and with one bit flipped, or cut short, it is refused.

NINEDOF_LONG damages each kind 5500 times.
"""

import os
import random
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from sizes import size

import ninedof as nd
from ninedof.records.proofs import save_certificate
from ninedof.records.record import load_record
from ninedof.support.kept.files import Saved, form_of, json_bytes, read_json, read_npz, write_npz, write_whole
from ninedof.support.kept.store import Store

FLIPS, CUTS = size(40, 5000), size(10, 500)
ARRAYS = {
    "scalar": np.array(3.5),
    "text": np.array(["a", "grüße"]),
    "empty": np.zeros((0, 3)),
    "columns": np.asfortranarray(np.arange(12.0).reshape(3, 4)),
    "bytes": np.frombuffer(b"abc", np.uint8),
    "flags": np.array([True, False]),
    "many": np.random.default_rng(0).random(1000),
}


@pytest.fixture(scope="module")
def best():
    return nd.optimize(nd.Study(constraints={"radius_ratio": (None, 1.5)}), starts=2)


def record(folder, best):
    return nd.save(best, folder / "run"), load_record


def certificate(folder, best):
    return save_certificate(best.certify(time_limit=0.0), folder / "certify.json"), nd.load_certificate


def question(folder, best):
    Store(folder / "run", {"kind": "test", "far": float("inf")}).close()
    return folder / "run" / "question.json", lambda file: read_json(file, "question")


def sweep(folder, best):
    return nd.sweep(best.geometry, best.configuration, {"x_p": (-1.0, 1.0, 9)}).save(
        folder / "a.npz"
    ), nd.SweepResult.load


def piece(folder, best):
    store = Store(folder / "run", {"kind": "test"})
    store.keep(3, {"a": np.linspace(0.0, 1.0, 57)})
    store.close()

    def read(_):
        if (found := store.read(3)) is None:
            raise ValueError("missing")  # it is computed again
        return found

    return store.path(3), read


KINDS = [record, certificate, question, sweep, piece]


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_damage_is_told(tmp_path, best, kind):
    file, read = kind(tmp_path, best)
    data, chance = file.read_bytes(), random.Random(kind.__name__)
    read(file)
    for k in range(FLIPS + CUTS):
        damaged = bytearray(data)
        if k < FLIPS:
            damaged[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
        else:
            del damaged[chance.randrange(len(data)) :]
        file.write_bytes(damaged)
        with pytest.raises(ValueError, match=r"\Amissing|got no file as ninedof wrote it|cannot be read"):
            read(file)


OTHERS = [b"", b"[1]", b"{}", b'{"format": "other"}', b"not json", b"\0", b"PK\x03\x04", b"\x93NUMPY"]


@pytest.mark.parametrize("contents", OTHERS, ids=repr)
def test_other_files_are_refused_by_name(tmp_path, contents):
    for name, read in (("record.json", load_record), ("a.npz", nd.SweepResult.load)):
        (tmp_path / name).write_bytes(contents)
        with pytest.raises(ValueError, match=name):
            read(tmp_path / name)
    for read in (load_record, nd.SweepResult.load):
        with pytest.raises(ValueError, match="nowhere: cannot be read"):
            read(tmp_path / "nowhere")


def test_a_file_of_another_format_is_refused(tmp_path, best):
    np.savez(tmp_path / "numbers.npz", a=np.zeros(3))
    with pytest.raises(ValueError, match=r"numbers\.npz: got no"):
        nd.SweepResult.load(tmp_path / "numbers.npz")
    (tmp_path / "a.json").write_bytes(json_bytes("other", {}))
    with pytest.raises(ValueError, match=f"got another format than '{form_of('record')}'"):
        load_record(tmp_path / "a.json")
    with pytest.raises(ValueError, match=r"a\.npz: got no 'ninedof-workspace"):
        nd.WorkspaceMap.load(sweep(tmp_path, best)[0])


def test_no_code_is_read_from_a_file(tmp_path):
    np.savez(tmp_path / "a.npz", a=np.array([lambda: 0, 1], dtype=object)[1:])
    with pytest.raises(ValueError, match="got no file as ninedof wrote it"):
        read_npz(tmp_path / "a.npz")
    with pytest.raises(ValueError, match="Object arrays cannot be saved"):
        write_npz(tmp_path / "b.npz", {"a": np.array([1], dtype=object)})
    assert not (tmp_path / "b.npz").exists()


@pytest.mark.parametrize("compressed", [False, True])
def test_arrays_are_read_as_they_were_written_and_by_numpy_too(tmp_path, compressed):
    file = write_npz(tmp_path / "a.npz", ARRAYS, compressed=compressed)
    with np.load(file) as by_numpy:
        for found in (read_npz(file), by_numpy):
            assert list(found) == list(ARRAYS)
            for name, array in ARRAYS.items():
                assert (found[name].dtype, found[name].shape) == (array.dtype, array.shape)
                np.testing.assert_array_equal(found[name], array)


@pytest.mark.parametrize("moment", ["write", "replace"])
def test_a_failed_write_leaves_the_old_file(tmp_path, monkeypatch, moment):
    def full(*_):
        raise OSError(28, "No space left on device")

    file = tmp_path / ("ü" * 125 + ".json")  # a name of the full length: that of its part is not longer
    write_whole(file, b"old")
    monkeypatch.setattr(os, "fsync" if moment == "write" else "replace", full)
    with pytest.raises(OSError, match="No space left on device") as caught:
        write_whole(file, b"new")
    assert caught.value.filename == str(file)
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [(file.name, b"old")]


@dataclass
class Kept(Saved):
    KIND = "test"

    value: Any


@pytest.mark.parametrize(
    "value",
    [{"npy": "value"}, {"npy": "words"}, {"npy": ["x_p"]}, {"npy": np.arange(3.0)}, {"npy": {"npy": np.zeros((0, 3))}}],
    ids=str,
)
def test_no_mapping_is_taken_for_the_mark_of_an_array(tmp_path, value):
    read = Kept.load(Kept(value).save(tmp_path / "a.npz")).value
    assert repr(read) == repr(value)


def test_an_index_may_have_the_name_of_that_mark(tmp_path, best):
    def npy(geometry, configuration, _):
        return nd.condition_number(geometry, configuration)

    swept = nd.sweep(best.geometry, best.configuration, {"x_p": (-0.1, 0.1, 3)}, npy)
    read = nd.SweepResult.load(swept.save(tmp_path / "a.npz"))
    assert read.dims == swept.dims
    assert np.array_equal(read["npy"], swept["npy"])
