"""Finished chunks in a folder, each written whole or not at all, and the question they answer."""

from __future__ import annotations

import hashlib
import os
import re
import secrets
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from ninedof.support.arguments import shown, whole
from ninedof.support.files import Arrays, is_leftover, npz_bytes, write_whole
from ninedof.support.json import decode, plain
from ninedof.support.lock import LOCK, FolderLock
from ninedof.support.npz import DAMAGE, read_npz
from ninedof.support.reading import JSON, read_file, read_text
from ninedof.support.seal import digest_of, unsealed, write_sealed
from ninedof.support.system import memory
from ninedof.support.versions import versions

FORMAT = "ninedof-chunks-2"
EARLIER = "ninedof-chunks-1"
MANIFEST = "manifest.json"
MARK = b"ninedof chunk 2\n"
DIGEST = 32  # bytes
FILES = re.compile(rf"chunk-\d{{8,}}|{re.escape(MANIFEST)}|finished\.npz")
ASIDE = "not-a-"  # begins the new name of a folder in the place of a chunk


class Store:
    """A folder of finished chunks.

    It holds `manifest.json`, the question, the points of a chunk and the digest of both, and one file per chunk. A file
    starts with a digest of that digest, its own number and its contents: a chunk that was truncated, damaged, renamed
    or left by another question or size is computed again. The version of the package is part of the question.

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
        self._create()
        self._is_ours()  # before the lock, which is a file
        self._lock = FolderLock(self.folder)
        try:
            self._digest = self._open(asked)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Let another run use the folder."""
        self._lock.close()

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
        path = self.path(k)
        if path.is_dir() and not path.is_symlink():  # whoever made it: no file can take its place
            path.rename(path.with_name(f"{ASIDE}{path.name}-{secrets.token_hex(4)}"))
        write_whole(path, MARK + self._digest_of(k, payload) + payload)

    def read(self, k: int) -> Arrays | None:
        """Return a finished chunk; None if it is missing or damaged."""
        path = self.path(k)
        try:
            data = read_file(path, memory() // 4)  # one that was written was there more than once
        except (OSError, MemoryError):
            return None
        start = len(MARK) + DIGEST
        payload = data[start:]
        if data[:start] != MARK + self._digest_of(k, payload):
            return None
        try:
            return read_npz(payload)
        except (OSError, *DAMAGE):
            return None

    def _digest_of(self, k: int, payload: bytes) -> bytes:
        own = hashlib.sha256(f"{self._digest} {k} ".encode())
        own.update(payload)
        return own.digest()

    def _create(self) -> None:
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ValueError(
                f"out: got {self.folder}, which cannot be created ({error.strerror}), expected a folder"
            ) from None

    def _is_ours(self) -> bool:
        """Return whether there is a manifest of ours; raise for a folder that holds something else."""
        manifest = self.folder / MANIFEST
        if os.path.lexists(manifest):
            _manifest(manifest)
            return True
        others = sorted(p.name for p in self.folder.iterdir() if p.name != LOCK and not is_leftover(p, FILES))
        if others:
            raise ValueError(
                f"out: got {self.folder}, which holds {shown(others[0])} but no {MANIFEST}, expected it empty"
            )
        return False

    def _open(self, question: Mapping[str, Any]) -> str:
        """Return the digest of the manifest, written or found; once it is ours and locked, clear what a kill left."""
        ours = self._is_ours()
        manifest = self.folder / MANIFEST
        data = {"format": FORMAT, "chunk": self.chunk, "question": question}
        if ours:
            found = _manifest(manifest)
            if digest_of(found["question"]) != digest_of(question):
                what = ", ".join(differing(plain(found["question"]), plain(question)))
                raise ValueError(
                    f"out: got {self.folder}, which holds the chunks of another question (it differs in {what}), "
                    "expected an empty folder, or the question that was asked there"
                )
            data = found
            self.chunk = found["chunk"]
        for entry in self.folder.iterdir():
            if is_leftover(entry, FILES):
                with suppress(OSError):
                    entry.unlink()
        if not ours:
            write_sealed(manifest, data, JSON)
        return digest_of(data)


def differing(one: Mapping[str, Any], other: Mapping[str, Any]) -> list[str]:
    """Return the entries in which two questions differ."""
    return sorted(name for name in {*one, *other} if one.get(name) != other.get(name))


def _manifest(path: Path) -> dict[str, Any]:
    """Return what a manifest says, if ninedof wrote it and nothing of it was changed."""
    try:
        data = decode(read_text(path, JSON))
        kind = data["format"]
        if kind not in (FORMAT, EARLIER) or not isinstance(data["question"], dict):
            raise ValueError
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    except (ValueError, KeyError, TypeError, RecursionError):
        raise ValueError(f"{path}: got no {FORMAT!r} manifest, expected one written by ninedof") from None
    if kind == EARLIER:
        raise ValueError(f"{path}: got the chunks of an earlier version of ninedof, expected an empty folder")
    entries = unsealed(data, path, required=True)
    whole(f"{path}: chunk", entries.get("chunk"), 1)
    return entries
