"""Collects the values of chunks, in memory or, if they are too large, in files."""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninedof.chunks import Arrays
from ninedof.design.indices import Index
from ninedof.support.files import PART, is_plain_name, naming

IN_MEMORY = 2**26  # bytes of all arrays; more go to files, if there is a folder


class Sink:
    """Takes chunks in any order.

    With a folder of chunks, arrays too large for memory become .npy files there. They are written by position and read
    through a memory map, so that memory never holds all of them.
    """

    def __init__(self, indices: tuple[Index, ...], shape: tuple[int, ...]) -> None:
        self._grid = shape
        self._shapes = {i.name: (*shape, *i.tail) for i in indices}
        self._parts: dict[str, NDArray[Any] | _File] = {}

    def begin(self, folder: Path | None) -> Callable[[int, int, Arrays], None]:
        """Allocate all values; return the function that stores those of points first ... last - 1."""
        size = 8 * sum(map(math.prod, self._shapes.values()))
        try:
            if folder is None or size <= IN_MEMORY:
                self._parts.update((name, np.empty(shape)) for name, shape in self._shapes.items())
            else:
                self._begin_files(folder, size)
        except MemoryError:
            raise self._too_many("what fits into memory, or out for a folder") from None
        return self._deliver

    def _begin_files(self, folder: Path, size: int) -> None:
        # The name of a caller's function may be no name of a file.
        stems = [name if is_plain_name(name) else f"array-{k}" for k, name in enumerate(self._shapes)]
        paths = [folder / f"{stem}.npy" for stem in stems]
        for path in paths:
            _part_of(path).unlink(missing_ok=True)  # of a run that was killed, or a link
        free = _free(folder)
        if size > free:
            room = f"{size / 1e9:.3g} GB, and {free / 1e9:.3g} GB are free on the disk of out"
            raise self._too_many(f"fewer: their values take {room}")
        for (name, shape), path in zip(self._shapes.items(), paths, strict=True):
            self._parts[name] = _File(path, shape)

    def _too_many(self, expected: str) -> ValueError:
        return ValueError(f"over: got {' x '.join(map(str, self._grid))} points, expected {expected}")

    def _deliver(self, first: int, last: int, arrays: Arrays) -> None:
        for name, part in self._parts.items():
            values = arrays[name]
            if isinstance(part, _File):
                part.put(first, last, values)
            else:
                part.reshape(-1, *values.shape[1:])[first:last] = values

    def discard(self) -> None:
        """Remove the files that are not whole: the chunks stay, and another run makes them anew."""
        for part in self._parts.values():
            if isinstance(part, _File):
                part.discard()

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return everything."""
        return {name: part.whole() if isinstance(part, _File) else part for name, part in self._parts.items()}


def _part_of(path: Path) -> Path:
    return path.with_name(f"{PART}{path.name}")


def _free(folder: Path) -> float:
    """Return the bytes that are free on a disk; infinity where it does not say."""
    with suppress(OSError):
        disk = shutil.disk_usage(folder)
        if disk.total:
            return disk.free
    return math.inf


class _File:
    """A .npy file written by position: a writeable memory map would fill the memory of the process."""

    def __init__(self, path: Path, shape: tuple[int, ...]) -> None:
        self._path, self._part = path, _part_of(path)
        np.lib.format.open_memmap(self._part, mode="w+", dtype=np.float64, shape=shape)
        self._file = self._part.open("r+b")
        np.lib.format.read_magic(self._file)
        np.lib.format.read_array_header_1_0(self._file)
        self._start = self._file.tell()

    def put(self, first: int, last: int, values: NDArray[Any]) -> None:
        data = np.ascontiguousarray(values, dtype=np.float64)
        try:
            self._file.seek(self._start + first * (data.nbytes // (last - first)))
            self._file.write(data.tobytes())
        except OSError as error:
            raise naming(error, self._path) from None

    def discard(self) -> None:
        with suppress(OSError):
            self._file.close()
        with suppress(OSError):
            self._part.unlink(missing_ok=True)

    def whole(self) -> NDArray[Any]:
        try:
            self._file.close()
            os.replace(self._part, self._path)
        except OSError as error:
            raise naming(error, self._path) from None
        return np.asanyarray(np.load(self._path, mmap_mode="r"))
