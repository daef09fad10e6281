"""Inverse kinematics along a trajectory."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof.conditioning.characteristic_length import characteristic_length as length_of
from ninedof.conditioning.conditioning import condition_number
from ninedof.kinematics.acceleration import inverse_acceleration
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.kinematics.velocity import inverse_velocity
from ninedof.motion.derivatives import angular_derivatives, derivatives, stencils
from ninedof.motion.followed import Followed
from ninedof.motion.internal_point import internal_points, rule_argument
from ninedof.motion.trajectory import Trajectory, trajectory_argument
from ninedof.position.tracking import TrackStatus, track
from ninedof.redundancy.search_arguments import leg_limits
from ninedof.robot.configuration import Configuration, single
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import singularity_margins
from ninedof.statics.statics import leg_forces
from ninedof.support.arrays import Floats, as_number
from ninedof.support.units import unit_argument

SAME = 1e-9  # difference of a pose tracked back


def follow(
    geometry: Geometry,
    trajectory: Trajectory,
    home: Configuration,
    internal_point: str | float = "carried",
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    characteristic_length: float | str = 1.0,
    force: ArrayLike | None = None,
    moment: ArrayLike | None = None,
    unit: str | None = None,
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
    force, moment : array_like, shape (3,) or (n, 3), optional
        Load on the platform at its origin, base axes, for the leg forces.
    unit : str, optional
        Name of the length unit, for screens, figures and the head of legs.csv: "mm", "cm", "m", "in" or "ft". None by
        default. With one, times are in seconds: rates are labelled mm/s.

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
    for low, high in zip(*bounds, strict=True):
        if not 0.0 <= low <= high:
            raise ValueError(f"limits: got {low:g} to {high:g}, expected 0 <= low <= high")
    length = characteristic_length
    lc = (
        float(length_of(geometry, home, length))
        if isinstance(length, str)
        else as_number("characteristic_length", length)
    )
    s = internal_points(geometry, trajectory, home, rule, lc, bounds)
    c = Configuration(trajectory.position, trajectory.rotation, s)
    at = stencils(trajectory.time)
    moving = [angular_derivatives(at, c.rotation), derivatives(at, c.position), derivatives(at, s)]
    velocity, acceleration = ([pair[k] for pair in moving] for k in (0, 1))
    lengths = leg_lengths(geometry, c)
    returned, error = _tracked_back(geometry, c, lengths)
    return Followed(
        geometry=geometry,
        trajectory=trajectory,
        configurations=c,
        internal_point=rule,
        leg_lengths=lengths,
        leg_rates=inverse_velocity(geometry, c, *velocity),
        leg_accelerations=inverse_acceleration(geometry, c, *velocity, *acceleration),
        velocity=np.concatenate(velocity, axis=1),
        acceleration=np.concatenate(acceleration, axis=1),
        characteristic_length=lc,
        condition_number=condition_number(geometry, c, lc),
        singularity_margins=singularity_margins(geometry, c),
        limits=bounds,
        leg_forces=_forces(geometry, c, force, moment),
        tracked=returned == len(trajectory),
        tracked_until=float(trajectory.time[returned - 1]),
        tracking_error=error,
        unit=unit_argument(unit),
    )


def _forces(geometry: Geometry, c: Configuration, force: Any, moment: Any) -> Floats | None:
    if force is None and moment is None:
        return None
    zero = np.zeros(3)
    return leg_forces(geometry, c, zero if moment is None else moment, zero if force is None else force).forces


def _tracked_back(geometry: Geometry, c: Configuration, lengths: Floats) -> tuple[int, float]:
    """Return how many poses from the first on `track` returns, and the largest difference of a pose it reached."""
    found = track(geometry, lengths[1:], c[0])
    unit = float(lengths.max())
    differences = (
        np.abs(found.position - c.position[1:]).max(axis=1) / unit,
        np.abs(found.rotation - c.rotation[1:]).max(axis=(1, 2)),
        np.abs(found.internal_point - c.internal_point[1:]).max(axis=1) / unit,
    )
    error = np.max(differences, axis=0)
    wrong = np.flatnonzero((found.status != TrackStatus.TRACKED) | ~(error <= SAME))
    reached = error[~np.isnan(error)]
    return int(wrong[0]) + 1 if len(wrong) else len(lengths), float(reached.max(initial=0.0))
