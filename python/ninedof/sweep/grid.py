"""The work of a sweep: a grid, the robots at its points, and the indices computed there."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ninedof.design.indices import Index, identity
from ninedof.support.arrays import Floats
from ninedof.support.extras import versions
from ninedof.support.kept.chunks import Computed, computed
from ninedof.support.kept.files import Arrays, naming, part_name
from ninedof.support.running import Progress
from ninedof.support.text import json_values
from ninedof.support.units import DEG, unit_entry
from ninedof.sweep.axis import Grid
from ninedof.sweep.result import SweepResult

if TYPE_CHECKING:
    from concurrent.futures import Executor


class Subject(Protocol):
    """The robots at the points of a grid."""

    def values(self, at: dict[str, Floats], indices: tuple[Index, ...], threads: int | None) -> Arrays:
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
        return self.subject.values(self.grid.in_radians(first, last), self.indices, self.threads)

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        return {**self._arguments(), "index": [identity(i) for i in self.indices]}

    def _arguments(self) -> dict[str, Any]:
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
        with computed(self, out, executor, progress) as (store, chunks):
            shapes = {i.name: (*self.grid.shape, *i.tail) for i in self.indices}
            arrays = (
                _in_memory(chunks, shapes, self.points) if store is None else _in_files(chunks, shapes, store.folder)
            )
        swept = tuple(axis.name for axis in self.grid.axes)
        labelled = {name: "deg" if name.endswith(DEG) else units[name] for name in swept}
        labelled |= {i.name: i.unit for i in self.indices}
        labels = {i.dimension: np.array(i.components) for i in self.indices if i.dimension}
        return SweepResult(
            arrays=arrays,
            dims={i.name: (*swept, i.dimension) if i.dimension else swept for i in self.indices},
            coords={axis.name: axis.values() for axis in self.grid.axes} | labels,
            units={name: (unit or "length") if of == "length" else of for name, of in labelled.items()},
            attributes=json_values(
                {**unit_entry(unit), **self._arguments(), "index": [i.name for i in self.indices], **versions()}
            ),
        )


def _in_memory(chunks: Computed, shapes: Mapping[str, tuple[int, ...]], points: int) -> dict[str, Floats]:
    """Return an array for each index, filled by chunks."""
    try:
        arrays = {name: np.empty(shape) for name, shape in shapes.items()}
    except MemoryError:
        raise ValueError(f"over: got {points} points, expected what fits into memory, or out for a folder") from None
    for (first, last), values in chunks:
        for name, array in arrays.items():
            array.reshape(-1, *values[name].shape[1:])[first:last] = values[name]
    return arrays


def _write_at(path: Path, place: int, content: bytes) -> None:
    try:
        with path.open("r+b") as file:
            file.seek(place)
            file.write(content)
    except OSError as error:
        raise naming(error, path) from None


def _in_files(chunks: Computed, shapes: Mapping[str, tuple[int, ...]], folder: Path) -> dict[str, Floats]:
    """Return the same arrays from files, which take their names once they are whole: memory holds one chunk."""
    parts = {name: folder / part_name(f"{name}.npy") for name in shapes}
    try:
        heads = {n: np.lib.format.open_memmap(parts[n], "w+", np.float64, shape).offset for n, shape in shapes.items()}
        for (first, _), values in chunks:
            for name, head in heads.items():  # written, not mapped: a full disk is an error and not a crash
                _write_at(parts[name], head + first * values[name][0].nbytes, values[name].tobytes())
        for name, part in parts.items():
            os.replace(part, folder / f"{name}.npy")
    finally:
        for part in parts.values():
            part.unlink(missing_ok=True)
    return {name: np.load(folder / f"{name}.npy", mmap_mode="r") for name in shapes}
