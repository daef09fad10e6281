"""The question of a sheet: what its options ask for, and what the study states where they are left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.duty import INTERNAL, Masses, six
from ninedof.design.limit_numbers import CONES, JOINTS, PARTS, cone_limits, exempt_pairs
from ninedof.design.limits import ROWS
from ninedof.design.study import Study
from ninedof.design.tool import Tool
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.robot.idle import IDLE
from ninedof.support.arguments import Vector, choice, finite, shown, vector
from ninedof.support.arrays import Floats, as_floats, one_or_each


def duty_of(design: Any) -> Study:
    """Return the study of a design with the poses that it was solved for; without one, one with its unit and tool."""
    study: Study | None = getattr(design, "solved", None) or getattr(design, "study", None)
    return study or Study(unit=getattr(design, "unit", ""), tool=getattr(design, "tool", Tool()))


def leg_limits_of(study: Study, kind: str) -> Floats:
    """Return the greatest force or power that a study allows each leg at its poses; infinite where it has no limit."""
    most = np.full(9, np.inf)
    for one in study.limits:
        if one.at == "poses" and one.kind == kind:
            legs = [LEGS.index(leg) for leg in PARTS[one.name]]
            most[legs] = np.minimum(most[legs], one.high)
    return most


def leg_limits_argument(name: str, value: ArrayLike) -> Floats:
    """Return the limits of an argument, one for each leg."""
    limit = one_or_each(name, value, 9)
    if limit.shape != (9,) or not (limit >= 0.0).all():
        raise ValueError(f"{name}: got {shown(value)}, expected numbers >= 0, one or nine")
    return limit


def with_duty(options: Mapping[str, Any], study: Study) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the options of a sheet, those left out as the study states them, and the tables that gave some."""
    speeds, tolerances = study.speeds, study.tolerances
    moves = speeds.linear > 0.0 or speeds.angular > 0.0
    stated = (
        ("speeds", "linear_speed", speeds.linear if moves else None),
        ("speeds", "angular_speed", speeds.angular if moves else None),
        ("loads", "loads", study.loads.wrenches or None),
        ("tolerances", "leg_errors", tolerances.legs or None),
        ("tolerances", "joint_errors", tolerances.joints or None),
    )
    out, tables = dict(options), []
    for table, name, value in stated:
        if out[name] is None and value is not None:
            out[name] = value
            tables.append(table)
    if (out["mass"] is None and study.masses.platform > 0.0) or masses_besides_platform(study) is not None:
        tables.append("masses")
    return out, tuple(dict.fromkeys(tables))


def weight_of(study: Study, mass: float | None, centre: ArrayLike | None, gravity: ArrayLike | None) -> Weight | None:
    """Return the weight of the platform, of options or, where they are left out, of the study; None without a mass.

    `centre` is in the platform's own frame, that of the weight in the frame of geometries, the tool's.
    """
    masses = study.masses
    mass = (masses.platform or None) if mass is None else mass
    if mass is None:
        for name, value in (("centre", centre), ("gravity", gravity)):
            if value is not None:
                raise ValueError(f"{name}: got {shown(value)} without a mass, expected a mass too")
        return None
    at = vector("centre", masses.centre if centre is None else centre)
    force_per_mass = vector("gravity", study.loads.gravity if gravity is None else gravity)
    return Weight(finite("mass", mass, 0.0), study.tool.seen(at), force_per_mass)


def masses_of(study: Study, mass: float | None = None, centre: Vector | None = None) -> Masses | None:
    """Return the masses of a study in the frame of geometries; None where all are 0.

    `mass` and `centre`, in the frame of the plate, take the place of the platform's.
    """
    masses = study.masses
    if mass is not None:
        masses = replace(masses, platform=mass)
    if centre is not None:
        masses = replace(masses, centre=centre)
    return masses.seen_from(study.tool) if masses else None


def masses_words(study: Study, mass: float | None = None) -> list[str]:
    """Return which masses are those of the study, where the platform's may be given; empty for none."""
    if mass is None:
        return ["[masses]"] * bool(study.masses)
    return ["[masses] but the platform's mass"] * bool(replace(study.masses, platform=0.0))


def masses_besides_platform(study: Study) -> Masses | None:
    """Return the masses of the legs and of O; None where they are 0. Sheets have the platform as a `Weight`."""
    masses = masses_of(study)
    if masses is None or not any((masses.cylinder, masses.rod, masses.internal_point)):
        return None
    return replace(masses, platform=0.0)


FASTEST = 1e100  # speeds: their squares must be numbers
SLOW = {"linear_speed": 1.0, "angular_speed": 0.0}  # where nothing states them


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


class Weight(NamedTuple):
    """The weight of the platform with what it carries."""

    mass: float
    centre: Vector
    """Centre of mass in the platform frame of the geometry, that of the tool."""
    gravity: Vector
    """Force per mass, base axes: with 9.81 and kilograms forces are in newtons, in any unit of length."""


def motion_of(options: Mapping[str, Any], c: Configuration, rule: str) -> Motion:
    """Return the motion of the options of a sheet; O moves as they say, else by a rule, "" as in a stack of poses."""
    speeds = {name: slow if options[name] is None else options[name] for name, slow in SLOW.items()}
    linear, angular = (finite(name, speed, 0.0, FASTEST) for name, speed in speeds.items())
    internal, twist, rate = (options[name] for name in ("internal", "twist", "twist_rate"))
    internal = rule or _internal_over(c) if internal is None else choice("internal", internal, INTERNAL)
    if twist is not None:
        expected = "six finite numbers, rotation first"
        rate = (0.0,) * 6 if rate is None else six("twist_rate", rate, expected)
        return Motion(linear, angular, internal, six("twist", twist, expected), rate)
    if rate is not None:
        raise ValueError(f"twist_rate: got {shown(rate)} without a twist, expected a twist too")
    return Motion(linear, angular, internal)


def question_of(g: Geometry, neutral: Configuration, study: Study, motion: Motion) -> _core.SheetQuestion:
    """Return the question about a robot in motion, without loads, tolerances, stiffness and l_c."""
    moving = _core.PlatformMotion(
        internal=motion.internal, linear_speed=motion.linear_speed, angular_speed=motion.angular_speed
    )
    if motion.twist is not None:
        moving.given = _core.TwistMotion(twist=motion.twist, rate=motion.twist_rate)
    return _core.SheetQuestion(g, neutral, limits=_limits(study), exempt=exempt_pairs(g, study), motion=moving)


def _internal_over(c: Configuration) -> str:
    """Return the rule that O follows over a stack of poses: "held", "carried", "shifted", or "least" where none."""
    size = IDLE * np.abs(np.concatenate([c.position, c.internal_point])).max()
    moves = np.abs(c.position - c.position[0]).max() > size or np.abs(c.rotation - c.rotation[0]).max() > IDLE
    if not moves:
        return "least"
    arm = c.internal_point - c.position
    own = (arm[:, None] @ c.rotation)[:, 0]  # rows: Q^T (s - p)
    for rule, places in (("held", c.internal_point), ("carried", own), ("shifted", arm)):
        if np.abs(places - places[0]).max() <= size:
            return rule
    return "least"


def _limits(study: Study) -> list[_core.Limit]:
    """Return limits at poses: of each kind of joint about its axis, then all that the study has.

    Ratios, which the sheet has no table of, only where the study limits them. Forces, rates and powers of legs are
    numbers of the sheet anyhow.
    """
    names = [name for name in PARTS if len(ROWS[name].sides) == 1 and name not in CONES and not ROWS[name].needs]
    out = [_core.Limit(name=name) for name in names if ROWS[name].kind != "ratio" or name in study.constraints]
    for name, limit in cone_limits(study).items():
        axis = (0.0, 0.0, 0.0) if limit is None else study.limit_for_core(limit).axis
        out.append(_core.Limit(name=name, axis=axis))
    cones = (one for one in study.limits if one.row.is_angle and one.name not in JOINTS)
    return out + [study.limit_for_core(one) for one in cones]


def load_rows(loads: ArrayLike | None) -> Floats:
    """Return loads as rows (moment, force), none for None."""
    rows = np.zeros((0, 6)) if loads is None else np.atleast_2d(as_floats("loads", loads, (6,)))
    if rows.ndim != 2 or not np.isfinite(rows).all():
        raise ValueError(f"loads: got {shown(loads)}, expected rows of six finite numbers, moment and force")
    return rows
