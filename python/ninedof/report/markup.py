"""Pieces of HTML. Plain text is escaped wherever it is put in, and made visible; what is `Html` already is not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import NamedTuple

from ninedof.support.printable import escaped


class Html(str):
    """Text that is HTML already."""


class Section(NamedTuple):
    """A section of the page."""

    id: str
    title: str
    body: Html


def safe(value: object) -> str:
    """Return a value as HTML: escaped, unless it is HTML already."""
    return str(value) if isinstance(value, Html) else escape(escaped(str(value)))


def tag(name: str, *children: object, **attributes: object) -> Html:
    """Return an element; a trailing underscore of an attribute (class_) is dropped, others become hyphens."""
    given = "".join(f' {key.strip("_").replace("_", "-")}="{escape(escaped(str(v)))}"' for key, v in attributes.items())
    return Html(f"<{name}{given}>{''.join(safe(child) for child in children)}</{name}>")


def joined(*parts: Html) -> Html:
    """Return parts one after the other."""
    return Html("\n".join(part for part in parts if part))


def paragraphs(sentences: Iterable[str], kind: str = "") -> Html:
    """Return a paragraph for each sentence."""
    return joined(*(tag("p", text, **({"class_": kind} if kind else {})) for text in sentences if text))


def table(caption: str, head: Sequence[object], rows: Iterable[Sequence[object]], words: Sequence[int] = ()) -> Html:
    """Return a table that scrolls sideways on a narrow screen; an empty row starts a new group.

    Parameters
    ----------
    caption, head : str, sequence
    rows : iterable of sequences
        The first cell names its row.
    words : sequence of int
        Columns that hold words, to the left; the others hold numbers, to the right.

    """
    kinds = ["w" if k in words or k == 0 else "n" for k in range(len(head))]
    top = tag("tr", *(tag("th", cell, scope="col", class_=kind) for cell, kind in zip(head, kinds, strict=True)))
    groups: list[list[Html]] = [[]]
    for row in rows:
        if not row:
            groups.append([])
            continue
        first = tag("th", row[0], scope="row", class_="w")
        cells = (tag("td", cell, class_=kind) for cell, kind in zip(row[1:], kinds[1:], strict=True))
        groups[-1].append(tag("tr", first, *cells))
    bodies = (tag("tbody", *group) for group in groups if group)
    inner = tag("table", tag("caption", caption), tag("thead", top), *bodies)
    return tag("div", inner, class_="table", tabindex=0, role="region", aria_label=caption)


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
