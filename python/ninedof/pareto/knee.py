"""The point of a front to look at first: its knee."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ninedof.pareto.front import Front

FLAT = 1e-6  # of the range of the objective: a front that bulges less has no knee


class Preferred(NamedTuple):
    """What `preferred` returns."""

    number: int
    """Counted from 1, as the table of the front has it."""
    words: str
    """Why."""


def preferred(front: Front) -> Preferred | None:
    """Return the knee of a front, else the tightest limit with the least objective; None without a design.

    The knee is the point farthest below the straight line between the two ends, both axes over their ranges. Limits
    that are no better than a tighter one do not count, nor does an infinite one.
    """
    points = [
        (k, limit, value)
        for k, (limit, value, flat) in enumerate(zip(front.limits, front.objectives, front.dominated, strict=True))
        if not (math.isnan(value) or flat)
    ]
    if not points:
        return None
    finite = [point for point in points if math.isfinite(point[1])]
    if len(finite) > 2:
        at = np.array([point[1:] for point in finite])
        x, y = (
            (column - column[-1]) / (column[0] - column[-1]) for column in at.T
        )  # 1 at the tightest, 0 at the loosest
        below = x - y
        if below.max() > FLAT:
            number = finite[int(below.argmax())][0] + 1
            return Preferred(number, "the knee of the front: farthest below the straight line between its ends")
    return Preferred(points[-1][0] + 1, "the least objective; the front has no knee")
