"""What long work is made of."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Arrays", "Task", "Work"]

Arrays = dict[str, NDArray[Any]]
"""What a chunk leaves: named arrays."""


class Task(Protocol):
    """A chunk to compute: small, picklable, and the same arrays whenever and wherever it is called."""

    def __call__(self) -> Arrays:
        """Compute it."""
        ...


class Work(Protocol):
    """Points 0 ... points - 1, cut into chunks of `chunk` points; the last may be smaller."""

    @property
    def points(self) -> int:
        """Return how many there are."""

    @property
    def chunk(self) -> int:
        """Return how many a chunk has."""

    def task(self, first: int, last: int) -> Task:
        """Return the work on points first ... last - 1."""

    def question(self) -> dict[str, Any]:
        """Return all that the arrays depend on, as plain JSON values."""


def bounds(work: Work, k: int) -> tuple[int, int]:
    """Return the first point of chunk k and the one behind its last."""
    return k * work.chunk, min((k + 1) * work.chunk, work.points)


def chunks_of(work: Work) -> int:
    """Return the number of chunks."""
    return -(-work.points // work.chunk)


def as_arrays(value: Any) -> Arrays:
    """Return what a task left as C-contiguous arrays."""
    return {name: np.ascontiguousarray(array) for name, array in value.items()}
