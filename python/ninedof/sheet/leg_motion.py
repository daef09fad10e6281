"""The motion of the platform behind the speeds and accelerations of the legs, and how O moves in it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof.robot.configuration import Configuration
from ninedof.robot.idle import IDLE
from ninedof.support.arguments import choice, finite, shown
from ninedof.support.arrays import as_floats

FASTEST = 1e100  # speeds: their squares must be numbers
INTERNAL = ("least", "held", "shifted", "carried")


class Motion(NamedTuple):
    """A motion of the platform in any direction, and a given one."""

    linear_speed: float
    """Of the platform origin, length/time."""
    angular_speed: float
    """rad/time."""
    internal: str
    """How O moves: "least" squares of the leg rates and of the leg accelerations, "held", "shifted" or "carried" as in
    `ninedof.redundancy.rules`."""
    twist: tuple[float, ...] | None = None
    """Angular velocity (rad/time) and velocity of the platform's origin, base frame; None without one."""
    twist_rate: tuple[float, ...] = (0.0,) * 6
    """Its time derivative."""

    @classmethod
    def checked(
        cls,
        linear_speed: float,
        angular_speed: float,
        internal: str,
        twist: ArrayLike | None = None,
        twist_rate: ArrayLike | None = None,
    ) -> Motion:
        """Return the motion of valid arguments."""
        speeds = (
            finite("linear_speed", linear_speed, 0.0, FASTEST),
            finite("angular_speed", angular_speed, 0.0, FASTEST),
        )
        rule = choice("internal", internal, INTERNAL)
        if twist is None:
            if twist_rate is not None:
                raise ValueError(f"twist_rate: got {shown(twist_rate)} without a twist, expected a twist too")
            return cls(*speeds, rule)
        rate = (0.0,) * 6 if twist_rate is None else _six("twist_rate", twist_rate)
        return cls(*speeds, rule, _six("twist", twist), rate)


def shown_internal(c: Configuration) -> str:
    """Return the rule that O follows over a stack of poses: "held", "carried", "shifted", or "least" where none."""
    if len(c) < 2:
        return "least"
    size = IDLE * np.abs(np.concatenate([c.position, c.internal_point])).max()
    arm = c.internal_point - c.position
    own = (arm[:, None] @ c.rotation)[:, 0]  # rows: Q^T (s - p)
    for rule, places in (("held", c.internal_point), ("carried", own), ("shifted", arm)):
        if np.abs(places - places[0]).max() <= size:
            return rule
    return "least"


def _six(name: str, value: ArrayLike) -> tuple[float, ...]:
    found = as_floats(name, value, (6,))
    if found.shape != (6,) or not np.isfinite(found).all():
        raise ValueError(f"{name}: got {shown(value)}, expected six finite numbers, rotation first")
    return tuple(found.tolist())
