"""Degrees where a person types or reads angles; radians everywhere else."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

DIGITS = 9  # decimals of degrees: more than a person types
DEG = "_deg"


def exact_degrees(*radians: float) -> tuple[float, ...] | None:
    """Return the short degrees that convert to exactly these radians, or None if there are none.

    A file can then show the 45 that was typed, and reading it gives the same bits.
    """
    degrees = tuple(round(math.degrees(x), DIGITS) for x in radians)
    same = all(math.radians(d) == x for d, x in zip(degrees, radians, strict=True))
    return degrees if same else None


def in_radians(given: Mapping[str, Any], checks: Mapping[str, Callable[[str, Any], Any]]) -> dict[str, Any]:
    """Return a mapping with the entries `angle`_deg in radians, under their own names; ValueError if both are given.

    `checks` has for each angle by name the check of its value: numbers in any nesting of tuples.
    """
    out = dict(given)
    for name, check in checks.items():
        if (key := name + DEG) in given:
            if name in given:
                raise ValueError(f"{name}: got both {name} and {key}, expected one of the two")
            out[name] = _radians(check(key, out.pop(key)))
    return out


def _radians(degrees: Any) -> Any:
    return tuple(map(_radians, degrees)) if isinstance(degrees, tuple) else math.radians(degrees)


def plain_name(name: str) -> str:
    """Return a name without the ending that says degrees."""
    return name.removesuffix(DEG)


def angle_entry(name: str, radians: float | tuple[float, ...]) -> tuple[str, float | tuple[float, ...]]:
    """Return key and value of a file for one or more angles: in degrees if that is exact.

    0 and infinity are the same in both, and keep the plain name.
    """
    ends = radians if isinstance(radians, tuple) else (radians,)
    degrees = exact_degrees(*ends)
    if degrees is None or all(x == 0.0 or math.isinf(x) for x in ends):
        return name, radians
    return name + DEG, degrees if isinstance(radians, tuple) else degrees[0]


def degrees_of(radians: float) -> float:
    """Return an angle in degrees: the short number that was typed, or one that converts back, where there is one."""
    exact, near = exact_degrees(radians), math.degrees(radians)
    tried = exact or (near, math.nextafter(near, math.inf), math.nextafter(near, -math.inf))
    return next((degrees for degrees in tried if math.radians(degrees) == radians), near)


def half_turn(name: str, radians: float) -> None:
    """Raise unless an angle is at most half a turn."""
    if not radians <= math.pi:
        got = f"{radians:g} radians, {degrees_of(radians):g} degrees"
        raise ValueError(f"{name}: got {got}, expected at most pi, 180 degrees (degrees are given as {name}{DEG})")
