"""The work of a sweep: a grid, the robots at its points, and the indices computed there."""

from __future__ import annotations

import math
import os
import zlib
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ninedof.design.index_argument import identity
from ninedof.design.indices import Index
from ninedof.support.angles import DEG
from ninedof.support.arrays import Floats
from ninedof.support.blocks import forget
from ninedof.support.files import Arrays
from ninedof.support.json import plain
from ninedof.support.progress import Progress
from ninedof.support.units import unit_entry
from ninedof.support.versions import versions
from ninedof.sweep.axis import Grid
from ninedof.sweep.chunks import FINISHED, Folder, chunks_of, run
from ninedof.sweep.result import SweepResult


class Subject(Protocol):
    """The robots at the points of a grid."""

    def values(self, at: dict[str, Floats], count: int, indices: tuple[Index, ...], threads: int | None) -> Arrays:
        """Return the indices at n points, given by the value of each swept variable."""

    def question(self) -> dict[str, Any]:
        """Return what the values depend on, as plain JSON values."""


@dataclass(frozen=True, eq=False)
class GridWork:
    """The indices at all points of a grid."""

    subject: Subject
    grid: Grid
    indices: tuple[Index, ...]
    chunk: int
    threads: int | None = None

    @property
    def points(self) -> int:
        """Return the number of points."""
        return self.grid.points

    def part(self, first: int, last: int) -> GridWork:
        """Return the work with only the axis values that points first ... last - 1 need."""
        return replace(self, grid=self.grid.part(first, last))

    def values(self, first: int, last: int) -> Arrays:
        """Return the indices at points first ... last - 1."""
        return self.subject.values(self.grid.in_radians(first, last), last - first, self.indices, self.threads)

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        return {**self._asked(), "index": [identity(i) for i in self.indices]}

    def begin(self, folder: Folder | None) -> Values:
        """Return the values that a folder has, the others to be computed."""
        return Values(self, folder)

    def _asked(self) -> dict[str, Any]:
        return {**self.subject.question(), "over": [axis.question() for axis in self.grid.axes]}

    def result(
        self,
        units: Mapping[str, str],
        unit: str = "",
        executor: Executor | None = None,
        out: str | os.PathLike[str] | None = None,
        progress: Progress | None = None,
    ) -> SweepResult:
        """Compute everything and return it with its labels; `unit` is the name of the length unit."""
        arrays = run(self, executor, out, progress).arrays
        swept = tuple(axis.name for axis in self.grid.axes)
        labelled = {name: "deg" if name.endswith(DEG) else units[name] for name in swept}
        labelled |= {i.name: i.unit for i in self.indices}
        labels = {i.dimension: np.array(i.components) for i in self.indices if i.dimension}
        return SweepResult(
            arrays=arrays,
            dims={i.name: (*swept, i.dimension) if i.dimension else swept for i in self.indices},
            coords={axis.name: axis.values() for axis in self.grid.axes} | labels,
            units={name: (unit or "length") if of == "length" else of for name, of in labelled.items()},
            attributes=plain(
                {**unit_entry(unit), **self._asked(), "index": [i.name for i in self.indices], **versions()}
            ),
        )


class Values:
    """The values of all indices, in memory or in files of a folder: one that is damaged there is computed again."""

    def __init__(self, work: GridWork, folder: Folder | None) -> None:
        """Begin with those of the folder."""
        self._chunk, self._folder, self._axes = work.chunk, folder, len(work.grid.shape)
        shapes = {i.name: (*work.grid.shape, *i.tail) for i in work.indices}
        points = " x ".join(map(str, work.grid.shape))
        size = 8 * sum(map(math.prod, shapes.values()))
        if folder is not None and not folder.saved and size > (free := folder.free()):
            room = f"their values take {size / 1e9:.3g} GB, and {free / 1e9:.3g} GB are free on the disk of out"
            raise ValueError(f"over: got {points} points, expected fewer: {room}")
        make = (lambda _, shape: np.empty(shape)) if folder is None else folder.array
        try:
            self.arrays: dict[str, Floats] = {name: make(name, shape) for name, shape in shapes.items()}
        except MemoryError:
            expected = "what fits into memory, or out for a folder"
            raise ValueError(f"over: got {points} points, expected {expected}") from None
        self.finished: NDArray[np.uint64] = np.zeros(chunks_of(work), np.uint64)
        """The checksum of each chunk."""
        noted = self.finished if folder is None else folder.saved.get(FINISHED, self.finished)
        for k in np.flatnonzero(noted):
            if _checksum(self._rows(int(k))) == noted[k]:
                self.finished[k] = noted[k]

    def add(self, first: int, arrays: Arrays) -> None:
        """Take the values of the chunk that begins with point `first`."""
        for name in self.arrays:
            values = arrays[name] = np.ascontiguousarray(arrays[name], dtype=np.float64)
            if self._folder is None:
                self.arrays[name].reshape(-1, *values.shape[1:])[first : first + len(values)] = values
            else:
                self._folder.put(name, first, values)
        self.finished[first // self._chunk] = _checksum(arrays)

    def noted(self) -> Arrays:
        """Return what the folder notes besides the values."""
        return {FINISHED: self.finished}

    def _rows(self, k: int) -> Arrays:
        """Return the values of chunk k."""
        rows = slice(k * self._chunk, (k + 1) * self._chunk)
        return {name: array.reshape(-1, *array.shape[self._axes :])[rows] for name, array in self.arrays.items()}


def _checksum(arrays: Arrays) -> np.uint64:
    """Return a checksum of values, never 0."""
    sum_ = 0
    for name in sorted(arrays):
        sum_ = zlib.crc32(np.ascontiguousarray(arrays[name]).data, sum_)
        forget(arrays[name])
    return np.uint64(sum_ | 1 << 32)
