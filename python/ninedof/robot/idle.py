"""Legs that never move."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.robot.leg_names import LEGS
from ninedof.support.arrays import Floats

IDLE: float = _core.idle_share
"""Of the longest leg: a leg whose length changes by less does not move."""


def idle_legs(lengths: Floats) -> NDArray[np.bool_]:
    """Return which legs have the same length at all poses, of which there are several; lengths (n, 9)."""
    return np.asarray(_core.idle_legs(lengths.min(axis=0), lengths.max(axis=0))) & (len(lengths) > 1)


def idle_names(lengths: Floats) -> tuple[str, ...]:
    """Return the names of the legs that never move."""
    return tuple(name for name, idle in zip(LEGS, idle_legs(lengths), strict=True) if idle)
