"""Where the values of chunks are put together: in memory, or in files where there are too many."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninedof.chunks import Arrays
from ninedof.sweep.index import Index

__all__ = ["Sink"]

IN_MEMORY = 2**28  # bytes of all arrays; more go to files, if there is a folder


class Sink:
    """Takes chunks in any order.

    Beside a folder of chunks, arrays too large for memory become .npy files. They are written by position and read
    through a memory map, so that neither needs room for all.
    """

    def __init__(self, indices: tuple[Index, ...], shape: tuple[int, ...], folder: Path | None) -> None:
        shapes = {i.name: (*shape, *i.tail) for i in indices}
        large = folder is not None and 8 * sum(math.prod(s) for s in shapes.values()) > IN_MEMORY
        self._parts: dict[str, _Memory | _File] = {
            name: _File(folder / f"{name}.npy", s) if large and folder is not None else _Memory(s)
            for name, s in shapes.items()
        }

    def deliver(self, first: int, last: int, arrays: Arrays) -> None:
        """Take the values of points first ... last - 1."""
        for name, part in self._parts.items():
            part.put(first, last, arrays[name])

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return everything."""
        return {name: part.whole() for name, part in self._parts.items()}


class _Memory:
    def __init__(self, shape: tuple[int, ...]) -> None:
        self._all = np.empty(shape)

    def put(self, first: int, last: int, values: NDArray[Any]) -> None:
        self._all.reshape(-1, *values.shape[1:])[first:last] = values

    def whole(self) -> NDArray[Any]:
        return self._all


class _File:
    """A .npy file, written by position: a writeable map would keep all of it in our memory until the system objects."""

    def __init__(self, path: Path, shape: tuple[int, ...]) -> None:
        self._path = path
        part = path.with_name(f".part-{path.name}")
        np.lib.format.open_memmap(part, mode="w+", dtype=np.float64, shape=shape)
        with part.open("rb") as file:
            np.lib.format.read_magic(file)
            np.lib.format.read_array_header_1_0(file)
            self._start = file.tell()
        self._part, self._file = part, part.open("r+b")

    def put(self, first: int, last: int, values: NDArray[Any]) -> None:
        data = np.ascontiguousarray(values, dtype=np.float64)
        self._file.seek(self._start + first * (data.nbytes // (last - first)))
        self._file.write(data.tobytes())

    def whole(self) -> NDArray[Any]:
        self._file.close()
        os.replace(self._part, self._path)
        return np.asanyarray(np.load(self._path, mmap_mode="r"))
