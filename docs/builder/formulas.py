"""Formulas: the pages write them as plain text, l_c and σ_min; the site shows the part after the sign as an index."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from sphinx import addnodes

# One letter, perhaps with accents of its own, then what is set lower: a word of up to three letters, or digits.
INDEX = re.compile(r"(?<![A-Za-z0-9_])([^\W\d_][\u0300-\u036f]*)_((?:max|min|mid|[A-Za-z]|\d{1,2})(?![A-Za-z0-9_]))")
CODE = (nodes.literal, nodes.raw, nodes.image, addnodes.desc_signature)


def lower_indices(app: Any, document: nodes.document) -> None:
    """Set indices lower, in text and in formulas, in place; code keeps its names."""
    for block in filter(is_formula, document.findall(nodes.literal_block)):
        block.rawsource = ""  # or Sphinx would highlight it, and lose the indices
    for text in list(document.findall(nodes.Text)):
        if INDEX.search(text) and not is_code(text):
            parts = INDEX.split(text)  # text, letter and index by turns
            lower = [nodes.subscript("", part) if k % 3 == 2 else nodes.Text(part) for k, part in enumerate(parts)]
            text.parent.replace(text, lower)


def is_formula(block: nodes.literal_block) -> bool:
    """Return whether a block is a formula: it has no language."""
    return bool(block.get("language", "none") == "none")


def is_code(node: Any) -> bool:
    """Return whether a text lies in code: in a block with a language, a name or a signature."""
    while node is not None:
        if isinstance(node, CODE) or (isinstance(node, nodes.literal_block) and not is_formula(node)):
            return True
        node = node.parent
    return False
