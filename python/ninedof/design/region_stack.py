"""Poses of a region as stacks of configurations of one design."""

from __future__ import annotations

import numpy as np

from ninedof import _core
from ninedof.design.pose import Pose
from ninedof.design.region import Region
from ninedof.motion.rotations import from_vectors
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats

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
