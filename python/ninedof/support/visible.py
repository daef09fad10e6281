"""Foreign text made visible: characters that act on a terminal, a page or a figure in place of standing there."""

from __future__ import annotations

import re

# Control characters but tab and newline; marks that turn the direction of writing, so that a line reads otherwise than
# it is; halves of characters, as in names of files that are no text; what is no character.
ACTING = re.compile(
    r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufdd0-\ufdef\ufeff\ufffe\uffff]"
)


def visible(text: str) -> str:
    r"""Return a text with such characters as Python writes them, such as \x1b and \u202e.

    Examples
    --------
    >>> visible("a\x1b[31mb")
    'a\\x1b[31mb'

    """
    return ACTING.sub(lambda found: found[0].encode("unicode_escape", "surrogatepass").decode(), text)
