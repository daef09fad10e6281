"""Poses of a region as stacks of configurations of one design, and samples of them."""

from __future__ import annotations

import numpy as np

from ninedof import _core
from ninedof.design.pose import Pose
from ninedof.design.region import Region
from ninedof.motion.rotations import from_vectors
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats

OUTWARD = 1.25  # half of a sample is drawn from a region larger by this and moved to the boundary
ROOT = 1.1127756842787055  # of x^7 = x + 1: powers of its inverse spread points evenly over six dimensions


def places_o(region: Region) -> bool:
    """Return whether the region alone says where O is."""
    return region.internal_point != "best"


def configurations_at(region: Region, neutral: Configuration, at: Floats) -> tuple[Floats, Configuration]:
    """Return the poses nearest to given coordinates.

    Parameters
    ----------
    region : Region
        One that says where O is.
    neutral : Configuration
        The neutral one of the design.
    at : numpy.ndarray, shape (n, 6)
        Shift of p (on a path the first from -1 to 1), tilt about x and y, and yaw.

    Returns
    -------
    at : numpy.ndarray, shape (n, 6)
        The nearest coordinates in the region.
    configurations : Configuration, shape (n,)

    """
    rows = _core.region_poses(region.for_core(), np.ascontiguousarray(at))
    near, shift, turn, internal = np.split(rows, [6, 9, 12], axis=1)
    unit = float(neutral.position[2]) if region.unit == "zp" else 1.0
    q = from_vectors(turn) @ neutral.rotation
    return near, Configuration(neutral.position + unit * shift, q, neutral.internal_point + unit * internal)


def poses_at(region: Region, at: Floats) -> tuple[Pose, ...]:
    """Return the poses nearest to given coordinates, for the poses of an objective."""
    rows = _core.region_poses(region.for_core(), np.ascontiguousarray(at)).tolist()
    return tuple(Pose(tuple(row[6:9]), tuple(row[9:12]), tuple(row[12:15]), region.unit) for row in rows)


def samples(region: Region, count: int) -> Floats:
    """Return coordinates of `count` poses: even in the region, then as many again, a good part of them on its boundary.

    Even: in positions, in the tilt vector and in the yaw. A sequence of low discrepancy, always the same.
    """
    n = np.arange(1, count + 1)[:, None]
    cube = (0.5 + n * ROOT ** -np.arange(1.0, 7.0)) % 1.0
    return np.concatenate([_spread(region, cube, 1.0), _spread(region, cube, OUTWARD)])


def _spread(region: Region, cube: Floats, outward: float) -> Floats:
    """Return the coordinates of points of the unit cube."""
    reach = np.asarray(region.reach)
    at = reach * np.clip(outward * (2.0 * cube - 1.0), -1.0, 1.0)
    at[:, 3:5] = region.tilt * _disc(cube[:, 3:5], outward)
    if region.cylinder is not None:
        at[:, :2] = region.cylinder[0] * _disc(cube[:, :2], outward)
    elif region.ball is not None:
        z, turn = 2.0 * cube[:, 1] - 1.0, 2.0 * np.pi * cube[:, 2]
        ring = np.sqrt(1.0 - z**2)
        ways = np.column_stack([ring * np.cos(turn), ring * np.sin(turn), z])
        at[:, :3] = region.ball * np.minimum(outward * np.cbrt(cube[:, :1]), 1.0) * ways
    return at


def _disc(square: Floats, outward: float) -> Floats:
    radius, turn = np.minimum(outward * np.sqrt(square[:, 0]), 1.0), 2.0 * np.pi * square[:, 1]
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])
