"""The limits of a study on leg lengths, for each leg."""

from __future__ import annotations

import math

import numpy as np

from ninedof.design.limits import each, for_core, place
from ninedof.design.study import Study
from ninedof.support.arrays import Floats

LEGS = {"leg_length": range(9), "external_length": range(3), "upper_length": range(3, 6), "lower_length": range(6, 9)}
"""Constraints of lengths, and their legs in the order of `leg_lengths`."""

OTHERS = ("leg_ratio", "stroke_ratio", "stroke", "leg_clearance", "base_cone", "platform_cone")
"""Limits at poses that do not follow from the length of one leg at one pose."""


def leg_limits_of(study: Study, zp: float) -> tuple[Floats, Floats]:
    """Return the least and greatest length of each leg in a study, shapes (9,); 0 and infinity where it has none.

    Parameters
    ----------
    study : Study
    zp : float
        Height of the platform, for limits in units of it.

    """
    low, high = np.zeros(9), np.full(9, math.inf)
    for name, limit in each(study.constraints):
        given = for_core(name, limit)
        if name in LEGS and given["at"] == "poses":
            unit, legs = zp if given["of"] == "zp" else 1.0, list(LEGS[name])
            low[legs] = np.maximum(low[legs], unit * given["low"])
            high[legs] = np.minimum(high[legs], unit * given["high"])
    return low, high


def other_limits_of(study: Study) -> tuple[str, ...]:
    """Return the study's limits at poses that `leg_limits_of` does not cover."""
    at_poses = {name for name, limit in each(study.constraints) if place(limit) == "poses"}
    limited = ("condition_limit",) if study.objective.condition_limit is not None else ()
    return (*(name for name in OTHERS if name in at_poses), *limited)
