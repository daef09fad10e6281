"""How docstrings are read: bars of mathematics are no markup, and public names are links."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.roles import XRefRole

import ninedof as nd


def read(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Prepare the lines of a docstring in place, before the sections of numpy's style are read."""
    escape_bars(lines)
    if what in ("attribute", "property", "data"):
        lines[:0] = ["..", ""]  # an empty comment, or the words before a colon in the first line are taken for a type


def escape_bars(lines: list[str]) -> None:
    """Escape `|` in prose, in place: moduli and norms are not substitutions. Examples keep theirs."""
    in_example = False
    for k, line in enumerate(lines):
        in_example = bool(line.strip()) and (in_example or line.lstrip().startswith(">>>"))
        if not in_example:
            parts = re.split(r"(`[^`]*`)", line)
            lines[k] = "".join(p if p.startswith("`") else re.sub(r"(?<!\\)\|", r"\\|", p) for p in parts)


def public_name(
    name: str, rawtext: str, text: str, lineno: int, inliner: Any, options: Any = None, content: Any = ()
) -> tuple[list[nodes.Node], list[nodes.system_message]]:
    """Role of `text` in single quotes: a link if it is a public name or a member of one, else code."""
    target = text.removeprefix("nd.")
    if target.partition(".")[0] in nd.__all__ and re.fullmatch(r"[\w.]+", target):
        words = f"{text} <ninedof.{target}>"
        return XRefRole()("py:obj", f":py:obj:`{words}`", words, lineno, inliner, options or {}, list(content))
    return [nodes.literal(rawtext, text)], []


def keep_public_links(app: Any, document: nodes.document) -> None:
    """Make words of the types of parameters plain, in place, unless they are public names: "shape" is no attribute."""
    for link in list(document.findall(addnodes.pending_xref)):
        target = str(link.get("reftarget"))
        if link.get("refdomain") == "py" and not target.startswith("ninedof.") and target not in nd.__all__:
            link.replace_self(link.children)
