"""The question of a sheet: the motion behind the speeds of the legs, loads, tolerances, stiffness."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.limit_numbers import CONES, JOINTS, PARTS, cone_limits, exempt_pairs
from ninedof.design.limits import ROWS
from ninedof.design.study import Study
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.idle import IDLE
from ninedof.support.arguments import Vector, choice, finite, shown, vector
from ninedof.support.arrays import Floats, as_floats

FASTEST = 1e100  # speeds: their squares must be numbers
INTERNAL = ("least", "held", "shifted", "carried")
STANDARD = (0.0, 0.0, -9.81)


class SheetArguments(TypedDict, total=False):
    """Options of `sheet`, which says what they mean."""

    linear_speed: float | None
    angular_speed: float | None
    internal: str | None
    loads: ArrayLike | None
    leg_errors: ArrayLike | None
    joint_errors: ArrayLike | None
    leg_stiffness: ArrayLike | None
    characteristic_length: float | str | None
    twist: ArrayLike | None
    twist_rate: ArrayLike | None
    mass: float | None
    centre: ArrayLike | None
    gravity: ArrayLike | None
    samples: int
    unit: str | None


class Motion(NamedTuple):
    """A motion of the platform in any direction, and a given one."""

    linear_speed: float
    """Of the platform origin, length/time."""
    angular_speed: float
    """rad/time."""
    internal: str
    """The motion of O: "least" squares of the leg rates and of the leg accelerations, "held", "shifted" or "carried" as
    in `ninedof.redundancy.rules`."""
    twist: tuple[float, ...] | None = None
    """Angular velocity (rad/time) and velocity of the platform's origin, base frame; None without one."""
    twist_rate: tuple[float, ...] = (0.0,) * 6
    """Its time derivative."""

    @classmethod
    def of(
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


class Weight(NamedTuple):
    """The weight of the platform with what it carries."""

    mass: float
    centre: Vector
    """Centre of mass in the platform frame of the geometry, that of the tool."""
    gravity: Vector
    """Force per mass, base axes: with 9.81 and kilograms forces are in newtons, in any unit of length."""

    @classmethod
    def of(cls, mass: float | None, centre: ArrayLike | None, gravity: ArrayLike | None) -> Weight | None:
        """Return the weight of valid arguments, None without a mass; at the platform's origin by default."""
        if mass is None:
            for name, value in (("centre", centre), ("gravity", gravity)):
                if value is not None:
                    raise ValueError(f"{name}: got {shown(value)} without a mass, expected a mass too")
            return None
        at = vector("centre", (0.0, 0.0, 0.0) if centre is None else as_floats("centre", centre, (3,)).tolist())
        return cls(
            finite("mass", mass, 0.0),
            at,
            vector("gravity", STANDARD if gravity is None else as_floats("gravity", gravity, (3,)).tolist()),
        )

    def wrench(self, rotation: Floats) -> Floats:
        """Return (moment about p, force) at each rotation of the platform, (n, 3, 3), in base axes, shape (n, 6)."""
        arm = rotation @ np.asarray(self.centre)
        force = np.broadcast_to(self.mass * np.asarray(self.gravity), arm.shape)
        return np.concatenate([np.cross(arm, force), force], axis=-1)


def question_of(
    g: Geometry,
    neutral: Configuration,
    study: Study | None,
    motion: Motion,
    loads: Sequence[Floats] = (),
    weight: Weight | None = None,
) -> _core.SheetQuestion:
    """Return the question about legs and loads as the core takes it, without tolerances, stiffness and l_c."""
    moving = _core.PlatformMotion(
        internal=motion.internal, linear_speed=motion.linear_speed, angular_speed=motion.angular_speed
    )
    if motion.twist is not None:
        moving.given = _core.TwistMotion(twist=motion.twist, rate=motion.twist_rate)
    out = _core.SheetQuestion(
        g, neutral, limits=_limits(study), exempt=exempt_pairs(g, study), motion=moving, loads=loads
    )
    if weight is not None:
        out.weight = _core.Weight(**weight._asdict())
    return out


def internal_over(c: Configuration) -> str:
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


def _limits(study: Study | None) -> list[_core.Limit]:
    """Return limits at poses: of each kind of joint about its axis, then all that the study has.

    Ratios, which the sheet has no table of, only where the study limits them. Forces, rates and powers of legs are
    numbers of the sheet anyhow.
    """
    limits = study.limits if study is not None else ()
    own = {limit.name for limit in limits}
    cones = [study.limit_for_core(one) for one in limits if one.row.is_angle] if study is not None else []
    joints = []
    for name, one in cone_limits(study).items():
        axis = (0.0, 0.0, 0.0) if one is None or study is None else study.limit_for_core(one).axis
        joints.append(_core.Limit(name=name, axis=axis))
    names = [name for name in PARTS if len(ROWS[name].sides) == 1 and name not in CONES and not ROWS[name].needs]
    others = [_core.Limit(name=name) for name in names if ROWS[name].kind != "ratio" or name in own]
    return others + joints + [one for one in cones if one.name not in JOINTS]


def _six(name: str, value: ArrayLike) -> tuple[float, ...]:
    numbers = as_floats(name, value, (6,))
    if numbers.shape != (6,) or not np.isfinite(numbers).all():
        raise ValueError(f"{name}: got {shown(value)}, expected six finite numbers, rotation first")
    return tuple(numbers.tolist())


def robot_of(design: Any, poses: Configuration | None) -> tuple[Geometry, Configuration, float | str]:
    """Return geometry, stack of poses with the neutral one first, and characteristic length of a design."""
    if poses is not None and (not isinstance(poses, Configuration) or len(poses.shape) != 1 or not len(poses)):
        raise ValueError(f"poses: got {shown(poses)}, expected a stack of configurations of shape (n,)")
    if isinstance(design, Geometry):
        if poses is None:
            raise ValueError("poses: got none, expected configurations for a Geometry, the neutral one first")
        return design, poses, 1.0
    try:
        g, neutral, length = design.geometry, design.configuration, design.characteristic_length
    except AttributeError:
        raise ValueError(f"design: got {type(design).__name__}, expected a result, a design or a Geometry") from None
    if g is None or neutral is None:
        raise ValueError("design: got a result without a design, expected one")
    more = getattr(design, "configurations", None) if poses is None else poses
    stacks = [neutral, *([] if more is None else [more[1:] if poses is None else more])]
    p, q, s = ([np.atleast_2d(getattr(x, name)) for x in stacks] for name in ("position", "rotation", "internal_point"))
    q = [x.reshape(-1, 3, 3) for x in q]
    return g, Configuration(np.concatenate(p), np.concatenate(q), np.concatenate(s)), length


def load_rows(loads: ArrayLike | None) -> Floats:
    """Return loads as rows (moment, force), none for None."""
    rows = np.zeros((0, 6)) if loads is None else np.atleast_2d(as_floats("loads", loads, (6,)))
    if rows.ndim != 2 or not np.isfinite(rows).all():
        raise ValueError(f"loads: got {shown(loads)}, expected rows of six finite numbers, moment and force")
    return rows
