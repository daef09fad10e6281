"""Margins: what a value leaves of a limit, the same wherever one is shown."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

TOLERANCE = 1e-6
"""A limit that is passed by no more is kept, as for `certify`: between the poses that were looked at, a design of the
optimizer passes its limits by up to 1e-7."""
MOST = 1e4  # per cent: from here on the number itself says little


def margin_of(kind: str, side: str, limit: ArrayLike, value: ArrayLike) -> Any:
    """Return what a value leaves of a limit, negative where the limit is violated.

    A ratio, a length or an angle leaves a share of the limit: (limit - value) / limit of a max, (value - limit) / limit
    of a min. A determinant has no scale and its limit may be 0: it leaves value - limit.

    Parameters
    ----------
    kind : str
        As in the table of constraints: "ratio", "length", "angle" or "sign".
    side : str
        "min" or "max".
    limit, value : array_like
        In the same unit.

    """
    above = np.subtract(value, limit)
    room = above if side == "min" else -above
    return room[()] if kind == "sign" else np.divide(room, limit)[()]


def value_of(kind: str, side: str, limit: float, margin: float) -> float:
    """Return the value that leaves this margin."""
    room = margin if kind == "sign" else margin * limit
    return limit + room if side == "min" else limit - room


def is_violated(margin: float) -> bool:
    """Whether a margin is negative beyond the tolerance, or unknown."""
    return not margin >= -TOLERANCE


def margin_words(margin: float, kind: str) -> str:
    """Return a margin in per cent of the limit; that of a "sign", which has no scale, as it is."""
    if not math.isfinite(margin):
        return "-" if math.isnan(margin) else "∞" if margin > 0.0 else "-∞"
    if kind == "sign":
        return f"{round(margin, 4) + 0.0:.4f}"
    percent = 100.0 * margin
    if abs(percent) >= MOST:
        return f"over {MOST:.0f} %" if percent > 0.0 else f"below -{MOST:.0f} %"
    return f"{round(percent, 2) + 0.0:.2f} %"
