"""Numbers as the page shows them."""

from __future__ import annotations

import math


def short(value: float) -> str:
    """Return a number with four decimals, zero as "0", and a very large or small one with an exponent."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    return f"{value:.4f}" if 1e-3 <= abs(value) < 1e7 else f"{value:.4e}"


def degrees(value: float | None) -> str:
    """Return an angle in radians as degrees, "-" for none."""
    return "-" if value is None else f"{math.degrees(value):.2f}°"
