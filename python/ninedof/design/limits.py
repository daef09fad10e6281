"""Limits of a study: the table of constraints of the core, and one limit as a study file has it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.tool import Tool
from ninedof.robot.geometry import LEGS
from ninedof.support.arguments import Vector, choice, finite, items, known_keys, number, shown, vector, whole
from ninedof.support.structs import Check, Fixed, plain, within
from ninedof.support.units import angle_entry, degrees_of, half_turn, in_radians, kind_unit

ROWS = {row.name: row for row in _core.constraint_table}
OF_LENGTHS = {
    name: [LEGS.index(part) for part in parts]
    for name, parts in _core.limit_parts.items()
    if ROWS[name].kind == "length" and set(parts) <= set(LEGS)
}
"""Constraints of lengths, and their legs in the order of `leg_lengths`."""
STEPS, MOST_STEPS = _core.singularity_free_steps  # parts of the way from the neutral pose that singularity_free tests
AT = ("poses", "neutral")
"""The places where a limit holds: every pose of the objective, the default, or the neutral pose alone."""


@dataclass(frozen=True)
class Limit:
    """One limit of a study."""

    name: str
    low: float = 0.0
    """0 for an open side; angles in radians."""
    high: float = math.inf
    """Infinite for an open side."""
    of: str = "length"
    axis: Vector | tuple[()] = ()
    """Of a cone, as it was given; () for the directions of the legs at the neutral pose."""
    steps: int = STEPS
    at: str = AT[0]

    @property
    def row(self) -> _core.ConstraintInfo:
        """Its row in the table of constraints."""
        return ROWS[self.name]

    @property
    def label(self) -> str:
        """Its name in margins, prices and messages, as in the core, with " at neutral" for that pose alone."""
        return label(self.name, self.at)

    @property
    def kind(self) -> str:
        """As in its row; "ratio" for a length over zp or a radius."""
        return "ratio" if self.of != "length" else self.row.kind

    @property
    def sides(self) -> dict[str, float]:
        """The sides that are not open, "min" before "max"."""
        sides = {"min": self.low} if self.low != 0.0 else {}
        return sides | ({"max": self.high} if self.high != math.inf else {})

    def unit(self, of_lengths: str = "", force_unit: str = "") -> str:
        """Return the unit in which it is shown, as `kind_unit`: "deg" for an angle, that of lengths or forces, or "".

        `force_unit` is the unit of forces, `Study.force_unit`.
        """
        return kind_unit(self.kind, of_lengths, force_unit)

    @property
    def options(self) -> dict[str, Any]:
        """The options that differ from the defaults beside the two sides."""
        values = {"of": self.of, "axis": self.axis, "steps": self.steps, "at": self.at}
        return {name: value for name, value in values.items() if value != getattr(Limit, name)}

    @property
    def entries(self) -> dict[str, Any]:
        """Its sides and options; beside an option at least one side, though it may be open."""
        first = self.row.sides[0]
        sides = self.sides or ({first: self.low if first == "min" else self.high} if self.options else {})
        return sides | self.options

    def to_dict(self) -> dict[str, Any]:
        """Return the table of a study file; `parse` reads it back to the same bits."""
        angles = self.row.sides if self.row.is_angle else ()
        entries = (angle_entry(*item) if item[0] in angles else item for item in self.entries.items())
        return {name: plain(value) for name, value in entries}

    def axis_in(self, tool: Tool) -> Vector | tuple[()]:
        """Return the axis in the frame of geometries: that of a cone of the platform is seen from the tool's frame."""
        return tool.turned(self.axis) if self.axis and self.row.body == "platform" and tool else self.axis

    def for_core(self, tool: Tool, duty: _core.Duty | None = None) -> _core.Limit:
        """Return the limit as the core takes it: the axis of unit length, in the frame of geometries."""
        axis = self.axis_in(tool)
        return _core.Limit(**vars(self) | {"axis": _unit(axis) if axis else (0.0, 0.0, 0.0), "duty": duty})


def parse(name: str, value: Any) -> tuple[Limit, ...]:
    """Return the limits that a study has for a name, checked: one, or one for each value of `at` in their order.

    `value` is (low, high), None for an open side, or a mapping of min, max (max_deg for angles) and the options of the
    constraint; or a sequence of those with a mapping among them.
    """
    where, row = f"constraints.{name}", ROWS[name]
    if not isinstance(value, list | tuple) or not any(isinstance(one, Mapping | Limit) for one in value):
        return (_parse(where, row, value),)
    limits = {}
    for k, one in enumerate(value):
        limit = _parse(f"{where}[{k}]", row, one)
        if limit.at in limits:
            raise ValueError(f'{where}.at: got "{limit.at}" twice, expected one limit for each of {", ".join(AT)}')
        limits[limit.at] = limit
    return tuple(limits[at] for at in AT if at in limits)


def form(limits: Sequence[Limit]) -> Any:
    """Return limits of one name as `Study.constraints` has them: (low, high) or, with options, a mapping or several."""
    forms = [Fixed(one.entries) for one in limits]
    if len(forms) > 1:
        return tuple(forms)
    return forms[0] if limits[0].options else (forms[0].get("min"), forms[0].get("max"))


def label(name: str, at: str) -> str:
    """Return the label of a limit by its name and place."""
    return name if at == AT[0] else f"{name} at {at}"


def limit_words(name: str, side: str) -> str:
    """Return a side of a limit in words: "the greatest joint height" for "joint_height", "max"."""
    plain = name.replace("_", " ")
    return plain if plain == "no singularity" else f"the {'greatest' if side == 'max' else 'least'} {plain}"


def split_label(text: str) -> tuple[str, str]:
    """Return the name and the place of a label."""
    name, _, at = text.partition(" at ")
    return name, at or AT[0]


def kind_of(name: str) -> str:
    """Return the kind of a limit by its row; "ratio" for one that is no constraint, whose margin is a share too."""
    return ROWS[name].kind if name in ROWS else "ratio"


def names_with_max() -> list[str]:
    """Return the constraints that have a max."""
    return [name for name, row in ROWS.items() if "max" in row.sides]


def require_stated(limits: Sequence[Limit], states: Mapping[str, bool]) -> None:
    """Raise ValueError if a limit is about loads or speeds that a study does not state."""
    expected = {"loads": "wrenches in [loads], or [masses]", "speeds": "linear or angular in [speeds]"}
    for limit in limits:
        for table in limit.row.needs:
            if not states[table]:
                raise ValueError(f"constraints.{limit.name}: got a study without {table}, expected {expected[table]}")


def _parse(where: str, row: _core.ConstraintInfo, value: Any) -> Limit:
    if isinstance(value, Limit):
        value = value.entries
    if not isinstance(value, Mapping):
        low, high = items(where, value, "(low, high), None for an open side, or a table", 2)
        value = {"min": low, "max": high}
    table = {key: one for key, one in value.items() if one is not None}
    checks: dict[str, Check] = dict.fromkeys(row.sides, number)
    angles = dict(checks) if row.is_angle else {}
    if len(row.units) > 1:
        checks["of"] = partial(choice, known=row.units)
    checks |= {option: OPTIONS[option] for option in row.options} | {"at": partial(choice, known=AT)}
    known_keys(where, table, [*checks, *(f"{name}_deg" for name in angles)])
    with within(where):
        entries = {key: checks[key](key, one) for key, one in in_radians(table, angles).items()}
        if "radius" in entries:
            if "min" in entries:
                raise ValueError("min: got both min and radius, expected one of the two (min is twice the radius)")
            entries["min"] = 2.0 * entries.pop("radius")
        if "steps" in entries and entries.get("at") == "neutral":
            raise ValueError(f"steps: got {entries['steps']}, expected none: no way leads to the neutral pose")
        if row.is_angle and "max" in entries:
            half_turn("max", entries["max"])
    low, high = entries.pop("min", row.default_low), entries.pop("max", None)
    _require_sensible(where, row, low, high)
    limit = Limit(row.name, low or 0.0, math.inf if high is None else high, **entries)
    if limit.options and low is None and high is None:
        raise ValueError(f"{where}: got {', '.join(limit.options)} alone, expected {' or '.join(row.sides)} too")
    return limit


def _axis(name: str, value: Any) -> Vector:
    axis = vector(name, value)
    if not math.hypot(*axis) > 0.0:
        raise ValueError(f"{name}: got {shown(value)}, expected a direction, not zero")
    return axis


OPTIONS: dict[str, Check] = {
    "radius": partial(finite, least=0.0),
    "axis": _axis,
    "steps": partial(whole, least=1, most=MOST_STEPS),
}


def _require_sensible(where: str, row: _core.ConstraintInfo, low: float | None, high: float | None) -> None:
    """Raise for limits that no design can meet or that have no effect."""
    least, most = 0.0 if low is None else low, math.inf if high is None else high
    if not (0.0 <= least <= most and least < math.inf and most > 0.0):
        ends = [None if end is None else degrees_of(end) if row.is_angle else end for end in (low, high)]
        got = f"({ends[0]}, {ends[1]}){' degrees' * row.is_angle}"
        raise ValueError(f"{where}: got {got}, expected 0 <= low <= high, high above 0")
    if row.kind == "sign" and not 0.0 < least < 1.0:
        raise ValueError(f"{where}: got min = {least:g}, expected a number between 0 and 1")


def _unit(axis: Vector) -> Vector:
    """Return the direction of an axis; its largest entry first, so that no square over- or underflows."""
    scaled = np.array(axis) / max(abs(v) for v in axis)
    x, y, z = (scaled / np.linalg.norm(scaled)).tolist()
    return x, y, z
