"""Sets of poses for an objective: a box, a ball, a path. Each returns a tuple of `Pose`."""

from __future__ import annotations

import itertools
import math
from functools import partial
from typing import Any

import numpy as np

from ninedof.design.pose import DEFAULT_INTERNAL_POINT, ZERO, Pose
from ninedof.support.angles import DEG, in_radians
from ninedof.support.arguments import Vector, finite, vector, vectors, whole
from ninedof.support.schema import Check

__all__ = ["Pose", "ball", "box", "path"]

MOST_POSES = 10_000  # in one study; each takes one decomposition per evaluation


def box(
    half: Any,
    points: int = 3,
    tilt: Any = None,
    tilt_deg: Any = None,
    internal_point: Any = DEFAULT_INTERNAL_POINT,
    unit: str = "length",
) -> tuple[Pose, ...]:
    """Return a grid of poses over a box about the neutral pose, and tilts at its centre.

    Parameters
    ----------
    half : (3,) floats
        Half edges along x, y and z of the base frame; an axis with 0 has one point.
    points : int
        Points on each other axis, both ends included; 3 by default: -half, 0, +half.
    tilt, tilt_deg : (3,) floats, optional
        Angles about x, y and z, radians or degrees: the neutral pose is also turned by plus and minus each, one at a
        time. None by default.
    internal_point, unit
        As in `Pose`, for all of them.

    Examples
    --------
    >>> from ninedof import poses
    >>> len(poses.box((0.1, 0.1, 0.1), tilt_deg=(10, 10, 0), unit="zp"))
    31

    """
    edges = vector("half", half, least=0.0)
    count = whole("points", points, 1, MOST_POSES)
    axes = [_grid(h, count if h > 0.0 else 1) for h in edges]
    if (every := math.prod(map(len, axes))) > MOST_POSES:
        raise ValueError(f"points: got {every} poses in all, expected at most {MOST_POSES}")
    places: list[Vector] = [(x, y, z) for x, y, z in itertools.product(*axes)]
    return _with_tilts(places, tilt, tilt_deg, internal_point, unit)


def ball(
    radius: float,
    points: int = 33,
    tilt: Any = None,
    tilt_deg: Any = None,
    internal_point: Any = DEFAULT_INTERNAL_POINT,
    unit: str = "length",
) -> tuple[Pose, ...]:
    """Return low-discrepancy poses in a ball about the neutral pose, and tilts at its centre.

    Parameters
    ----------
    radius : float
        Of the ball.
    points : int
        Number of poses, 33 by default. The first is the centre, the last lies on the surface; each represents the same
        share of the volume.
    tilt, tilt_deg, internal_point, unit
        As in `box`.

    Examples
    --------
    >>> from ninedof import poses
    >>> poses.ball(0.1, points=5)[0].position
    (0.0, 0.0, 0.0)

    """
    size = finite("radius", radius, least=0.0)
    count = whole("points", points, 1, MOST_POSES)
    places: list[Vector] = [ZERO]
    # Directions by the two-dimensional sequence of the plastic number: another point leaves the others unchanged.
    plastic = 1.324717957244746
    for k in range(1, count):
        distance = size * (k / (count - 1)) ** (1.0 / 3.0)
        height = 2.0 * ((0.5 + k / plastic) % 1.0) - 1.0
        around = 2.0 * math.pi * ((0.5 + k / plastic**2) % 1.0)
        flat = math.sqrt(1.0 - height * height)
        places.append((distance * flat * math.cos(around), distance * flat * math.sin(around), distance * height))
    return _with_tilts(places, tilt, tilt_deg, internal_point, unit)


def path(
    positions: Any,
    rotations: Any = None,
    rotations_deg: Any = None,
    points: int = 17,
    internal_point: Any = DEFAULT_INTERNAL_POINT,
    unit: str = "length",
) -> tuple[Pose, ...]:
    """Return poses along a path, straight between its corners.

    Parameters
    ----------
    positions : sequence of (3,) floats
        Shifts of p at the corners, at least two.
    rotations, rotations_deg : sequence of (3,) floats, optional
        Rotation vector at each corner, radians or degrees, interpolated linearly in between. None by default.
    points : int
        Number of poses, 17 by default, both ends included, evenly spaced over the arc length of the positions (over the
        corners, if p does not move at all).
    internal_point, unit
        As in `Pose`, for all of them.

    Examples
    --------
    >>> from ninedof import poses
    >>> [pose.position[0] for pose in poses.path([[0, 0, 0], [1, 0, 0]], points=3)]
    [0.0, 0.5, 1.0]

    """
    corners = vectors("positions", positions)
    if len(corners) < 2:
        raise ValueError(f"positions: got {len(corners)} corners, expected at least two")
    turns = _radians("rotations", rotations, rotations_deg, vectors) or (ZERO,) * len(corners)
    if len(turns) != len(corners):
        raise ValueError(f"rotations: got {len(turns)} rotations, expected one a corner, {len(corners)}")
    count = whole("points", points, 2, MOST_POSES)
    with np.errstate(over="ignore"):  # of huge numbers, see below
        steps = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    if not steps.any():
        steps = np.ones_like(steps)
    for k, step in enumerate(steps):
        if step == 0.0 and turns[k] != turns[k + 1]:
            raise ValueError(
                f"positions[{k + 1}]: got the place of the corner before it with another rotation, expected a path on "
                "which the platform moves wherever it turns"
            )
    along = np.concatenate([[0.0], np.cumsum(steps)])
    with np.errstate(all="ignore"):  # of huge numbers, which poses refuse
        at = np.linspace(0.0, along[-1], count)
        p, q = (
            np.column_stack([np.interp(at, along, column) for column in np.transpose(rows)])
            for rows in (corners, turns)
        )
    return tuple(Pose(tuple(x), tuple(w), internal_point, unit) for x, w in zip(p.tolist(), q.tolist(), strict=True))


def _grid(half: float, count: int) -> list[float]:
    """Return points from -half to half, exactly symmetric."""
    return [half * ((2 * k - (count - 1)) / (count - 1)) for k in range(count)] if count > 1 else [0.0]


def _with_tilts(places: list[Vector], tilt: Any, tilt_deg: Any, internal_point: Any, unit: str) -> tuple[Pose, ...]:
    """Return poses at the places, and the neutral pose turned by plus and minus each angle that is not zero."""
    angles = _radians("tilt", tilt, tilt_deg, partial(vector, least=0.0)) or ZERO
    turns = [sign * angle * np.eye(3)[k] for k, angle in enumerate(angles) if angle > 0.0 for sign in (1.0, -1.0)]
    every = [(p, ZERO) for p in places] + [(ZERO, tuple((turn + 0.0).tolist())) for turn in turns]
    return tuple(Pose(p, turn, internal_point, unit) for p, turn in every)


def _radians(name: str, radians: Any, degrees: Any, check: Check) -> Any:
    """Return an argument that has a second name for degrees; None without one."""
    values = {key: value for key, value in ((name, radians), (name + DEG, degrees)) if value is not None}
    return check(name, in_radians(values, {name: check})[name]) if values else None
