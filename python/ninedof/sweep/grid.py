"""The work of a sweep: a grid, the robots at its points, and the indices computed there."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ninedof.design.indices import Index, identity
from ninedof.support.angles import DEG
from ninedof.support.arrays import Floats, forget
from ninedof.support.extras import versions
from ninedof.support.files import Arrays, part_name
from ninedof.support.json import plain
from ninedof.support.progress import Progress
from ninedof.support.store import Store
from ninedof.support.units import unit_entry
from ninedof.sweep.axis import Grid
from ninedof.sweep.chunks import computed
from ninedof.sweep.result import SweepResult

if TYPE_CHECKING:
    from concurrent.futures import Executor


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
        return {**self._arguments(), "index": [identity(i) for i in self.indices]}

    def _arguments(self) -> dict[str, Any]:
        return {**self.subject.question(), "over": [axis.question() for axis in self.grid.axes]}

    @contextmanager
    def _arrays(self, store: Store | None) -> Iterator[dict[str, Floats]]:
        """Yield an array for each index, to be filled: in memory, or in files that then take their names."""
        shapes = {i.name: (*self.grid.shape, *i.tail) for i in self.indices}
        points = " x ".join(map(str, self.grid.shape))
        if store is None:
            try:
                arrays = {name: np.empty(shape) for name, shape in shapes.items()}
            except MemoryError:
                expected = "what fits into memory, or out for a folder"
                raise ValueError(f"over: got {points} points, expected {expected}") from None
            yield arrays
            return
        parts = {name: store.folder / part_name(f"{name}.npy") for name in shapes}
        try:
            try:
                arrays = {name: _file_array(parts[name], shape) for name, shape in shapes.items()}
            except OSError as error:
                room = f"{8 * sum(map(math.prod, shapes.values())) / 1e9:.4g} GB for their values on the disk of out"
                raise ValueError(f"over: got {points} points, expected fewer: {room}: {error.strerror}") from None
            yield arrays
            for name, part in parts.items():
                os.replace(part, store.folder / f"{name}.npy")
        finally:
            for part in parts.values():
                part.unlink(missing_ok=True)

    def result(
        self,
        units: Mapping[str, str],
        unit: str = "",
        executor: Executor | None = None,
        out: str | os.PathLike[str] | None = None,
        progress: Progress | None = None,
    ) -> SweepResult:
        """Compute everything and return it with its labels; `unit` is the name of the length unit."""
        with computed(self, out, executor, progress) as (store, chunks):
            with self._arrays(store) as arrays:
                for (first, last), values in chunks:
                    for name, array in arrays.items():
                        array.reshape(-1, *values[name].shape[1:])[first:last] = values[name]
                        forget(array)
            if store is not None:
                arrays = {name: np.load(store.folder / f"{name}.npy", mmap_mode="r") for name in arrays}
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
                {**unit_entry(unit), **self._arguments(), "index": [i.name for i in self.indices], **versions()}
            ),
        )


def _file_array(part: Path, shape: tuple[int, ...]) -> Floats:
    """Return an array in a new file that has its room on the disk: a disk that fills up later ends the process."""
    array: Floats = np.lib.format.open_memmap(part, "w+", np.float64, shape)
    with part.open("r+b") as file:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(file.fileno(), 0, part.stat().st_size)
    return array
