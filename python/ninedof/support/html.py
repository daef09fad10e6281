"""Small tables for notebooks, escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from ninedof.support.short import short


def html_table(caption: str, rows: Iterable[Sequence[Any]], head: Sequence[str] = ()) -> str:
    """Return a table; the first cell of a row names it."""
    lines = [f'<table><caption style="text-align: left">{escape(caption)}</caption>']
    if head:
        lines.append("<thead><tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr></thead>")
    lines.append("<tbody>")
    for first, *others in rows:
        cells = "".join(f"<td>{escape(_text(cell))}</td>" for cell in others)
        lines.append(f"<tr><th>{escape(_text(first))}</th>{cells}</tr>")
    return "\n".join([*lines, "</tbody></table>"])


def _text(cell: Any) -> str:
    return "-" if cell is None else cell if isinstance(cell, str) else short(cell)
