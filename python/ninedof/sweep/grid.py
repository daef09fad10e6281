"""The work of a sweep: a grid, the robots at its points, and the indices computed there."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ninedof.design.indices import Index, identity
from ninedof.support.angles import DEG
from ninedof.support.arrays import Floats
from ninedof.support.extras import versions
from ninedof.support.files import Arrays, naming, part_name
from ninedof.support.json import plain
from ninedof.support.progress import Progress
from ninedof.support.store import Store
from ninedof.support.units import unit_entry
from ninedof.sweep.axis import Grid
from ninedof.sweep.chunks import computed, opened
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

    def _targets(self, store: Store | None, unfinished: ExitStack) -> dict[str, Target]:
        """Return an array for each index, in memory or in files of the folder; files that stay unfinished go."""
        shapes = {i.name: (*self.grid.shape, *i.tail) for i in self.indices}
        points = " x ".join(map(str, self.grid.shape))
        size = 2 * 8 * sum(map(math.prod, shapes.values()))  # the finished chunks, and the arrays
        folder = None if store is None else store.folder
        if store is not None and not store.kept() and size > (free := _free(store.folder)):
            room = f"their values take {size / 1e9:.4g} GB, and {free / 1e9:.3g} GB are free on the disk of out"
            raise ValueError(f"over: got {points} points, expected fewer: {room}")
        try:
            targets = {}
            for name, shape in shapes.items():
                targets[name] = Target(name, shape, folder)
                unfinished.callback(targets[name].discard)
            return targets
        except MemoryError:
            expected = "what fits into memory, or out for a folder"
            raise ValueError(f"over: got {points} points, expected {expected}") from None

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
        with opened(self, out) as (work, store):
            chunks = computed(work, store, executor, progress)
            with ExitStack() as unfinished:
                targets = work._targets(store, unfinished)
                for chunk, values in chunks:
                    for name, target in targets.items():
                        target.put(chunk.first, values[name])
                arrays = {name: target.array() for name, target in targets.items()}
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


class Target:
    """An array that chunks fill: in memory, or in a file that takes none."""

    def __init__(self, name: str, shape: tuple[int, ...], folder: Path | None) -> None:
        """Make it, without values."""
        self._path = None if folder is None else folder / f"{name}.npy"
        if folder is None or self._path is None:
            self._array = np.empty(shape)
            return
        self._part = folder / part_name(self._path.name)
        try:
            self._offset = np.lib.format.open_memmap(self._part, "w+", np.float64, shape).offset
            self._file = self._part.open("r+b")
        except OSError as error:
            self._part.unlink(missing_ok=True)
            raise naming(error, self._path) from None

    def put(self, first: int, values: Floats) -> None:
        """Take the values of points from `first` on."""
        if self._path is None:
            self._array.reshape(-1, *values.shape[1:])[first : first + len(values)] = values
            return
        try:  # a memory map would fill the memory, and a full disk end the process
            self._file.seek(self._offset + first * (values.nbytes // len(values)))
            self._file.write(np.ascontiguousarray(values).data)
            self._file.flush()
        except OSError as error:
            raise naming(error, self._path) from None

    def array(self) -> Floats:
        """Return the full array; one in a file takes its name, and is read as it is needed."""
        if self._path is None:
            return self._array
        self._file.close()
        os.replace(self._part, self._path)
        mapped: Floats = np.load(self._path, mmap_mode="r")
        return mapped

    def discard(self) -> None:
        """Remove the file of an array that is not full."""
        if self._path is not None:
            with suppress(OSError):
                self._file.close()
            self._part.unlink(missing_ok=True)


def _free(folder: Path) -> float:
    """Return the bytes that are free on a disk; infinity where it does not say."""
    import shutil  # when it is needed, as it takes time to load

    with suppress(OSError):
        disk = shutil.disk_usage(folder)
        if disk.total:
            return disk.free
    return math.inf
