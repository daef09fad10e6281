"""What a study asks of every pose, as criteria of a workspace."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

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


def study_criteria(limits: Iterable[Limit], zp: float) -> tuple[dict[str, Any], list[str]]:
    """Return the limits of a study that a pose alone can meet, and the names of the others.

    Ranges of leg lengths keep the names of their constraints; `leg_ranges` makes leg limits of them. Limits in zp are
    taken at the given height, of the design at its neutral pose. All are eased by `EASE` of themselves.
    """
    found: dict[str, Any] = {}
    left: list[str] = []
    for limit in limits:
        name, unit = limit.name, zp if limit.of == "zp" else 1.0
        low, high = unit * limit.low * (1.0 - EASE), unit * limit.high * (1.0 + EASE)
        if limit.at != "poses":
            left.append(limit.label)
        elif name in LEGS:
            found[name] = (low, high)
        elif limit.row.is_angle:
            angle = min(high, math.pi) if "max" in limit.sides else None
            found[name] = {"max": angle, "axis": limit.axis} if limit.axis else angle
        elif name == "leg_clearance":
            found |= {name: low} if low > 0.0 else {}
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
