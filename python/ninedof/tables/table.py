"""A table as data, and as plain text."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias, TypeGuard

from ninedof.support.units import with_unit
from ninedof.tables.numbers import PAGE, RIGHT, SHORT, WORDS, cell

Cell: TypeAlias = str | float | int | None


class Column(NamedTuple):
    """A column of a table."""

    name: str = ""
    unit: str = ""
    format: str = WORDS
    """WORDS to the left, RIGHT for text to the right; SHORT for numbers with the decimals of the largest of their unit,
    DEGREES for radians shown in degrees, or a format of Python such as ".6f"."""


def columns(*heads: str) -> list[Column]:
    """Return columns of text for their heads: to the left, or to the right with ">" before the head."""
    return [Column(head.lstrip(">"), "", RIGHT if head.startswith(">") else WORDS) for head in heads]


class Line(NamedTuple):
    """A row whose cells are values of one quantity, in a table that has a column for each thing."""

    name: str
    values: Sequence[Cell]
    format: str = RIGHT
    unit: str = ""


@dataclass(frozen=True)
class Table:
    """A title, columns, and rows in groups: an empty row begins a new group. Notes are sentences below it."""

    title: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Any] | Line]
    notes: Sequence[str] = ()

    @property
    def has_head(self) -> bool:
        """Whether any column has a name."""
        return any(column.name for column in self.columns)

    def texts(self, digits: int = PAGE) -> list[list[list[str]]]:
        """Return the groups of rows with their cells as text; `digits` are those of SHORT numbers."""
        groups: list[list[list[str]]] = [[]]
        among = self._numbers()
        for row in self.rows:
            if isinstance(row, Line):
                numbers = [float(x) for x in row.values if _is_number(x)]
                values = (cell(x, row.format, numbers, digits) for x in row.values)
                groups[-1].append([with_unit(row.name, row.unit), *values])
            elif row:
                pairs = zip(row, self.columns, strict=True)
                groups[-1].append([cell(x, c.format, among.get(c.unit, ()), digits) for x, c in pairs])
            else:
                groups.append([])
        return [group for group in groups if group]

    def _numbers(self) -> dict[str, list[float]]:
        """Return the SHORT numbers of all columns of each unit: they have the same decimals."""
        numbers: dict[str, list[float]] = {}
        for row in self.rows:
            for x, column in zip(row, self.columns, strict=False) if not isinstance(row, Line) else ():
                if column.format == SHORT and _is_number(x):
                    numbers.setdefault(column.unit, []).append(float(x))
        return numbers


Part: TypeAlias = "str | Table | tuple[Table, ...]"
"""A part of what is shown: a sentence, a table, or tables that may stand side by side."""


def _is_number(value: Any) -> TypeGuard[float]:
    return not isinstance(value, str) and value is not None and math.isfinite(value)


def grouped(rows: Iterable[Sequence[Any]], count: int = 3) -> Iterator[Sequence[Any]]:
    """Yield rows with a new group after each `count`: the legs and joints of a kind are three."""
    for k, row in enumerate(rows):
        if k and k % count == 0:
            yield ()
        yield row


def plain_text(part: Part) -> str:
    """Return a part as lines of plain text."""
    if isinstance(part, tuple):
        return "\n".join(map(plain_text, part))
    if not isinstance(part, Table):
        return part
    rows = [row for group in part.texts() for row in group]
    if part.has_head:
        rows.insert(0, [with_unit(column.name, column.unit) for column in part.columns])
    widths = [max(len(row[k]) for row in rows) for k in range(len(part.columns))] if rows else []
    left = [column.format == WORDS for column in part.columns]
    lines = [
        "  ".join(f"{text:{'<' if to_left else '>'}{w}}" for text, w, to_left in zip(row, widths, left, strict=True))
        for row in rows
    ]
    return "\n".join([part.title, *(line.rstrip() for line in lines), *part.notes])
