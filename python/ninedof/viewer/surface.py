"""The surface where a field on a regular grid is zero: one vertex for each cell that it passes (surface nets)."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arrays import Floats

Faces = NDArray[np.uint32]


def surface(field: Floats, low: Floats, high: Floats) -> tuple[Floats, Faces]:
    """Return a closed surface about the points where the field is positive, normals outward.

    Gibson, Constrained elastic surface nets (1998), without the relaxation: the vertex of a cell is the mean of the
    points where the surface crosses its edges.

    Parameters
    ----------
    field : numpy.ndarray, shape (a, b, c)
        Values at the points of a grid, each side at least 2.
    low, high : numpy.ndarray, shape (3,)
        The first and the last point of the grid. Beyond them the field counts as negative.

    Returns
    -------
    vertices : numpy.ndarray, shape (v, 3)
    faces : numpy.ndarray of uint32, shape (f, 3)

    """
    f = np.pad(field, 1, constant_values=-1e9)  # so far below zero that the surface ends at the grid
    cells = np.array(f.shape) - 1
    total, count = np.zeros((*cells, 3)), np.zeros(cells)

    def corner(offset: tuple[int, ...]) -> Floats:
        x, y, z = (slice(k, k + n) for k, n in zip(offset, cells.tolist(), strict=True))
        return np.asarray(f[x, y, z])

    for axis, a, b in product(range(3), (0, 1), (0, 1)):
        first = [a, b]
        first.insert(axis, 0)
        last = first.copy()
        last[axis] = 1
        here, there = corner(tuple(first)), corner(tuple(last))
        crossed = (here > 0.0) != (there > 0.0)
        t = np.divide(here, here - there, out=np.zeros_like(here), where=crossed)
        point = np.broadcast_to(np.array(first, dtype=np.float64), total.shape).copy()
        point[..., axis] += t
        total += np.where(crossed[..., None], point, 0.0)
        count += crossed
    passed = count > 0
    number = np.full(cells, -1)
    number[passed] = np.arange(int(passed.sum()))
    step = (high - low) / (np.array(field.shape) - 1)
    vertices = low + step * (np.argwhere(passed) + total[passed] / count[passed][:, None] - 1.0)
    quads = [_across(f, number, axis) for axis in range(3)]
    corners = np.concatenate(quads)
    return vertices, np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]).astype(np.uint32)


def _across(f: Floats, number: NDArray[np.intp], axis: int) -> NDArray[np.intp]:
    """Return a quad of the four cells about each edge along an axis that the surface crosses."""
    inside = np.moveaxis(f, axis, 0) > 0.0
    about = np.moveaxis(number, axis, 0)
    leaves, enters = inside[:-1] & ~inside[1:], ~inside[:-1] & inside[1:]
    found = []
    for crossed, flipped in ((leaves, False), (enters, True)):
        k, i, j = np.nonzero(crossed)
        around = [(i - 1, j - 1), (i, j - 1), (i, j), (i - 1, j)]
        quad = np.column_stack([about[k, a, b] for a, b in around])
        # The two other axes keep their order, which is a left-handed one about y.
        found.append(quad[:, ::-1] if flipped != (axis == 1) else quad)
    return np.concatenate(found)


def volume(vertices: Floats, faces: Faces) -> float:
    """Return the volume within a closed surface."""
    if not len(faces):
        return 0.0
    middle = vertices - vertices.mean(axis=0)
    a, b, c = (middle[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def smoothed(vertices: Floats, faces: Faces, rounds: int = 3) -> Floats:
    """Return the vertices, each moved half way to the mean of its neighbours some times: for the eye, not for volumes.

    Surface nets leave teeth along sharp edges.
    """
    pairs = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.intp)
    count = np.bincount(pairs[:, 0], minlength=len(vertices))[:, None]
    for _ in range(rounds):
        total = [np.bincount(pairs[:, 0], vertices[pairs[:, 1], axis], len(vertices)) for axis in range(3)]
        vertices = 0.5 * (vertices + np.column_stack(total) / count)
    return vertices
