"""Every kind of stored piece with one bit flipped, or cut short: the damage is told, or what is read is what was kept.

NINEDOF_LONG damages each kind 5500 times.
"""

import json
import os
import random
import zipfile

import numpy as np
import pytest
from sizes import size

import ninedof as nd
from ninedof.chunks.store import MARK, Store
from ninedof.runs.folder import load_record
from ninedof.support.npz import ALWAYS, MOST_ARRAYS, TIMES, read_npz

FLIPS, CUTS = size(120, 5000), size(20, 500)
QUESTION = {"kind": "test", "value": 0.1, "far": float("inf")}
ARRAYS = {"a": np.linspace(0.0, 1.0, 57), "b": np.arange(20)}
BOX = ((-0.5, -0.5, 3.5), (0.5, 0.5, 4.5))


def plain(value):
    """What a loaded thing says, as text that has every bit."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, dict):
        return {name: plain(v) for name, v in value.items()}
    return repr(value)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("damage") / "run"
    found = nd.optimize(nd.Study(constraints={"radius_ratio": (None, 1.5)}), starts=2)
    nd.save(found, folder)
    return folder, found


def record(place, run):
    return run[0] / "record.json", lambda file: (
        lambda r: (r.kind, r.asked.to_dict(), plain(dict(r.results)), r.versions, r.created, r.files, r.command)
    )(load_record(file))


def machine(place, run):
    from ninedof.runs.machine_file import certificate_file, save_certificate

    file = certificate_file(run[0])
    save_certificate(run[1].certify(time_limit=0.0), file)
    return file, lambda file: repr(nd.load_certificate(file))


def manifest(place, run):
    with Store(place / "chunks", QUESTION, 57):
        pass

    def read(file):
        with Store(file.parent, QUESTION, 57) as store:
            return store.chunk

    return place / "chunks" / "manifest.json", read


def chunk(place, run):
    with Store(place / "chunks", QUESTION, 57) as store:
        store.write(3, ARRAYS)

    def read(file):
        with Store(file.parent, QUESTION, 57) as store:
            found = store.read(3)
        if found is None:  # it is computed again
            raise ValueError("missing")
        return plain(found)

    return place / "chunks" / "chunk-00000003", read


def of_kind(found):
    def piece(place, run):
        made = found(run)
        return made.save(place / "result.npz"), lambda file: plain(type(made).load(file)._contents())

    return piece


def swept(run):
    best = run[1].best
    return nd.sweep(best.geometry, best.configuration, {"x_p": (-1.0, 1.0, 9)}, ["condition_number", "leg_lengths"])


def mapped(run):
    best = run[1].best
    return nd.workspace(
        best.geometry, box=BOX, home=best.configuration, criteria={"condition_number": 6.0}, resolution=4
    )


def certified(run):
    best = run[1].best
    criteria = {"condition_number": 6.0}
    return nd.certified_workspace(
        best.geometry, BOX, criteria=criteria, home=best.configuration, gap=0.5, time_limit=2.0
    )


def followed(run):
    best = run[1].best
    return nd.follow(best.geometry, nd.Trajectory.circle(best.configuration, 0.2, points=11), best.configuration)


PIECES = {
    "record": record,
    "machine": machine,
    "manifest": manifest,
    "chunk": chunk,
    "sweep": of_kind(swept),
    "atlas": of_kind(lambda _: nd.atlas(1000)),
    "map": of_kind(mapped),
    "certified": of_kind(certified),
    "motion": of_kind(followed),
}


def outcome(read, file):
    """What is read, or the words of the refusal."""
    try:
        return read(file), ""
    except ValueError as error:
        return None, str(error)


@pytest.mark.parametrize("name", PIECES)
def test_damage_is_told_or_changes_nothing(tmp_path, run, name):
    file, read = PIECES[name](tmp_path, run)
    data, chance = file.read_bytes(), random.Random(name)
    expected = read(file)
    told = 0
    for k in range(FLIPS + CUTS):
        damaged = bytearray(data)
        if k < FLIPS:
            damaged[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
        else:
            del damaged[chance.randrange(len(data)) :]
        file.write_bytes(damaged)
        found, words = outcome(read, file)
        told += bool(words)
        assert "\n" not in words
        assert words or found == expected, f"{name}: damage {k} was read"
    file.write_bytes(data)
    assert read(file) == expected
    assert told > 0.5 * (FLIPS + CUTS)


@pytest.mark.parametrize("old", ['"kind": "optimization"', '"seed": 0', '"created": "20'])
def test_a_value_changed_by_hand_is_told(tmp_path, run, old):
    file = tmp_path / "record.json"
    text = (run[0] / "record.json").read_text()
    assert old in text
    file.write_text(text.replace(old, old[:-1] + "1" + old[-1] if old.endswith("0") else old.replace("o", "O", 1)))
    with pytest.raises(ValueError, match=r"^.*record.json: (got a file that was changed or damaged|not a JSON)"):
        load_record(file)


@pytest.mark.parametrize(
    "change", [lambda t: t.replace('"digest"', '"digesu"'), lambda t: t.replace("record-3", "record-2")]
)
def test_a_record_cannot_pass_for_an_earlier_one_without_a_digest(tmp_path, run, change):
    file = tmp_path / "record.json"
    file.write_text(change((run[0] / "record.json").read_text()))
    with pytest.raises(ValueError, match="changed or damaged"):
        load_record(file)


@pytest.mark.parametrize("entry", [("versions",), ("results", "optimization", "candidates", 0, "variables")])
def test_a_key_of_a_record_forges_no_line(tmp_path, run, entry):
    data = json.loads((run[0] / "record.json").read_text())
    place = data
    for key in entry:
        place = place[key]
    place["\x1b]0;evil\x07\nninedof: all is well"] = []
    del data["digest"]
    (tmp_path / "record.json").write_text(json.dumps(data | {"format": "ninedof-record-2"}))
    with pytest.raises(ValueError, match="all is well") as error:
        nd.load(tmp_path)
    assert str(error.value).isprintable()


def test_a_record_of_an_earlier_release_has_no_digest_and_loads(tmp_path, run):
    data = json.loads((run[0] / "record.json").read_text())
    del data["digest"]
    (tmp_path / "record.json").write_text(json.dumps(data | {"format": "ninedof-record-2"}))
    assert nd.load(tmp_path).best.objective == run[1].best.objective


# --- Small files that would be large ----------------------------------------------------------------------------------


def npz(path, arrays):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in arrays.items():
            archive.writestr(name, data)
    return path


def header(shape, descr="<f8"):
    body = repr({"descr": descr, "fortran_order": False, "shape": shape}).encode().ljust(117) + b"\n"
    return b"\x93NUMPY\x01\x00" + len(body).to_bytes(2, "little") + body


def zeros(path, count):
    """Write deflated zeros, without their bytes in memory."""
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive,
        archive.open("a.npy", "w", force_zip64=True) as member,
    ):
        member.write(header((count // 8,)))
        for _ in range(count // 2**20):
            member.write(bytes(2**20))
    return path


@pytest.mark.parametrize("kind", [nd.SweepResult, nd.WorkspaceMap])
def test_a_small_file_that_expands_to_more_than_the_bound_is_refused_unread(tmp_path, kind, monkeypatch):
    """Two megabytes became four gigabytes. The bound is made small here, the file with it."""
    monkeypatch.setattr("ninedof.support.npz.ALWAYS", 2**24)
    path = zeros(tmp_path / "large.npz", 2**25)
    assert TIMES * path.stat().st_size < 2**24
    opened = []
    monkeypatch.setattr(zipfile.ZipFile, "open", lambda *a, **k: opened.append(a))
    with pytest.raises(ValueError, match="expected a whole one that `save` wrote"):
        kind.load(path)
    assert not opened


def test_the_bound_is_far_above_what_is_written(tmp_path, run):
    """The best compressed result here has a hundredth of it."""
    for made in (nd.atlas(1000), mapped(run)):
        size = made.save(tmp_path / "result.npz").stat().st_size
        arrays = sum(np.asarray(array).nbytes for array in made._contents().values())
        assert arrays < max(ALWAYS, TIMES * size) / 100


@pytest.mark.parametrize(
    "arrays",
    [
        {"a.npy": header((2**40,)) + bytes(8)},  # numpy would make the array before it reads
        {"a.npy": header((-1,)) + bytes(8)},
        {"a.npy": header((2**62, 4)) + bytes(8)},
        {"a.npy": header((2**40,), "|V0")},
        {"a.npy": header((2**40,), "<U0")},
        {"a.npy": header((1,), "|O") + b"cos\nsystem\n(S'false'\ntR."},
        {"a.txt": b"words"},
        {"a.npy": header((1,)) + bytes(9)},
        {"a.npy": header((2,)) + bytes(8)},
        {f"a{k}.npy": header(()) + bytes(8) for k in range(MOST_ARRAYS + 1)},
        {"../../evil.txt": b"words"},
    ],
)
def test_a_file_of_other_arrays_is_refused(tmp_path, arrays):
    with pytest.raises((ValueError, KeyError)):
        read_npz(npz(tmp_path / "a.npz", arrays))
    assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]


@pytest.mark.parametrize("byte", [b"(", b"'", b"\n  x\n y"])
def test_a_header_that_numpy_cannot_tokenize_is_damage(tmp_path, byte):
    """numpy raises tokenize.TokenError, which is no ValueError."""
    whole = header((1,))
    path = npz(tmp_path / "a.npz", {"a.npy": whole[: -1 - len(byte)] + byte + b"\n" + bytes(8)})
    with pytest.raises(ValueError, match="expected a whole one that `save` wrote"):
        nd.SweepResult.load(path)


def test_arrays_of_every_kind_are_read_as_they_were_written(tmp_path):
    arrays = {
        "scalar": np.array(3.5),
        "text": np.array(["a", "grüße"]),
        "empty": np.zeros((0, 3)),
        "columns": np.asfortranarray(np.arange(12.0).reshape(3, 4)),
        "bytes": np.frombuffer(b"abc", np.uint8),
        "flags": np.array([True, False]),
        "many": np.random.default_rng(0).random(400_000),
    }
    for save in (np.savez, np.savez_compressed):
        save(tmp_path / "a.npz", **arrays)
        found = read_npz(tmp_path / "a.npz")
        assert list(found) == list(arrays)
        for name, array in arrays.items():
            assert (found[name].dtype, found[name].shape) == (array.dtype, array.shape)
            np.testing.assert_array_equal(found[name], array)
            assert found[name].flags.writeable


@pytest.mark.parametrize("make", [os.mkfifo, lambda p: p.mkdir(), lambda p: p.symlink_to("/dev/zero")])
def test_what_is_no_file_is_not_waited_for(tmp_path, make):
    make(tmp_path / "a.npz")
    with pytest.raises(ValueError, match=r"a\.npz: cannot be read \(.+\)"):
        nd.SweepResult.load(tmp_path / "a.npz")


def endless(path):
    """A terabyte of zeros, behind the mark of a chunk."""
    with path.open("wb") as file:
        file.write(MARK)
        file.truncate(2**40)


HOSTILE = [os.mkfifo, lambda p: p.mkdir(), lambda p: p.symlink_to("/dev/zero"), endless]


@pytest.mark.parametrize("make", HOSTILE)
def test_what_is_no_chunk_is_computed_again(tmp_path, make):
    with Store(tmp_path / "chunks", QUESTION, 57) as store:
        make(store.path(3))
        assert store.read(3) is None
        if store.path(3).is_symlink() or store.path(3).is_dir():
            store.write(3, ARRAYS)
            assert plain(store.read(3)) == plain(ARRAYS)


@pytest.mark.parametrize("where", ["size", "arrays"])
def test_a_file_larger_than_the_memory_is_refused_unread(tmp_path, monkeypatch, where):
    path = zeros(tmp_path / "large.npz", 2**22)
    size = path.stat().st_size
    monkeypatch.setattr("ninedof.support.npz.memory", lambda: size - 1 if where == "size" else 2**22)
    opened = []
    monkeypatch.setattr(zipfile.ZipFile, "open", lambda *a, **k: opened.append(a))
    with pytest.raises(ValueError, match="expected a whole one that `save` wrote"):
        nd.SweepResult.load(path)
    assert not opened


def test_a_terabyte_in_the_place_of_arrays_is_refused(tmp_path):
    endless(tmp_path / "sweep.npz")
    with pytest.raises(ValueError, match=r"sweep\.npz: got no 'ninedof-sweep"):
        nd.SweepResult.load(tmp_path / "sweep.npz")
