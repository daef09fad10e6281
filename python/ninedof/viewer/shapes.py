"""Meshes of the scene, rods, balls and plates, and the quaternions that turn them; numpy alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ninedof.robot.plates import outlines
from ninedof.support.arrays import Floats

Faces = NDArray[np.uint32]
Mesh = tuple[Floats, Faces]
"""Vertices, shape (v, 3), and triangles, shape (f, 3)."""


def rod(sides: int = 14) -> Mesh:
    """Return a closed cylinder of radius 1 about z, from z = 0 to z = 1."""
    # Rims twice, so that the shading of the caps does not bend into that of the side.
    return _revolved(np.array([[0, 1], [1, 1], [1, 1], [1, 0], [1, 0], [0, 0]]), sides)


def ball(rings: int = 8) -> Mesh:
    """Return a sphere of radius 1."""
    fall = np.linspace(0.0, np.pi, rings + 1)
    return _revolved(np.column_stack([np.sin(fall), np.cos(fall)]), 2 * rings)


def _revolved(profile: NDArray[np.generic], sides: int) -> Mesh:
    """Return the surface of a profile (radius, height), from top to bottom, turned about z."""
    turn = np.linspace(0.0, 2.0 * np.pi, sides + 1)
    ring = np.column_stack([np.cos(turn), np.sin(turn), np.ones(sides + 1)])
    vertices = (profile[:, None, [0, 0, 1]] * ring).reshape(-1, 3)
    corner = (np.arange(len(profile) - 1)[:, None] * (sides + 1) + np.arange(sides)).ravel()
    below = corner + sides + 1
    faces = np.concatenate(
        [np.column_stack([corner, below, below + 1]), np.column_stack([corner, below + 1, corner + 1])]
    )
    return vertices, faces.astype(np.uint32)


def plate(joints: Floats, thickness: float) -> tuple[Floats, Faces, Floats]:
    """Return the hull of six joints, a slab if they lie in a plane, else a solid; and its edges, shape (n, 2, 3).

    The joints lie on the upper face of a slab of positive thickness, on the lower face of one of negative thickness.
    """
    sides = outlines(joints)
    if len(sides) == 1:
        (top,) = sides
        normal = np.cross(top[1] - top[0], top[2] - top[1])
        bottom = top - (1.0 if normal[2] >= 0.0 else -1.0) * thickness / np.linalg.norm(normal) * normal
        rims = [top, bottom]
        sides = [
            top,
            bottom[::-1],
            *(np.array([bottom[i - 1], bottom[i], top[i], top[i - 1]]) for i in range(len(top))),
        ]
    else:
        rims = sides
    starts = np.cumsum([0, *(len(side) for side in sides)])
    faces = [(a, a + k, a + k + 1) for a, side in zip(starts, sides, strict=False) for k in range(1, len(side) - 1)]
    edges = np.concatenate([np.stack([rim, np.roll(rim, -1, axis=0)], axis=1) for rim in rims])
    return np.concatenate(sides), np.array(faces, dtype=np.uint32), edges


def along(directions: Floats) -> Floats:
    """Return the quaternions (w, x, y, z) that turn z into unit vectors, shapes (n, 3) to (n, 4)."""
    x, y, z = directions.T
    opposite = z < -1.0 + 1e-12
    turns = np.column_stack([np.where(opposite, 0.0, 1.0 + z), np.where(opposite, 1.0, -y), x, np.zeros(len(z))])
    return np.asarray(turns / np.linalg.norm(turns, axis=1, keepdims=True))
