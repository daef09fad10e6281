"""What differs between operating systems, in this one file: POSIX calls where there are any, others on Windows."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_OF_ANOTHER = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)  # POSIX leaves the choice; Windows has the first or the last
_LOCK_FLAGS = os.O_CREAT | os.O_RDWR | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_NOFOLLOW", 0)


def open_for_lock(path: Path) -> int:
    """Return the descriptor of a file to lock, made if it is missing; no link is followed."""
    return os.open(path, _LOCK_FLAGS, 0o644)


def lock_file(descriptor: int) -> bool:
    """Lock an open file for this process; False at once where another process holds it.

    The system removes the lock when the process ends, however it ends.
    """
    try:
        if sys.platform == "win32":
            os.lseek(descriptor, 0, os.SEEK_SET)
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        else:
            # A lock of the process: unlike with flock, workers that outlive a killed parent do not keep it.
            fcntl.lockf(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in _OF_ANOTHER:
            return False
        raise
    return True


def removes_open_files() -> bool:
    """Return whether a file that is open can be removed."""
    return sys.platform != "win32"


def memory() -> int:
    """Return the bytes of memory of this machine; more than any file has where the system does not say."""
    try:
        pages = os.sysconf("SC_PHYS_PAGES")
        return pages * os.sysconf("SC_PAGE_SIZE") if pages > 0 else 2**63
    except (AttributeError, OSError, ValueError):  # Windows; a name that is not known
        return 2**63


def after_fork(call: Callable[[], object]) -> None:
    """Call a function in each child that this process forks; Windows has none."""
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_child=call)


def sync_folder(folder: Path) -> None:
    """Let the names in a folder survive a loss of power, where a system knows how: others do it by themselves."""
    if sys.platform == "win32":
        return
    with suppress(OSError):  # not every file system takes it, and the file is written
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
