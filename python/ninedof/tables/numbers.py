"""Numbers as tables show them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

DECIMALS = 4  # at least
ROUNDING = 1e-9  # of the largest number: nothing but rounding is below
PAGE, SCREEN = 6, 5  # significant digits of the largest number: what is on paper may go to a workshop
WORDS, RIGHT, SHORT, DEGREES = "", ">", "short", "degrees"


def short(value: float, among: Iterable[float] = (), digits: int = PAGE) -> str:
    """Return a number with so many significant digits or more, and four decimals or more.

    With `among`, the numbers of its table, the decimals are those of the largest. Zero is "0"; an exponent is used
    where all are very large or small, or nothing of a number would be left.
    """
    size = max((abs(x) for x in (value, *among) if math.isfinite(x)), default=0.0)
    if not math.isfinite(value):
        return f"{value:g}"
    if abs(value) <= ROUNDING * size:
        return "0"
    exponent = f"{value:.{digits - 1}e}"
    if not 1e-3 <= size < 1e7:
        return exponent
    text = f"{value:.{max(DECIMALS, digits - 1 - math.floor(math.log10(size)))}f}"
    return text if text.strip("-0.") else exponent


def cell(value: Any, form: str, among: Iterable[float] = (), digits: int = PAGE) -> str:
    """Return a cell as text: text as it is, "-" for None and NaN, and a number in the format of its column."""
    if isinstance(value, str):
        return value
    if value is None or math.isnan(value):
        return "-"
    if form == SHORT:
        return short(float(value), among, digits)
    return f"{math.degrees(value):.2f}°" if form == DEGREES else format(value, form)


def load_text(value: float, among: Iterable[float] = ()) -> str:
    """Return a force, a speed or a power with the digits of a screen; 0 for rounding beside the largest of `among`."""
    size = max((abs(x) for x in among if math.isfinite(x)), default=0.0)
    text = "0" if abs(value) <= ROUNDING * size else f"{value:.{SCREEN}g}"
    return f"{value:.0f}" if "e+" in text and abs(value) < 1e7 else text


def spread(low: float, high: float, among: Iterable[float] = ()) -> str:
    """Return one number or both ends of a range, "2 to 3", as `load_text` writes them."""
    numbers = [*among]
    ends = [load_text(x, numbers) for x in (low, high)]
    return ends[0] if ends[0] == ends[1] else f"{ends[0]} to {ends[1]}"
