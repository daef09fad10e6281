"""The work of a sweep: a grid, the robots at its points, and the indices computed there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ninedof.chunks import Arrays, run
from ninedof.design.index_argument import identity
from ninedof.design.indices import Index
from ninedof.support.angles import DEG
from ninedof.support.arrays import Floats
from ninedof.support.json import plain
from ninedof.support.units import unit_entry
from ninedof.support.versions import versions
from ninedof.sweep.axis import Grid
from ninedof.sweep.result import SweepResult
from ninedof.sweep.sink import Sink


class Subject(Protocol):
    """The robots at the points of a grid."""

    def values(self, at: dict[str, Floats], count: int, indices: tuple[Index, ...], threads: int | None) -> Arrays:
        """Return the indices at n points, given by the value of each swept variable."""

    def question(self) -> dict[str, Any]:
        """Return what the values depend on, as plain JSON values."""


@dataclass(frozen=True, eq=False)
class GridTask:
    """The indices at points first ... last - 1."""

    subject: Subject
    grid: Grid
    indices: tuple[Index, ...]
    first: int
    last: int
    threads: int | None

    def __call__(self) -> Arrays:
        """Compute them."""
        at = self.grid.in_radians(self.first, self.last)
        return self.subject.values(at, self.last - self.first, self.indices, self.threads)


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

    def task(self, first: int, last: int) -> GridTask:
        """Return the work on points first ... last - 1, with only the axis values that it needs."""
        return GridTask(self.subject, self.grid.part(first, last), self.indices, first, last, self.threads)

    def fits(self, count: int, arrays: Arrays) -> bool:
        """Return whether arrays are those of so many points."""
        shapes = {i.name: (count, *i.tail) for i in self.indices}
        return shapes == {name: array.shape for name, array in arrays.items()} and all(
            array.dtype.kind in "biuf" for array in arrays.values()
        )

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        return {**self._points(), "index": [identity(i) for i in self.indices]}

    def _points(self) -> dict[str, Any]:
        return {**self.subject.question(), "over": [axis.question() for axis in self.grid.axes]}

    def result(self, units: Mapping[str, str], unit: str = "", **options: Any) -> SweepResult:
        """Compute everything and return it with its labels; options as of `chunks.run`.

        `unit` is the name of the length unit, in the place of "length".
        """
        sink = Sink(self.indices, self.grid.shape)
        try:
            run(self, sink.begin, **options)
        except BaseException:
            sink.discard()
            raise
        swept = tuple(axis.name for axis in self.grid.axes)
        labelled = {name: "deg" if name.endswith(DEG) else units[name] for name in swept}
        labelled |= {i.name: i.unit for i in self.indices}
        labels = {i.dimension: np.array(i.components) for i in self.indices if i.dimension}
        return SweepResult(
            arrays=sink.arrays(),
            dims={i.name: (*swept, i.dimension) if i.dimension else swept for i in self.indices},
            coords={axis.name: axis.values() for axis in self.grid.axes} | labels,
            units={name: (unit or "length") if of == "length" else of for name, of in labelled.items()},
            attributes=plain(
                {**unit_entry(unit), **self._points(), "index": [i.name for i in self.indices], **versions()}
            ),
        )
