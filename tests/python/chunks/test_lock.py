"""A folder belongs to one run at a time, in this process and in others; a lock that was given back leaves nothing."""

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.support import lock as module
from ninedof.support.lock import LOCK, FolderLock

USED = r"^out: got .*, which another run is using, expected another folder$"
HOLD = """
import sys
from pathlib import Path
from ninedof.support.lock import FolderLock
held = FolderLock(Path(sys.argv[1]))
print("held", flush=True)
sys.stdin.read()
"""


def holding(folder):
    """Start a process that holds the lock of a folder until it is ended."""
    path = os.pathsep.join([str(Path(nd.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(folder)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": path},
    )
    assert process.stdout.readline() == b"held\n"
    return process


def test_another_process_excludes_this_one_until_it_ends_however_it_ends(tmp_path):
    process = holding(tmp_path)
    try:
        with pytest.raises(ValueError, match=USED):
            FolderLock(tmp_path)
        assert (tmp_path / LOCK).exists()
        process.send_signal(signal.SIGKILL)
        process.wait(30)
        assert (tmp_path / LOCK).exists()  # a leftover that locks nothing
        FolderLock(tmp_path).close()
    finally:
        process.kill()
        process.communicate()
    assert not list(tmp_path.iterdir())


def test_of_many_threads_one_has_the_folder(tmp_path):
    """Each thread takes and gives back the lock again and again; never two hold it."""
    inside, most, taken = [], [], []

    def work():
        for _ in range(200):
            try:
                held = FolderLock(tmp_path)
            except ValueError:
                continue
            inside.append(0)
            most.append(len(inside))
            inside.pop()
            taken.append(0)
            held.close()

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert taken
    assert set(most) == {1}
    assert not list(tmp_path.iterdir())


def test_a_lock_is_of_the_folder_and_not_of_its_name(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "folder")
    with FolderLock(tmp_path / "folder"):
        for name in ("folder", "link", "folder/../folder"):
            with pytest.raises(ValueError, match=USED):
                FolderLock(tmp_path / name)
        (tmp_path / "folder").rename(tmp_path / "moved")
        with pytest.raises(ValueError, match=USED):
            FolderLock(tmp_path / "moved")


def test_a_file_that_was_removed_and_made_anew_is_locked_anew(tmp_path, monkeypatch):
    """Between opening and locking another run ends and removes the file: the lock of the old one excludes nobody."""
    real, calls = module.lock_file, []

    def slow(descriptor):
        calls.append(descriptor)
        if len(calls) == 1:
            (tmp_path / LOCK).unlink()
        return real(descriptor)

    monkeypatch.setattr(module, "lock_file", slow)
    with FolderLock(tmp_path):
        assert len(calls) == 2
        assert (tmp_path / LOCK).exists()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_forked_child_holds_nothing_and_gives_nothing_back(tmp_path):
    held = FolderLock(tmp_path)
    child = os.fork()
    if child == 0:
        held.close()
        try:
            FolderLock(tmp_path)
        except ValueError:
            os._exit(0)
        os._exit(1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert (tmp_path / LOCK).exists()
    held.close()


@pytest.mark.parametrize("kind", ["folder", "link", "missing"])
def test_what_cannot_be_locked_is_refused_in_one_line(tmp_path, kind):
    folder = tmp_path / "out"
    if kind != "missing":
        folder.mkdir()
    if kind == "folder":
        (folder / LOCK).mkdir()
    if kind == "link":  # the file of somebody else would be locked
        (tmp_path / "foreign").write_text("mine")
        (folder / LOCK).symlink_to(tmp_path / "foreign")
    with pytest.raises(ValueError, match=r"^out: got .*, which cannot be locked \(.+\), expected a writeable place$"):
        FolderLock(folder)
    if kind == "link":
        assert (tmp_path / "foreign").read_text() == "mine"


def test_a_system_without_locks_says_so(tmp_path, monkeypatch):
    def refused(_):
        raise OSError(37, "No locks available")

    monkeypatch.setattr(module, "lock_file", refused)
    with pytest.raises(ValueError, match=r"cannot be locked \(No locks available\)") as caught:
        FolderLock(tmp_path)
    assert "\n" not in str(caught.value)
