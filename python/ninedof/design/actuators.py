"""Actuators that can be bought: rows of a study file or of a CSV file, and the limits that a row sets to legs."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from ninedof.design.duty import duty
from ninedof.support.arguments import cleaned, finite, instance, items, number, path_argument, shown, text
from ninedof.support.kept.files import csv_table, finite_or_nan, read_text, require_entries
from ninedof.support.structs import StudyTable, entries, entry, within
from ninedof.support.text import short_repr

LEG_KINDS = ("external", "upper", "lower")
"""The kinds of legs: each takes one row, three actuators of it."""
FOR = ("kinds", "all")


def price_words(price: float) -> str:
    """Return a price with all of its digits: six would make 12345.67 another one."""
    return f"{price:.15g}"


def _name(name: str, value: Any) -> str:
    if not text(name, value).strip():
        raise ValueError(f"{name}: got {shown(value)}, expected a name")
    return text(name, value)


def _above_zero(name: str, value: Any, check: Callable[[str, Any], float] = finite) -> float:
    if not (x := check(name, value)) > 0.0:
        raise ValueError(f"{name}: got {shown(value)}, expected a number above 0")
    return x


_greatest = partial(_above_zero, check=number)


@short_repr
@dataclass(frozen=True)
class Actuator(StudyTable):
    """A linear actuator that can be bought: a row of a catalogue.

    Parameters
    ----------
    name : text
        Shown as it is; each row has its own.
    shortest, longest : float
        The lengths of a leg with it, between its joints, in the unit of the study.
    force : float
        Greatest modulus of its force, in the unit of the loads. Without limit by default.
    rate : float
        Greatest speed, length/time. Without limit by default.
    price : float, optional
        Of one. Unknown by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.Actuator("A300", shortest=450.0, longest=750.0, force=800.0)
    Actuator(name='A300', shortest=450, longest=750, force=800)

    """

    name: str = entry(_name)
    shortest: float = entry(_above_zero)
    longest: float = entry(_above_zero)
    force: float = entry(_greatest, math.inf)
    rate: float = entry(_greatest, math.inf)
    price: float | None = entry(partial(finite, least=0.0), None)

    def __post_init__(self) -> None:
        """Check every entry, and that there is a stroke."""
        super().__post_init__()
        if not self.shortest < self.longest:
            raise ValueError(f"longest: got {self.longest:g}, expected more than the shortest, {self.shortest:g}")

    def is_as_good_as(self, other: Actuator) -> bool:
        """Whether it can do all that another one can, and is not known to cost more."""
        instance("other", other, Actuator)
        wide = self.shortest <= other.shortest and other.longest <= self.longest
        strong = self.force >= other.force and self.rate >= other.rate
        if self.price is None or other.price is None:
            return wide and strong and self.price == other.price
        return wide and strong and self.price <= other.price


class Rows(tuple[Actuator, ...]):
    """Rows of a file, and its name as it was given; other rows are a plain tuple."""

    file: str


COLUMNS = tuple(one.name for one in entries(Actuator))


def actuator_rows(name: str, value: Any) -> tuple[Actuator, ...]:
    """Return the rows of an argument: actuators, or mappings of their entries."""
    if isinstance(value, Rows):
        return value
    rows = items(name, value, "rows with name, shortest and longest")
    own = duty(Actuator)
    return _distinct(name, [own(f"{name}[{k}]", row) for k, row in enumerate(rows)])


def _distinct(where: str, rows: Sequence[Actuator]) -> tuple[Actuator, ...]:
    names = [row.name for row in rows]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{where}: got two rows of the name {shown(name)}, expected each name once")
    return tuple(rows)


def catalogue(path: str | os.PathLike[str], unit: str, called: str = "") -> Rows:
    """Return the rows of a CSV file whose first line names the columns; ValueError names file, line and column.

    An empty force or rate is without limit, an empty price unknown. Other columns are left out. Lengths are in `unit`:
    a file that names another one is refused. The rows are of the file `called` so, by default as it is named.
    """
    file = path_argument("actuators", path)
    text = read_text(file)
    with within(file, ": "):
        line, heads, body = csv_table(text)
        names = [name for name, _ in heads]
        for column in COLUMNS:
            if column not in names:
                got = cleaned(", ".join(names))
                raise ValueError(f"line {line}: got no column {column}, expected {', '.join(COLUMNS)}; there are {got}")
        for name, own in heads:
            if name in ("shortest", "longest") and own and unit and own != unit:
                raise ValueError(f"line {line}, column {name}: got {own}, expected {unit} as in the study")
        if not body:
            raise ValueError("got no rows, expected at least one actuator")
        require_entries(body, names)
        rows = Rows(_distinct("name", [_row(at, dict(zip(names, row, strict=True))) for at, row in body]))
        rows.file = called or file.name
        return rows


def _row(line: int, entries: Mapping[str, str]) -> Actuator:
    values: dict[str, Any] = {"name": entries["name"]}
    for column in COLUMNS[1:]:
        if not entries[column] and column not in COLUMNS[:3]:
            continue
        values[column] = finite_or_nan(entries[column])
        if math.isnan(values[column]):
            raise ValueError(f"line {line}, column {column}: got {shown(entries[column])}, expected a finite number")
    with within(f"line {line}, column", " "):
        return Actuator(**values)


def beside_study(path: str | os.PathLike[str], name: str, unit: str) -> Rows:
    """Return the rows of the file that a study file names: one of its own folder, or in a folder there."""
    file = path_argument("actuators", name)
    if file.is_absolute() or ".." in file.parts:
        raise ValueError(f"actuators: got {shown(name)}, expected a CSV file in the folder of the study file")
    return catalogue(Path(path).parent / file, unit, name)


def require_together(rows: Sequence[Actuator], greatest_price: float | None, constraints: Mapping[str, Any]) -> None:
    """Raise ValueError if entries of a study do not go together with its actuators."""
    if greatest_price is not None and not rows:
        raise ValueError(f"greatest_price: got {price_words(greatest_price)} without actuators, expected both")
    for k, row in enumerate(rows):
        if greatest_price is not None and row.price is None:
            raise ValueError(f"actuators[{k}].price: got none, expected a number, as greatest_price is given")
    for name in (f"{kind}_{what}" for kind in LEG_KINDS for what in ("length", "force", "rate")):
        if rows and name in constraints:
            raise ValueError(f"constraints.{name}: got it beside actuators, which set it, expected one of them")


def hull(rows: Iterable[Actuator]) -> Actuator:
    """Return what at least one of the rows can do: the least shortest, the greatest of the others."""
    every = list(rows)
    most = {name: max(getattr(row, name) for row in every) for name in ("longest", "force", "rate")}
    return Actuator("any", shortest=min(row.shortest for row in every), **most)


def row_limits(kind: str, row: Actuator, stated: Mapping[str, bool]) -> dict[str, Any]:
    """Return the constraints of a kind of legs that have a row: forces and rates where loads and speeds are stated."""
    limits: dict[str, Any] = {f"{kind}_length": (row.shortest, row.longest)}
    for name, needs in (("force", "loads"), ("rate", "speeds")):
        if math.isfinite(most := getattr(row, name)) and stated[needs]:
            limits[f"{kind}_{name}"] = (None, most)
    return limits
