"""Roll, pitch and yaw as URDF and SDFormat have them: R = Rz(yaw) Ry(pitch) Rx(roll); and bars between joints."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import pairwise

import numpy as np

from ninedof.support.arrays import Floats

Angles = tuple[float, float, float]


def angles(rotation: Floats) -> Angles:
    """Return roll, pitch and yaw of a rotation, radians; yaw is 0 where the pitch is a right angle."""
    level = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], level)
    if level < 1e-12:
        return math.atan2(-rotation[1, 2], rotation[1, 1]), pitch, 0.0
    return math.atan2(rotation[2, 1], rotation[2, 2]), pitch, math.atan2(rotation[1, 0], rotation[0, 0])


def rotation_of(rpy: Angles) -> Floats:
    """Return the rotation of roll, pitch and yaw."""
    (cr, cp, cy), (sr, sp, sy) = ([f(a) for a in rpy] for f in (math.cos, math.sin))
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    about_y = np.array([[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]])
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(about_z @ about_y @ about_x)


def pointing(direction: Floats) -> Angles:
    """Return the angles of a frame whose z axis has a direction."""
    x, y, z = (float(v) for v in direction)
    return 0.0, math.atan2(math.hypot(x, y), z), math.atan2(y, x)


def bars(joints: Iterable[Floats]) -> Iterator[tuple[Floats, Angles, float]]:
    """Yield middle, angles and length of bars around a plate, from joint to joint; z is along the bar.

    Joints in the order of their angles about their mean; two at the same place have no bar.
    """
    points = np.array(list(joints))
    x, y, _ = (points - points.mean(axis=0)).T
    ring = points[np.argsort(np.arctan2(y, x), kind="stable")]
    for a, b in pairwise([*ring, ring[0]]):
        length = float(np.linalg.norm(b - a))
        if length > 1e-9 * float(np.abs(points).max()):
            yield 0.5 * (a + b), pointing((b - a) / length), length
