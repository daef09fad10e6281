"""The surface of a workspace for the view: where its cells are half allowed.

The cells give the allowed share of the voxels of a coarse grid; the shares are smoothed, and a surface net puts a
vertex into each cube of eight voxels that the surface crosses, and a quadrangle across each edge that it crosses.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ninedof.support.arrays import Floats
from ninedof.workspace import WorkspaceMap

VOXELS = 36  # along each side of the workspace, about
LEVELS = (0.15, 0.6)  # of the surface, where the volume is kept


def body_of(found: WorkspaceMap) -> dict[str, Any] | None:
    """Return vertices and faces of the surface; None for orientations, samples and empty workspaces."""
    if found.of_angles or found.method == "sample" or not found.volume > 0.0:
        return None
    low, side, share = shares(found)
    count = round(float(share.sum()))
    for axis in range(3):
        share = _smoothed(share, axis)
    level = float(np.clip(np.sort(share, axis=None)[-max(count, 1)], *LEVELS))  # as many voxels are above it as allowed
    points, faces = surface_net(share, level)
    if not len(faces):
        return None
    placed = low + points * side
    return {"vertices": np.round(placed, _decimals(placed)).tolist(), "faces": faces.tolist()}


def shares(found: WorkspaceMap) -> tuple[Floats, Floats, Floats]:
    """Return the middle of the first voxel, the sides of a voxel, and the allowed share of each, empty ones around.

    A voxel has the size of a cell, so that a cell lies in one voxel or fills several.
    """
    cells = found.cells
    some = np.flatnonzero(cells.fraction > 0.0)
    centre, size, part = cells.centre[some], cells.size[some], cells.fraction[some]
    span = (centre + 0.5 * size).max(axis=0) - (centre - 0.5 * size).min(axis=0)
    halves = np.floor(np.log2(VOXELS * cells.size.max(axis=0) / span).min())
    side = np.maximum(cells.size.max(axis=0) / 2.0 ** max(halves, 0.0), cells.size.min(axis=0))
    first = np.floor((centre - 0.5 * size - found.low) / side + 1e-6).min(axis=0)
    low = found.low + first * side
    share = np.zeros(tuple(np.ceil(((centre + 0.5 * size) - low) / side - 1e-6).max(axis=0).astype(int)))
    small = (size <= 1.5 * side).all(axis=1)
    at = tuple(np.floor((centre[small] - low) / side).astype(int).T)
    np.add.at(share, at, part[small] * size[small].prod(axis=1) / side.prod())
    for k in np.flatnonzero(~small):
        ends = (np.rint((centre[k] + sign * size[k] - low) / side).astype(int) for sign in (-0.5, 0.5))
        share[tuple(slice(a, b) for a, b in zip(*ends, strict=True))] = part[k]
    return low - 1.5 * side, side, np.pad(np.minimum(share, 1.0), 2)


def surface_net(field: Floats, level: float) -> tuple[Floats, Any]:
    """Return vertices (n, 3) in voxels and faces (m, 4) of the surface where a field has a level, facing outward.

    On the rim of the field it is below level.
    """
    inside = field > level
    total, weight = np.zeros((*(np.array(field.shape) - 1), 3)), np.zeros(np.array(field.shape) - 1)
    crossings = []
    for axis in range(3):
        n = field.shape[axis]
        a, b = (np.take(field, np.arange(k, n - 1 + k), axis=axis) for k in range(2))
        crossed = np.argwhere((a > level) != (b > level))
        start, end = a[tuple(crossed.T)], b[tuple(crossed.T)]
        point = crossed.astype(float)
        point[:, axis] += (level - start) / (end - start)
        for cube in _cubes(crossed, axis):
            np.add.at(total, tuple(cube.T), point)
            np.add.at(weight, tuple(cube.T), 1.0)
        crossings.append((crossed, axis, inside[tuple(crossed.T)]))
    number = np.cumsum(weight.ravel() > 0.0).reshape(weight.shape) - 1
    vertices = total[weight > 0.0] / weight[weight > 0.0][:, None]
    faces = []
    for crossed, axis, from_inside in crossings:
        quads = np.stack([number[tuple(cube.T)] for cube in _cubes(crossed, axis)], axis=1)
        faces.append(np.where(from_inside[:, None], quads, quads[:, ::-1]))
    return vertices, np.concatenate(faces)


def _cubes(edges: Any, axis: int) -> Iterator[Any]:
    """Yield the four cubes about each edge along an axis, turning about it."""
    for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
        cube = edges.copy()
        cube[:, (axis + 1) % 3] -= du
        cube[:, (axis + 2) % 3] -= dv
        yield cube


def _smoothed(field: Floats, axis: int) -> Floats:
    """Return a field averaged with its neighbours along an axis, weights 1, 2, 1."""
    wide = np.pad(field, [(1, 1) if k == axis else (0, 0) for k in range(3)])
    n = field.shape[axis]
    before, here, after = (np.take(wide, np.arange(k, k + n), axis=axis) for k in range(3))
    return np.asarray(0.25 * before + 0.5 * here + 0.25 * after)


def _decimals(points: Floats) -> int:
    size = float(np.ptp(points, axis=0).max())
    return 4 - int(np.floor(np.log10(size)))
