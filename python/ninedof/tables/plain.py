"""Tables as plain text."""

from __future__ import annotations

from ninedof.support.units import with_unit
from ninedof.tables.table import WORDS, Part, Table


def plain(part: Part) -> str:
    """Return a part as lines of plain text."""
    if isinstance(part, tuple):
        return "\n".join(map(plain, part))
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
