"""Speeds and accelerations of the legs: for a motion of the platform in any direction, and for a given twist."""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof.kinematics.acceleration import inverse_acceleration
from ninedof.kinematics.velocity import internal_velocity, inverse_velocity
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.idle import IDLE
from ninedof.support.arguments import choice, finite, shown
from ninedof.support.arrays import Floats, as_floats

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


def leg_speeds(g: Geometry, c: Configuration, motion: Motion) -> Floats:
    """Return the largest rate of each leg over the directions of velocity and angular velocity, shape (n, 9)."""
    omega, pdot = np.eye(6)[:, :3], np.eye(6)[:, 3:]
    each = c[:, None]
    rates = _rates(g, each, motion.internal, omega, pdot)
    turning, shifting = np.linalg.norm(rates[:, :3], axis=1), np.linalg.norm(rates[:, 3:], axis=1)
    return np.asarray(motion.linear_speed * shifting + motion.angular_speed * turning)


def leg_accelerations(g: Geometry, c: Configuration, motion: Motion) -> Floats:
    """Return a bound of each leg's acceleration while the platform's speed and angular velocity are constant, (n, 9).

    The acceleration is a quadratic form of the twist. Over all directions it is at most V^2 |H_vv| + W^2 |H_ww| +
    2 V W |H_wv| with 2-norms of its blocks, and that is reached where one of the speeds V and W is 0.
    """
    v, w = motion.linear_speed, motion.angular_speed
    used = [k for k, speed in enumerate([w] * 3 + [v] * 3) if speed > 0.0]
    out = np.zeros((len(c), 9))
    if not used:
        return out
    pairs = list(combinations(used, 2))
    unit = np.eye(6)
    twists = np.array([*unit[used], *(unit[i] + unit[j] for i, j in pairs)])
    found = _accelerations(g, c[:, None], motion.internal, twists, np.zeros(6))  # pose, twist, leg
    form = np.zeros((len(c), 9, 6, 6))
    for k, i in enumerate(used):
        form[:, :, i, i] = found[:, k]
    for k, (i, j) in enumerate(pairs, start=len(used)):
        form[:, :, i, j] = form[:, :, j, i] = 0.5 * (found[:, k] - form[:, :, i, i] - form[:, :, j, j])
    known = np.isfinite(form).all(axis=(2, 3))
    form[~known] = 0.0
    if w > 0.0:
        out += w**2 * np.abs(np.linalg.eigvalsh(form[:, :, :3, :3])).max(axis=-1)
    if v > 0.0:
        out += v**2 * np.abs(np.linalg.eigvalsh(form[:, :, 3:, 3:])).max(axis=-1)
    if v > 0.0 and w > 0.0:
        out += 2.0 * v * w * np.linalg.svd(form[:, :, :3, 3:], compute_uv=False)[..., 0]
    return np.where(known, out, np.inf)


def twist_rates(g: Geometry, c: Configuration, motion: Motion) -> Floats:
    """Return the rate of each leg for the given twist, shape (n, 9)."""
    twist = np.asarray(motion.twist)
    return _rates(g, c, motion.internal, twist[:3], twist[3:])


def twist_accelerations(g: Geometry, c: Configuration, motion: Motion) -> Floats:
    """Return the acceleration of each leg for the given twist and its rate, shape (n, 9)."""
    return _accelerations(g, c, motion.internal, np.asarray(motion.twist), np.asarray(motion.twist_rate))


def _rates(g: Geometry, c: Configuration, internal: str, omega: Floats, pdot: Floats) -> Floats:
    sdot = None if internal == "least" else _velocity_of_o(g, c, internal, omega, pdot)
    return inverse_velocity(g, c, omega, pdot, sdot)


def _accelerations(g: Geometry, c: Configuration, internal: str, twist: Floats, rate: Floats) -> Floats:
    omega, pdot, alpha, pddot = twist[..., :3], twist[..., 3:], rate[:3], rate[3:]
    sdot = _velocity_of_o(g, c, internal, omega, pdot)
    arm = c.internal_point - c.position
    sddot = np.zeros(3)
    if internal == "shifted":
        sddot = pddot
    elif internal == "carried":
        sddot = pddot + np.cross(alpha, arm) + np.cross(omega, np.cross(omega, arm))
    found = inverse_acceleration(g, c, omega, pdot, sdot, alpha, pddot, sddot)
    if internal != "least":
        return found
    # Column k of S: accelerations of the internal legs per unit of sddot along k. The least squares leave what S cannot
    # reach; a leg of length 0 has no acceleration and drops out as NaN.
    still = np.zeros(3)
    per_unit = [inverse_velocity(g, c, still, still, axis)[..., 3:] for axis in np.eye(3)]
    s = np.nan_to_num(np.stack(per_unit, axis=-1))
    internal_legs = found[..., 3:, None]
    left = internal_legs - s @ (np.linalg.pinv(s) @ np.nan_to_num(internal_legs))
    return np.concatenate([found[..., :3], left[..., 0]], axis=-1)


def _velocity_of_o(g: Geometry, c: Configuration, internal: str, omega: Floats, pdot: Floats) -> Floats:
    if internal == "least":
        return internal_velocity(g, c, omega, pdot)
    if internal == "held":
        return np.zeros(3)
    return pdot if internal == "shifted" else pdot + np.cross(omega, c.internal_point - c.position)


def _six(name: str, value: ArrayLike) -> tuple[float, ...]:
    found = as_floats(name, value, (6,))
    if found.shape != (6,) or not np.isfinite(found).all():
        raise ValueError(f"{name}: got {shown(value)}, expected six finite numbers, rotation first")
    return tuple(found.tolist())
