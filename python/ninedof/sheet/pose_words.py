"""A configuration in words."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.support.units import amount


def pose_words(c: Configuration, neutral_rotation: Floats, unit: str = "") -> str:
    """Return position, place of O and the angle turned from the neutral pose."""
    # The arc tangent is exact for small angles too.
    turn = c.rotation @ neutral_rotation.T
    skew = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    angle = math.degrees(math.atan2(float(np.linalg.norm(skew)), 0.5 * (float(np.trace(turn)) - 1.0)))
    p, o = (amount(vector_words(point), unit) for point in (c.position, c.internal_point))
    return f"p = {p}, O = {o}, turned {angle:.2f}° from neutral"


def vector_words(values: Iterable[float]) -> str:
    """Return numbers in brackets; rounding at zero is not shown."""
    return "(" + ", ".join(f"{round(float(x), 9) + 0.0:g}" for x in values) + ")"


def decimals_of(*arrays: Floats) -> int:
    """Return how many decimals show four digits of the largest number."""
    size = max(float(np.abs(array[np.isfinite(array)]).max(initial=0.0)) for array in arrays)
    return max(0, 3 - math.floor(math.log10(size))) if size > 0.0 else 0


def fixed(value: float, decimals: int) -> str:
    """Return a number with as many decimals as all of a table, 0 where nothing is left of it."""
    text = f"{value:.{decimals}f}"
    return text if text.strip("-0.") else "0"
