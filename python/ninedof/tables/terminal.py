"""Tables on a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rich import box, table
from rich.console import Group
from rich.text import Text

from ninedof.support.text import escaped
from ninedof.support.units import heading
from ninedof.tables.numbers import SCREEN, WORDS
from ninedof.tables.table import Part, Table

# Styles, from roomy to tight: frame, spaces around a cell, and characters of a column beside its text.
STYLES: tuple[tuple[box.Box, tuple[int, int, int, int], bool, int], ...] = (
    (box.HEAVY_HEAD, (0, 1, 0, 1), True, 3),
    (box.HEAVY_HEAD, (0, 1, 0, 1), False, 3),
    (box.SIMPLE_HEAD, (0, 1, 0, 0), True, 2),
    (box.SIMPLE_HEAD, (0, 0, 0, 0), True, 1),
)


def terminal(part: Part, width: int) -> Any:
    """Return what rich prints for a part; a table of numbers that is wide stands closer together."""
    if isinstance(part, tuple):
        return Group(*(terminal(one, width) for one in part))
    if not isinstance(part, Table):
        return part
    title = [Text(escaped(part.title), style="bold")] if part.title else []
    return Group(*title, _rich(part, width), *part.notes)


def _rich(one: Table, width: int) -> table.Table:
    groups = one.texts(SCREEN)
    heads = [heading(column.name, column.unit) for column in one.columns]
    words = [column.format == WORDS for column in one.columns]
    rows = [row for group in groups for row in group]
    texts = [(head, *(row[k] for row in rows)) for k, head in enumerate(heads)]
    least = [
        max(_least(head, True), *(_least(text, folds) for text in others), 0)
        for (head, *others), folds in zip(texts, words, strict=True)
    ]
    want = [max(len(line) for text in column for line in text.split("\n")) for column in texts]
    names = [want[0], *least[1:]]  # a row's name in one line, where there is room and it is no sentence
    if want[0] <= width // 2 and sum(names) + STYLES[-1][3] * len(heads) <= width:
        least = names
    styles = (style for style in STYLES if sum(least) + style[3] * len(heads) + 2 * style[2] <= width)
    frame, padding, edge, beside = next(styles, STYLES[-1])
    out = table.Table(box=frame, padding=padding, pad_edge=edge, show_header=one.has_head)
    widths = _widths(least, want, width - beside * len(heads) - edge)
    for head, folds, own in zip(heads, words, widths, strict=True):
        out.add_column(head, justify="left" if folds else "right", overflow="fold", width=own)
    for group in groups:
        for k, row in enumerate(group, start=1):
            out.add_row(*row, end_section=k == len(group))
    return out


def _widths(least: list[int], want: list[int], room: int) -> Sequence[int | None]:
    """Return the widths of columns where rich, which cuts the widest ones to one width, would tear a word."""

    def cut(narrowest: list[int]) -> list[int]:
        cuts = (
            [max(n, min(w, most)) for n, w in zip(narrowest, want, strict=True)] for most in range(max(want), 0, -1)
        )
        return next((widths for widths in cuts if sum(widths) <= room), want)

    torn = any(width < needs for width, needs in zip(cut([0] * len(want)), least, strict=True))
    return cut(least) if torn and sum(least) <= room else [None] * len(want)


def _least(text: str, folds: bool) -> int:
    """Return how wide the column of a text must be: words and lists may fold, numbers with their units may not."""
    folds = folds or ", " in text or "  " in text
    return max((len(part) for part in (text.split() if folds else text.split("\n"))), default=0)
