"""How docstrings are read: bars of mathematics are no markup, and public names are links."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from sphinx import addnodes


def read(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Prepare a docstring in place before numpy's sections are read: `|` is escaped, but in code and examples."""
    in_example = False
    for k, line in enumerate(lines):
        in_example = bool(line.strip()) and (in_example or line.lstrip().startswith(">>>"))
        if not in_example:
            lines[k] = re.sub(r"(`[^`]*`|\\\|)|\|", lambda match: match[1] or r"\|", line)
    if what in ("attribute", "property", "data"):
        lines[:0] = ["..", ""]  # an empty comment, or the words before a colon in the first line are taken for a type


def whole_names(app: Any, document: nodes.document) -> None:
    """Look words of types up as names of the package, in place: "shape" is no attribute of some class."""
    for link in document.findall(addnodes.pending_xref):
        if link.get("reftype") == "class":
            link.attributes.pop("refspecific", None)
            link["py:class"] = None


def public_name(app: Any, env: Any, link: addnodes.pending_xref, words: nodes.TextElement) -> nodes.Element | None:
    """Return the link to a name of the package that another module mentions, or that begins with `nd`."""
    if link.get("refdomain") != "py":
        return None
    name = f"ninedof.{link['reftarget'].removeprefix('nd.')}"
    return env.domains["py"].resolve_xref(env, link["refdoc"], app.builder, "obj", name, link, words)
