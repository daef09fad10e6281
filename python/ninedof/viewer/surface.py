"""The surface of a field whose grid it may reach, as triangles, smoothed for the eye."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ninedof.support.arrays import Floats
from ninedof.workspace.surface import WorkspaceSurface, surface_net

Faces = NDArray[np.uint32]
BEYOND = -1e9  # of a field at the points around its grid: so far below zero that the surface ends at the grid


def surface(field: Floats, low: Floats, high: Floats) -> WorkspaceSurface:
    """Return a closed surface about the points of a grid from low to high where the field is positive."""
    step = (high - low) / (np.array(field.shape) - 1)
    return surface_net(np.pad(field, 1, constant_values=BEYOND), 0.0, low - step, step)


def triangles(quads: NDArray[np.int64]) -> Faces:
    """Return two triangles for each quadrilateral."""
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.uint32)


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
