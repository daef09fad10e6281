"""Designs of the hexagonal family by number: design k does not depend on the chunk it is in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.support.arrays import Floats

BOUNDS: dict[str, tuple[float, float]] = {
    **dict.fromkeys(("a1", "a2", "b1", "b2"), (0.0, 10.0)),
    "zp": (0.05, 10.0),
    "zs_fraction": (0.0, 1.0),
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
    values: Floats = _core.hexagonal_condition_numbers(designs, 1, None)
    return values.reshape(-1)


def squared_radius_ratio(designs: Floats) -> Floats:
    """Return (base / platform radius)^2; the joints of a hexagon are sqrt((a1^2 + a1 a2 + a2^2) / 3) off the axis."""
    a1, a2, b1, b2 = designs.T[:4]
    with np.errstate(all="ignore"):  # plates of size 0, or so small or large that squares are not numbers
        ratio: Floats = (a1 * a1 + a1 * a2 + a2 * a2) / (b1 * b1 + b1 * b2 + b2 * b2)
    return ratio
