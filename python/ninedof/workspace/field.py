"""The fields of a map on an even raster, smooth between the centres of its cells: for sections and bodies to draw."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr
from ninedof.workspace.cells import LIMITS, WorkspaceCells, WorkspaceSlice

MOST_VOXELS = 1_300_000
Indices = NDArray[np.int64]
Ends = tuple[Floats, Floats]


@short_repr
class WorkspaceField(NamedTuple):
    """Allowed share and condition number on an even raster about the workspace; arrays of shape (n_x, n_y, n_z)."""

    axes: tuple[Floats, Floats, Floats]
    """Positions of the raster along each coordinate."""
    fraction: Floats
    """Allowed share, smoothed over neighbours: the workspace ends where it is one half; 0 in the outermost layer."""
    condition_number: Floats
    """Interpolated between the centres of cells, outside the workspace too."""


def field_of(cells: WorkspaceCells, ends: Ends, most: int = MOST_VOXELS) -> WorkspaceField:
    """Return the fields of cells of an octree or a grid between `ends`, on at most about `most` points.

    From coarse to fine: the values of each level are the means of the cells in it where there are cells so small, and
    interpolated linearly from the level above elsewhere. So a large cell has no step at its faces.
    """
    low, high = ends
    coarse = np.round((high - low) / cells.size.max(axis=0)).astype(np.int64)  # largest cells along each side
    level = np.round(np.log2((high - low)[0] / cells.size[:, 0] / coarse[0])).astype(np.int64)
    first, last = _about(cells, ends, coarse)
    voxels = int(np.prod(last - first))
    finest = 0
    while finest < int(level.max()) and voxels * 8 ** (finest + 1) <= most:
        finest += 1
    inside = np.all(
        (cells.centre > low + (high - low) * first / coarse) & (cells.centre < low + (high - low) * last / coarse),
        axis=1,
    )
    there = WorkspaceCells._make(values[inside] for values in cells)
    level = level[inside]
    known = np.isfinite(there.condition_number)
    worst = float(there.condition_number[known].max(initial=1.0))
    kappa = np.log(np.where(known, there.condition_number, worst))
    fraction, logarithm = np.zeros(last - first), np.zeros(last - first)
    for k in range(finest + 1):
        if k:
            fraction, logarithm = _finer(fraction), _finer(logarithm)
        place = (there.centre - low) / (high - low) * (coarse << k) - (first << k)
        shape = tuple((last - first) << k)
        at = np.ravel_multi_index(tuple(np.floor(place).astype(np.int64).T), shape)
        small = level >= k
        weight = np.exp2(-3.0 * np.maximum(level - k, 0))
        _put(logarithm, at[small], kappa[small], weight[small])
        _put(fraction, at[small], there.fraction[small], weight[small])
        large = (level < k) & (there.state != 1)  # wholly inside or outside: nothing to interpolate
        for one in np.unique(level[large]).tolist():
            these = large & (level == one)
            corner = np.floor(place[these] - 0.5 * (1 << (k - one)) + 0.5).astype(np.int64)
            fraction[_blocks(corner, 1 << (k - one))] = there.fraction[these][:, None]
    step = (high - low) / (coarse << finest)
    start = low + (high - low) * first / coarse
    x, y, z = (start[j] + step[j] * (np.arange(-1, fraction.shape[j] + 1) + 0.5) for j in range(3))
    smooth = _smoothed(np.pad(fraction, 1))
    return WorkspaceField((x, y, z), smooth, np.exp(_smoothed(np.pad(logarithm, 1, mode="edge"))))


def _about(cells: WorkspaceCells, ends: Ends, coarse: Indices) -> tuple[Indices, Indices]:
    """Return the largest cells that hold the workspace, and one more on each side, as ranges of their numbers."""
    low, high = ends
    held = cells.fraction > 0.0
    if not held.any():
        return np.zeros(3, dtype=np.int64), coarse
    half = 0.5 * cells.size[held]
    corners = (cells.centre[held] - half).min(axis=0), (cells.centre[held] + half).max(axis=0)
    first = np.floor((corners[0] - low) / (high - low) * coarse + 1e-6).astype(np.int64) - 1
    last = np.ceil((corners[1] - low) / (high - low) * coarse - 1e-6).astype(np.int64) + 1
    return np.maximum(first, 0), np.minimum(last, coarse)


def _put(array: Floats, at: Indices, values: Floats, weight: Floats) -> None:
    """Set the mean of the values at each place."""
    total = np.bincount(at, weight, array.size)
    mean = np.bincount(at, weight * values, array.size)
    there = total > 0.0
    array.ravel()[there] = mean[there] / total[there]


def _blocks(corner: Indices, side: int) -> tuple[Indices, Indices, Indices]:
    """Return the places in cubes of `side` from their lowest corners, each of shape (n, side ** 3)."""
    steps = np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    x, y, z = np.moveaxis(corner[:, None] + steps, -1, 0)
    return x, y, z


def _finer(array: Floats) -> Floats:
    """Return the values at twice as many places along each axis, linear between the centres."""
    for axis in range(3):
        ends = np.take(array, [0], axis), np.take(array, [-1], axis)
        wide = np.moveaxis(np.concatenate([ends[0], array, ends[1]], axis), axis, 0)
        near = wide[1:-1]
        pairs = np.stack([0.75 * near + 0.25 * wide[:-2], 0.75 * near + 0.25 * wide[2:]], axis=1)
        array = np.moveaxis(pairs.reshape(-1, *near.shape[1:]), 0, axis)
    return np.ascontiguousarray(array)


def _smoothed(array: Floats) -> Floats:
    for axis in range(3):
        wide = np.moveaxis(np.pad(array, [(1, 1) if k == axis else (0, 0) for k in range(3)], mode="edge"), axis, 0)
        array = np.moveaxis(0.25 * wide[:-2] + 0.5 * wide[1:-1] + 0.25 * wide[2:], 0, axis)
    return np.ascontiguousarray(array)


def section_of(
    cells: WorkspaceCells, field: WorkspaceField, ends: Ends, coordinates: tuple[str, str, str], fixed: int, at: float
) -> WorkspaceSlice:
    """Return the section of a field where coordinate number `fixed` has the value `at`, within its raster."""
    h, v = (k for k in range(3) if k != fixed)
    along = field.axes[fixed]
    place = float(np.clip((at - along[0]) / (along[1] - along[0]), 0.0, len(along) - 1.0))
    before = min(int(place), len(along) - 2)
    share = place - before

    def plane(values: Floats) -> Floats:
        pair = [np.take(values, before + k, fixed).T for k in (0, 1)]
        return np.asarray((1.0 - share) * pair[0] + share * pair[1])

    fraction = plane(field.fraction)
    if not along[0] <= at <= along[-1]:
        fraction = np.zeros_like(fraction)
    state = np.where(fraction >= 0.5, 2, 0).astype(np.uint8)
    edge = (fraction > 0.0) & (fraction < 1.0)
    state[edge] = 1
    limit = np.full(fraction.shape, -1, dtype=np.int16)
    rows, columns = np.nonzero(edge)
    points = np.column_stack([field.axes[h][columns], field.axes[v][rows]])
    step = np.array([field.axes[k][1] - field.axes[k][0] for k in range(3)])
    limit[edge] = _limits(cells, points, (fixed, at), step, ends)
    kappa = np.where(fraction > 0.0, plane(field.condition_number), np.nan)
    axes = (coordinates[h], coordinates[v])
    return WorkspaceSlice(axes, (coordinates[fixed], at), field.axes[h], field.axes[v], state, limit, kappa, fraction)


def _limits(
    cells: WorkspaceCells, points: Floats, plane: tuple[int, float], step: Floats, ends: Ends
) -> NDArray[np.int16]:
    """Return the limit of the boundary cell nearest to each point of a plane; "box" at a face without one."""
    fixed, at = plane
    drawn = [k for k in range(3) if k != fixed]
    near = np.abs(cells.centre[:, fixed] - at) <= 0.5 * cells.size[:, fixed] + step[fixed]
    held = np.flatnonzero(near & (cells.state == 1))
    face = np.min([np.abs(points - end[drawn]) / step[drawn] for end in ends], axis=(0, 2)) <= 1.0
    box = np.int16(LIMITS.index("box"))
    if not len(held):
        return np.where(face, box, np.int16(-1)).astype(np.int16)
    out = np.empty(len(points), dtype=np.int16)
    places, limits, size = cells.centre[held][:, drawn], cells.limit[held], cells.size[held][:, drawn]
    for n, point in enumerate(points):
        away = np.maximum(np.abs(places - point) - 0.5 * size, 0.0) / step[drawn]
        square = np.einsum("ij,ij->i", away, away)
        k = int(square.argmin())
        out[n] = box if face[n] and square[k] > 1.0 else limits[k]
    return out
