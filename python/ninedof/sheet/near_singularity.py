"""The nearest singularity: how far the platform may shift or turn, or O move, from the poses of a design."""

from __future__ import annotations

from typing import NamedTuple

from ninedof import _core
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import mechanism_of

MOTIONS = ("shift", "turn", "internal")


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
    out = {}
    for name, near in zip(MOTIONS, _core.nearest_singularities(g, c, internal == "held"), strict=True):
        there = near.configuration
        out[name] = NearSingularity(
            name,
            near.distance,
            str(mechanism_of(near.mechanism)),
            near.pose,
            tuple(near.direction.tolist()),
            tuple(there.position.tolist()),
            tuple(map(tuple, there.rotation.tolist())),
            tuple(there.internal_point.tolist()),
        )
    return out
