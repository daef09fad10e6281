"""The name of the length unit: a label on what is shown and written. Nothing is converted."""

from __future__ import annotations

from collections.abc import Mapping
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


def kind_unit(kind: str, of_lengths: str) -> str:
    """Return the unit of values of a kind: "deg", that of lengths, a rate or a power, "" for others."""
    rate = per(of_lengths, "s")
    return {"angle": "deg", "length": of_lengths, "rate": rate, "power": times("force", rate)}.get(kind, "")


def metres(unit: str) -> float:
    """Return the unit in metres; 1 without one."""
    above, below = METRES[unit]
    return above / below
