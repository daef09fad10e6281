"""Limits of constraints: parse what a study gives, write it to files, convert it for the core."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple, cast

import numpy as np

from ninedof import _core
from ninedof.support.angles import degrees_of, exact_degrees
from ninedof.support.arguments import Vector, choice, known_keys, number, pair, shown, vector, whole

Limit = tuple[float | None, float | None] | Mapping[str, Any]
"""(low, high), None for an open side; with options a mapping of min, max and the options."""

Limits = Limit | Sequence[Limit]
"""What a study has for a name: one limit, or one for each value of `at`, then in normal form a tuple of mappings."""


class Row(NamedTuple):
    """A row of the core's table of constraints, or of criteria of workspaces."""

    name: str
    kind: str
    """"ratio", "length", "angle" or "sign"."""
    sides: tuple[str, ...]
    """"min", "max" or both."""
    units: tuple[str, ...]
    """Values of the option `of`, the default first."""
    options: tuple[str, ...]
    """Further options: "radius", "axis", "steps"."""
    default_low: float | None
    """min where none is given."""

    @property
    def is_angle(self) -> bool:
        """Whether limits are angles, in radians."""
        return self.kind == "angle"


ROWS = {row.name: row for row in (Row(*values) for values in _core.constraint_table)}
CONSTRAINTS = tuple(ROWS)
STEPS, MOST_STEPS = _core.singularity_free_steps  # parts of the way from the neutral pose that singularity_free tests
AT = ("poses", "neutral")
"""Where a limit holds: at every pose of the objective, the default, or at the neutral pose alone."""


def parse(name: str, value: Any) -> Limits:
    """Return what a study has for a name in its normal form: checked, angles in radians, defaults left out.

    `value` is (low, high), None for an open side, or a mapping of min, max (max_deg for angles) and the options of the
    constraint; or a sequence of those with a mapping among them, at most one for each value of `at`.
    """
    if not isinstance(value, list | tuple) or not any(isinstance(entry, Mapping) for entry in value):
        return _parse_one(name, value)
    found: dict[str, Limit] = {}
    for entry in value:
        limit = _parse_one(name, entry)
        if (where := place(limit)) in found:
            raise ValueError(f'{name}.at: got "{where}" twice, expected one limit for each of {", ".join(AT)}')
        found[where] = limit
    if len(found) == 1:
        return next(iter(found.values()))
    return tuple(MappingProxyType(_table(*parts(found[where]))) for where in AT)


def each(constraints: Mapping[str, Limits]) -> list[tuple[str, Limit]]:
    """Return every limit with the name of its constraint, those stated twice one after the other."""
    out: list[tuple[str, Limit]] = []
    for name, limits in constraints.items():
        out += [(name, limit) for limit in _each_of(limits)]
    return out


def place(limit: Limit) -> str:
    """Return where a limit holds, "poses" or "neutral"."""
    return str(limit.get("at", AT[0])) if isinstance(limit, Mapping) else AT[0]


def label(name: str, at: str) -> str:
    """Return what margins, prices and messages call a limit, as in the core: "base_cone", "base_cone at neutral"."""
    return name if at == AT[0] else f"{name} at {at}"


def shown_unit(name: str, limit: Limit, unit: str = "") -> str:
    """Return the unit in which a limit is shown: "deg" for an angle, that of lengths for a length, "" for a ratio."""
    if ROWS[name].is_angle:
        return "deg"
    plain = ROWS[name].kind == "length" and parts(limit)[2].get("of", ROWS[name].units[0]) == "length"
    return unit if plain else ""


def kind_of(name: str) -> str:
    """Return the kind of a limit by its row; "ratio" for one that is no constraint, whose margin is a share too."""
    return ROWS[name].kind if name in ROWS else "ratio"


def split_label(text: str) -> tuple[str, str]:
    """Return the name and the place of a label."""
    name, _, at = text.partition(" at ")
    return name, at or AT[0]


def _parse_one(name: str, value: Any) -> Limit:
    row = ROWS[name]
    if isinstance(value, Mapping):
        low, high, options = _from_mapping(row, value)
    else:
        expected = "(low, high), None for an open side, or a mapping"
        low, high = (None if x is None else number(name, x) for x in pair(name, value, expected))
        options = {}
    named = label(name, options.get("at", AT[0]))
    if low is None:
        low = row.default_low
    for side, limit in (("min", low), ("max", high)):
        if limit is not None and side not in row.sides:
            raise ValueError(f"{named}: got a {side}, {limit:g}, expected only a {row.sides[0]}")
    _require_sensible(row, named, low, high)
    if not options:
        return low, high
    if low is None and high is None:
        raise ValueError(f"{named}: got {', '.join(options)} alone, expected {' or '.join(row.sides)} too")
    return MappingProxyType(_table(low, high, options))


def names_with_max() -> list[str]:
    """Return the constraints that have a max."""
    return [name for name, row in ROWS.items() if "max" in row.sides]


def to_table(name: str, limits: Limits) -> dict[str, Any] | list[dict[str, Any]]:
    """Return the table of a study file, or an array of tables; `parse` reads it back to the same bits."""
    tables = [_to_table(name, limit) for limit in _each_of(limits)]
    return tables if len(tables) > 1 else tables[0]


def _to_table(name: str, limit: Limit) -> dict[str, Any]:
    low, high, options = parts(limit)
    out: dict[str, Any] = {}
    for side, value in (("min", low), ("max", high)):
        if value is not None:
            degrees = exact_degrees(value) if ROWS[name].is_angle else None
            out |= {side: value} if degrees is None else {f"{side}_deg": degrees[0]}
    return out | {key: list(v) if isinstance(v, tuple) else v for key, v in options.items()}


def for_core(name: str, limit: Limit) -> dict[str, Any]:
    """Return the limit as the core takes it: open sides 0 and infinity, the axis of unit length."""
    low, high, options = parts(limit)
    axis = options.get("axis", ())
    return {
        "name": name,
        "low": 0.0 if low is None else low,
        "high": math.inf if high is None else high,
        "of": options.get("of", "length"),
        "axis": _unit(axis) if axis else [],
        "steps": options.get("steps", STEPS),
        "at": place(limit),
    }


def _unit(axis: Sequence[float]) -> list[float]:
    """Return the direction of an axis; its largest entry first, so that no square over- or underflows."""
    scaled = np.array(axis) / max(abs(v) for v in axis)
    return [float(v) for v in scaled / np.linalg.norm(scaled)]


def _each_of(limits: Limits) -> Sequence[Limit]:
    """Return one limit or several in normal form as a sequence; a pair of numbers is one limit."""
    if isinstance(limits, tuple) and isinstance(limits[0], Mapping):
        return cast("tuple[Limit, ...]", limits)
    return (cast("Limit", limits),)


def _table(low: float | None, high: float | None, options: Mapping[str, Any]) -> dict[str, Any]:
    sides = {side: limit for side, limit in (("min", low), ("max", high)) if limit is not None}
    return sides | dict(options)


def parts(limit: Limit) -> tuple[float | None, float | None, dict[str, Any]]:
    """Return low, high and the options of a limit in normal form."""
    if isinstance(limit, tuple):
        return *limit, {}
    options = {key: value for key, value in limit.items() if key not in ("min", "max")}
    return limit.get("min"), limit.get("max"), options


def _from_mapping(row: Row, given: Mapping[str, Any]) -> tuple[float | None, float | None, dict[str, Any]]:
    """Return low, high and the options that are not at their default."""
    name = row.name
    at = choice(f"{name}.at", given.get("at", AT[0]), AT)
    named = label(name, at)
    sides = [*row.sides, *(f"{side}_deg" for side in row.sides if row.is_angle)]
    of = ["of"] if len(row.units) > 1 else []
    known_keys(label(f"constraints.{name}", at), given, [*sides, *of, *row.options, "at"])
    low, high = _side(named, given, "min"), _side(named, given, "max")
    if given.get("radius") is not None:
        if low is not None:
            raise ValueError(f"{named}: got both min and radius, expected one of the two (min is twice the radius)")
        low = 2.0 * number(label(f"{name}.radius", at), given["radius"])
    options: dict[str, Any] = {}
    if choice(label(f"{name}.of", at), given.get("of", row.units[0]), row.units) != row.units[0]:
        options["of"] = given["of"]
    if "axis" in given:
        options["axis"] = _axis(label(f"{name}.axis", at), given["axis"])
    if at != AT[0]:
        options["at"] = at
        if "steps" in given:
            got = shown(given["steps"])
            raise ValueError(f"{label(f'{name}.steps', at)}: got {got}, expected none: no way leads to this pose")
    steps = whole(f"{name}.steps", given.get("steps", STEPS), 1, MOST_STEPS)
    if steps != STEPS:
        options["steps"] = steps
    return low, high, options


def _side(name: str, given: Mapping[str, Any], side: str) -> float | None:
    plain, degrees = given.get(side), given.get(f"{side}_deg")
    if plain is not None and degrees is not None:
        raise ValueError(f"{name}: got both {side} and {side}_deg, expected one of the two")
    if degrees is not None:
        return math.radians(number(name, degrees))
    return None if plain is None else number(name, plain)


def _axis(name: str, value: Any) -> Vector:
    axis = vector(name, value)
    if not math.hypot(*axis) > 0.0:
        raise ValueError(f"{name}: got {shown(value)}, expected a direction, not zero")
    return axis


def _require_sensible(row: Row, name: str, low: float | None, high: float | None) -> None:
    """Raise for limits that no design can meet or that have no effect."""
    least, most = 0.0 if low is None else low, math.inf if high is None else high
    if not (0.0 <= least <= most and least < math.inf and most > 0.0):
        ends = [None if end is None else degrees_of(end) if row.is_angle else end for end in (low, high)]
        got = f"({ends[0]}, {ends[1]}){' degrees' * row.is_angle}"
        raise ValueError(f"{name}: got {got}, expected 0 <= low <= high, high above 0")
    if high is not None and row.is_angle and not high <= math.pi:
        got = f"{high:g} radians, {degrees_of(high):g} degrees"
        raise ValueError(f"{name}: got {got}, expected at most pi, 180 degrees (degrees are given as max_deg)")
    if row.kind == "sign" and not 0.0 < least < 1.0:
        raise ValueError(f"{name}: got min = {least:g}, expected a number between 0 and 1")
