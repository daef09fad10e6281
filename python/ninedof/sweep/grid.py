"""The work of a sweep: a grid, the robots at its points, and the indices computed there."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ninedof.design.indices import Index, identity
from ninedof.support.arrays import Floats, blocks
from ninedof.support.extras import versions
from ninedof.support.kept.chunks import computed
from ninedof.support.kept.files import Arrays, naming, part_name
from ninedof.support.kept.store import Store
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
        size = 2 * 8 * sum(map(math.prod, shapes.values()))  # the finished chunks, and the arrays
        if not store.kept() and size > (free := _free(store.folder)):
            room = f"their values take {size / 1e9:.4g} GB, and {free / 1e9:.3g} GB are free on the disk of out"
            raise ValueError(f"over: got {points} points, expected fewer: {room}")
        files = {name: store.folder / f"{name}.npy" for name in shapes}
        parts = {name: file.with_name(part_name(file.name)) for name, file in files.items()}
        try:
            yield {name: _file_array(parts[name], files[name], shape) for name, shape in shapes.items()}
            for name, part in parts.items():
                os.replace(part, files[name])
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
            attributes=json_values(
                {**unit_entry(unit), **self._arguments(), "index": [i.name for i in self.indices], **versions()}
            ),
        )


def _file_array(part: Path, file: Path, shape: tuple[int, ...]) -> Floats:
    """Return an array in a new file. Zeros take its room on the disk, which must not be full behind a memory map."""
    try:
        array = np.lib.format.open_memmap(part, "w+", np.float64, shape)
        with part.open("r+b") as opened:
            opened.seek(array.offset)
            for _, piece in blocks(array):
                opened.write(piece.tobytes())
    except OSError as error:
        raise naming(error, file) from None
    return array


def _free(folder: Path) -> float:
    """Return the bytes that are free on a disk; infinity where it does not say."""
    import shutil  # when it is needed, as it takes time to load

    with suppress(OSError):
        return disk.free if (disk := shutil.disk_usage(folder)).total else math.inf
    return math.inf
