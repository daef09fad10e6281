"""The nearest singularity: how far the platform may shift or turn, or O move, from the poses of a design."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import singularity_margins
from ninedof.singularity.singularity_distance import distance_to_singularity
from ninedof.support.arrays import Floats

MOTIONS = ("shift", "turn", "internal")
WAYS = 60  # directions over the sphere
MOST_POSES = 100  # those with the least determinants
REFINED = 6  # poses from which directions are refined
FIRST_ANGLE, LAST_ANGLE = 0.25, 1e-4  # between refined directions, rad
WORTHWHILE = 1e-9  # decrease of the distance, relative
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


def near_singularities(
    g: Geometry, c: Configuration, internal: str, most_poses: int = MOST_POSES
) -> dict[str, NearSingularity]:
    """Return the nearest singularity of a stack of poses for each of MOTIONS.

    The least over the poses and over directions: many, then refined at the nearest poses. Along each direction no
    singularity is missed (`distance_to_singularity`). Of more than `most_poses` those with the least determinants.
    """
    least = np.abs(np.stack(singularity_margins(g, c))).min(axis=0)
    poses = np.sort(np.argsort(least, kind="stable")[:most_poses])
    longest = FARTHEST * float(leg_lengths(g, c).max())
    ways = _sphere()
    found = {}
    for motion in MOTIONS:
        most = np.pi if motion == "turn" else longest
        distances = _distances(g, c[poses][:, None], motion, internal, ways, most)
        nearest = np.argsort(distances.min(axis=1), kind="stable")[:REFINED]
        ends = [
            _refined(g, c[poses[k : k + 1]], motion, internal, ways[distances[k].argmin()], distances[k].min(), most)
            for k in nearest
        ]
        best = min(range(len(ends)), key=lambda k: ends[k][0])
        found[motion] = _at(g, c, int(poses[nearest[best]]), motion, internal, ends[best][1], most)
    return found


def _refined(
    g: Geometry, c: Configuration, motion: str, internal: str, way: Floats, distance: float, most: float
) -> tuple[float, Floats]:
    """Return the least distance near a direction: to the best of eight directions around, or nearer to it."""
    if not np.isfinite(distance):
        return np.inf, way
    angle, turns = FIRST_ANGLE, np.arange(8) * np.pi / 4.0
    while angle > LAST_ANGLE:
        across = np.cross(way, np.eye(3)[np.argmin(np.abs(way))])
        across /= np.linalg.norm(across)
        rings = np.cos(turns)[:, None] * across + np.sin(turns)[:, None] * np.cross(way, across)
        around = np.cos(angle) * way + np.sin(angle) * rings
        found = _distances(g, c, motion, internal, around, most)[0]
        if found.min() < distance * (1.0 - WORTHWHILE):
            way, distance = around[found.argmin()], found.min()
        else:
            angle *= 0.5
    return float(distance), way


def _tangents(motion: str, internal: str, ways: Floats) -> Floats:
    """Return (omega, dp, ds) of unit motions, shape (k, 9)."""
    out = np.zeros((len(ways), 9))
    if motion == "turn":
        out[:, :3] = ways
    elif motion == "internal":
        out[:, 6:] = ways
    else:
        out[:, 3:6] = ways
        out[:, 6:] = 0.0 if internal == "held" else ways
    return out


def _distances(g: Geometry, c: Configuration, motion: str, internal: str, ways: Floats, most: float) -> Floats:
    found = distance_to_singularity(g, c, most * _tangents(motion, internal, ways)).distance
    return np.asarray(most * found).reshape(-1, len(ways))


def _at(
    g: Geometry, c: Configuration, pose: int, motion: str, internal: str, way: Floats, most: float
) -> NearSingularity:
    tangent = _tangents(motion, internal, way[None])[0]
    found = distance_to_singularity(g, c[pose], most * tangent)
    distance = float(most * found.distance)
    there = c[pose].moved(distance * tangent) if np.isfinite(distance) else c[pose]
    return NearSingularity(
        motion,
        distance,
        str(found.mechanism),
        pose,
        tuple(way.tolist()),
        tuple(there.position.tolist()),
        tuple(tuple(row) for row in there.rotation.tolist()),
        tuple(there.internal_point.tolist()),
    )


def _sphere() -> Floats:
    """Return directions evenly over the sphere, and both ways along the axes."""
    n = np.arange(WAYS) + 0.5
    z, turn = 1.0 - 2.0 * n / WAYS, n * np.pi * (3.0 - np.sqrt(5.0))
    ring = np.sqrt(1.0 - z**2)
    spiral = np.column_stack([ring * np.cos(turn), ring * np.sin(turn), z])
    return np.concatenate([np.eye(3), -np.eye(3), spiral])
