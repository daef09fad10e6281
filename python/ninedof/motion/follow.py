"""Inverse kinematics along a trajectory."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import characteristic_length as length_of
from ninedof.motion.followed import Followed
from ninedof.motion.trajectory import Trajectory, trajectory_argument
from ninedof.redundancy.rules import RULES
from ninedof.redundancy.search_arguments import leg_limits
from ninedof.robot.configuration import Configuration, operands_with, single
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import SingularityMargins
from ninedof.support.arguments import choice, finite, pair
from ninedof.support.arrays import Floats, as_number


def follow(
    geometry: Geometry,
    trajectory: Trajectory,
    home: Configuration,
    internal_point: str | float = "carried",
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    characteristic_length: float | str = 1.0,
    load: tuple[ArrayLike | None, ArrayLike | None] = (None, None),
) -> Followed:
    """Return lengths, rates and accelerations of the legs along a trajectory, and what limits it.

    Velocity and acceleration of platform and O are those of the polynomial of degree four through the five nearest
    poses; the rates of the legs follow from them in closed form. The poses are not smoothed: errors of rounding in a
    file of few digits show in the accelerations. As a check the lengths are tracked back from the first pose.

    Parameters
    ----------
    geometry : Geometry
    trajectory : Trajectory
    home : Configuration
        The neutral configuration, a single one: it says where O is.
    internal_point : {"carried", "shifted", "held", "best"} or float
        O along the trajectory. "carried", the default: as a point of the platform, so that O keeps its side of the
        upper internal joints on every trajectory; while the platform does not turn, the upper internal legs do not
        move. "shifted": with the platform's origin, s - p as at home in base axes, as regions of studies have it.
        "held": where it is at home; the lower internal legs never move. `idle_legs` names such legs. A number:
        this fraction of the way from the centroid of the internal joints of the base to that of the platform. "best":
        `best_internal_path` within the limits, at 201 poses, with a cubic spline between them.
    limits : (low, high), optional
        Least and greatest leg lengths, each a number or shape (9,). None by default. They are reported, and respected
        by "best" only.
    characteristic_length : float or str
        Length l_c of the condition number, or a kind of `characteristic_length`, taken at home; 1 by
        default; a Result and a Design have their own, `found.characteristic_length`.
    load : (force, moment), optional
        On the platform at its origin, base axes, for the leg forces: each of shape (3,) or (n, 3), or None.

    Returns
    -------
    Followed

    Raises
    ------
    ValueError
        If an argument does not fit, or no position of O is allowed at a pose with "best".

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> circle = nd.Trajectory.circle(home, radius=0.5, duration=2.0, points=201)
    >>> found = nd.follow(g, circle, home, limits=(2.0, 5.2))
    >>> found
    <Followed: 201 poses, breaks l1 high, l2 high, l3 high>
    >>> found.leg_rates.shape, found.tracked, found.tracking_error < 1e-9
    ((201, 9), True, True)

    """
    trajectory_argument(trajectory)
    single(geometry, home, "home")
    rule, bounds = rule_argument(internal_point), leg_limits(limits)
    lc = characteristic_length
    lc = float(length_of(geometry, home, lc)) if isinstance(lc, str) else as_number("characteristic_length", lc)
    time, p, q = trajectory.time, trajectory.position, trajectory.rotation
    loads = _loads(geometry, Configuration(p, q, p), *pair("load", load, "force and moment"))
    found = _core.follow(geometry, home, time, p, q, rule, bounds, lc, loads)
    tracked, margins, forces = found.pop("tracked"), found.pop("singularity_margins"), found.pop("leg_forces")
    return Followed(
        geometry=geometry,
        trajectory=trajectory,
        configurations=Configuration(p, q, found.pop("internal_point")),
        internal_point=rule,
        characteristic_length=lc,
        singularity_margins=SingularityMargins(*margins),
        limits=bounds,
        leg_forces=forces if len(loads) else None,
        tracked=tracked == len(trajectory),
        tracked_until=float(time[tracked - 1]),
        unit=trajectory.unit,
        **found,
    )


def rule_argument(rule: Any) -> str | float:
    """Return a rule for O: one of RULES or a fraction."""
    return choice("internal_point", rule, RULES) if isinstance(rule, str) else finite("internal_point", rule)


def _loads(geometry: Geometry, poses: Configuration, force: Any, moment: Any) -> Floats:
    """Return moment and force at each pose, shape (n, 6); no rows without a load."""
    if force is None and moment is None:
        return np.empty((0, 6))
    moment, force = (np.zeros(3) if value is None else value for value in (moment, force))
    shape, _, load = operands_with(geometry, poses, moment=(moment, 3), force=(force, 3))
    if shape != poses.shape:
        raise ValueError(f"load: got stacks of shape {shape}, expected one load for each of {len(poses)} poses")
    return np.concatenate(load, axis=1)
