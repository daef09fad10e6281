"""The folder of a run: its question, and every finished piece, so that the same call goes on behind the last one."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, Self

from ninedof.support.arguments import shown
from ninedof.support.extras import versions
from ninedof.support.kept.files import (
    PART,
    Arrays,
    json_bytes,
    read_json,
    read_npz,
    sha256,
    write_npz,
    write_whole,
)
from ninedof.support.running import has_kept
from ninedof.support.text import decode, encode

QUESTION, PIECES = "question.json", "pieces"
MOST_NAMED = 3  # differences of two questions in a message


class Store:
    """The question of a run and its finished pieces, in a folder.

    The folder holds `question.json`, and in `pieces` a file for each piece, numbered from 0. The digest of a piece
    covers the question and the number too: one that is damaged, renamed or left by another question is computed again.
    The version of the package is part of the question.

    The folder is made if it is missing; it must be empty or hold a run with the same question, all that the pieces
    depend on as plain values: ValueError names both. The chunk, the points of a piece, is that of the run there.
    """

    def __init__(self, folder: str | os.PathLike[str], question: Mapping[str, Any], chunk: int = 1) -> None:
        self._run = Path(folder)
        self.folder = self._run / PIECES
        self._unwritten = False
        self._lock: int | None = None
        self._made = not self._run.exists()
        own = decode(encode({**question, "ninedof": versions()["ninedof"]}))
        file = self._run / QUESTION
        try:
            require_run_or_nothing(self._run)
            self._run.mkdir(parents=True, exist_ok=True)
            self._lock = _locked(self._run)
            if not file.exists():
                write_whole(file, json_bytes("question", {"chunk": chunk, "question": own}))
            there = read_json(file, "question")
            self.folder.mkdir(exist_ok=True)
            for part in self.folder.glob(f"{PART}*"):  # of a run that was killed
                part.unlink(missing_ok=True)
            if encode(there["question"], sort_keys=True) != encode(own, sort_keys=True):
                differing = list(differences(there["question"], own))
                more = f" and {len(differing) - MOST_NAMED} more" * (len(differing) > MOST_NAMED)
                raise ValueError(
                    f"out: got {self._run}, which holds the run of another question: "
                    f"{'; '.join(differing[:MOST_NAMED])}{more}; expected a new folder or the question there"
                )
        except OSError as error:
            self.close()
            expected = f"which cannot be used ({error.strerror}), expected a writeable place"
            raise ValueError(f"out: got {self._run}, {expected}") from None
        except ValueError:
            self.close()
            raise
        self.chunk: int = there["chunk"]
        self._salt = sha256(encode(there, sort_keys=True).encode()).hexdigest()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, error: BaseException | None, *_: object) -> None:
        """Name what is kept where an error ends the run; remove the folder where that is nothing."""
        self.close()
        if self.has_pieces():
            has_kept()
        if not isinstance(error, Exception):
            return
        with suppress(OSError):
            if self.has_pieces():
                error.add_note(f"Finished pieces are kept in {self._run}: the same call goes on from there.")
                return
            self.folder.rmdir()
            if [path.name for path in self._run.iterdir()] == [QUESTION]:
                (self._run / QUESTION).unlink()
                if self._made:
                    self._run.rmdir()

    def close(self) -> None:
        """Let another run have the folder."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def has_pieces(self) -> bool:
        """Return whether there are pieces."""
        return any(self.folder.glob("*.npz"))

    def path(self, k: int) -> Path:
        """Return the file of a piece."""
        return self.folder / f"{k:08d}.npz"

    def read(self, k: int) -> Arrays | None:
        """Return a finished piece; None if it is missing or damaged."""
        try:
            return read_npz(self.path(k), f"{self._salt} {k} ")
        except ValueError:
            return None

    def keep(self, k: int, arrays: Arrays) -> None:
        """Write a finished piece if there is room; without, a warning tells of the first: the run is worth more."""
        try:
            write_npz(self.path(k), arrays, salt=f"{self._salt} {k} ")
        except OSError as error:
            if not self._unwritten:
                import logging  # when it is needed, as it takes time to load

                words = "%s; the run goes on, but what cannot be written is lost if it ends early"
                logging.getLogger("ninedof").warning(words, error)
            self._unwritten = True


def _locked(folder: Path) -> int | None:
    """Keep a second run out of a folder while this one has it open; None where no system call does."""
    if sys.platform == "win32":
        return None
    import fcntl

    opened = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(opened)
        raise ValueError(f"out: got {folder}, which another run is using, expected another folder") from None
    return opened


def folder_of(run: str | os.PathLike[str]) -> Path:
    """Return the folder of a run that is named by its folder or by a file there."""
    place = Path(run)
    return place if place.is_dir() else place.parent


def require_run_or_nothing(folder: Path) -> None:
    """Raise for a folder that holds something, but no run."""
    if not os.path.lexists(folder):
        return
    if not folder.is_dir():
        raise ValueError(f"out: got {folder}, which is no folder, expected a new one or that of a run")
    others = sorted(path.name for path in folder.iterdir() if not path.name.startswith(PART))  # of a kill
    if others and QUESTION not in others:
        expected = "expected a new or an empty folder, or that of a run"
        raise ValueError(f"out: got {folder}, which holds {shown(others[0])} but no {QUESTION}, {expected}")


def differences(there: Any, here: Any, name: str = "") -> Iterator[str]:
    """Yield the entries in which two questions differ, with both values."""
    if isinstance(there, Mapping) and isinstance(here, Mapping):
        if there.get("kind") != here.get("kind"):
            there, here = ({"kind": one.get("kind")} for one in (there, here))
        for key in {**there, **here}:
            yield from differences(there.get(key), here.get(key), f"{name}.{key}" if name else str(key))
    elif isinstance(there, list) and isinstance(here, list) and len(there) == len(here):
        for k, pair in enumerate(zip(there, here, strict=True)):
            yield from differences(*pair, f"{name}[{k}]")
    elif there != here:
        yield f"{name} is {_words(there)} there and {_words(here)} here"


def _words(value: Any) -> str:
    return "missing" if value is None else shown(value)
