"""The boundary of a workspace as a surface of quadrilaterals: for figures, reports and the viewer."""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr
from ninedof.workspace.field import WorkspaceField

LEVELS = (0.15, 0.6)  # of the allowed share at the surface, where that keeps the volume


@short_repr
class WorkspaceSurface(NamedTuple):
    """A closed surface; seen from outside the corners of a face run counterclockwise."""

    points: Floats
    """Shape (n, 3), in the coordinates of the map."""
    faces: NDArray[np.int64]
    """Rows of four numbers of points, shape (m, 4)."""

    @property
    def normals(self) -> Floats:
        """Outward unit normals of the faces, shape (m, 3)."""
        a, b, c, d = (self.points[self.faces[:, k]] for k in range(4))
        across = np.cross(c - a, d - b)
        return np.asarray(across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300))

    @property
    def volume(self) -> float:
        """Volume enclosed, by the divergence theorem."""
        a, b, c, d = (self.points[self.faces[:, k]] for k in range(4))
        return float((np.einsum("ij,ij->", a, np.cross(b, c)) + np.einsum("ij,ij->", a, np.cross(c, d))) / 6.0)


def surface_of(field: WorkspaceField) -> WorkspaceSurface:
    """Return the surface of a field, at a level of its allowed share.

    The field is smoothed, which shrinks a body that is round or thin where the share is one half. So the level is the
    one that as many points of the raster are above as are allowed, within `LEVELS`.
    """
    allowed = max(round(float(field.fraction.sum())), 1)
    level = float(np.clip(np.partition(field.fraction, -allowed, axis=None)[-allowed], *LEVELS))
    first = np.array([x[0] for x in field.axes])
    return surface_net(field.fraction, level, first, np.array([x[1] for x in field.axes]) - first)


def surface_net(values: Floats, level: float, first: Floats, step: Floats) -> WorkspaceSurface:
    """Return the closed surface about the values above a level: a surface net (Gibson, 1998), not relaxed.

    Each cube of eight raster points with both kinds has one vertex, the mean of the places on its edges where the level
    is crossed; each raster edge between the kinds has one face, of the vertices of the four cubes around it.

    Parameters
    ----------
    values : array, shape (n_x, n_y, n_z)
        On an even raster; the outermost ones are not above the level.
    level : float
    first, step : array, shape (3,)
        The place of the first value, and from each to the next.

    """
    inside = values > level
    corner = [(slice(i, i - 1 or None), slice(j, j - 1 or None), slice(k, k - 1 or None)) for i, j, k in _CORNERS]
    count = sum(inside[c].astype(np.int8) for c in corner)
    mixed = np.asarray((count > 0) & (count < 8))
    number = np.full(mixed.shape, -1, dtype=np.int64)
    number[mixed] = np.arange(int(mixed.sum()))
    near = np.stack([values[c][mixed] for c in corner])
    total, crossed = np.zeros((near.shape[1], 3)), np.zeros(near.shape[1])
    for a, b in _EDGES:
        cut = (near[a] > level) != (near[b] > level)
        t = (level - near[a][cut]) / (near[b][cut] - near[a][cut])
        start, end = np.array(_CORNERS[a]), np.array(_CORNERS[b])
        total[cut] += start + t[:, None] * (end - start)
        crossed[cut] += 1.0
    points = first + step * (np.argwhere(mixed) + total / crossed[:, None])
    return WorkspaceSurface(points, np.concatenate([_faces(inside, number, axis) for axis in range(3)]))


_CORNERS = tuple(product((0, 1), repeat=3))
_EDGES = tuple(
    (a, b)
    for a in range(8)
    for b in range(a + 1, 8)
    if sum(p != q for p, q in zip(_CORNERS[a], _CORNERS[b], strict=True)) == 1
)


def _faces(inside: NDArray[np.bool_], number: NDArray[np.int64], axis: int) -> NDArray[np.int64]:
    """Return the faces across raster edges along an axis; the outermost points are outside, so no cube is missing."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    before = np.moveaxis(inside, axis, 0)[:-1]
    after = np.moveaxis(inside, axis, 0)[1:]
    at = np.argwhere(np.moveaxis(before != after, 0, axis))
    leaving = np.moveaxis(before, 0, axis)[tuple(at.T)]  # from inside to outside along the axis

    def cube(down_u: int, down_v: int) -> NDArray[np.int64]:
        where = at.copy()
        where[:, u] -= down_u
        where[:, v] -= down_v
        return np.asarray(number[tuple(where.T)])

    ring = np.column_stack([cube(1, 1), cube(0, 1), cube(0, 0), cube(1, 0)])
    return np.where(leaving[:, None], ring, ring[:, ::-1])
