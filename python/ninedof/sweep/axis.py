"""The axes and the grid of a sweep, and the part of the grid that a chunk needs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof.support.arguments import choice, finite, is_number, shown, whole
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.units import DEG, plain_name

Values = ArrayLike | tuple[float, float, int]
"""Values along an axis, or (low, high, count) for evenly spaced ones."""

MOST_AXES = 3
MOST = 2**40  # points along an axis: beyond it positions between 0 and 1 would lose digits


@dataclass(frozen=True, eq=False)
class Axis:
    """Values along one axis: explicit, or `count` of them from `low` to `high`."""

    name: str
    count: int
    low: float = 0.0
    high: float = 0.0
    explicit: Floats | None = None
    """Values `start`, `start` + 1, ...; None for evenly spaced ones."""
    start: int = 0
    """Number of the first explicit value on the axis: a chunk has only the values that it needs."""

    def at(self, k: NDArray[np.intp]) -> Floats:
        """Return the values of numbers 0 ... count - 1; both ends are met exactly."""
        if self.explicit is not None:
            return self.explicit[k - self.start]
        t = k / (self.count - 1) if self.count > 1 else np.zeros(k.shape)
        return self.low * (1.0 - t) + self.high * t

    def values(self) -> Floats:
        """Return all values."""
        return self.at(np.arange(self.count))

    def only(self, first: int, last: int) -> Axis:
        """Return an axis with values first ... last - 1 only."""
        if self.explicit is None:
            return self
        return Axis(self.name, self.count, explicit=self.explicit[first:last].copy(), start=first)

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        if self.explicit is not None:
            return {"name": self.name, "values": self.explicit}
        return {"name": self.name, "low": self.low, "high": self.high, "count": self.count}


@dataclass(frozen=True, eq=False)
class Grid:
    """All combinations of the values of one to three axes, the last axis running fastest."""

    axes: tuple[Axis, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Return the number of values along each axis."""
        return tuple(axis.count for axis in self.axes)

    @property
    def points(self) -> int:
        """Return the number of combinations."""
        return math.prod(self.shape)

    def part(self, first: int, last: int) -> Grid:
        """Return a grid with the values of points first ... last - 1 only, small to send."""
        row = math.prod(self.shape[1:])
        head = self.axes[0].only(first // row, (last - 1) // row + 1)
        return Grid((head, *self.axes[1:]))

    def at(self, first: int, last: int) -> dict[str, Floats]:
        """Return the values of points first ... last - 1 by the axis's name."""
        numbers = np.unravel_index(np.arange(first, last), self.shape)
        return {axis.name: axis.at(k) for axis, k in zip(self.axes, numbers, strict=True)}

    def in_radians(self, first: int, last: int) -> dict[str, Floats]:
        """Return the same with angles in radians, under their plain names."""
        at = self.at(first, last).items()
        return {plain_name(n): np.radians(values) if n.endswith(DEG) else values for n, values in at}


def axes_of(over: Any, known: Sequence[str], angles: Iterable[str] = ()) -> Grid:
    """Check the argument `over` and return its grid; an angle may be swept in degrees, with _deg behind its name."""
    expected = f"a mapping of one to {MOST_AXES} names to values"
    if not isinstance(over, Mapping) or not 1 <= len(over) <= MOST_AXES:
        raise ValueError(f"over: got {shown(over)}, expected {expected}")
    degrees = {angle + DEG for angle in angles}
    names = [*known, *(name for name in over if name in degrees)]  # in messages the plain ones are enough
    grid = Grid(tuple(_axis(choice("over", name, names), values) for name, values in over.items()))
    for name in degrees & set(over):
        if plain_name(name) in over:
            raise ValueError(f"over: got both {plain_name(name)} and {name}, expected one of the two")
    if grid.points > MOST:
        raise ValueError(f"over: got {' x '.join(map(str, grid.shape))} points, expected at most {MOST}")
    return grid


def _axis(name: str, values: Any) -> Axis:
    if isinstance(values, tuple):
        if len(values) != 3 or not is_number(values[2]):
            raise ValueError(
                f"over[{name!r}]: got {shown(values)}, expected an array of values, or (low, high, count) for a range"
            )
        low, high = (finite(f"over[{name!r}]", end) for end in values[:2])
        count = whole(f"over[{name!r}]: count", values[2], 1, MOST)
        if count == 1 and low != high:
            raise ValueError(f"over[{name!r}]: got {shown(values)}, expected a count of 2 at least, or low = high")
        return Axis(name, count, low, high)
    explicit = as_floats(f"over[{name!r}]", values, ())
    if explicit.ndim != 1 or not explicit.size or not np.isfinite(explicit).all():
        raise ValueError(f"over[{name!r}]: got {shown(values)}, expected finite values of shape (n,)")
    return Axis(name, explicit.size, explicit=explicit)
