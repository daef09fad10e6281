"""Distances between joints and between legs."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ninedof.support.arrays import Floats
from ninedof.verify.robot import Robot


def between_points(points: Floats) -> Floats:
    """Return the distance of every two of n points, shape (n (n - 1) / 2,)."""
    return np.array([float(np.linalg.norm(a - b)) for a, b in combinations(points, 2)])


def between_legs(robot: Robot) -> Floats:
    """Return the distance of every two legs that share no joint, at every pose of the objective.

    Returns
    -------
    numpy.ndarray, shape (poses * pairs,)

    """
    start, end = robot.ends(robot.poses)
    first, second = robot.apart.T
    return between_segments(start[:, first], end[:, first], start[:, second], end[:, second]).reshape(-1)


def between_segments(a: Floats, b: Floats, c: Floats, d: Floats) -> Floats:
    """Return the distance of the segments ab and cd.

    One of the nearest points is an end of its segment, or both are interior and lie on the common normal. The second
    case needs both feet of the normal inside the segments, and segments that are not parallel.

    Parameters
    ----------
    a, b, c, d : numpy.ndarray, shape (..., 3)

    Returns
    -------
    numpy.ndarray, shape (...)

    """
    ends = np.min([_to_segment(a, c, d), _to_segment(b, c, d), _to_segment(c, a, b), _to_segment(d, a, b)], axis=0)
    u, v, w = b - a, d - c, c - a
    normal = np.cross(u, v)
    square = np.sum(normal**2, axis=-1)
    crossing = square > 1e-20 * np.sum(u**2, axis=-1) * np.sum(v**2, axis=-1)
    safe = np.where(crossing, square, 1.0)
    along_u = np.sum(np.cross(w, v) * normal, axis=-1) / safe
    along_v = np.sum(np.cross(w, u) * normal, axis=-1) / safe
    inside = crossing & (along_u >= 0.0) & (along_u <= 1.0) & (along_v >= 0.0) & (along_v <= 1.0)
    lines = np.abs(np.sum(w * normal, axis=-1)) / np.sqrt(safe)
    return np.asarray(np.where(inside, np.minimum(lines, ends), ends))


def _to_segment(point: Floats, a: Floats, b: Floats) -> Floats:
    along = b - a
    square = np.sum(along**2, axis=-1)
    share = np.clip(np.sum((point - a) * along, axis=-1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    foot = a + share[..., None] * along
    return np.asarray(np.linalg.norm(point - foot, axis=-1))
