"""Finished chunks in a folder, each written whole or not at all, and the question they answer."""

from __future__ import annotations

import fcntl
import hashlib
import io
import os
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from ninedof.support.arguments import shown
from ninedof.support.files import PART, Arrays, npz_bytes, write_whole
from ninedof.support.json import decode, encode, plain
from ninedof.support.versions import versions

FORMAT = "ninedof-chunks-1"
MANIFEST = "manifest.json"
MARK = b"ninedof chunk 1\n"
DIGEST = 32  # bytes


_taken: set[Path] = set()  # folders in use by this process: its file lock does not exclude its own threads
_mutex = threading.Lock()
os.register_at_fork(after_in_child=_taken.clear)  # the parent keeps the lock


class Store:
    """A folder of finished chunks.

    It holds `manifest.json`, the question and its fingerprint, and one file per chunk. A file starts with a digest of
    the question, its own number and its contents: a chunk that was truncated, damaged, renamed or left by another
    question is computed again. The version of the package is part of the question.

    Parameters
    ----------
    folder : path
        Made if it is missing. It must be empty or hold the chunks of the same question.
    question : mapping
        All that the chunks depend on, as plain values.
    chunk : int
        Points per chunk. In a folder with chunks theirs is used.

    Raises
    ------
    ValueError
        If the folder holds something else or another run is using it.

    """

    def __init__(self, folder: str | os.PathLike[str], question: Mapping[str, Any], chunk: int) -> None:
        self.folder = Path(folder)
        self.chunk = chunk
        asked = {**plain(question), "ninedof": versions()["ninedof"]}
        self._fingerprint = fingerprint(asked)
        self._create()
        self._own = self.folder.resolve()
        self._lock = self._locked()
        try:
            self._open(asked)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Let another run use the folder."""
        with _mutex:
            if self._lock >= 0:  # not closed yet
                os.close(self._lock)
                _taken.discard(self._own)
            self._lock = -1

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def path(self, k: int) -> Path:
        """Return the file of a chunk."""
        return self.folder / f"chunk-{k:08d}"

    def write(self, k: int, arrays: Arrays) -> None:
        """Write a finished chunk; after this it survives a kill and a loss of power."""
        payload = npz_bytes(arrays)
        write_whole(self.path(k), MARK + self._digest(k, payload) + payload)

    def read(self, k: int) -> Arrays | None:
        """Return a finished chunk; None if it is missing or damaged."""
        try:
            data = self.path(k).read_bytes()
        except OSError:
            return None
        start = len(MARK) + DIGEST
        payload = data[start:]
        if data[:start] != MARK + self._digest(k, payload):
            return None
        try:
            with np.load(io.BytesIO(payload), allow_pickle=False) as found:
                return dict(found)
        except (OSError, ValueError, BadZipFile):
            return None

    def _digest(self, k: int, payload: bytes) -> bytes:
        own = hashlib.sha256(f"{self._fingerprint} {k} ".encode())
        own.update(payload)
        return own.digest()

    def _create(self) -> None:
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ValueError(
                f"out: got {self.folder}, which cannot be created ({error.strerror}), expected a folder"
            ) from None

    def _locked(self) -> int:
        """Lock the folder for this process. The system removes the lock when the process ends, however it ends."""
        in_use = f"out: got {self.folder}, which another run is using, expected another folder"
        with _mutex:
            if self._own in _taken:  # not opened: closing any descriptor of the file would release the lock
                raise ValueError(in_use)
            lock = os.open(self.folder / ".lock", os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o644)
            try:
                # A lock of the process: unlike with flock, workers that outlive a killed parent do not keep it.
                fcntl.lockf(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                os.close(lock)
                raise ValueError(in_use) from None
            _taken.add(self._own)
        return lock

    def _open(self, question: Mapping[str, Any]) -> None:
        manifest = self.folder / MANIFEST
        for leftover in self.folder.glob(f"{PART}*"):  # of a run that was killed: no other uses the folder
            leftover.unlink(missing_ok=True)
        if not manifest.exists():
            if others := sorted(p.name for p in self.folder.iterdir() if p.name != ".lock"):
                raise ValueError(
                    f"out: got {self.folder}, which holds {shown(others[0])} but no {MANIFEST}, expected it empty"
                )
            data = {"format": FORMAT, "fingerprint": self._fingerprint, "chunk": self.chunk, "question": question}
            write_whole(manifest, (encode(data) + "\n").encode())
            return
        found = _manifest(manifest)
        if found["fingerprint"] != self._fingerprint:
            what = ", ".join(differing(plain(found["question"]), question))
            raise ValueError(
                f"out: got {self.folder}, which holds the chunks of another question (it differs in {what}), "
                "expected an empty folder, or the question that was asked there"
            )
        self.chunk = found["chunk"]


def fingerprint(question: Mapping[str, Any]) -> str:
    """Return the digest of a question; numbers count to the last bit."""
    return hashlib.sha256(encode([FORMAT, question], indent=None, sort_keys=True).encode()).hexdigest()


def differing(one: Mapping[str, Any], other: Mapping[str, Any]) -> list[str]:
    """Return the entries in which two questions differ."""
    return sorted(name for name in {*one, *other} if one.get(name) != other.get(name))


def _manifest(path: Path) -> dict[str, Any]:
    try:
        data = decode(path.read_text(encoding="utf-8"))
        if data["format"] != FORMAT or not isinstance(data["question"], dict) or int(data["chunk"]) < 1:
            raise ValueError
        str(data["fingerprint"])
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    except (ValueError, KeyError, TypeError):
        raise ValueError(f"{path}: got no {FORMAT!r} manifest, expected one written by ninedof") from None
    return dict(data)
