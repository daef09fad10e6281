"""The folder of a run: the same question goes on there, another is refused with both named."""

import re
import threading

import numpy as np
import pytest

from ninedof.records.record import run_folder
from ninedof.support.kept import store as module
from ninedof.support.kept.store import Store

QUESTION = {"kind": "test", "limits": {"leg_ratio": 2.0, "far": float("inf")}, "over": [1, 2], "name": "a"}
ARRAYS = {"a": np.arange(3.0)}


def test_the_same_question_goes_on(tmp_path):
    with Store(tmp_path / "a" / "run", QUESTION, 20) as store:
        assert store.read(0) is None
        store.keep(1, ARRAYS)
    with Store(tmp_path / "a" / "run", QUESTION, 7) as store:
        assert store.chunk == 20  # that of the folder
        assert store.read(1)["a"].tolist() == [0.0, 1.0, 2.0]
        store.path(1).rename(store.path(2))
        assert store.read(2) is None  # its number is another
    assert sorted(path.name for path in (tmp_path / "a" / "run").iterdir()) == ["pieces", "question.json"]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"limits": {"leg_ratio": 2.5, "far": 1.0}}, "limits.leg_ratio is 2.0 there and 2.5 here; limits.far is inf"),
        ({"limits": {"leg_ratio": 2.0}}, "limits.far is inf there and missing here"),
        ({"over": [1, 3]}, "over[1] is 2 there and 3 here"),
        ({"over": [1]}, "over is [1, 2] there and [1] here"),
        ({"kind": "other", "name": "b"}, "kind is 'test' there and 'other' here; expected"),
    ],
)
def test_another_question_is_refused_with_both_named(tmp_path, change, words):
    Store(tmp_path / "run", QUESTION).close()
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    said = f"out: got {tmp_path / 'run'}, which holds the run of another question: {words}"
    with pytest.raises(ValueError, match=re.escape(said)):
        Store(tmp_path / "run", {**QUESTION, **change})
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")} == before


def test_another_version_is_another_question(tmp_path, monkeypatch):
    Store(tmp_path, QUESTION).close()
    monkeypatch.setattr(module, "versions", lambda: {"ninedof": "0.0.1"})
    with pytest.raises(ValueError, match=r"ninedof is '.+' there and '0\.0\.1' here"):
        Store(tmp_path, QUESTION)


@pytest.mark.parametrize("opened", [lambda path: Store(path, QUESTION), lambda path: run_folder(path).__enter__()])
def test_a_place_of_something_else_is_refused_and_left_alone(tmp_path, opened):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis").write_text("mine")
    (tmp_path / "link").symlink_to(tmp_path / "nothing")
    for name, words in (("file", "which is no folder"), ("full", "which holds 'thesis'"), ("link", "no folder")):
        with pytest.raises(ValueError, match=rf"^out: got .*{name}, .*{words}"):
            opened(tmp_path / name)
    assert {path.name for path in tmp_path.rglob("*")} == {"file", "full", "thesis", "link"}


def test_a_folder_that_cannot_be_made_is_told_before_the_work(tmp_path):
    (tmp_path / "file").write_text("kept")
    with pytest.raises(ValueError, match=r"^out: got .+, which cannot be used \(Not a directory\), expected"):
        Store(tmp_path / "file" / "below", QUESTION)


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_bad_input_leaves_no_folder_and_an_interruption_its_question(tmp_path, error):
    with pytest.raises(error), Store(tmp_path / "run", QUESTION):
        raise error("bad")
    assert (tmp_path / "run").exists() == (error is KeyboardInterrupt)


def test_what_is_kept_is_named_where_an_error_ends_the_run(tmp_path):
    error, store = RuntimeError("lost"), Store(tmp_path, QUESTION)
    store.keep(0, ARRAYS)
    store.__exit__(type(error), error)
    assert error.__notes__ == [f"Finished pieces are kept in {tmp_path}: the same call goes on from there."]


def test_of_two_questions_at_once_in_one_folder_one_is_refused(tmp_path):
    """Both ended well, and one record was lost."""
    for k in range(20):
        begin, refused = threading.Barrier(2), []

        def ask(name, folder=tmp_path / str(k), begin=begin, refused=refused):
            begin.wait()
            try:
                Store(folder, {**QUESTION, "name": name}).close()
            except ValueError:
                refused.append(name)

        both = [threading.Thread(target=ask, args=(name,)) for name in "ab"]
        for one in both:
            one.start()
        for one in both:
            one.join()
        assert len(refused) == 1


def test_a_folder_in_use_is_refused(tmp_path):
    with Store(tmp_path, QUESTION), pytest.raises(ValueError, match="which another run is using"):
        Store(tmp_path, QUESTION)
    Store(tmp_path, QUESTION).close()


def test_folders_made_in_one_second_differ_and_empty_ones_are_removed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with run_folder(None) as one, run_folder(None) as other:
        assert one != other
        (one / "kept").touch()
    assert [path.name for path in (tmp_path / "runs").iterdir()] == [one.name]
