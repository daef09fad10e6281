"""The nearest singularity in any direction: of positions, of turns, or of O."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration, operands
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import mechanism_of
from ninedof.support.arguments import choice, finite, whole
from ninedof.support.arrays import Floats, thread_argument
from ninedof.support.short import short_repr
from ninedof.support.structs import from_core

PARTS = {"rotation": 0, "position": 3, "internal_point": 6}  # place in a tangent of `Configuration.moved`
FARTHEST = 2000.0  # longest legs, or quarter turns: what is farther takes long and is no matter of this machine


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
    geometry : Geometry
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

    Returns
    -------
    NearestSingularity

    Raises
    ------
    ValueError
        If an argument does not fit.

    Examples
    --------
    O reaches the plane of the upper internal joints:

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> found = nd.nearest_singularity(g, nd.Configuration.neutral(3.9828, 2.4432), "internal_point")
    >>> round(found.distance, 6), found.mechanism
    (1.5396, <Mechanism.C: 'c'>)

    """
    first = PARTS[choice("part", part, PARTS)]
    operands(geometry, configuration)
    if len(configuration.shape) > 1 or configuration.shape == (0,):
        raise ValueError(f"configuration: got shape {configuration.shape}, expected a single one or a stack (n,)")
    count = whole("directions", directions, 0, 10**6)
    size = math.pi / 2.0 if part == "rotation" else float(np.nanmax(leg_lengths(geometry, configuration)))
    reach = 2.0 * size if most is None else finite("most", most, 0.0, FARTHEST * size)
    motions = np.zeros((9, 3))
    motions[first : first + 3] = np.eye(3)
    found = _core.nearest_singularity(geometry, configuration, motions, reach, count, thread_argument(threads))
    there = found.configuration if math.isfinite(found.distance) or configuration.shape else configuration
    return from_core(NearestSingularity, found, mechanism=mechanism_of(found.mechanism), configuration=there)
