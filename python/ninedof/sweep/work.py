"""The work of a sweep: a grid, what its points stand for, and what is computed there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.chunks import Arrays
from ninedof.support.arrays import Floats
from ninedof.sweep.axis import Grid
from ninedof.sweep.index import Index, identity
from ninedof.sweep.result import SweepResult

__all__ = ["GridTask", "GridWork", "Subject", "versions"]


class Subject(Protocol):
    """What the points of a grid stand for."""

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
        at = self.grid.at(self.first, self.last)
        return self.subject.values(at, self.last - self.first, self.indices, self.threads)


@dataclass(frozen=True, eq=False)
class GridWork:
    """All of it."""

    subject: Subject
    grid: Grid
    indices: tuple[Index, ...]
    chunk: int
    threads: int | None = None

    @property
    def points(self) -> int:
        """Return how many there are."""
        return self.grid.points

    def task(self, first: int, last: int) -> GridTask:
        """Return the work on points first ... last - 1, with no more of the axes than it needs."""
        return GridTask(self.subject, self.grid.part(first, last), self.indices, first, last, self.threads)

    def question(self) -> dict[str, Any]:
        """Return what the values depend on. The version is part of it: chunks of two versions do not mix."""
        return {
            **self.subject.question(),
            "over": [axis.question() for axis in self.grid.axes],
            "index": [identity(i) for i in self.indices],
            "ninedof": _core.version,
        }

    def labelled(self, arrays: Mapping[str, NDArray[Any]], units: Mapping[str, str]) -> SweepResult:
        """Return the arrays with their labels."""
        swept = tuple(axis.name for axis in self.grid.axes)
        dims = {i.name: (*swept, i.dimension) if i.dimension else swept for i in self.indices}
        labels = {i.dimension: np.array(i.labels) for i in self.indices if i.dimension}
        return SweepResult(
            arrays=arrays,
            dims=dims,
            coords={axis.name: axis.values() for axis in self.grid.axes} | labels,
            units={name: units[name] for name in swept} | {i.name: i.unit for i in self.indices},
            attributes={**self.subject.question(), "index": [i.name for i in self.indices], **versions()},
        )


def versions() -> dict[str, str]:
    """Return the versions the values depend on."""
    return {"ninedof": _core.version, "numpy": np.__version__}
