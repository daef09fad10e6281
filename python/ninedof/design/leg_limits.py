"""The limits of a study on leg lengths, for each leg."""

from __future__ import annotations

import math

import numpy as np

from ninedof import _core
from ninedof.design.limits import ROWS
from ninedof.design.study import Study
from ninedof.robot.leg_names import LEGS as LEG_NAMES
from ninedof.support.arrays import Floats

SPREADS = _core.limits_over_lengths  # limits that compare poses
LEGS = {
    name: [LEG_NAMES.index(part) for part in parts]
    for name, parts in _core.limit_parts.items()
    if ROWS[name].kind == "length" and set(parts) <= set(LEG_NAMES)
}
"""Constraints of lengths, and their legs in the order of `leg_lengths`."""


def leg_limits_of(study: Study, zp: float) -> tuple[Floats, Floats]:
    """Return the least and greatest length of each leg in a study, shapes (9,); 0 and infinity where it has none.

    Parameters
    ----------
    study : Study
    zp : float
        Height of the platform, for limits in units of it.

    """
    low, high = np.zeros(9), np.full(9, math.inf)
    for limit in study.limits:
        if limit.name in LEGS and limit.at == "poses":
            unit, legs = zp if limit.of == "zp" else 1.0, LEGS[limit.name]
            low[legs] = np.maximum(low[legs], unit * limit.low)
            high[legs] = np.minimum(high[legs], unit * limit.high)
    return low, high
