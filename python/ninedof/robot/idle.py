"""Legs that never move, and legs that never carry load."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.robot.geometry import LEGS
from ninedof.support.arrays import Floats

IDLE: float = _core.idle_share
"""Of the longest leg: a leg whose length changes by less does not move."""


def idle_legs(lengths: Floats) -> NDArray[np.bool_]:
    """Return which legs have the same length at all poses, of which there are several; lengths (n, 9)."""
    return np.asarray(_core.idle_legs(lengths.min(axis=0), lengths.max(axis=0))) & (len(lengths) > 1)


def idle_names(lengths: Floats) -> tuple[str, ...]:
    """Return the names of the legs that never move."""
    return tuple(name for name, idle in zip(LEGS, idle_legs(lengths), strict=True) if idle)


UNLOADED = 1e-9
"""Of the greatest force in any leg: a leg that carries no more at every pose carries no load."""
NEVER_MOVE = "a strut of fixed length would do"
NEVER_CARRY = "no force closes their play, so backlash there moves the platform"


def unloaded_names(forces: Floats) -> tuple[str, ...]:
    """Return the names of the legs whose force is 0 at all poses, under a load; forces (..., 9)."""
    most = np.abs(forces).reshape(-1, 9).max(axis=0, initial=0.0)
    return tuple(
        name for name, one in zip(LEGS, most, strict=True) if one <= UNLOADED * most.max() and most.max() > 0.0
    )
