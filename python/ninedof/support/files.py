"""Files written whole or not at all, and named arrays in one of them."""

from __future__ import annotations

import io
import os
import secrets
import struct
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar
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

T = TypeVar("T")


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


def npz_bytes(arrays: Mapping[str, Any], *, compressed: bool = False) -> bytes:
    """Return the bytes of a .npz file."""
    buffer = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(buffer, **arrays)
    return buffer.getvalue()


def write_npz(path: str | os.PathLike[str], arrays: Mapping[str, Any], *, compressed: bool = False) -> Path:
    """Write named arrays and return the path: the suffix .npz is added if it is missing."""
    file = Path(path)
    file = file if file.suffix == ".npz" else file.with_name(file.name + ".npz")
    return write_whole(file, npz_bytes(arrays, compressed=compressed))


def read_npz(path: str | os.PathLike[str], what: str, made: Callable[[Arrays], T]) -> T:
    """Return what `made` makes of the arrays of a file.

    Raises
    ------
    ValueError
        Naming the file, if it cannot be read, is damaged, or `made` raises because it holds something else.

    """
    try:
        with open(path, "rb") as file, np.load(file, allow_pickle=False) as found:
            contents = dict(found)
        return made(contents)
    except OSError as error:
        raise ValueError(f"{os.fspath(path)}: cannot be read ({error.strerror or error})") from None
    except DAMAGE:
        raise ValueError(f"{os.fspath(path)}: got no {what} file, expected a whole one that `save` wrote") from None
