"""Where run folders are made, and removed again if bad input ends a run at once."""

from __future__ import annotations

import itertools
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path

from ninedof.chunks.store import MANIFEST
from ninedof.support.files import why_not_writable

RUNS = Path("runs")


def new_directory(out: Path | None) -> Path:
    """Create the run folder before any work is done: `out`, or runs/<time> here.

    An existing folder must be empty: a run never overwrites another.
    """
    if out is not None:
        if _taken(out):
            raise ValueError(f"out: got {out}, which exists and is not an empty folder, expected a new one")
        _create(out, exist_ok=True)
        if reason := why_not_writable(out / "record.json"):
            raise ValueError(f"out: got {out}, which cannot be written to ({reason}), expected a writeable place")
        return out
    stamp = datetime.now().strftime("%Y%m%d-%H%M%S")
    for attempt in itertools.count():
        path = RUNS / (f"{stamp}-{attempt}" if attempt else stamp)
        if _create(path, exist_ok=False):
            return path
    raise AssertionError("unreachable")


@contextmanager
def run_directory(out: Path | None) -> Iterator[Path]:
    """Create the run folder as `new_directory` does; remove it if bad input ends the run before anything was kept."""
    existed = out is not None and out.exists()
    directory = new_directory(out)
    try:
        yield directory
    except ValueError:
        if not any(path.is_file() and not _is_preparation(path) for path in directory.rglob("*")):
            _remove(directory, existed)
        raise


def _is_preparation(path: Path) -> bool:
    return path.name.startswith(".") or path.name == MANIFEST


def _remove(directory: Path, keep: bool) -> None:
    for entry in directory.iterdir():
        shutil.rmtree(entry) if entry.is_dir() else entry.unlink()
    if not keep:
        directory.rmdir()
        if directory.parent == RUNS:
            with suppress(OSError):  # other runs are there
                RUNS.rmdir()


def _taken(path: Path) -> bool:
    try:
        return path.exists() and (not path.is_dir() or any(path.iterdir()))
    except OSError as error:
        raise ValueError(f"out: got {path}, which cannot be read ({error.strerror}), expected a new folder") from None


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
