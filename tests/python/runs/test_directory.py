"""Run folders are made before any work and never shared."""

import errno
import os
from contextlib import nullcontext

import pytest

from ninedof.chunks.store import ASIDE
from ninedof.design.indices import computed
from ninedof.proof.optimum import FILE as CERTIFICATE
from ninedof.report.report import FILE as REPORT
from ninedof.runs import directory, folder
from ninedof.runs.directory import COMMAND, new_directory, run_directory, used_directory
from ninedof.runs.machine_file import begun_file, certificate_file
from ninedof.runs.motion_folder import ARRAYS_FILE, LEGS_FILE, POSES_FILE
from ninedof.support.command import running
from ninedof.support.files import is_leftover, part_name
from ninedof.support.lock import LOCK, FolderLock


def test_folders_made_in_one_second_differ(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert len({new_directory(None) for _ in range(5)}) == 5


def test_a_folder_that_cannot_be_made_is_refused_before_any_work(tmp_path):
    (tmp_path / "file").write_text("kept")
    for out in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(ValueError, match=r"^out: got .+, expected"):
            new_directory(out)
    assert (tmp_path / "file").read_text() == "kept"


def command():
    """The time of a command: what it holds is given back at its end."""
    return running("ninedof", ["optimize"])


def test_a_command_has_its_folder_to_itself_until_it_ends(tmp_path):
    out = tmp_path / "out"
    with command():
        new_directory(out)
        with pytest.raises(ValueError, match="which another run is using"):
            new_directory(out)
        with pytest.raises(ValueError, match="which another run is using"), used_directory(out):
            pass
        (out / "record.json").write_text("kept")
    assert [p.name for p in out.iterdir()] == ["record.json"]
    with used_directory(out), pytest.raises(ValueError, match="which another run is using"), used_directory(out):
        pass
    assert [p.name for p in out.iterdir()] == ["record.json"]


def test_a_folder_that_another_run_fills_meanwhile_is_refused(tmp_path, monkeypatch):
    """Both saw it empty; the other was faster, and has ended."""
    out, real = tmp_path / "out", directory.FolderLock

    def late(folder):
        (folder / "record.json").write_text("of the other")
        return real(folder)

    monkeypatch.setattr(directory, "FolderLock", late)
    with pytest.raises(ValueError, match="which another run is using"):
        new_directory(out)
    assert [p.name for p in out.iterdir()] == ["record.json"]


def test_a_run_that_begins_as_an_empty_one_ends_loses_nothing(tmp_path, monkeypatch):
    out, close = tmp_path / "out", FolderLock.close
    begun = []

    def closing(lock):
        close(lock)
        if not begun:  # between the lock and the removal
            begun.append(True)
            with FolderLock(out):
                (out / "record.json").write_text("of the other")

    monkeypatch.setattr(FolderLock, "close", closing)
    with pytest.raises(ValueError, match="bad"):
        ended_by(ValueError("bad"), out, "chunks/manifest.json")
    assert [p.name for p in out.iterdir()] == ["record.json"]


def test_leftovers_of_a_run_that_was_killed_as_it_began_do_not_count(tmp_path):
    (tmp_path / LOCK).touch()
    (tmp_path / ".part-record.json-0123abcd").write_text("half")
    assert new_directory(tmp_path) == tmp_path
    (tmp_path / ".part-film.mkv").write_text("mine")
    with pytest.raises(ValueError, match="not an empty folder"):
        new_directory(tmp_path)


@pytest.mark.parametrize("name", ["thesis", "film.mkv", "thesis.json", "chunk-00000001", "sweep.docx", "n" * 39])
def test_a_part_that_somebody_else_writes_counts(tmp_path, name):
    foreign = tmp_path / f".part-{name}-cafebabe"
    foreign.write_text("thesis")
    with pytest.raises(ValueError, match="exists and is not an empty folder"):
        new_directory(tmp_path)
    assert [path.read_text() for path in tmp_path.iterdir()] == ["thesis"]


def test_the_parts_of_all_files_of_a_run_are_known(tmp_path):
    """Else a run that goes on after a kill would leave them."""
    figures = ["mechanism", "workspace", "workspace_body", "certified_workspace", "figure_7", "sweep", "front"]
    figures += [f"sweep_{name}" for name in computed()]
    names = [f"{stem}.{kind}" for stem in figures for kind in ("png", "svg", "pdf")]
    names += [*folder.ARRAYS.values(), folder.FILE, folder.CERTIFIED, COMMAND, directory.LONGEST, CERTIFICATE, REPORT]
    names += [LEGS_FILE, POSES_FILE, ARRAYS_FILE, begun_file(certificate_file(f"{tmp_path}#1000")).name]
    for name in names:
        part = tmp_path / part_name(name)
        part.touch()
        assert is_leftover(part, directory.FILES), name


def ended_by(error, out, *names):
    """A run that has made files, and folders for them, when an error ends it."""
    with run_directory(out) as folder:
        for name in names:
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text("kept")
        raise error


@pytest.mark.parametrize("error", [ValueError, MemoryError, RuntimeError, KeyboardInterrupt])
@pytest.mark.parametrize("as_command", [False, True])
def test_a_run_that_ends_at_once_leaves_no_folder(tmp_path, error, as_command):
    """Nor those above it that were made for it."""
    with command() if as_command else nullcontext(), pytest.raises(error):
        ended_by(error, tmp_path / "a" / "b" / "c", ".part-record.json-0123abcd", "chunks/.part-manifest.json-0123abcd")
    assert not list(tmp_path.iterdir())


def test_bad_input_leaves_no_folder_with_a_question_alone(tmp_path):
    with pytest.raises(ValueError, match="bad"):
        ended_by(ValueError("bad"), tmp_path / "out", "chunks/manifest.json")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "name",
    ["record.json", ".mine", "chunks/chunk-00000000", "chunks/.part-thesis-cafebabe", ".part-chunk-00000001-cafebabe"],
)
def test_what_was_kept_stays(tmp_path, name):
    with pytest.raises(ValueError, match="bad"):
        ended_by(ValueError("bad"), tmp_path / "out", name, "chunks/manifest.json")
    assert (tmp_path / "out" / name).read_text() == "kept"


def test_a_folder_that_was_there_stays(tmp_path):
    (tmp_path / "out").mkdir()
    with pytest.raises(ValueError, match="bad"), run_directory(tmp_path / "out"):
        raise ValueError("bad")
    assert not list((tmp_path / "out").iterdir())


def test_a_link_to_nothing_is_refused(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "nothing")
    with pytest.raises(ValueError, match=r"^out: got .*link, which cannot be used \(it is a link to nothing\)"):
        new_directory(tmp_path / "link")
    assert not (tmp_path / "nothing").exists()


@pytest.mark.parametrize("length", [256, 5000])
def test_a_name_that_is_too_long_is_told_before_the_work(tmp_path, length):
    with pytest.raises(ValueError, match=r"^out: got .*File name too long.*expected"):
        new_directory(tmp_path / ("n" * length))
    assert not list(tmp_path.iterdir())


def test_a_path_that_leaves_no_room_for_our_names_is_told_before_the_work(tmp_path, monkeypatch):
    """The folder can be made, but not the longest file in it."""
    deep = tmp_path
    while len(str(deep)) < 3800:
        deep = deep / ("d" * 200)
    deep = deep / ("e" * (4060 - len(str(deep))))
    with pytest.raises(ValueError, match=r"^out: got .*which cannot be written to \(File name too long\)"):
        new_directory(deep)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_takes_no_files_is_told_before_the_work(tmp_path, monkeypatch):
    """Also to root, who may write into what is read-only: the system call is made to fail."""
    real = os.open

    def refused(path, *more, **options):
        if str(path).startswith(str(tmp_path)):
            raise OSError(errno.EROFS, "Read-only file system", str(path))
        return real(path, *more, **options)

    monkeypatch.setattr(os, "open", refused)
    with pytest.raises(ValueError, match=r"^out: got .*Read-only file system.*expected a writeable place$"):
        new_directory(tmp_path / "out")
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_a_read_only_folder_is_told_before_the_work(tmp_path):
    (tmp_path / "out").mkdir(mode=0o555)
    with pytest.raises(ValueError, match=r"^out: got .*Permission denied.*expected"):
        new_directory(tmp_path / "out")


def test_no_name_is_longer_than_what_is_probed():
    """Chunks, their parts, figures of every index, certificates of the last point of a front."""
    names = [f"chunks/{part_name('chunk-00000000')}", f"sweep_{max(computed(), key=len)}.pdf", "certify-1000.json"]
    names += [f"chunks/{ASIDE}chunk-00000000-01234567", part_name("n" * 300)]
    assert max(map(len, names)) <= len(directory.LONGEST)
