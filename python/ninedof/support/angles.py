"""Degrees where a person types or reads angles; radians everywhere else."""

from __future__ import annotations

import math
from typing import Any

from ninedof.support.arguments import Vector, vector

DIGITS = 9  # decimals of degrees: more than a person types


def exact_degrees(*radians: float) -> tuple[float, ...] | None:
    """Return the short degrees that convert to exactly these radians, or None if there are none.

    A file can then show the 45 that was typed, and reading it gives the same bits.
    """
    degrees = tuple(round(math.degrees(x), DIGITS) for x in radians)
    same = all(math.radians(d) == x for d, x in zip(degrees, radians, strict=True))
    return degrees if same else None


def vector_argument(name: str, radians: Any, degrees: Any, least: float = -math.inf) -> Vector:
    """Return three angles in radians, given as `name` or, in degrees, as `name`_deg; zero by default."""
    if radians is not None and degrees is not None:
        raise ValueError(f"{name}: got both {name} and {name}_deg, expected one of the two")
    if degrees is not None:
        x, y, z = vector(f"{name}_deg", degrees, least)
        return math.radians(x), math.radians(y), math.radians(z)
    return (0.0, 0.0, 0.0) if radians is None else vector(name, radians, least)


def rotation_entry(name: str, radians: Vector) -> dict[str, list[float]]:
    """Return the entry of a file for three angles, in degrees if that is exact."""
    degrees = exact_degrees(*radians)
    return {name: list(radians)} if degrees is None else {f"{name}_deg": list(degrees)}
