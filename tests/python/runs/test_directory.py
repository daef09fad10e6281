"""Run folders are made before any work and never shared."""

import pytest

from ninedof.runs.directory import new_directory


def test_folders_made_in_one_second_differ(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert len({new_directory(None) for _ in range(5)}) == 5


def test_a_folder_that_cannot_be_made_is_refused_before_any_work(tmp_path):
    (tmp_path / "file").write_text("kept")
    for out in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(ValueError, match=r"^out: got .+, expected"):
            new_directory(out)
    assert (tmp_path / "file").read_text() == "kept"
