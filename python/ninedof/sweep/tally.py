"""The tally of a survey: a histogram of the designs, and the best one of each radius ratio."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arrays import Floats
from ninedof.support.files import Arrays

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
