"""What long work is made of: points, cut into chunks, and a task for each chunk."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from ninedof.support.arguments import whole
from ninedof.support.files import Arrays

MOST_CHUNK = 2**24  # points


class Task(Protocol):
    """One chunk to compute: small, picklable, and the same arrays whenever and wherever it is called."""

    def __call__(self) -> Arrays:
        """Compute it."""
        ...


class Work(Protocol):
    """Points 0 ... points - 1 in chunks of `chunk` points; the last may be smaller."""

    @property
    def points(self) -> int:
        """Return the number of points."""

    @property
    def chunk(self) -> int:
        """Return the number of points of a chunk."""

    def task(self, first: int, last: int) -> Task:
        """Return the work on points first ... last - 1."""

    def fits(self, count: int, arrays: Arrays) -> bool:
        """Return whether arrays are those of so many points: what is kept is looked at before it is taken."""

    def question(self) -> dict[str, Any]:
        """Return all that the arrays depend on, but for the version of this package, as plain JSON values."""


def chunk_argument(chunk: object, default: int) -> int:
    """Return the number of points of a chunk."""
    return default if chunk is None else whole("chunk", chunk, 1, MOST_CHUNK)


def bounds(work: Work, k: int) -> tuple[int, int]:
    """Return the first point of chunk k and the one after its last."""
    return k * work.chunk, min((k + 1) * work.chunk, work.points)


def chunks_of(work: Work) -> int:
    """Return the number of chunks."""
    return -(-work.points // work.chunk)


def as_arrays(value: Any) -> Arrays:
    """Return the result of a task as C-contiguous arrays."""
    return {name: np.ascontiguousarray(array) for name, array in value.items()}
