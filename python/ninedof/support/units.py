"""Units of what is typed and shown: the name of the length unit, a label; degrees, with radians everywhere else."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from ninedof.support.arguments import choice, did_you_mean, shown

UNITS = ("mm", "cm", "m", "in", "ft")
METRES = {"mm": (1, 1000), "cm": (1, 100), "m": (1, 1), "in": (254, 10000), "ft": (3048, 10000), "": (1, 1)}
"""A unit in metres as a fraction, so that 850 mm is 0.85 and not 0.8500000000000001; none is taken as it is."""
SCALES = ("length", "zp")
"""Of shifts of poses: the length unit, or the height zp of the design."""

AT_TOP = 'the length unit is named at the top of the file, before the tables: unit = "mm"'
IN_OBJECTIVE = 'the scale of pose shifts is named in the objective: [objective] unit = "zp"'


def unit_argument(value: Any) -> str:
    """Return the name of a length unit, "" for None or ""."""
    if value is None or (isinstance(value, str) and value == ""):
        return ""
    if isinstance(value, str) and value in UNITS:
        return value
    hint = ""
    if isinstance(value, str):
        hint = f"; {IN_OBJECTIVE}" if value in SCALES else did_you_mean(value, UNITS)
    raise ValueError(f"unit: got {shown(value)}, expected the name of a length unit, one of {', '.join(UNITS)}{hint}")


def scale(name: str, value: Any) -> str:
    """Return the scale of pose shifts, "length" or "zp"."""
    if isinstance(value, str) and value in UNITS:
        raise ValueError(f"{name}: got {shown(value)}, expected one of {', '.join(SCALES)}, a scale; {AT_TOP}")
    return choice(name, value, SCALES)


def require_unit_at_top(tables: Mapping[str, Mapping[str, Any]]) -> None:
    """Raise where the length unit stands in a table: in TOML a key below [solver] is one of that table."""
    for name, entries in tables.items():
        if "unit" in entries:
            raise ValueError(f"{name}.unit: got {shown(entries['unit'])}, expected no unit here: {AT_TOP}")


def unit_entry(unit: str) -> dict[str, str]:
    """Return the entry of a file or of JSON; none without a unit."""
    return {"unit": unit} if unit else {}


def with_unit(label: str, unit: str) -> str:
    """Return a label such as "zs (mm)"; the label alone without a unit."""
    return f"{label} ({unit})" if unit else label


def heading(title: str, unit: str) -> str:
    """Return the head of a column, the unit on a line of its own."""
    return f"{title}\n({unit})" if unit else title


def amount(text: str, unit: str) -> str:
    """Return "300 mm" for the text "300"; the text alone without a unit."""
    return f"{text} {unit}" if unit else text


def per(above: str, below: str) -> str:
    """Return "mm/s" for "mm" and "s"; "" without a unit on either side."""
    return f"{above}/{below}" if above and below else ""


def times(above: str, unit: str) -> str:
    """Return "force mm" for "force" and "mm"; "" without a unit."""
    return f"{above} {unit}" if above and unit else ""


def kind_unit(kind: str, of_lengths: str, force_unit: str = "") -> str:
    """Return the unit of values of a kind: "deg", that of lengths, a rate or a power, "" for others.

    `force_unit` is the unit of forces, the kind "number": "N", or "" for one without a name.
    """
    rate = per(of_lengths, "s")
    units = {"angle": "deg", "length": of_lengths, "number": force_unit, "rate": rate}
    return (units | {"power": times(force_unit or "force", rate)}).get(kind, "")


def unit_of_forces(of_lengths: str, masses: object) -> str:
    """Return the unit of forces: "N" where masses are stated and lengths have a unit, else ""."""
    return "N" if of_lengths and masses else ""


def watt_note(of_lengths: str) -> str:
    """Return what a watt is in newtons times a unit of lengths per second."""
    return f"1 W is {1.0 / metres(of_lengths):.4g} N {of_lengths}/s"


def metres(unit: str) -> float:
    """Return the unit in metres; 1 without one."""
    above, below = METRES[unit]
    return above / below


DIGITS = 9  # decimals of degrees: more than a person types
DEG = "_deg"


def exact_degrees(*radians: float) -> tuple[float, ...] | None:
    """Return the short degrees that convert to exactly these radians, or None if there are none.

    A file can then show the 45 that was typed, and reading it gives the same bits.
    """
    degrees = tuple(round(math.degrees(x), DIGITS) for x in radians)
    same = all(math.radians(d) == x for d, x in zip(degrees, radians, strict=True))
    return degrees if same else None


def in_radians(entries: Mapping[str, Any], checks: Mapping[str, Callable[[str, Any], Any]]) -> dict[str, Any]:
    """Return a mapping with the entries `angle`_deg in radians, under their own names; ValueError if both are given.

    `checks` has for each angle by name the check of its value: numbers in any nesting of tuples.
    """
    out = dict(entries)
    for name, check in checks.items():
        if (key := name + DEG) in entries:
            if name in entries:
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
