"""Where run folders are made, and removed again if bad input ends a run at once. A run has its folder to itself."""

from __future__ import annotations

import itertools
import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path

from ninedof.chunks.store import FILES as CHUNK_FILES
from ninedof.chunks.store import MANIFEST
from ninedof.support.command import at_end
from ninedof.support.files import is_leftover, why_not_writable
from ninedof.support.lock import LOCK, FolderLock

RUNS = Path("runs")
COMMAND = "command.json"  # what the run was asked: written before the work
LONGEST = "n" * 80  # no name that a run writes into its folder is longer, a folder of chunks between counted
FILES = re.compile(
    r"(record|command|certify(-\d+)?(\.begun|\.command)?)\.json|optimum\.certificate|report\.html"
    r"|(map|certified|sweep|atlas|motion)\.npz|(legs|poses)\.csv"
    r"|(mechanism|condition|poses|convergence|front|sweep(_[a-z_]+)?|atlas|motion|figure_[1-7]"
    r"|workspace(_body)?|certified_workspace)\.(png|svg|pdf)"
    r"|n{40}"  # the probe
)
"""Names of the files of a run folder, as far as the names of their parts repeat them."""


def new_directory(out: Path | None) -> Path:
    """Create the run folder before any work is done: `out`, or runs/<time> here.

    An existing folder must be empty: a run never overwrites another. A command has the folder to itself until it ends,
    and leaves none that is empty.
    """
    directory, lock, made = _begun(out)
    if not at_end(lambda: _give_back(directory, lock, made)):
        lock.close()
    return directory


@contextmanager
def run_directory(out: Path | None) -> Iterator[Path]:
    """Create the run folder as `new_directory` does; remove it if an error ends the run before anything was kept.

    It belongs to this run until the end of the block, or of the command that runs.
    """
    directory, lock, made = _begun(out)
    later = at_end(lambda: _give_back(directory, lock, made))
    try:
        yield directory
    except Exception:
        _give_back(directory, lock, made, ended_at_once=True)
        raise
    finally:
        if not later:
            _give_back(directory, lock, made)


@contextmanager
def used_directory(directory: Path, name: str = "out") -> Iterator[Path]:
    """Have the folder of an earlier run to oneself until the end of the block, or of the command that runs."""
    lock = FolderLock(directory, name)
    later = at_end(lock.close)
    try:
        if reason := why_not_writable(directory / LONGEST):
            raise ValueError(
                f"{name}: got {directory}, which cannot be written to ({reason}), expected a writeable place"
            )
        yield directory
    finally:
        if not later:
            lock.close()


def _begun(out: Path | None) -> tuple[Path, FolderLock, list[Path]]:
    """Return a new run folder, its lock, and the folders that were made for it."""
    if out is None:
        directory, made = _of_now()
    else:
        if _taken(out):
            raise ValueError(f"out: got {out}, which exists and is not an empty folder, expected a new one")
        directory, made = out, _missing(out)
        _create(out, exist_ok=True)
    lock = None
    try:
        lock = FolderLock(directory)
        if _taken(directory):  # since it was looked at
            raise ValueError(f"out: got {directory}, which another run is using, expected another folder")
        if reason := why_not_writable(directory / LONGEST):
            raise ValueError(f"out: got {directory}, which cannot be written to ({reason}), expected a writeable place")
    except BaseException:
        if lock is not None:
            lock.close()
        _unmake(made)
        raise
    return directory, lock, made


def _give_back(directory: Path, lock: FolderLock, made: list[Path], ended_at_once: bool = False) -> None:
    """Let others have the folder; remove it where all that is in it is nothing. Without the lock nothing is touched.

    Of a run that ended at once the question is nothing too; if more is there, the folder stays with the command.
    """
    if not lock.held:
        return
    prepared = (MANIFEST, COMMAND) if ended_at_once else ()
    empty = all(path.name in prepared or _is_nothing(path, directory) for path in _files(directory))
    if empty:
        _clear(directory)  # while it is locked: behind the lock another run may have begun
    if empty or not ended_at_once:
        lock.close()
    if empty:
        _unmake(made)


def _clear(directory: Path) -> None:
    with suppress(OSError):
        for entry in directory.iterdir():
            if entry.name != LOCK:
                with suppress(OSError):
                    shutil.rmtree(entry) if entry.is_dir() and not entry.is_symlink() else entry.unlink()


def _unmake(made: list[Path]) -> None:
    for folder in made:
        with suppress(OSError):  # others are there
            folder.rmdir()


def _files(directory: Path) -> list[Path]:
    return [path for path in directory.rglob("*") if path.is_symlink() or not path.is_dir()]


def _is_nothing(path: Path, directory: Path) -> bool:
    return path.name == LOCK or is_leftover(path, FILES if path.parent == directory else CHUNK_FILES)


def _of_now() -> tuple[Path, list[Path]]:
    stamp = datetime.now().strftime("%Y%m%d-%H%M%S")
    for attempt in itertools.count():
        path = RUNS / (f"{stamp}-{attempt}" if attempt else stamp)
        made = _missing(path)
        if _create(path, exist_ok=False):
            return path, made
    raise AssertionError("unreachable")


def _missing(path: Path) -> list[Path]:
    """Return the folders of a path that do not exist, the innermost first."""
    return [folder for folder in (path, *path.parents) if not os.path.lexists(folder)]


def _taken(path: Path) -> bool:
    """Return whether a place holds anything but the leftovers of a run that was killed as it began."""
    try:
        if path.is_symlink() and not path.exists():
            raise ValueError("it is a link to nothing")
        if not path.is_dir():
            return os.path.lexists(path)
        return not all(_is_nothing(entry, path) for entry in path.iterdir())
    except (OSError, ValueError) as error:  # a zero byte is a ValueError
        reason = error.strerror if isinstance(error, OSError) else error
        raise ValueError(f"out: got {path}, which cannot be used ({reason}), expected a new folder") from None


def _create(path: Path, exist_ok: bool) -> bool:
    """Create a folder; return False if it exists and may not."""
    try:
        path.mkdir(parents=True, exist_ok=exist_ok)
    except FileExistsError:
        return False
    except OSError as error:
        reason = error.strerror
        raise ValueError(f"out: got {path}, which cannot be created ({reason}), expected a writeable place") from None
    return True
