"""Named arrays in one file: written whole or not at all, and refused in one way where it is damaged."""

from __future__ import annotations

import io
import os
import struct
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar
from zipfile import BadZipFile

import numpy as np

from ninedof.chunks.store import write_whole
from ninedof.chunks.work import Arrays

__all__ = ["read_npz", "write_npz"]

# What zipfile and numpy raise on bits that were changed; NotImplementedError and RuntimeError for flags and methods.
DAMAGE = (
    *(ValueError, KeyError, TypeError, IndexError, AttributeError, EOFError, OverflowError, MemoryError),
    *(NotImplementedError, RuntimeError, BadZipFile, zlib.error, struct.error),
)

T = TypeVar("T")


def write_npz(path: str | os.PathLike[str], arrays: Mapping[str, Any], *, compressed: bool = False) -> Path:
    """Write arrays, and return where: the suffix .npz is added if it is missing."""
    file = Path(path)
    file = file if file.suffix == ".npz" else file.with_name(file.name + ".npz")
    buffer = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(buffer, **arrays)
    write_whole(file, buffer.getvalue())
    return file


def read_npz(path: str | os.PathLike[str], what: str, made: Callable[[Arrays], T]) -> T:
    """Return what is made of the arrays of a file.

    Raises
    ------
    ValueError
        Naming the file, where it cannot be read, is damaged, or `made` finds it to be another.

    """
    try:
        with open(path, "rb") as file, np.load(file, allow_pickle=False) as found:
            contents = dict(found)
        return made(contents)
    except OSError as error:
        raise ValueError(f"{os.fspath(path)}: cannot be read ({error.strerror or error})") from None
    except DAMAGE:
        raise ValueError(f"{os.fspath(path)}: got no {what} file, expected a whole one that `save` wrote") from None
