"""Degrees where a person types or reads angles; radians everywhere else."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from ninedof.support.arguments import Vector, is_number, number, pair, vector

DIGITS = 9  # decimals of degrees: more than a person types
DEG = "_deg"


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


def in_radians(where: str, given: Mapping[str, Any], angles: Iterable[str]) -> dict[str, Any]:
    """Return a mapping with the entries `angle`_deg of numbers or pairs of numbers in radians, under their own names.

    Raises
    ------
    ValueError
        If an angle is given both ways; the message names both.

    """
    keys = {name + DEG: name for name in angles}
    found: dict[str, Any] = {}
    for key, value in given.items():
        if key not in keys:
            found[key] = value
            continue
        if keys[key] in given:
            raise ValueError(f"{where}: got both {keys[key]} and {key}, expected one of the two")
        found[keys[key]] = _radians(value, key)
    return found


def _radians(value: Any, name: str) -> Any:
    if is_number(value):
        return math.radians(number(name, value))
    low, high = (number(name, end) for end in pair(name, value, "a number of degrees, or (low, high)"))
    if not low <= high:
        raise ValueError(f"{name}: got [{low:g}, {high:g}], expected low <= high, in degrees")
    return math.radians(low), math.radians(high)


def plain_name(name: str) -> str:
    """Return a name without the ending that says degrees."""
    return name.removesuffix(DEG)


def angle_entry(name: str, radians: float | tuple[float, float]) -> tuple[str, float | list[float]]:
    """Return key and value of a file for an angle or its bounds: in degrees if that is exact.

    0 and infinity are the same in both, and keep the plain name.
    """
    ends = radians if isinstance(radians, tuple) else (radians,)
    degrees = exact_degrees(*ends)
    if degrees is None or all(x == 0.0 or math.isinf(x) for x in ends):
        return name, list(ends) if isinstance(radians, tuple) else radians
    return name + DEG, list(degrees) if isinstance(radians, tuple) else degrees[0]


def degrees_of(radians: float) -> float:
    """Return an angle in degrees: the short number that was typed, or one that converts back, where there is one."""
    exact, near = exact_degrees(radians), math.degrees(radians)
    tried = exact or (near, math.nextafter(near, math.inf), math.nextafter(near, -math.inf))
    return next((degrees for degrees in tried if math.radians(degrees) == radians), near)
