"""Finished chunks survive kills, damaged files, other questions and other runs."""

import hashlib
import json
import os
import random
import shutil
import signal
import time

import numpy as np
import pytest
import sweep_work as work
from sweep_work import GRID, HOME, G

import ninedof as nd
from ninedof.chunks.store import FORMAT, Store
from ninedof.support.seal import digest_of, sealed
from ninedof.sweep import sink

QUESTION = {"kind": "test", "value": 0.1}


def asked(folder=None, **options):
    return nd.sweep(G, HOME, GRID, out=folder, chunk=20, **options)["condition_number"]


@pytest.fixture(scope="module")
def expected():
    return asked()


def chunks(folder):
    return sorted(folder.glob("chunk-*"))


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


@pytest.mark.slow
def test_a_sweep_killed_many_times_is_resumed(child, tmp_path, expected, monkeypatch):
    """SIGKILL at random moments. Finished chunks are not computed again, and the result has the same bits."""
    folder, notes = tmp_path / "out", tmp_path / "notes"
    moments = random.Random(5)
    kills = computed_before_the_end = 0
    first_of = {repr(start): k for k, start in enumerate(firsts())}
    for round_ in range(400):  # five or so where the machine is idle
        mine = notes / str(round_)
        mine.mkdir(parents=True)
        finished = {int(p.name[-8:]) for p in chunks(folder)}
        process = child(folder, mine)
        deadline = time.monotonic() + 60.0
        while not any(mine.iterdir()) and process.is_alive() and time.monotonic() < deadline:
            time.sleep(0.002)
        process.join(moments.uniform(0.04, 0.05))  # of the 20 chunks six at most
        if process.is_alive():
            process.kill()
            kills += 1
        process.join()
        status = process.exitcode
        assert status in (0, -signal.SIGKILL), child.errors.read_text()
        called = [first_of[p.read_text()] for p in mine.iterdir() if p.read_text()]
        assert len(set(called)) == len(called)
        assert not finished & set(called), "a finished chunk was computed again"
        computed_before_the_end += len(called)
        if status == 0:
            break
    assert status == 0
    assert kills >= 3
    lost = computed_before_the_end - 20  # a chunk that was computed but not kept when the kill came
    assert 0 <= lost <= kills
    last = notes / "last"
    last.mkdir()
    monkeypatch.setenv("NINEDOF_TEST_NOTES", str(last))
    found = nd.sweep(G, HOME, GRID, work.noted, out=folder, chunk=20)["noted"]
    assert found.tobytes() == expected.tobytes()
    assert not list(last.iterdir()), "a complete sweep computes nothing"
    assert {p.name for p in folder.iterdir()} == {"manifest.json", *(f"chunk-{k:08d}" for k in range(20))}


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
    assert [p.name for p in chunks(out)] == ["chunk-00000000", "chunk-00000001"]
    assert len(list(out.glob(".part-chunk-00000002-*"))) == 1
    monkeypatch.setenv("NINEDOF_TEST_NOTES", str(later))
    assert nd.sweep(G, HOME, GRID, work.noted, out=out)["noted"].tobytes() == expected.tobytes()
    assert len(list(later.iterdir())) == 18
    assert not list(out.glob(".part-*"))


def test_a_kill_between_write_and_rename_leaves_no_chunk(tmp_path, expected, monkeypatch):
    def killed(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr("os.replace", killed)
        with pytest.raises(KeyboardInterrupt):
            Store(tmp_path, QUESTION, 20)
    assert not list(tmp_path.iterdir())
    Store(tmp_path, QUESTION, 20).close()


def test_leftovers_of_a_kill_are_removed(tmp_path, expected):
    asked(tmp_path)
    (tmp_path / ".part-chunk-00000003-0123abcd").write_bytes(b"half")
    chunks(tmp_path)[3].unlink()
    assert asked(tmp_path).tobytes() == expected.tobytes()
    assert not list(tmp_path.glob(".part-*"))


# --- Damage -----------------------------------------------------------------------------------------------------------


def cut(path):
    path.write_bytes(path.read_bytes()[:-7])


def emptied(path):
    path.write_bytes(b"")


def one_bit(path):
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 4
    path.write_bytes(data)


def first_byte(path):
    path.write_bytes(b"?" + path.read_bytes()[1:])


def appended(path):
    path.write_bytes(path.read_bytes() + b"\0")


def of_its_neighbour(path):
    shutil.copy(path.with_name("chunk-00000004"), path)


@pytest.mark.parametrize("damage", [cut, emptied, one_bit, first_byte, appended, of_its_neighbour])
def test_a_damaged_chunk_is_computed_again_and_no_other(tmp_path, damage, expected, monkeypatch):
    out, notes = tmp_path / "out", tmp_path / "notes"
    notes.mkdir()
    monkeypatch.setenv("NINEDOF_TEST_NOTES", str(notes))
    nd.sweep(G, HOME, GRID, work.noted, out=out, chunk=20)
    for path in notes.iterdir():
        path.unlink()
    damage(out / "chunk-00000007")
    found = nd.sweep(G, HOME, GRID, work.noted, out=out)["noted"]
    assert found.tobytes() == expected.tobytes()
    assert [p.read_text() for p in notes.iterdir()] == [repr(firsts()[7])]


def test_a_chunk_with_the_right_digest_and_wrong_contents_is_not_read(tmp_path):
    with Store(tmp_path, QUESTION, 20) as store:
        payload = b"not an archive"
        asked = digest_of({"format": FORMAT, "chunk": 20, "question": {**QUESTION, "ninedof": nd.__version__}})
        digest = hashlib.sha256(f"{asked} 0 ".encode() + payload).digest()
        store.path(0).write_bytes(b"ninedof chunk 2\n" + digest + payload)
        assert store.read(0) is None
        store.write(0, {"a": np.arange(3.0)})
        assert store.read(0)["a"].tolist() == [0.0, 1.0, 2.0]
        assert store.read(1) is None


# --- Other questions --------------------------------------------------------------------------------------------------

OTHERS = {
    "over": lambda out: nd.sweep(G, HOME, {**GRID, "x_p": (-1.0, 1.0 + 1e-15, 23)}, out=out),
    "order": lambda out: nd.sweep(G, HOME, dict(reversed(GRID.items())), out=out),
    "index": lambda out: nd.sweep(G, HOME, GRID, "manipulability", out=out),
    "home": lambda out: nd.sweep(G, nd.Configuration.neutral(3.9828, 2.4436), GRID, out=out),
    "geometry": lambda out: nd.sweep(nd.Geometry.hexagonal(0.0, 5.8125, 2.9062, 0.0), HOME, GRID, out=out),
    "relative": lambda out: nd.sweep(G, HOME, GRID, out=out, relative=False),
    "internal_point": lambda out: nd.sweep(G, HOME, GRID, out=out, internal_point="carried"),
    "characteristic_length": lambda out: nd.sweep(G, HOME, GRID, out=out, characteristic_length="optimal"),
    "kind": lambda out: nd.sweep_designs({"a1": 0, "a2": 5, "b1": 3, "b2": 0, "zp": 4}, {"zs": [1.0]}, out=out),
}


@pytest.mark.parametrize("entry", OTHERS)
def test_a_folder_refuses_another_question(tmp_path, entry, expected):
    asked(tmp_path)
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}
    with pytest.raises(
        ValueError, match=r"out: got .*another question \(it differs in .*\), expected an empty folder"
    ) as e:
        OTHERS[entry](tmp_path)
    assert entry in str(e.value) or entry == "order"
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before
    assert asked(tmp_path).tobytes() == expected.tobytes()


def test_another_version_is_another_question(tmp_path, monkeypatch):
    asked(tmp_path)
    monkeypatch.setattr("ninedof._core.version", "99.0")
    with pytest.raises(ValueError, match="differs in ninedof"):
        asked(tmp_path)


def test_the_chunk_size_of_a_folder_is_kept(tmp_path, expected):
    asked(tmp_path)
    assert nd.sweep(G, HOME, GRID, out=tmp_path, chunk=64)["condition_number"].tobytes() == expected.tobytes()
    assert len(chunks(tmp_path)) == 20


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("notes.txt", "mine", "holds 'notes.txt' but no manifest.json"),
        ("manifest.json", "{}", "expected one written by ninedof"),
        ("manifest.json", "{", "expected one written by ninedof"),
        (
            "manifest.json",
            json.dumps({"format": "ninedof-chunks-2", "question": {}, "chunk": 0}),
            "expected it as it was",
        ),
    ],
)
def test_a_folder_of_other_files_is_refused_and_not_changed(tmp_path, name, text, words):
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match=words):
        asked(tmp_path)
    assert (tmp_path / name).read_text() == text
    assert not chunks(tmp_path)


def test_a_file_in_place_of_the_folder_is_refused(tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(ValueError, match=r"out: got .*file, which cannot be created"):
        asked(tmp_path / "file")


def test_an_index_without_a_name_cannot_be_kept(tmp_path):
    with pytest.raises(ValueError, match=r"index: got <function .*expected a function with a name of its own"):
        nd.sweep(G, HOME, GRID, lambda g, c, lc: nd.condition_number(g, c, lc), out=tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_two_runs_do_not_share_a_folder(child, tmp_path):
    notes = tmp_path / "notes"
    notes.mkdir()
    process = child(tmp_path / "out", notes)
    try:
        deadline = time.monotonic() + 60.0
        while not chunks(tmp_path / "out") and time.monotonic() < deadline:
            time.sleep(0.002)
        os.kill(process.pid, signal.SIGSTOP)  # it must not finish during the test
        with pytest.raises(ValueError, match="which another run is using"):
            asked(tmp_path / "out")
    finally:
        process.kill()
        process.join()
    with pytest.raises(ValueError, match="another question"):  # a killed run holds no lock
        asked(tmp_path / "out")


def test_two_stores_of_one_process_do_not_share_a_folder(tmp_path):
    with Store(tmp_path / "out", QUESTION, 20):
        (tmp_path / "link").symlink_to(tmp_path / "out")
        for name in ("out", "link"):
            with pytest.raises(ValueError, match="which another run is using"):
                Store(tmp_path / name, QUESTION, 20)
        with Store(tmp_path / "other", QUESTION, 20):
            pass
    for _ in range(2):
        again = Store(tmp_path / "out", QUESTION, 20)
        again.close()
        again.close()


# --- Interrupted ------------------------------------------------------------------------------------------------------


def test_an_interruption_leaves_what_was_finished(tmp_path, expected):
    def stop(done, *_):
        if done >= 100:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        asked(tmp_path, progress=stop)
    assert len(chunks(tmp_path)) == 5
    seen = []
    assert asked(tmp_path, progress=lambda *a: seen.append(a)).tobytes() == expected.tobytes()
    assert seen == [(done, 391, None) for done in [*range(100, 391, 20), 391]]


def test_control_c_ends_a_run_at_the_next_chunk(child, tmp_path):
    notes = tmp_path / "notes"
    notes.mkdir()
    process = child(tmp_path / "out", notes)
    try:
        deadline = time.monotonic() + 60.0
        while not chunks(tmp_path / "out") and time.monotonic() < deadline:
            time.sleep(0.002)
        os.kill(process.pid, signal.SIGINT)
        process.join(30)
        assert process.exitcode == 1
    finally:
        process.kill()
    assert "KeyboardInterrupt" in child.errors.read_text()
    assert 1 <= len(chunks(tmp_path / "out")) < 20
    assert not list((tmp_path / "out").glob(".part-*"))


# --- Large arrays -----------------------------------------------------------------------------------------------------


def test_large_arrays_go_to_files(tmp_path, expected, monkeypatch):
    monkeypatch.setattr(sink, "IN_MEMORY", 1000)
    found = nd.sweep(G, HOME, GRID, ["condition_number", "leg_lengths"], out=tmp_path, chunk=20)
    assert isinstance(found["condition_number"], np.memmap)
    assert not found["condition_number"].flags.writeable
    assert found["condition_number"].tobytes() == expected.tobytes()
    assert found["leg_lengths"].tobytes() == nd.sweep(G, HOME, GRID, "leg_lengths")["leg_lengths"].tobytes()
    assert np.load(tmp_path / "leg_lengths.npy").shape == (23, 17, 9)
    again = nd.sweep(G, HOME, GRID, ["condition_number", "leg_lengths"], out=tmp_path)
    assert again["condition_number"].tobytes() == expected.tobytes()


# --- What is kept is what was asked -----------------------------------------------------------------------------------


def changed(path, **entries):
    """Change a manifest as somebody would who wants to."""
    data = json.loads(path.read_text()) | entries
    path.write_text(json.dumps(data))


@pytest.mark.parametrize("entries", [{"chunk": 40}, {"chunk": 20.0}, {"digest": "0" * 64}, {"more": 1}])
def test_a_manifest_that_was_changed_is_refused(tmp_path, entries):
    """Of "chunk" the fingerprint knew nothing: an atlas counted 6 757 120 designs of 12 000 000, with status 0."""
    asked(tmp_path)
    changed(tmp_path / "manifest.json", **entries)
    with pytest.raises(ValueError, match=r"manifest.json: got a file that was changed or damaged since it was written"):
        asked(tmp_path)


@pytest.mark.parametrize("chunk", [1.5, "20", 0, None, True])
def test_a_chunk_that_is_no_number_of_points_is_named(tmp_path, chunk):
    """By somebody who knows how the file is sealed."""
    asked(tmp_path)
    manifest = tmp_path / "manifest.json"
    data = json.loads(manifest.read_text()) | {"chunk": chunk}
    del data["digest"]
    manifest.write_text(json.dumps(sealed(data)))
    with pytest.raises(ValueError, match=r"manifest.json: chunk: got .*, expected a whole number from 1"):
        asked(tmp_path)


def test_a_question_that_was_changed_is_refused(tmp_path):
    asked(tmp_path)
    data = json.loads((tmp_path / "manifest.json").read_text())
    changed(tmp_path / "manifest.json", question=data["question"] | {"relative": False})
    with pytest.raises(ValueError, match="changed or damaged"):
        nd.sweep(G, HOME, GRID, out=tmp_path, chunk=20, relative=False)


def test_a_manifest_without_a_digest_or_of_an_earlier_format_is_refused(tmp_path):
    asked(tmp_path)
    manifest = tmp_path / "manifest.json"
    data = json.loads(manifest.read_text())
    digest = data.pop("digest")
    manifest.write_text(json.dumps(data))
    with pytest.raises(ValueError, match="changed or damaged"):
        asked(tmp_path)
    manifest.write_text(json.dumps(data | {"format": "ninedof-chunks-1", "fingerprint": digest}))
    with pytest.raises(ValueError, match=r"earlier version of ninedof, expected an empty folder$") as caught:
        asked(tmp_path)
    assert "\n" not in str(caught.value)


def test_chunks_of_another_size_under_a_manifest_made_to_fit_are_computed_again(tmp_path, expected):
    """Two folders of the same question: the chunks of one are worth nothing in the other."""
    asked(tmp_path / "a")
    nd.sweep(G, HOME, GRID, out=tmp_path / "b", chunk=40)
    for path in chunks(tmp_path / "a"):
        shutil.copy(path, tmp_path / "b" / path.name)
    assert nd.sweep(G, HOME, GRID, out=tmp_path / "b")["condition_number"].tobytes() == expected.tobytes()


@pytest.mark.parametrize("wrong", [{"condition_number": np.zeros(19)}, {}, {"other": np.zeros(20)}])
def test_a_kept_chunk_of_other_points_is_computed_again(tmp_path, wrong, expected):
    """Its digest is right: the rows are counted all the same."""
    asked(tmp_path)
    manifest = json.loads((tmp_path / "manifest.json").read_text())
    question = {name: value for name, value in manifest["question"].items() if name != "ninedof"}
    with Store(tmp_path, question, 20) as store:
        store.write(3, wrong)
    assert asked(tmp_path).tobytes() == expected.tobytes()


@pytest.mark.parametrize("inside", [False, True])
def test_a_folder_in_the_place_of_a_chunk_is_put_aside(tmp_path, inside, expected):
    asked(tmp_path)
    chunk = tmp_path / "chunk-00000003"
    chunk.unlink()
    chunk.mkdir()
    if inside:
        (chunk / "mine").write_text("kept")
    assert asked(tmp_path).tobytes() == expected.tobytes()
    (aside,) = tmp_path.glob("not-a-chunk-00000003-*")
    assert [p.read_text() for p in aside.iterdir()] == ["kept"] * inside
    assert chunk.is_file()


@pytest.mark.parametrize("make", [os.mkfifo, lambda p: p.symlink_to("/dev/zero"), lambda p: p.symlink_to("nothing")])
def test_what_is_no_file_in_the_place_of_a_chunk_is_replaced(tmp_path, make, expected):
    asked(tmp_path)
    chunk = tmp_path / "chunk-00000003"
    chunk.unlink()
    make(chunk)
    assert asked(tmp_path).tobytes() == expected.tobytes()
    assert chunk.is_file()
    assert not chunk.is_symlink()


@pytest.mark.parametrize(
    "foreign",
    [".part-film.mkv", ".part-chunk-notes", ".part-manifest.json", "manifest.json", ".part-chunk-00000001-abc"],
)
@pytest.mark.parametrize("with_another", [False, True])
def test_a_foreign_folder_is_not_touched(tmp_path, foreign, with_another):
    """`.part-*` files were deleted before the folder was looked at."""
    (tmp_path / foreign).write_text("mine")
    if with_another:
        (tmp_path / "notes.txt").write_text("mine")
    before = {p.name: p.stat().st_mtime_ns for p in tmp_path.iterdir()}
    folder_before = tmp_path.stat().st_mtime_ns
    with pytest.raises(ValueError, match=r"^(out: got|.*manifest.json: got no) .*expected"):
        asked(tmp_path)
    assert {p.name: p.stat().st_mtime_ns for p in tmp_path.iterdir()} == before
    assert tmp_path.stat().st_mtime_ns == folder_before


def test_of_our_own_folder_only_our_own_parts_are_removed(tmp_path, expected):
    asked(tmp_path)
    (tmp_path / ".part-film.mkv").write_text("mine")
    (tmp_path / ".part-manifest.json-0123abcd").write_text("ours")
    assert asked(tmp_path).tobytes() == expected.tobytes()
    assert [p.name for p in tmp_path.glob(".part-*")] == [".part-film.mkv"]


@pytest.mark.parametrize("name", ["../../evil", "a/b", "a\\b", "", ".hidden", "x" * 300, "a\0b", "a\nb", 5])
def test_the_name_of_an_index_does_not_lead_outside(tmp_path, name, monkeypatch):
    def own(g, c, lc):
        return nd.condition_number(g, c, lc)

    monkeypatch.setattr(sink, "IN_MEMORY", 0)
    callable_ = type("Own", (), {"__call__": lambda self, *a: own(*a), "__qualname__": "Own"})()
    callable_.__name__ = name
    with pytest.raises(ValueError, match=r"^index: got a function of the name .*, expected a name"):
        nd.sweep(G, HOME, GRID, callable_, out=tmp_path / "deep" / "out")
    assert not list(tmp_path.iterdir())
