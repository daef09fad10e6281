"""Numbers as the page shows them."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ninedof.sheet.pose_words import fixed

DIGITS = 6  # significant, of the largest number of a table
DECIMALS = 4  # at least
ROUNDING = 1e-9  # of the largest number: nothing but rounding is below


def short(value: float, among: Iterable[float] = ()) -> str:
    """Return a number with six significant digits or more, and four decimals or more.

    With `among`, the numbers of its table, the decimals are those of the largest. Zero is "0"; an exponent is used
    where all are very large or small, or nothing of a number would be left.
    """
    size = max((abs(x) for x in (value, *among) if math.isfinite(x)), default=0.0)
    if not math.isfinite(value):
        return f"{value:g}"
    if abs(value) <= ROUNDING * size:
        return "0"
    exponent = f"{value:.{DIGITS - 1}e}"
    if not 1e-3 <= size < 1e7:
        return exponent
    text = fixed(value, max(DECIMALS, DIGITS - 1 - math.floor(math.log10(size))))
    return exponent if text == "0" else text


def degrees(value: float | None) -> str:
    """Return an angle in radians as degrees, "-" for none."""
    return "-" if value is None else f"{math.degrees(value):.2f}°"
