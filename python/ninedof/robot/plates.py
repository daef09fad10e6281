"""The shape of a plate: the convex hull of its six joints, flat or solid."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats

_TOLERANCE = 1e-9  # relative to the size of the plate


def points_of(g: Geometry, c: Configuration) -> Floats:
    """Return the joints of the base, those of the platform in the base frame, each external first, and O: (13, 3)."""
    carried = c.position + np.vstack([g.platform_external, g.platform_internal]) @ c.rotation.T
    return np.vstack([g.base_external, g.base_internal, carried, c.internal_point])


def distinct(points: Floats) -> Floats:
    """Return the points without those that coincide with an earlier one, such as coupled joints."""
    size = float(np.ptp(points, axis=0).max())
    out: list[Floats] = []
    for point in points:
        if all(np.linalg.norm(point - other) > _TOLERANCE * size for other in out):
            out.append(point)
    return np.array(out)


def outlines(joints: Floats) -> list[Floats]:
    """Return the faces of the convex hull of a few points, each as an ordered outline (m, 3).

    One polygon if the points (n, 3) lie in a plane (joints inside it are left out), else the faces of a solid; they may
    not all lie on one line. All planes through three points are tested: twenty for six joints.
    """
    points = distinct(joints)
    size = float(np.ptp(points, axis=0).max())
    faces: dict[tuple[int, ...], Floats] = {}
    for triple in combinations(range(len(points)), 3):
        a, b, c = points[list(triple)]
        normal = np.cross(b - a, c - a)
        length = float(np.linalg.norm(normal))
        if length <= _TOLERANCE * size**2:
            continue
        normal /= length
        heights = (points - a) @ normal
        in_plane = np.abs(heights) <= _TOLERANCE * size
        above, below = bool(np.any(heights[~in_plane] > 0)), bool(np.any(heights[~in_plane] < 0))
        if not (above and below):
            faces.setdefault(tuple(np.flatnonzero(in_plane).tolist()), _outline(points[in_plane], normal))
    return list(faces.values())


def _outline(points: Floats, normal: Floats) -> Floats:
    """Return the corners of the convex hull of points in a plane, in order (Andrew's monotone chain)."""
    across = points[1] - points[0]
    across = across / np.linalg.norm(across)
    flat = np.column_stack([points @ across, points @ np.cross(normal, across)])
    slack = _TOLERANCE * float(np.ptp(flat, axis=0).max()) ** 2
    order = np.lexsort((flat[:, 1], flat[:, 0])).tolist()

    def chain(indices: list[int]) -> list[int]:
        out: list[int] = []
        for index in indices:
            while len(out) > 1:
                (ax, ay), (bx, by) = flat[out[-1]] - flat[out[-2]], flat[index] - flat[out[-2]]
                if ax * by - ay * bx > slack:  # a turn to the left
                    break
                out.pop()
            out.append(index)
        return out[:-1]

    return points[chain(order) + chain(order[::-1])]
