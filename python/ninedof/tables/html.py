"""Pieces of HTML. Plain text is escaped wherever it is put in, and made visible; what is `Html` already is not."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ninedof.support.text import escaped
from ninedof.support.units import with_unit
from ninedof.tables.numbers import WORDS
from ninedof.tables.table import Part, Table

NAMES = re.compile("(?<=[a-z]{2})_(?=[a-z]{2})")  # between words, as in leg_ratio; x_p is a symbol


class Html(str):
    """Text that is HTML already."""


def safe(value: object) -> str:
    """Return a value as HTML: escaped, unless it is HTML already."""
    from html import escape  # when it is needed, as it takes time to load

    return value if isinstance(value, Html) else escape(escaped(str(value)))


def tag(name: str, *children: object, **attributes: object) -> Html:
    """Return an element; a trailing underscore of an attribute (class_) is dropped, others become hyphens."""
    pairs = "".join(f' {key.strip("_").replace("_", "-")}="{safe(str(v))}"' for key, v in attributes.items())
    return Html(f"<{name}{pairs}>{''.join(safe(child) for child in children)}</{name}>")


def joined(*parts: Html) -> Html:
    """Return parts one after the other."""
    return Html("\n".join(part for part in parts if part))


def paragraphs(sentences: Iterable[str], **attributes: object) -> Html:
    """Return a paragraph for each sentence."""
    return joined(*(tag("p", text, **attributes) for text in sentences if text))


def table_html(table: Table) -> Html:
    """Return a table with its notes below."""
    kinds = ["w" if column.format == WORDS else "n" for column in table.columns]
    heads = (
        tag("th", with_unit(column.name, column.unit), scope="col", class_=kind)
        for column, kind in zip(table.columns, kinds, strict=True)
    )
    bodies = (tag("tbody", *(tag("tr", *_cells(row, kinds)) for row in group)) for group in table.texts() if group)
    caption = [tag("caption", table.title)] if table.title else []
    head = [tag("thead", tag("tr", *heads))] if table.has_head else []
    notes = tag("div", paragraphs(table.notes, class_="note"), class_="notes") if any(table.notes) else Html()
    return joined(tag("table", *caption, *head, *bodies), notes)


def _cells(row: list[str], kinds: list[str]) -> Iterable[Html]:
    """Yield the cells of a row: the first one names it. Names of limits and variables are words here, lines a list."""
    first, *others = (NAMES.sub(" ", text.replace("\n", ", ")) for text in row)
    yield tag("th", first, scope="row", class_=kinds[0])
    yield from (tag("td", text, class_=kind) for text, kind in zip(others, kinds[1:], strict=True))


def html_of(part: Part) -> Html:
    """Return a part of what is shown for the page of a run; a table scrolls sideways on a narrow screen."""
    if isinstance(part, Html):
        return part
    if isinstance(part, str):
        return paragraphs([part])
    if isinstance(part, tuple):
        return beside(*map(html_of, part))
    return tag("div", table_html(part), class_="table", tabindex=0, role="region", aria_label=part.title)


def notebook(*parts: str | Table) -> str:
    """Return what a notebook shows of a result."""
    return tag("div", *(table_html(part) if isinstance(part, Table) else tag("p", part) for part in parts))


class Worded:
    """Base of a result that is told in sentences, as text and in a notebook."""

    def sentences(self) -> Iterable[str]:
        """Yield the sentences."""
        raise NotImplementedError

    def __str__(self) -> str:
        """Return the sentences."""
        return "\n".join(self.sentences())

    def _repr_html_(self) -> str:
        return notebook(*self.sentences())


def beside(*parts: Html) -> Html:
    """Return parts side by side where the screen is wide enough."""
    return tag("div", *(tag("div", part) for part in parts if part), class_="beside")


def facts(rows: Iterable[tuple[object, object]]) -> Html:
    """Return a list of names with their values."""
    return tag("dl", *(tag("div", tag("dt", name), tag("dd", value)) for name, value in rows))


def bullets(items: Iterable[str]) -> Html:
    """Return a list of sentences."""
    return tag("ul", *(tag("li", item) for item in items if item))


def listing(text: str) -> Html:
    """Return text as it is, in a fixed pitch."""
    return tag("pre", tag("code", text), tabindex=0)
