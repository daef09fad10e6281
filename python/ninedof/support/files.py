"""Files written whole or not at all, and results saved as one file of named arrays."""

from __future__ import annotations

import io
import os
import secrets
import struct
import zlib
from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Self
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

Arrays = dict[str, NDArray[Any]]

PART = ".part-"  # begins the name of a file that is being written

# What zipfile and numpy raise on bits that were changed; NotImplementedError and RuntimeError for flags and methods.
DAMAGE = (
    *(ValueError, KeyError, TypeError, IndexError, AttributeError, EOFError, OverflowError, MemoryError),
    *(NotImplementedError, RuntimeError, BadZipFile, zlib.error, struct.error),
)


def write_whole(path: Path, data: bytes) -> Path:
    """Write a file that appears whole or not at all, even if the power fails; return its path."""
    part = path.with_name(f"{PART}{path.name}-{secrets.token_hex(4)}")  # in the same folder: renaming is atomic there
    try:
        with part.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
            os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
    return path


def why_not_writable(path: Path) -> str:
    """Return why a file cannot be written there, "" where it can: to be known before the work, not after it."""
    part = path.with_name(f"{PART}{path.name}-{secrets.token_hex(4)}")
    try:
        if path.is_dir():
            return "it is a folder"
        part.touch()
        part.unlink()
    except OSError as error:
        return error.strerror or str(error)
    return ""


def own_or_new(name: str, path: Path, mark: str) -> None:
    """Raise ValueError, naming the argument, for a file that exists without the mark of those that ninedof writes."""
    if reason := why_not_writable(path):
        raise ValueError(f"{name}: got {path}, which cannot be written ({reason}), expected a writeable place")
    if path.exists() and mark.encode() not in path.read_bytes():
        raise ValueError(f"{name}: got {path}, which exists and was not written by ninedof, expected another name")


def npz_bytes(arrays: Mapping[str, Any], *, compressed: bool = False) -> bytes:
    """Return the bytes of a .npz file."""
    buffer = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(buffer, **arrays)
    return buffer.getvalue()


class Saved(ABC):
    """A result that one .npz file holds."""

    FORMAT: ClassVar[str]
    COMPRESSED: ClassVar[bool] = False

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write everything to one .npz file, whole or not at all, and return its path.

        Parameters
        ----------
        path : path
            The suffix .npz is added if it is missing.

        """
        file = Path(path)
        file = file if file.suffix == ".npz" else file.with_name(file.name + ".npz")
        return write_whole(file, npz_bytes(self._contents(), compressed=self.COMPRESSED))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read what `save` wrote.

        Parameters
        ----------
        path : path

        Raises
        ------
        ValueError
            Naming the file, if it cannot be read, is damaged, or has another format.

        """
        try:
            with open(path, "rb") as file, np.load(file, allow_pickle=False) as found:
                contents = dict(found)
            return cls._made(contents)
        except OSError as error:
            raise ValueError(f"{os.fspath(path)}: cannot be read ({error.strerror or error})") from None
        except DAMAGE:
            expected = f"got no {cls.FORMAT!r} file, expected a whole one that `save` wrote"
            raise ValueError(f"{os.fspath(path)}: {expected}") from None

    @abstractmethod
    def _contents(self) -> dict[str, Any]:
        """Return the arrays of the file."""

    @classmethod
    @abstractmethod
    def _made(cls, contents: Arrays) -> Self:
        """Return the result that has these arrays; raise an error of DAMAGE for those of another format."""
