"""Meshes of the scene: rods, balls, plates; numpy alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ninedof.robot.plates import outlines
from ninedof.support.arrays import Floats

Faces = NDArray[np.uint32]
Mesh = tuple[Floats, Faces]
"""Vertices, shape (v, 3), and triangles, shape (f, 3)."""

SIDES = 14  # of a rod


def rod() -> Mesh:
    """Return a closed cylinder of radius 1 about z, from z = 0 to z = 1."""
    turn = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(SIDES)])
    up = np.array([0.0, 0.0, 1.0])
    # Rims twice, so that the shading of the caps does not bend into that of the side.
    vertices = np.concatenate([ring, ring + up, ring, ring + up, [0.0 * up], [up]])
    k = np.arange(SIDES)
    j = (k + 1) % SIDES
    n = SIDES
    low, high = np.full(n, 4 * n), np.full(n, 4 * n + 1)
    faces = np.concatenate(
        [
            np.column_stack([k, j, n + j]),
            np.column_stack([k, n + j, n + k]),
            np.column_stack([low, 2 * n + j, 2 * n + k]),
            np.column_stack([high, 3 * n + k, 3 * n + j]),
        ]
    )
    return vertices, faces.astype(np.uint32)


def ball(rings: int = 8) -> Mesh:
    """Return a sphere of radius 1."""
    fall, turn = np.linspace(0.0, np.pi, rings + 1), np.linspace(0.0, 2.0 * np.pi, 2 * rings + 1)
    a, b = np.meshgrid(fall, turn, indexing="ij")
    vertices = np.stack([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)], axis=-1).reshape(-1, 3)
    wide = 2 * rings + 1
    i, j = (x.ravel() for x in np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij"))
    corner = i * wide + j
    lower, upper = [corner, corner + wide, corner + wide + 1], [corner, corner + wide + 1, corner + 1]
    return vertices, np.concatenate([np.column_stack(lower), np.column_stack(upper)]).astype(np.uint32)


def plate(joints: Floats, thickness: float) -> Mesh:
    """Return the hull of six joints: a slab if they lie in a plane, else a solid.

    The joints lie on the upper face of a slab of positive thickness, on the lower face of one of negative thickness.
    """
    sides = outlines(joints)
    if len(sides) != 1:
        return _fans(sides)
    top, bottom = _slab(sides[0], thickness)
    walls = [np.array([bottom[i - 1], bottom[i], top[i], top[i - 1]]) for i in range(len(top))]
    return _fans([top, bottom[::-1], *walls])


def edges(joints: Floats, thickness: float) -> Floats:
    """Return the edges of a plate as segments, shape (n, 2, 3)."""
    sides = outlines(joints)
    if len(sides) == 1:
        sides = list(_slab(sides[0], thickness))
    return np.concatenate([np.stack([side, np.roll(side, -1, axis=0)], axis=1) for side in sides])


def _slab(face: Floats, thickness: float) -> tuple[Floats, Floats]:
    """Return the face of the joints, and the one that is so far below it."""
    normal = np.cross(face[1] - face[0], face[2] - face[1])
    normal *= (1.0 if normal[2] >= 0.0 else -1.0) * thickness / np.linalg.norm(normal)
    return face, face - normal


def _fans(sides: list[Floats]) -> Mesh:
    vertices = np.concatenate(sides)
    faces, start = [], 0
    for side in sides:
        faces += [(start, start + k, start + k + 1) for k in range(1, len(side) - 1)]
        start += len(side)
    return vertices, np.array(faces, dtype=np.uint32)


def along(directions: Floats) -> Floats:
    """Return the quaternions (w, x, y, z) that turn z into unit vectors, shapes (n, 3) to (n, 4)."""
    x, y, z = directions.T
    w = 1.0 + z
    opposite = w < 1e-12
    found = np.column_stack([np.where(opposite, 0.0, w), np.where(opposite, 1.0, -y), x, np.zeros(len(z))])
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))
