"""Margins: what a value leaves of a limit, the same wherever one is shown."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core

TOLERANCE: float = _core.margin_tolerance
"""A limit that is violated by no more is kept, as for `certify`: between the poses that were looked at, a design of the
optimizer violates its limits by up to 1e-7."""
MOST = 1e4  # per cent: from here on the number itself says little


def margin_of(kind: str, side: str, limit: ArrayLike, value: ArrayLike) -> Any:
    """Return what a value leaves of a limit, negative where the limit is violated.

    A ratio, a length or an angle leaves a share of the limit: (limit - value) / limit of a max, (value - limit) / limit
    of a min; an open side leaves all. A determinant, of the kind "sign", has no scale and its limit may be 0: it leaves
    value - limit.
    """
    return _core.margin(kind, side, np.asarray(limit, dtype=float), np.asarray(value, dtype=float))


def is_violated(margin: float, kind: str = "ratio", limit: float = 0.0) -> bool:
    """Whether a margin is negative beyond the tolerance, or unknown.

    A "sign" needs its limit too, see `tolerance_of`.
    """
    return not margin >= -tolerance_of(kind, limit)


def tolerance_of(kind: str, limit: float) -> float:
    """Return how far below 0 a margin still counts as kept: TOLERANCE of the limit.

    The margin of a "sign" is no share of its limit. A determinant on the other side of a singularity is never kept.
    """
    return TOLERANCE * abs(limit) if kind == "sign" else TOLERANCE


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
