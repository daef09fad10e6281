"""Joint cone angles, and the determinants that change sign at singularities."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.verify.robot import Robot


def cone(robot: Robot, body: str, axis: Sequence[float]) -> Floats:
    """Return the angle between the six legs at a body and their axis, at every pose of the objective.

    Parameters
    ----------
    robot : Robot
    body : {"base", "platform"}
        Base: external and lower internal legs; platform: external and upper internal ones, all pointing away from
        the joint, in the frame of the body.
    axis : sequence of 3 floats, or empty
        In that frame. Empty: the direction of each leg itself at the neutral pose.

    Returns
    -------
    numpy.ndarray, shape (poses * 6,)
        Radians, 0 to pi.

    """
    seen = _directions(robot, body, robot.poses)
    middle = np.asarray(axis) if len(axis) else _directions(robot, body, robot.neutral)
    middle = np.broadcast_to(middle, seen.shape)
    across = np.linalg.norm(np.cross(seen, middle), axis=-1)
    return np.asarray(np.arctan2(across, np.sum(seen * middle, axis=-1)).reshape(-1))


def _directions(robot: Robot, body: str, c: Configuration) -> Floats:
    start, end = robot.ends(c)
    along = end - start
    if body == "base":
        return along[..., [0, 1, 2, 6, 7, 8], :]
    away = np.concatenate([-along[..., :3, :], along[..., 3:6, :]], axis=-2)
    return away @ c.rotation  # rows: Q^T v


def determinants(robot: Robot, steps: int) -> Floats:
    """Return det B, det C and det N at the neutral pose and along straight paths to all poses.

    The signs are those relative to the neutral pose, where all three are positive.

    Rows are unit vectors of the lower internal legs (B) and the upper internal legs (C), and d_i x w_i with unit
    vectors from O to the base joint and the platform joint of external leg i (N). A
    determinant that is zero or negative on a path means that the path crosses a singularity.

    Parameters
    ----------
    robot : Robot
    steps : int
        Equal parts of each path, in position, rotation vector and internal point; 0: the neutral pose alone.

    Returns
    -------
    numpy.ndarray, shape (3 (1 + steps * poses),)

    """
    here, there = robot.neutral, robot.poses
    turn = rotation_vector(there.rotation @ here.rotation.T)
    whole = np.concatenate([turn, there.position - here.position, there.internal_point - here.internal_point], axis=-1)
    parts = np.arange(1, steps + 1)[:, None, None] / steps
    path = here.moved((parts * whole).reshape(-1, 9))
    neutral, seen = _triples(robot, here), _triples(robot, path)
    return np.concatenate([np.abs(neutral).reshape(-1), (seen * np.sign(neutral)).reshape(-1)])


def _triples(robot: Robot, c: Configuration) -> Floats:
    start, end = robot.ends(c)
    along = end - start
    to_base, to_platform = (at[..., :3, :] - c.internal_point[..., None, :] for at in (start, end))
    turning = np.cross(_units(to_base), _units(to_platform))
    return np.asarray(
        np.linalg.det(np.stack([_units(along[..., 6:9, :]), _units(along[..., 3:6, :]), turning], axis=-3))
    )


def _units(v: Floats) -> Floats:
    sizes = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.asarray(v / np.where(sizes > 0.0, sizes, 1.0))


def rotation_vector(rotation: Floats) -> Floats:
    """Return the rotation vectors of matrices by angles under pi, shape (..., 3), radians."""
    skew = 0.5 * (rotation - np.swapaxes(rotation, -1, -2))
    axis = np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], axis=-1)
    sine = np.linalg.norm(axis, axis=-1, keepdims=True)
    cosine = 0.5 * (np.trace(rotation, axis1=-2, axis2=-1)[..., None] - 1.0)
    small = sine < 1e-12
    return np.asarray(np.where(small, axis, axis * np.arctan2(sine, cosine) / np.where(small, 1.0, sine)))
