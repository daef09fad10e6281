"""The rows of the nine legs: lengths, speeds, forces and angles at their joints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ninedof.design.indices import LEGS
from ninedof.design.internal_points import IDLE, idle_legs
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.kinematics.velocity import inverse_velocity
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.clearance import leg_ends
from ninedof.statics.statics import leg_forces
from ninedof.support.arguments import choice, finite
from ninedof.support.arrays import Floats

INTERNAL = ("least", "rest", "carried")


class Motion(NamedTuple):
    """A motion of the platform in any direction."""

    linear_speed: float
    """Of the platform origin, length/time."""
    angular_speed: float
    """rad/time."""
    internal: str
    """How O moves: "least" squared leg rates, "rest" or "carried" with the platform."""

    @classmethod
    def checked(cls, linear_speed: float, angular_speed: float, internal: str) -> Motion:
        """Return the motion of valid arguments."""
        speeds = finite("linear_speed", linear_speed, 0.0), finite("angular_speed", angular_speed, 0.0)
        return cls(*speeds, choice("internal", internal, INTERNAL))


@dataclass(frozen=True)
class LegRow:
    """One leg over the poses of a sheet."""

    name: str
    """l1 to l3 external, q1 to q3 upper internal, r1 to r3 lower internal."""
    shortest: float
    longest: float
    neutral: float
    """The length at the neutral pose."""
    stroke: float
    """longest - shortest."""
    stroke_ratio: float
    """longest / shortest."""
    idle: bool
    """Whether it has the same length at all poses, of which there are several."""
    speed: float
    """Largest rate over the directions of the motion and the poses."""
    base_cone: float | None
    """Largest angle at its base joint from its direction at the neutral pose, base frame, rad; None without one."""
    platform_cone: float | None
    """The same at its platform joint, platform frame."""
    forces: tuple[tuple[float, float], ...]
    """Least and largest force for each load, positive where the leg pushes."""

    def flat(self) -> dict[str, Any]:
        """Return the columns of a table, angles in degrees, "" where a leg has no such joint."""
        row: dict[str, Any] = {
            "leg": self.name,
            **{name: getattr(self, name) for name in ("shortest", "longest", "neutral", "stroke", "stroke_ratio")},
            "idle": int(self.idle),
            "speed": self.speed,
        }
        for name in ("base_cone", "platform_cone"):
            angle = getattr(self, name)
            row[f"{name}_deg"] = "" if angle is None else float(np.degrees(angle))
        for k, (low, high) in enumerate(self.forces):
            row |= {f"force_{k + 1}_min": low, f"force_{k + 1}_max": high}
        return row

    def to_dict(self) -> dict[str, Any]:
        """Return the row as plain values, angles in degrees and null where a leg has no such joint."""
        row = {k: None if v == "" else v for k, v in self.flat().items() if not k.startswith("force_")}
        return row | {"idle": self.idle, "forces": [{"min": low, "max": high} for low, high in self.forces]}


def leg_rows(g: Geometry, c: Configuration, motion: Motion, loads: Floats) -> tuple[LegRow, ...]:
    """Return the nine rows over a stack of poses, the neutral one first; loads (k, 6)."""
    lengths = leg_lengths(g, c)
    low, high = lengths.min(axis=0), lengths.max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):  # a leg of length 0
        ratio = high / low
    idle = idle_legs(lengths)
    speed = leg_speeds(g, c, motion).max(axis=0)
    base, platform = cone_angles(g, c)
    forces = [leg_forces(g, c, load[:3], load[3:]).forces for load in loads]
    return tuple(
        LegRow(
            name=LEGS[k],
            shortest=float(low[k]),
            longest=float(high[k]),
            neutral=float(lengths[0, k]),
            stroke=float(high[k] - low[k]),
            stroke_ratio=float(ratio[k]),
            idle=bool(idle[k]),
            speed=float(speed[k]),
            base_cone=None if 3 <= k < 6 else float(base[:, k].max()),
            platform_cone=None if k >= 6 else float(platform[:, k].max()),
            forces=tuple((float(f[:, k].min()), float(f[:, k].max())) for f in forces),
        )
        for k in range(9)
    )


def shown_internal(c: Configuration) -> str:
    """Return the rule that O follows over a stack of poses: "rest", "carried", or "least" where it is neither."""
    if len(c) < 2:
        return "least"
    size = IDLE * np.abs(np.concatenate([c.position, c.internal_point])).max()
    own = ((c.internal_point - c.position)[:, None] @ c.rotation)[:, 0]  # rows: Q^T (s - p)
    for rule, places in (("rest", c.internal_point), ("carried", own)):
        if np.abs(places - places[0]).max() <= size:
            return rule
    return "least"


def leg_speeds(g: Geometry, c: Configuration, motion: Motion) -> Floats:
    """Return the largest rate of each leg over the directions of velocity and angular velocity, shape (n, 9)."""
    omega, pdot = np.eye(6)[:, :3], np.eye(6)[:, 3:]
    each = c[:, None]
    if motion.internal == "least":
        sdot = None
    elif motion.internal == "rest":
        sdot = np.zeros(3)
    else:
        sdot = pdot + np.cross(omega, each.internal_point - each.position)
    rates = inverse_velocity(g, each, omega, pdot, sdot)  # pose, unit twist, leg
    turning, shifting = np.linalg.norm(rates[:, :3], axis=1), np.linalg.norm(rates[:, 3:], axis=1)
    return np.asarray(motion.linear_speed * shifting + motion.angular_speed * turning)


def cone_angles(g: Geometry, c: Configuration) -> tuple[Floats, Floats]:
    """Return the angles of the legs from their directions at the first pose, in the frames of base and platform."""
    start, end = leg_ends(g, c)
    along = end - start
    turned = along @ c.rotation  # rows: Q^T v
    return _angle(along, along[0]), _angle(turned, turned[0])


def _angle(x: Floats, y: Floats) -> Floats:
    across = np.linalg.norm(np.cross(x, y), axis=-1)
    return np.asarray(np.arctan2(across, np.sum(x * y, axis=-1)))
