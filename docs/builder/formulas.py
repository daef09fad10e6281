"""Formulas: the pages write them as plain text, l_c and σ_min; the site shows the part after the sign as an index."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes

# One letter, perhaps with accents of its own, then what is set lower: a word of up to three letters, or digits.
INDEX = re.compile(r"(?<![A-Za-z0-9_])([^\W\d_][\u0300-\u036f]*)_((?:max|min|mid|[A-Za-z]|\d{1,2})(?![A-Za-z0-9_]))")
KEPT = (nodes.literal, nodes.raw, nodes.image)


def lower_indices(app: Any, document: nodes.document) -> None:
    """Set indices lower, in text and in formulas, in place; code keeps its names."""
    for block in document.findall(nodes.literal_block):
        if block.get("language", "none") == "none":
            block.rawsource = ""  # or Sphinx would highlight it, and lose the indices
    for text in list(document.findall(nodes.Text)):
        if INDEX.search(text) and not _is_code(text):
            block = text.parent
            at = block.index(text)
            block.remove(text)
            block.insert(at, _pieces(str(text)))


def _is_code(text: nodes.Text) -> bool:
    node: Any = text
    while node is not None:
        if isinstance(node, nodes.literal_block):
            return bool(node.get("language", "none") != "none")
        if isinstance(node, KEPT) or (
            node.__class__.__name__.startswith("desc_") and "content" not in type(node).__name__
        ):
            return True
        node = node.parent
    return False


def _pieces(text: str) -> list[nodes.Node]:
    found: list[nodes.Node] = []
    end = 0
    for match in INDEX.finditer(text):
        found += [nodes.Text(text[end : match.end(1)]), nodes.subscript("", match[2])]
        end = match.end()
    return [*found, nodes.Text(text[end:])]
