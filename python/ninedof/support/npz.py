"""Arrays of a .npz file, read only as far as its directory says that they fit: a small file cannot fill the memory."""

from __future__ import annotations

import errno
import io
import os
import zlib
from collections.abc import Mapping
from pathlib import Path
from struct import error as StructError
from tokenize import TokenError
from typing import IO, Any
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile

import numpy as np
from numpy.typing import NDArray

from ninedof.support.blocks import blocks
from ninedof.support.system import memory

SUFFIX = ".npy"
KINDS = "biufcSU"  # of numbers and text: nothing that would run code
ALWAYS, TIMES = 2**29, 20
"""Arrays may have half a gigabyte, or twenty times the size of the file: what this package writes has far less."""
MOST_ARRAYS = 1000
PIECE = 2**20  # bytes read at a time

# What zipfile and numpy raise on bits that were changed; NotImplementedError and RuntimeError for flags and methods.
DAMAGE = (
    *(ValueError, KeyError, TypeError, IndexError, AttributeError, EOFError, OverflowError, MemoryError),
    *(NotImplementedError, RuntimeError, BadZipFile, zlib.error, StructError),
    *(TokenError, SyntaxError),  # numpy tokenizes a header that it cannot read otherwise
)


def read_npz(source: Path | bytes) -> dict[str, NDArray[Any]]:
    """Return the arrays of a .npz file, or of its bytes.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError or another of DAMAGE
        If it is no such file, is damaged, or would need more memory than `ALWAYS` and `TIMES` its own size,
        or than half of what there is.

    """
    if isinstance(source, Path) and source.exists() and not (source.is_file() or source.is_dir()):
        raise OSError(errno.EINVAL, "no regular file", os.fspath(source))
    with io.BytesIO(source) if isinstance(source, bytes) else source.open("rb") as file:
        size = file.seek(0, io.SEEK_END)
        if size > memory():  # its directory may be as large
            raise ValueError("it is larger than the memory")
        with ZipFile(file) as archive:
            entries = archive.infolist()
            most = min(max(ALWAYS, TIMES * size), memory() // 2)
            if len(entries) > MOST_ARRAYS or sum(one.file_size for one in entries) > most:
                raise ValueError("its arrays are too large")
            out: dict[str, NDArray[Any]] = {}
            for entry in entries:
                name = entry.filename.removesuffix(SUFFIX)
                if name in out or name == entry.filename or entry.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
                    raise ValueError("it holds more than arrays")
                with archive.open(entry) as member:
                    out[name] = _array(member, entry.file_size)
            return out


def write_npz(file: IO[bytes], arrays: Mapping[str, Any], *, compressed: bool = False) -> None:
    """Write arrays to an open file as numpy does, byte for byte; one that is mapped from a file in pieces."""
    with ZipFile(file, "w", ZIP_DEFLATED if compressed else ZIP_STORED) as archive:
        for name, value in arrays.items():
            array = np.asanyarray(value)
            with archive.open(name + SUFFIX, "w", force_zip64=True) as member:
                if not isinstance(array, np.memmap) or not array.flags.c_contiguous:
                    np.lib.format.write_array(member, array, allow_pickle=False)
                    continue
                np.lib.format.write_array_header_1_0(member, np.lib.format.header_data_from_array_1_0(array))
                for _, piece in blocks(array):
                    member.write(piece.tobytes())


def _array(member: IO[bytes], size: int) -> NDArray[Any]:
    """Return an array, whose header must fit the size in the directory: numpy would make it before it reads it."""
    headers = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
    shape, by_columns, dtype = headers[np.lib.format.read_magic(member)](member)
    if dtype.kind not in KINDS:
        raise ValueError("it holds no numbers")
    count = 1
    for length in shape:
        count *= length
    if min(shape, default=0) < 0 or not dtype.itemsize or count * dtype.itemsize != size - member.tell():
        raise ValueError("an array has not the size that it says")
    flat = np.empty(count, dtype)
    place, at = flat.view(np.uint8), 0
    while data := member.read(PIECE):  # to the end: zipfile compares the checksum there
        place[at : at + len(data)] = np.frombuffer(data, np.uint8)
        at += len(data)
    if at != len(place):
        raise ValueError("an array ends too soon")
    return flat.reshape(shape, order="F" if by_columns else "C")
