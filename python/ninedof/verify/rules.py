"""Every constraint from its definition: an independent computation of the core's margins.

A rule computes the values that a constraint limits: each value of `upper` must be at most the high limit, each value of
`lower` at least the low limit. Leg lengths come from the general path of the core, everything else from joints and
configurations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.verify import directions, spacing
from ninedof.verify.robot import Robot

MOST_PAIRED = 100  # poses; for more, all pairs of lengths would need too much memory


@dataclass(frozen=True)
class Limit:
    """One constraint with its limits and options, angles in radians."""

    name: str
    low: float = 0.0
    high: float = math.inf
    of: str = "length"
    axis: tuple[float, ...] = ()
    steps: int = 4
    at: str = "poses"
    """"poses", or "neutral" for the neutral pose alone."""

    @property
    def label(self) -> str:
        """What the core calls the limit."""
        return f"{self.name} at neutral" if self.at == "neutral" else self.name


def limits_of(study: Study) -> list[Limit]:
    """Return the limits of a study."""
    return [Limit(**limit.for_core()) for limit in study.limits]


def margins(limit: Limit, robot: Robot) -> Floats:
    """Return every margin of a limit: what is left of it in parts of it, negative if violated.

    Returns
    -------
    numpy.ndarray, shape (n,)
        The same n, in the same order, for all robots of a study.

    """
    rule, robot = RULES[limit.name], _where(limit, robot)
    out = []
    if math.isfinite(limit.high) and rule.upper is not None:
        values = rule.upper(robot, limit)
        out.append(1.0 - values / limit.high)
    if rule.lower is not None and (limit.low > 0.0 or rule.is_sign):
        values = rule.lower(robot, limit)
        out.append(values - limit.low if rule.is_sign else values / limit.low - 1.0)
    return np.concatenate(out) if out else np.empty(0)


def measured(limit: Limit, robot: Robot) -> float:
    """Return the least `max` of a limit that allows this robot."""
    rule, robot = RULES[limit.name], _where(limit, robot)
    if rule.upper is None:
        raise ValueError(f"{limit.name}: got a limit without a max, expected one with a max")
    return float(rule.upper(robot, limit).max())


def _where(limit: Limit, robot: Robot) -> Robot:
    """Return the robot with the poses at which a limit holds."""
    if limit.at != "neutral":
        return robot
    c = robot.neutral
    return replace(robot, poses=Configuration(c.position[None], c.rotation[None], c.internal_point[None]))


Values = Callable[[Robot, Limit], Floats]


@dataclass(frozen=True)
class Rule:
    """The values that a constraint limits."""

    upper: Values | None = None
    lower: Values | None = None
    is_sign: bool = False
    """Whether margins are plain differences, for want of a scale."""


def _legs(robot: Robot) -> Floats:
    return leg_lengths(robot.geometry, robot.poses).reshape(-1, 9)


def _radii(robot: Robot, body: str) -> Floats:
    return np.asarray(np.linalg.norm(robot.joints(body)[:, :2], axis=-1))


def _height(robot: Robot) -> float:
    return float(robot.neutral.position[2])


def _unit(robot: Robot, limit: Limit) -> float:
    return _height(robot) if limit.of == "zp" else 1.0


def _some_legs(first: int, last: int) -> Rule:
    def values(robot: Robot, limit: Limit) -> Floats:
        return _legs(robot)[:, first:last].reshape(-1) / _unit(robot, limit)

    return Rule(values, values)


def _between_poses(robot: Robot) -> tuple[Floats, Floats]:
    """Return leg lengths that broadcast to all pairs of poses, (n, n, 9), or beside the least for very many poses."""
    legs = _legs(robot)
    return legs[:, None], legs[None, :] if len(legs) <= MOST_PAIRED else legs.min(axis=0)[None, None]


def _stroke(robot: Robot, limit: Limit) -> Floats:
    long, short = _between_poses(robot)
    return (long - short).reshape(-1) / _unit(robot, limit)


def _stroke_ratio(robot: Robot, limit: Limit) -> Floats:
    long, short = _between_poses(robot)
    return (long / short).reshape(-1)


def _leg_ratios(robot: Robot, limit: Limit) -> Floats:
    legs = _legs(robot)
    others = legs if len(legs) <= MOST_PAIRED else legs.min()
    return np.divide.outer(legs, others).reshape(-1)


def _leg_ratio(robot: Robot, limit: Limit) -> Floats:
    legs = _legs(robot)
    return np.array([legs.max() / legs.min()])


def _joint_height(robot: Robot, limit: Limit) -> Floats:
    heights = np.abs(np.concatenate([robot.joints("base")[:, 2], robot.joints("platform")[:, 2]]))
    largest = max(_radii(robot, "base").max(), _radii(robot, "platform").max())
    return np.asarray(heights / (largest if limit.of == "radius" else 1.0))


def _joint_spacing(robot: Robot, limit: Limit) -> Floats:
    out = []
    for body in ("base", "platform"):
        apart = spacing.between_points(robot.joints(body))
        out.append(apart / (_radii(robot, body).max() if limit.of == "radius" else 1.0))
    return np.concatenate(out)


def _fraction(robot: Robot, limit: Limit) -> Floats:
    return np.array([robot.neutral.internal_point[2] / _height(robot)])


RULES: Mapping[str, Rule] = {
    # max(base) / max(platform): the high limit holds for every base joint, the low limit for every platform joint.
    "radius_ratio": Rule(
        lambda r, _: _radii(r, "base") / _radii(r, "platform").max(),
        lambda r, _: _radii(r, "base").max() / _radii(r, "platform"),
    ),
    "leg_ratio": Rule(_leg_ratios, _leg_ratio),
    "stroke_ratio": Rule(_stroke_ratio),
    "zs_fraction": Rule(_fraction, _fraction),
    "stroke": Rule(_stroke),
    "leg_length": _some_legs(0, 9),
    "external_length": _some_legs(0, 3),
    "upper_length": _some_legs(3, 6),
    "lower_length": _some_legs(6, 9),
    "height": Rule(lambda r, _: np.array([_height(r)]), lambda r, _: np.array([_height(r)])),
    "footprint": Rule(lambda r, _: _radii(r, "base"), lambda r, _: _radii(r, "base").max(keepdims=True)),
    "joint_height": Rule(_joint_height),
    "joint_spacing": Rule(lower=_joint_spacing),
    "leg_clearance": Rule(lower=lambda r, limit: spacing.between_legs(r) / _unit(r, limit)),
    "base_cone": Rule(lambda r, limit: directions.cone(r, "base", limit.axis)),
    "platform_cone": Rule(lambda r, limit: directions.cone(r, "platform", limit.axis)),
    "singularity_free": Rule(
        lower=lambda r, limit: directions.determinants(r, limit.steps if limit.at == "poses" else 0), is_sign=True
    ),
}
