"""A folder belongs to one run at a time, whichever process or thread it is in."""

from __future__ import annotations

import os
import threading
from contextlib import suppress
from pathlib import Path

from ninedof.support.system import after_fork, lock_file, open_for_lock, removes_open_files

LOCK = ".ninedof-lock"

_taken: set[tuple[int, int]] = set()  # folders locked by this process: its file lock does not exclude its own threads
_mutex = threading.Lock()


def _begin_child() -> None:
    """Forget what the parent holds: it keeps its locks, and the child has none. A thread of it may hold the mutex."""
    global _mutex
    _taken.clear()
    _mutex = threading.Lock()


after_fork(_begin_child)


class FolderLock:
    """The lock of a folder that exists, held until `close` or the end of the process, however it ends.

    The file `.ninedof-lock` is there while the lock is held; one that a killed process left locks nothing.

    Parameters
    ----------
    folder : path
    name : str
        Of the argument, for the message.

    Raises
    ------
    ValueError
        If another run holds it, or the file cannot be made.

    """

    def __init__(self, folder: Path, name: str = "out") -> None:
        self._file = folder / LOCK
        self._owner = os.getpid()
        self._descriptor: int | None = None
        try:
            at = folder.stat()
            self._key = (at.st_dev, at.st_ino)
            with _mutex:
                if self._key not in _taken:  # not opened else: closing any descriptor of the file releases the lock
                    self._descriptor = self._locked()
                if self._descriptor is not None:
                    _taken.add(self._key)
        except OSError as error:
            reason = error.strerror or str(error)
            raise ValueError(
                f"{name}: got {folder}, which cannot be locked ({reason}), expected a writeable place"
            ) from None
        if self._descriptor is None:
            raise ValueError(f"{name}: got {folder}, which another run is using, expected another folder")

    def _locked(self) -> int | None:
        """Return the descriptor of the locked file; None where another process holds it."""
        while True:
            descriptor = open_for_lock(self._file)
            kept = False
            try:
                if not lock_file(descriptor):
                    return None
                # Who held it may have removed the file since it was opened here: then this is a lock of nothing.
                with suppress(FileNotFoundError):
                    kept = os.path.samestat(os.fstat(descriptor), os.stat(self._file))
                if kept:
                    return descriptor
            finally:
                if not kept:
                    os.close(descriptor)

    @property
    def held(self) -> bool:
        """Whether the folder is this run's: in a forked child it is not."""
        return self._descriptor is not None and self._owner == os.getpid()

    def close(self) -> None:
        """Let another run use the folder; a second time this does nothing, and nor does it in a forked child."""
        with _mutex:
            if self._descriptor is None or not self.held:
                return
            if removes_open_files():  # while it is locked: nobody else can hold this file
                self._remove()
            os.close(self._descriptor)
            if not removes_open_files():  # nor one that another run has opened since
                self._remove()
            self._descriptor = None
            _taken.discard(self._key)

    def _remove(self) -> None:
        with suppress(OSError):
            self._file.unlink()

    def __enter__(self) -> FolderLock:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
