"""What a study asks of every pose, as criteria of a workspace."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ninedof.design import limits
from ninedof.design.limits import Limit
from ninedof.support.arrays import Floats

LEGS = {
    "leg_length": slice(0, 9),
    "external_length": slice(0, 3),
    "upper_length": slice(3, 6),
    "lower_length": slice(6, 9),
}
"""Constraints of leg lengths, and their legs in the order of `leg_lengths`."""


EASE = 1e-9
"""Share by which limits are eased: an optimum lies on some of them, and rounding would put its home pose outside."""


def study_criteria(constraints: Mapping[str, limits.Limits], zp: float) -> tuple[dict[str, Any], list[str]]:
    """Return the limits of a study that a pose alone can meet, and the names of the others.

    Ranges of leg lengths keep the names of their constraints; `leg_ranges` makes leg limits of them. Limits in zp are
    taken at the given height, of the design at its neutral pose. All are eased by `EASE` of themselves.
    """
    found: dict[str, Any] = {}
    left: list[str] = []
    for name, limit in limits.each(constraints):
        low, high, options = limits.parts(limit)
        unit = zp if options.get("of") == "zp" else 1.0
        low = None if low is None else unit * low * (1.0 - EASE)
        high = None if high is None else unit * high * (1.0 + EASE)
        if limits.place(limit) != "poses":
            left.append(limits.label(name, limits.place(limit)))
        elif name in LEGS:
            found[name] = (0.0 if low is None else low, math.inf if high is None else high)
        elif name in ("base_cone", "platform_cone"):
            found[name] = _cone(limit, None if high is None else min(high, math.pi))
        elif name == "leg_clearance":
            found |= {} if low is None else {name: low}
        elif name == "singularity_free":
            found[name] = True
        else:
            left.append(name)
    return found, left


def leg_ranges(ranges: Mapping[str, tuple[float, float]]) -> tuple[Any, Any] | None:
    """Return the leg limits that all given ranges leave: two numbers where they are those of all nine legs.

    Raises
    ------
    ValueError
        If a range is empty by itself.

    """
    low, high = np.zeros(9), np.full(9, np.inf)
    for name, (least, most) in ranges.items():
        if not 0.0 <= least < most:
            raise ValueError(f"{name}: got {least:g} to {most:g}, expected 0 <= low < high")
        legs = LEGS[name]
        low[legs], high[legs] = np.maximum(low[legs], least), np.minimum(high[legs], most)
    if not ranges or (not low.any() and np.isinf(high).all()):
        return None
    return (float(low[0]), float(high[0])) if np.ptp(low) == 0.0 and len(set(high.tolist())) == 1 else (low, high)


def own_fraction(upper: Floats, lower: Floats, point: Floats) -> float | None:
    """Return how far between the centroids of the lower and the upper internal joints a point lies, None if beside.

    zs / zp for plates whose internal joints are in the planes z = 0 and z = zp.
    """
    line, arm = upper - lower, point - lower
    square = float(line @ line)
    if not square > 0.0:
        return None
    fraction = float(arm @ line) / square
    return fraction if float(np.linalg.norm(arm - fraction * line)) <= 1e-9 * math.sqrt(square) else None


def _cone(limit: Limit, high: float | None) -> Any:
    axis = limit.get("axis") if isinstance(limit, Mapping) else None
    return high if axis is None else {"max": high, "axis": axis}
