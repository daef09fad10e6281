"""The designs of a survey by number, so that design k does not depend on the chunk it is in, and their tally."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import Arrays

RADIUS_RATIO, ZS_FRACTION = "radius_ratio", "zs_fraction"  # the size of a base, a variable in place of zs
BOUNDS: dict[str, tuple[float, float]] = {
    **dict.fromkeys(("a1", "a2", "b1", "b2"), (0.0, 10.0)),
    "zp": (0.05, 10.0),
    ZS_FRACTION: (0.0, 1.0),
}
"""In characteristic lengths; zs is a fraction of zp, since 0 < zs < zp (eq. 9b)."""

# The powers -1 ... -6 of the root of x^7 = x + 1, times 2^64: the additive recurrence that fills six dimensions evenly.
STEPS = (
    0xE60E2B722B53AEEC,
    0xCEBD76D9EDB6A8EF,
    0xB9C9AA3A51D00B65,
    0xA6F5777F6F889840,
    0x9609C71EB7D03F7A,
    0x86D516E50B04AB1B,
)
TO_UNIT = 2.0**-53


@dataclass(frozen=True)
class Sample:
    """A low-discrepancy sequence of designs within bounds; the seed shifts it.

    Computed in whole numbers modulo 2^64, so that it is as even after 10^12 designs as after ten.
    """

    seed: int
    bounds: tuple[tuple[float, float], ...] = tuple(BOUNDS.values())
    """Of a1, a2, b1, b2, zp and zs / zp."""

    def designs(self, first: int, last: int) -> Floats:
        """Return designs first ... last - 1, shape (n, 6): a1 a2 b1 b2 zp zs."""
        return self.at(np.arange(first, last, dtype=np.uint64))

    def at(self, numbers: NDArray[np.uint64]) -> Floats:
        """Return designs by number."""
        shift = np.random.SeedSequence(self.seed).generate_state(len(STEPS), np.uint64)
        out = np.empty((len(numbers), len(STEPS)))
        for k, (low, high) in enumerate(self.bounds):
            unit = ((numbers * np.uint64(STEPS[k]) + shift[k]) >> np.uint64(11)) * TO_UNIT
            np.add(unit * (high - low), low, out=out[:, k])
        out[:, 5] *= out[:, 4]
        return out

    def question(self) -> dict[str, Any]:
        """Return what the designs depend on."""
        return {"seed": self.seed, "bounds": dict(zip(BOUNDS, self.bounds, strict=True))}


def closed_form(designs: Floats) -> Floats:
    """Return the condition number at the neutral pose of designs (n, 6), lengths in characteristic lengths."""
    return _core.hexagonal_condition_numbers(designs, 1, None).reshape(-1)


def squared_radius_ratio(designs: Floats) -> Floats:
    """Return (base / platform radius)^2; the joints of a hexagon are sqrt((a1^2 + a1 a2 + a2^2) / 3) off the axis."""
    a1, a2, b1, b2 = designs.T[:4]
    with np.errstate(all="ignore"):  # plates of size 0, or so small or large that squares are not numbers
        ratio: Floats = (a1 * a1 + a1 * a2 + a2 * a2) / (b1 * b1 + b1 * b2 + b2 * b2)
    return ratio


OCTAVES, PER_OCTAVE = 4, 16  # base / platform from 1/16 to 16; 2, the paper's limit, is an edge
DECADES, PER_DECADE = 4, 40  # condition numbers from 1 to 10^4
ROWS = 2 * OCTAVES * PER_OCTAVE + 2
COLUMNS = DECADES * PER_DECADE + 1


def ratio_edges() -> Floats:
    """Return the lower ends of the bins of radius_ratio; the first bin is below 1/16, the last from 16 on."""
    return np.concatenate([[0.0], np.exp2(np.arange(ROWS - 1) / PER_OCTAVE - OCTAVES)])


def condition_edges() -> Floats:
    """Return the lower ends of the bins of the condition number; the last is from 10^4 on, singular designs too."""
    return np.power(10.0, np.arange(COLUMNS) / PER_DECADE)


@dataclass(eq=False)
class Tally:
    """Counts, and the best design of each bin of radius_ratio; without arrays that of no designs.

    Two tallies add up to the same whatever the order: counts are whole numbers, and of designs equally good the one
    with the least number is kept.
    """

    histogram: NDArray[np.int64] = field(default_factory=lambda: np.zeros((ROWS, COLUMNS), dtype=np.int64))
    best: Floats = field(default_factory=lambda: np.full(ROWS, np.inf))
    number: NDArray[np.int64] = field(default_factory=lambda: np.full(ROWS, -1, dtype=np.int64))

    def add(self, first: int, squared_ratio: Floats, kappa: Floats) -> None:
        """Add designs first, first + 1, ...: their numbers are above all those added before."""
        with np.errstate(divide="ignore"):
            row = _bin(np.log2(squared_ratio), PER_OCTAVE / 2.0, OCTAVES * PER_OCTAVE + 1, ROWS - 1)
            column = _bin(np.log10(kappa), PER_DECADE, 0, COLUMNS - 1)
        self.histogram += np.bincount(row * COLUMNS + column, minlength=ROWS * COLUMNS).reshape(ROWS, COLUMNS)
        better = np.flatnonzero(kappa < self.best[row])
        better = better[np.lexsort((better, kappa[better], row[better]))]
        rows, where = np.unique(row[better], return_index=True)
        self.best[rows] = kappa[better[where]]
        self.number[rows] = first + better[where]

    def plus(self, other: Tally) -> Tally:
        """Return the tally of both."""
        tie = (other.best == self.best) & (other.number < self.number) & (other.number >= 0)
        better = (other.best < self.best) | tie
        return Tally(
            self.histogram + other.histogram,
            np.where(better, other.best, self.best),
            np.where(better, other.number, self.number),
        )

    def arrays(self) -> Arrays:
        """Return its arrays."""
        return dict(vars(self))


def _bin(value: Floats, per_unit: float, zero: int, most: int) -> NDArray[np.intp]:
    """Return the bin of each value: the outermost beyond both ends, the last for NaN."""
    inside = np.fmax(np.fmin(np.floor(value * per_unit) + zero, float(most)), 0.0)
    return np.asarray(inside, dtype=np.intp)
