"""Designs beside each other: their numbers over the poses of their studies, their limits, what differs in the studies.

Every number is one of a `Sheet`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Any

from ninedof.design.actuators import LEG_KINDS, price_words
from ninedof.design.study import LENGTH
from ninedof.sheet.rows import LimitRow, limit_amount
from ninedof.sheet.sheet import Sheet, sheet
from ninedof.sheet.tables import over, pose_of
from ninedof.support.arguments import shown
from ninedof.support.margins import margin_words
from ninedof.support.structs import plain_fields
from ninedof.support.units import amount, metres
from ninedof.tables import DEGREES, RIGHT, SHORT, Column, Line, Table
from ninedof.tables.html import notebook
from ninedof.tables.numbers import ROUNDING, WORDS
from ninedof.tables.table import plain_text

MOST = 3  # designs: more do not fit on 80 columns
NAMES = ("A", "B", "C")
WIDE = 20  # characters of an entry of a study; longer ones stand below the table


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
    """Entries of the studies that are not the same, to the value in each, as its file has it; None where a study has
    none."""
    outside: tuple[dict[str, tuple[float, float, float]], ...]
    """For each design its variables that lie outside of the bounds of its own study: value, low and high, in the unit
    of the design, angles in radians."""
    sheets: tuple[Sheet, ...] = field(repr=False)
    """The sheet of each design."""
    actuators: tuple[Any, ...] = ()
    """The `Combination` of rows that the study of each design chose, None without a choice; () if none has one."""

    @property
    def broken(self) -> tuple[tuple[str, ...], ...]:
        """Names of the limits that each design breaks."""
        return tuple(
            tuple(name for name, rows in self.limits.items() if (row := rows[k]) and row.violated)
            for k in range(len(self.names))
        )

    def parts(self) -> list[Any]:
        """Return the tables and sentences that show it."""
        of_each = list(zip(self.names, self.sheets, strict=True))
        columns, numbers = self._columns(""), self.numbers
        if len(self.names) == 2:
            columns.append(Column("difference", "", RIGHT))
            numbers = {name: (one, other, other - one) for name, (one, other) in numbers.items()}
        lines = [
            Line(name, values, DEGREES if name.endswith(ANGLES) else SHORT, self.unit if _long(name) else "")
            for name, values in numbers.items()
        ]
        out: list[Any] = [Table("Numbers over the poses or the region of each study", columns, lines)]
        for name, one in of_each:
            out.append(f"{name}, {over(one)}, worst at {pose_of(one, one.condition_number.pose)}")
        if any(one.tool for one in self.sheets):
            out.append("p is the point of the tool where a study has one, height p its height; zp is that of the plate")
        if self.actuators:
            out.append(Table("Actuators", self._columns("legs", WORDS), self._actuator_rows()))
        if self.limits:
            rows = [row for label, entry in self.limits.items() for row in _limit_rows(label, entry, self.sheets)]
            out.append(Table("Limits", self._columns("limit"), rows))
        for (name, one), outside in zip(of_each, self.outside, strict=True):
            if outside:
                beyond = ", ".join(_outside_words(label, *ends, one.unit) for label, ends in outside.items())
                out.append(f"{name} is outside of the bounds of its study: {beyond}")
        for name, labels in zip(self.names, self.broken, strict=True):
            if labels:
                out.append(f"{name} breaks {', '.join(labels)}")
        if self.differences:
            long = {key for key, values in self.differences.items() if max(map(len, map(_entry, values))) > WIDE}
            entries = [
                [key, *("below" if key in long and value is not None else _entry(value) for value in values)]
                for key, values in self.differences.items()
            ]
            own = ", lengths in the unit of each" if len({one.unit for one in self.sheets}) > 1 else ""
            out.append(Table(f"What differs in the studies{own}", self._columns("", WORDS), entries))
            out += [_long_words(self.names, key, self.differences[key]) for key in self.differences if key in long]
        return out

    def _columns(self, first: str, form: str = RIGHT) -> list[Column]:
        return [Column(first), *(Column(name, "", form) for name in self.names)]

    def _actuator_rows(self) -> list[list[str]]:
        """Return for each kind of legs the row chosen, its lengths, the limits that it sets, and its price."""
        each = list(zip(self.actuators, self.sheets, strict=True))
        out = []
        for kind in LEG_KINDS:
            limits = [f"{kind}_{what}" for what in ("length", "force", "rate")]
            cells = [_row_cells(getattr(one, kind, None), limits, of) for one, of in each]
            heads = (kind, "  from", "  limits set", "  price of one")
            out += [[head, *values] for head, values in zip(heads, zip(*cells, strict=True), strict=True)]
        return [*out, ["price of all nine", *(_price(one) for one in self.actuators)]]

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain values; angles of limits in radians."""
        limits = {
            label: [None if row is None else row._asdict() | {"broken": row.violated} for row in rows]
            for label, rows in self.limits.items()
        }
        return plain_fields(self, "sheets") | {"limits": limits}

    def __str__(self) -> str:
        """Show all tables as text."""
        return "\n".join(map(plain_text, self.parts()))

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
    limits = _beside([{f"{row.name} {row.side}": row for row in one.limits} for one in sheets])
    return Comparison(
        titles,
        unit,
        _numbers(designs, sheets),
        limits,
        _differences([getattr(design, "study", None) for design in designs]),
        tuple(map(_outside, designs)),
        sheets,
        _chosen(designs),
    )


def _chosen(designs: Sequence[Any]) -> tuple[Any, ...]:
    """Return the rows of each design; one that is changed and not optimized has those of a run beside it, of its study.

    Runs of one study may have chosen rows of other names: then the change has none.
    """
    choices = [getattr(one, "actuators", None) for one in designs]
    runs = [(one.study, choice.chosen) for one, choice in zip(designs, choices, strict=True) if choice]

    def beside(design: Any) -> Any:
        rows = [row for study, row in runs if study == getattr(design, "study", None)]
        return rows[0] if rows and all(row == rows[0] for row in rows) else None

    each = zip(designs, choices, strict=True)
    return tuple(choice.chosen if choice else beside(one) for one, choice in each) if runs else ()


def _row_cells(row: Any, limits: Sequence[str], of: Sheet) -> tuple[str, str, str, str]:
    if row is None:
        return "-", "", "", ""
    known = {limit.name for limit in of.limits}
    sets = ", ".join(name.rpartition("_")[2] for name in limits if name in known)
    return row.name, amount(f"{row.shortest:g} to {row.longest:g}", of.unit), sets, _price(row)


def _price(of: Any) -> str:
    return "-" if of is None or of.price is None else price_words(of.price)


def _beside(entries: Sequence[Mapping[str, Any]], missing: Any = None) -> dict[str, tuple[Any, ...]]:
    """Return each name of several mappings to its values in them."""
    names = dict.fromkeys(name for one in entries for name in one)
    return {name: tuple(one.get(name, missing) for one in entries) for name in names}


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
    return not name.endswith(NO_LENGTHS)


def _numbers(designs: Sequence[Any], sheets: Sequence[Sheet]) -> dict[str, tuple[float, ...]]:
    """Return the quantities of the sheets, then the variables of the family that differ."""
    columns = []
    for design, one in zip(designs, sheets, strict=True):
        scale = metres(one.unit) / metres(sheets[0].unit)
        values = {name: get(one) for name, get in QUANTITIES.items()} | _variables(design)
        columns.append({name: value * (scale if _long(name) else 1.0) for name, value in values.items()})
    rows = _beside(columns, math.nan)
    differs = {name for name, row in rows.items() if not all(math.isclose(x, row[0], rel_tol=1e-12) for x in row)}
    return {name: row for name, row in rows.items() if name in QUANTITIES or name in differs}  # not by rounding alone


def _variables(design: Any, more: Sequence[str] = ()) -> dict[str, float]:
    """Return the variables of a design that are those of the family of its study, or among the others named."""
    study: Any = getattr(design, "study", None)
    names = () if study is None else (*study.variables, *more)
    return {name: design.variables[name] for name in names if name in design.variables}


def _outside(design: Any) -> dict[str, tuple[float, float, float]]:
    """Return the variables of a design outside of the bounds of its study, with these."""
    out = {}
    for name, value in _variables(design, [LENGTH]).items():
        two = design.study.variables.get(name, design.study.characteristic_length)
        low, high = two if isinstance(two, tuple) else (two, two)
        if max(low - value, value - high) > ROUNDING * abs(value):
            out[name] = (value, low, high)
    return out


def _outside_words(name: str, value: float, low: float, high: float, unit: str) -> str:
    angle = name.endswith(ANGLES)
    at, *ends = (f"{math.degrees(x) if angle else x:.6g}" for x in (value, low, high))
    bounds = f"fixed at {ends[0]}" if low == high else f"{ends[0]} to {ends[1]}"
    return f"{name} = {f'{at}°' if angle else amount(at, unit)} ({bounds})"


def _differences(studies: Sequence[Any]) -> dict[str, tuple[Any, ...]]:
    """Return the entries that differ between studies: the solver's are none of the machine."""
    rows = _beside([{} if study is None else _flat(study.to_dict()) for study in studies])
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


def _limit_rows(label: str, entry: Sequence[LimitRow | None], sheets: Sequence[Sheet]) -> list[list[str]]:
    cells = (_limit_cells(row, one) for row, one in zip(entry, sheets, strict=True))
    allowed, values, margins = zip(*cells, strict=True)
    below = [["  margin", *margins]]
    if len(set(allowed)) == 1:
        return [[f"{label} {allowed[0]}", *values], *below]
    return [[label, *values], ["  allowed", *allowed], *below]


def _limit_cells(row: LimitRow | None, of: Sheet) -> tuple[str, str, str]:
    if row is None:
        return "-", "-", ""
    allowed, value = (limit_amount(row, x, of.unit, of.force_unit) for x in (row.limit, row.value))
    return allowed, value, f"{'broken ' * row.violated}{margin_words(row.margin, row.unit)}"


def _entry(value: Any) -> str:
    return "-" if value is None else str(value)


def _long_words(names: Sequence[str], key: str, values: Sequence[Any]) -> str:
    """Return the values of an entry, of lists of rows the first row that differs."""
    rows = [[] if value is None else value for value in values]
    if any(
        not isinstance(row, list | tuple) or not all(isinstance(x, list | tuple | dict) for x in row) for row in rows
    ):
        return f"{key}: {', '.join(f'{name} {_entry(value)}' for name, value in zip(names, values, strict=True))}"
    k, first = next((k, row) for k, row in enumerate(zip_longest(*rows)) if any(x != row[0] for x in row))
    words = (
        f"{name} {'none' if x is None else x} ({len(row)} in all)"
        for name, x, row in zip(names, first, rows, strict=True)
    )
    return f"{key}, no. {k + 1}, the first that differs: {', '.join(words)}"
