"""What a damaged record makes of its page, as one line that names the record."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from ninedof.support.arguments import LONGEST
from ninedof.support.printable import escaped

ODD = (LookupError, TypeError, AttributeError, ArithmeticError)
"""Raised by values of another kind than the record of a run has: entries that are missing, words for numbers."""


@contextlib.contextmanager
def named(place: Path) -> Iterator[None]:
    """Raise ValueError in one line, naming the record, where its entries are not those of a run."""
    try:
        yield
    except ValueError as error:
        said = _line(error)
        raise ValueError(said if said.startswith(escaped(str(place))) else f"{place}: {said}") from None
    except ODD as error:
        said = f"{type(error).__name__}: {_line(error)}"
        raise ValueError(f"{place}: got a record that is not whole ({said}), expected that of a run") from None


def _line(error: Exception) -> str:
    text = escaped(" ".join(str(error).split()))
    return text if len(text) <= 2 * LONGEST else text[: 2 * LONGEST] + "..."
