"""The distance to a singularity: along a direction, and the nearest in any direction."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration, operands, operands_with
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import mechanisms_of
from ninedof.support.arguments import choice, finite, whole
from ninedof.support.arrays import Floats, as_number, thread_argument
from ninedof.support.text import short_repr

PARTS = {"rotation": 0, "position": 3, "internal_point": 6}  # place in a tangent of `Configuration.moved`
FARTHEST = 2000.0  # longest legs, or quarter turns: what is farther takes long and is no matter of this machine


@short_repr
class SingularityDistance(NamedTuple):
    """The first singular configuration on a path; leading dimensions broadcast."""

    distance: Any
    """In multiples of the direction, shape (...); infinite where the whole path is free."""
    mechanism: Any
    """The `Mechanism` lost there, `NONE` where the path is free; for a stack an array of their values."""
    each: Floats
    """The distance for each mechanism alone, in the order n, b, c, shape (..., 3)."""
    resolved: Any
    """False where the path is free up to `distance` and undecided beyond; shape (...)."""


@takes_designs
def distance_to_singularity(
    geometry: Geometry,
    configuration: Configuration,
    direction: ArrayLike,
    most: float = 1.0,
    threads: int | None = None,
) -> SingularityDistance:
    """Return the distance along a direction to the first singularity.

    The path is t -> configuration.moved(t * direction): p and s on straight lines, the platform turning about a fixed
    axis at a fixed rate. No zero is missed: within each step, bounds of the derivatives prove that the
    determinants keep their signs. A zero without change of sign is found where the determinant is below its rounding
    error; its place is then known to about the square root of that error.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    direction : array_like, shape (..., 9)
        (omega, dp, ds): rotation vector in radians and displacements in length units, base frame, as for
        `Configuration.moved`. Broadcasts against the configuration.
    most : float
        End of the path, in multiples of the direction. 1 by default: the displacement itself, so that an infinite
        distance means that the whole displacement is free. A pure rotation repeats after 2 pi / |omega|.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    SingularityDistance
        0 where the configuration itself is singular, infinite where the whole path is free, NaN where the
        configuration or the direction has NaN.

    Raises
    ------
    ValueError
        If the direction has another shape or is infinite, or `most` is not finite and positive.

    Examples
    --------
    O sinks to the plane of the lower joints:

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> ahead = nd.distance_to_singularity(g, c, [0, 0, 0, 0, 0, 0, 0, 0, -1.0], most=5.0)
    >>> round(float(ahead.distance), 10), ahead.mechanism
    (2.4432, <Mechanism.B: 'b'>)

    """
    shape, flat, t = operands_with(geometry, configuration, direction=(direction, 9))
    out = _core.distance_to_singularity(*flat, t, as_number("most", most), thread_argument(threads))
    return SingularityDistance(
        out[:, 0].reshape(shape)[()],
        mechanisms_of(out[:, 1], shape),
        out[:, 3:].reshape(*shape, 3),
        (out[:, 2] == 1.0).reshape(shape)[()],
    )


@short_repr
class NearestSingularity(NamedTuple):
    """The nearest singularity found about a configuration, or about any of a stack."""

    distance: float
    """Length, or angle in radians; infinite where none was found."""
    mechanism: Any
    """The `Mechanism` lost there, `NONE` where none was found."""
    direction: Floats
    """Unit vector of the motion, or axis of the turn, base axes, shape (3,)."""
    pose: int
    """Number of the configuration in the stack; 0 for a single one."""
    configuration: Configuration
    """The singular configuration; the given one where none was found."""


@takes_designs
def nearest_singularity(
    geometry: Geometry,
    configuration: Configuration,
    part: str = "position",
    most: float | None = None,
    directions: int = 1000,
    threads: int | None = None,
) -> NearestSingularity:
    """Return the nearest singularity in any direction of one part of the motion, the rest held still.

    The distance along a direction is that of `distance_to_singularity`: no singularity on the way is missed. The
    directions are searched: evenly spread ones and the axes, then about each of them that is nearer than its
    neighbours. A narrow valley between the first ones may be missed.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        A single one or a stack of shape (n,); of a stack the nearest of all is returned.
    part : {"position", "rotation", "internal_point"}
        "position": the platform moves without turning, O at rest. "rotation": it turns about an axis through p, O at
        rest. "internal_point": O moves, the platform at rest.
    most : float, optional
        How far is looked; by default twice the longest leg, and half a turn; at most a thousand times as far.
    directions : int
        Number of directions at first, 1000 by default.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Raises
    ------
    ValueError
        If an argument does not fit.

    Examples
    --------
    O reaches the plane of the upper internal joints:

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> nearest = nd.nearest_singularity(g, nd.Configuration.neutral(3.9828, 2.4432), "internal_point")
    >>> round(nearest.distance, 6), nearest.mechanism
    (1.5396, <Mechanism.C: 'c'>)

    """
    first = PARTS[choice("part", part, PARTS)]
    operands(geometry, configuration)
    if len(configuration.shape) > 1 or configuration.shape == (0,):
        raise ValueError(f"configuration: got shape {configuration.shape}, expected a single one or a stack (n,)")
    count, motions = whole("directions", directions, 0, 10**6), np.eye(9, 3, -first)
    size = math.pi / 2.0 if part == "rotation" else float(np.nanmax(leg_lengths(geometry, configuration)))
    reach = 2.0 * size if most is None else finite("most", most, 0.0, FARTHEST * size)
    near = _core.nearest_singularity(geometry, configuration, motions, reach, count, thread_argument(threads))
    there = near.configuration if math.isfinite(near.distance) or configuration.shape else configuration
    return NearestSingularity(near.distance, mechanisms_of(near.mechanism), near.direction, near.pose, there)
