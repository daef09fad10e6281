"""The nearest singularity: how far the platform may shift or turn, or O move, from the poses of a design."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.singularity.nearest_singularity import nearest_along
from ninedof.support.arrays import Floats

MOTIONS = ("shift", "turn", "internal")
DIRECTIONS = 1000  # looked along from every pose
FARTHEST = 4.0  # shifts looked at, in the longest leg


class NearSingularity(NamedTuple):
    """The nearest singularity for one way of moving."""

    motion: str
    """"shift": of the platform, O with it, or held where O is held over the poses. "turn": of the platform about its
    origin, O at rest. "internal": O alone."""
    distance: float
    """Length, or radians for a turn; infinite where none was found within four times the longest leg or half a turn."""
    mechanism: str
    """"n", "b" or "c": the determinant that is zero there; "" if none was found."""
    pose: int
    """The pose it is nearest to."""
    direction: tuple[float, ...]
    """Unit vector of the shift or axis of the turn, base axes."""
    position: tuple[float, ...]
    """p, Q and O where it is."""
    rotation: tuple[tuple[float, ...], ...]
    internal_point: tuple[float, ...]


def near_singularities(g: Geometry, c: Configuration, internal: str) -> dict[str, NearSingularity]:
    """Return the nearest singularity of a stack of poses, `nearest_singularity`, for each of MOTIONS."""
    longest = FARTHEST * float(leg_lengths(g, c).max())
    out = {}
    for motion in MOTIONS:
        found = nearest_along(g, c, _motions(motion, internal), np.pi if motion == "turn" else longest, DIRECTIONS)
        there = found.configuration
        out[motion] = NearSingularity(
            motion,
            found.distance,
            str(found.mechanism),
            found.pose,
            tuple(found.direction.tolist()),
            tuple(there.position.tolist()),
            tuple(tuple(row) for row in there.rotation.tolist()),
            tuple(there.internal_point.tolist()),
        )
    return out


def _motions(motion: str, internal: str) -> Floats:
    """Return the tangents (omega, dp, ds) of motions along three axes, shape (9, 3)."""
    rows = {"turn": [0], "internal": [6], "shift": [3] if internal == "held" else [3, 6]}[motion]
    out = np.zeros((9, 3))
    for row in rows:
        out[row : row + 3] = np.eye(3)
    return out
