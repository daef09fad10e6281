"""Text that cannot act on a terminal, a page or a figure: no escape sequence, no turned order of letters."""

from __future__ import annotations

import re

MOST = 1200  # characters of a message
HEAD, TAIL = 800, 300  # of those of a longer one that stay: its subject, and what was expected

# Control characters but tab and line feed, marks of direction and of width zero, separators of lines, lone surrogates,
# what is no character.
_UNPRINTABLE = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u00ad\u061c\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff"
    "\ufdd0-\ufdef\ufff9-\ufffb\ufffe\uffff\ud800-\udfff\U000e0000-\U000e007f]"
)


def escaped(text: str) -> str:
    """Return a text whose characters that are not to be seen are escapes as in Python, tabs and line feeds left."""
    return _UNPRINTABLE.sub(lambda found: ascii(found[0])[1:-1], text)


def one_line(text: str) -> str:
    """Return a message as one line: line feeds and tabs are escapes too, and a long one is cut in the middle."""
    if len(text) > MOST:
        text = f"{text[:HEAD]} ... {text[-TAIL:]}"
    return escaped(text).replace("\n", "\\n").replace("\t", "\\t")
