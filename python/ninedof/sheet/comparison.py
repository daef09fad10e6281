"""Designs beside each other: their numbers over the poses of their studies, their limits, what differs in the studies.

Every number is one of a `Sheet`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ninedof.design.study import LENGTH
from ninedof.sheet.limit_rows import LimitRow, limit_amount
from ninedof.sheet.pose_words import pose_words
from ninedof.sheet.sheet import Sheet, sheet
from ninedof.sheet.tables import over
from ninedof.support.arguments import shown
from ninedof.support.margins import is_violated, margin_words
from ninedof.support.units import amount, metres
from ninedof.tables import DEGREES, RIGHT, SHORT, Column, Line, Table
from ninedof.tables.html import notebook
from ninedof.tables.numbers import ROUNDING, short
from ninedof.tables.plain import plain

MOST = 3  # designs: more do not fit on 80 columns
NAMES = ("A", "B", "C")


@dataclass(frozen=True, eq=False, repr=False)
class Comparison:
    """Two or three designs beside each other; lengths in the unit of the first."""

    names: tuple[str, ...]
    unit: str
    """Of the lengths; "" without one."""
    numbers: dict[str, tuple[float, ...]]
    """Quantity to one value for each design, NaN where a design has none; lengths in `unit`, angles in radians."""
    limits: dict[str, tuple[LimitRow | None, ...]]
    """Limit and side, as "stroke_ratio max", to its row in the sheet of each design; lengths in the unit of each."""
    differences: dict[str, tuple[Any, ...]]
    """Entries of the studies that are not the same, to the value in each; None where a study has none."""
    outside: tuple[dict[str, tuple[float, float, float]], ...]
    """For each design its variables that lie outside of the bounds of its own study: value, low and high, in the unit
    of the design, angles in radians."""
    sheets: tuple[Sheet, ...] = field(repr=False)
    """The sheet of each design."""

    @property
    def broken(self) -> tuple[tuple[str, ...], ...]:
        """Names of the limits that each design breaks."""
        return tuple(
            tuple(name for name, rows in self.limits.items() if (row := rows[k]) and _broken(row))
            for k in range(len(self.names))
        )

    def parts(self) -> list[Any]:
        """Return the tables and sentences that show it."""
        columns = [Column(), *(Column(name, "", RIGHT) for name in self.names)]
        two = len(self.names) == 2
        if two:
            columns.append(Column("difference", "", RIGHT))
        lines = [
            Line(
                name,
                [*values, *([values[1] - values[0]] if two else [])],
                DEGREES if name.endswith(ANGLES) else SHORT,
                self.unit if _long(name) else "",
            )
            for name, values in self.numbers.items()
        ]
        out: list[Any] = [Table("Numbers over the poses of each study", columns, lines)]
        for name, one in zip(self.names, self.sheets, strict=True):
            c, unit = one.configurations, one.unit
            out.append(f"{name}, {over(one)}, worst at {pose_words(c[one.condition_number.pose], c.rotation[0], unit)}")
        if self.limits:
            columns = [Column("limit"), *(Column(name, "", RIGHT) for name in self.names)]
            rows = [row for label, entry in self.limits.items() for row in _limit_rows(label, entry, self.sheets)]
            out.append(Table("Limits", columns, rows))
        for name, outside, one in zip(self.names, self.outside, self.sheets, strict=True):
            if outside:
                beyond = ", ".join(_outside_words(label, *ends, one.unit) for label, ends in outside.items())
                out.append(f"{name} is outside of the bounds of its study: {beyond}")
        for name, labels in zip(self.names, self.broken, strict=True):
            if labels:
                out.append(f"{name} breaks {', '.join(labels)}")
        if self.differences:
            columns = [Column(), *(Column(name) for name in self.names)]
            entries = [[key, *map(_short_entry, values)] for key, values in self.differences.items()]
            out.append(Table("What differs in the studies", columns, entries))
        return out

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain values; angles of limits in radians."""
        limits = {
            label: [None if row is None else vars(row) | {"broken": _broken(row)} for row in rows]
            for label, rows in self.limits.items()
        }
        out = {"names": list(self.names), "numbers": {name: list(row) for name, row in self.numbers.items()}}
        differences = {key: list(values) for key, values in self.differences.items()}
        more = {"limits": limits, "differences": differences, "outside": list(self.outside)}
        return ({"unit": self.unit} if self.unit else {}) | out | more

    def __str__(self) -> str:
        """Show all tables as text."""
        return "\n".join(map(plain, self.parts()))

    def __repr__(self) -> str:
        """Show the worst condition number of each."""
        worst = ", ".join(
            f"{name} {one.condition_number.value:.6g}" for name, one in zip(self.names, self.sheets, strict=True)
        )
        return f"<Comparison: worst condition numbers {worst}>"

    def _repr_html_(self) -> str:
        return notebook(repr(self)[1:-1], *(part for part in self.parts() if isinstance(part, Table)))


def compare(*designs: Any, names: Sequence[str] | None = None) -> Comparison:
    """Return two or three designs beside each other: numbers, limits, variables, what differs in their studies.

    A region study is searched over its region, a study of poses evaluated at its poses, a Design at its neutral pose.

    Parameters
    ----------
    *designs : Result or Design
        Lengths are converted to the unit of the first.
    names : sequence of str, optional
        One for each; A, B, C by default.

    Raises
    ------
    ValueError
        If there are not two or three designs, one holds no design, or only some name the unit of their lengths.

    Examples
    --------
    >>> import ninedof as nd
    >>> result = nd.optimize(nd.Study.paper(), starts=8)
    >>> both = nd.compare(result, result.with_changes(a2="+10%"))
    >>> both.broken
    ((), ('radius_ratio max',))

    """
    if not 2 <= len(designs) <= MOST:
        raise ValueError(f"designs: got {len(designs)}, expected two or three")
    titles = NAMES[: len(designs)] if names is None else tuple(names) if isinstance(names, list | tuple) else ()
    if len(titles) != len(designs) or not all(isinstance(title, str) for title in titles):
        raise ValueError(f"names: got {shown(names)}, expected {len(designs)} texts, one for each design")
    sheets = tuple(sheet(design) for design in designs)
    unit = sheets[0].unit
    for title, one in zip(titles, sheets, strict=True):
        if bool(one.unit) != bool(unit):
            units = f"{titles[0]} in {unit or 'no unit'} and {title} in {one.unit or 'no unit'}"
            raise ValueError(f"designs: got {units}, expected a unit of lengths for all or for none")
    scales = [metres(one.unit) / metres(unit) if unit != one.unit else 1.0 for one in sheets]
    rows = [{(row.name, row.side): row for row in one.limits} for one in sheets]
    limits = {key: tuple(of.get(key) for of in rows) for key in dict.fromkeys(key for of in rows for key in of)}
    return Comparison(
        titles,
        unit,
        _numbers(designs, sheets, scales),
        {f"{name} {side}": entry for (name, side), entry in limits.items()},
        _differences([getattr(design, "study", None) for design in designs]),
        tuple(map(_outside, designs)),
        sheets,
    )


QUANTITIES: dict[str, Callable[[Sheet], float]] = {
    "worst condition number": lambda one: one.condition_number.value,
    "mean condition number": lambda one: one.mean_condition_number,
    "characteristic length": lambda one: one.characteristic_length,
    "shortest leg": lambda one: min(leg.shortest for leg in one.legs),
    "longest leg": lambda one: max(leg.longest for leg in one.legs),
    "largest stroke ratio": lambda one: max(leg.stroke_ratio for leg in one.legs),
    "distance of legs": lambda one: one.clearance.value,
    "least determinant": lambda one: one.determinants[one.nearest_singularity].value,
    "height p": lambda one: float(one.configurations.position[0, 2]),
    "height O": lambda one: float(one.configurations.internal_point[0, 2]),
}
ANGLES = ("theta_z", "_angle")
NO_LENGTHS = ("number", "ratio", "determinant", *ANGLES)


def _long(name: str) -> bool:
    """Whether a quantity is a length."""
    return not name.endswith(NO_LENGTHS)


def _numbers(designs: Sequence[Any], sheets: Sequence[Sheet], scales: Sequence[float]) -> dict[str, tuple[float, ...]]:
    """Return the quantities of the sheets, then the variables of the family that differ."""
    out = {
        name: tuple(get(one) * (scale if _long(name) else 1.0) for one, scale in zip(sheets, scales, strict=True))
        for name, get in QUANTITIES.items()
    }
    own = [_variables(design) for design in designs]
    for name in dict.fromkeys(name for values in own for name in values):
        row = tuple(
            values.get(name, math.nan) * (scale if _long(name) else 1.0)
            for values, scale in zip(own, scales, strict=True)
        )
        if len(set(row)) > 1:
            out[name] = row
    return out


def _variables(design: Any) -> Mapping[str, float]:
    study, values = getattr(design, "study", None), getattr(design, "variables", None) or {}
    return {name: values[name] for name in study.variables if name in values} if study else {}


def _outside(design: Any) -> dict[str, tuple[float, float, float]]:
    """Return the variables of a design outside of the bounds of its study, with these."""
    study, values = getattr(design, "study", None), getattr(design, "variables", None) or {}
    if study is None:
        return {}
    ends = {**study.variables, LENGTH: study.characteristic_length}
    bounds = {name: two if isinstance(two, tuple) else (two, two) for name, two in ends.items() if name in values}
    rows = {name: (values[name], *two) for name, two in bounds.items()}
    return {name: row for name, row in rows.items() if max(row[1] - row[0], row[0] - row[2]) > ROUNDING * abs(row[0])}


def _outside_words(name: str, value: float, low: float, high: float, unit: str) -> str:
    angle = name.endswith(ANGLES)
    at, *ends = (f"{math.degrees(x) if angle else x:.6g}" for x in (value, low, high))
    bounds = f"fixed at {ends[0]}" if low == high else f"{ends[0]} to {ends[1]}"
    return f"{name} = {f'{at}°' if angle else amount(at, unit)} ({bounds})"


def _differences(studies: Sequence[Any]) -> dict[str, tuple[Any, ...]]:
    """Return the entries that differ between studies: the solver's are none of the machine."""
    flat = [{} if study is None else _flat(study.to_dict()) for study in studies]
    rows = {key: tuple(one.get(key) for one in flat) for key in dict.fromkeys(key for one in flat for key in one)}
    with_study = [k for k, study in enumerate(studies) if study is not None]
    return {
        key: row
        for key, row in rows.items()
        if not key.startswith("solver.") and any(row[k] != row[with_study[0]] for k in with_study)
    }


def _flat(tree: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    out: dict[str, Any] = {}
    for key, value in tree.items():
        out |= _flat(value, f"{before}{key}.") if isinstance(value, Mapping) else {before + key: value}
    return out


def _broken(row: LimitRow) -> bool:
    return is_violated(row.margin, row.unit, row.limit)


def _limit_rows(label: str, entry: Sequence[LimitRow | None], sheets: Sequence[Sheet]) -> list[list[str]]:
    """Return what is allowed, the values and the margins."""
    of = list(zip(entry, sheets, strict=True))
    allowed = ["-" if row is None else limit_amount(row, row.limit, short, one.unit) for row, one in of]
    values = ["-" if row is None else limit_amount(row, row.value, short, one.unit) for row, one in of]
    margins = [
        "" if row is None else f"{'broken ' * _broken(row)}{margin_words(row.margin, row.unit)}" for row in entry
    ]
    same = len(set(allowed)) == 1
    head = f"{label} {allowed[0]}" if same else label
    return [[head, *values], *([] if same else [["  allowed", *allowed]]), ["  margin", *margins]]


def _short_entry(value: Any) -> str:
    text = "-" if value is None else str(value)
    return text if len(text) <= 20 else f"{text[:17]}..."
