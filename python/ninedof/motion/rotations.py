"""Rotations as quaternions, rotation vectors, Euler angles and matrices; stacks of shape (n, ...)."""

from __future__ import annotations

import numpy as np

from ninedof.support.arrays import Floats


def from_quaternions(quaternions: Floats) -> Floats:
    """Return the matrices of quaternions (w, x, y, z) of any length but zero, shape (n, 4)."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
    return np.ascontiguousarray(np.moveaxis(np.array(rows), 2, 0))


def from_vectors(vectors: Floats) -> Floats:
    """Return the matrices of rotation vectors in radians, shape (n, 3)."""
    half = 0.5 * np.linalg.norm(vectors, axis=1, keepdims=True)
    return from_quaternions(np.concatenate([np.cos(half), 0.5 * np.sinc(half / np.pi) * vectors], axis=1))


def from_euler(yaw: Floats, pitch: Floats, roll: Floats) -> Floats:
    """Return R_z(yaw) R_y(pitch) R_x(roll), angles in radians, shape (n,)."""
    z, y, x = (from_vectors(angle[:, None] * np.eye(3)[k]) for k, angle in ((2, yaw), (1, pitch), (0, roll)))
    return np.asarray(z @ y @ x)


def to_quaternions(rotations: Floats) -> Floats:
    """Return the quaternions (w, x, y, z) of matrices, shape (n, 4); each the nearer one to that before."""
    r, inverse = rotations, np.swapaxes(rotations, 1, 2)
    trace = np.trace(r, axis1=1, axis2=2)
    # Row k is 4 q_k q: the row of the largest component is accurate.
    rows = np.empty((len(r), 4, 4))
    rows[:, 0, 0] = 1.0 + trace
    rows[:, 0, 1:] = rows[:, 1:, 0] = (r - inverse)[:, (2, 0, 1), (1, 2, 0)]
    rows[:, 1:, 1:] = r + inverse + (1.0 - trace)[:, None, None] * np.eye(3)
    largest = np.argmax(np.diagonal(rows, axis1=1, axis2=2), axis=1)
    out: Floats = rows[np.arange(len(r)), largest]
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    opposite = np.cumsum(np.sum(out[1:] * out[:-1], axis=1) < 0.0) % 2 == 1
    out[1:][opposite] *= -1.0
    return out


def vectors_between(first: Floats, second: Floats) -> Floats:
    """Return the rotation vectors w, base frame, with exp(w) Q_first = Q_second, of quaternions (..., 4)."""
    w = np.sum(first * second, axis=-1, keepdims=True)
    a, b = first[..., 1:], second[..., 1:]
    v = first[..., :1] * b - second[..., :1] * a - np.cross(b, a)
    v = np.where(w < 0.0, -v, v)
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(size, np.abs(w))
    return np.asarray(v * np.divide(angle, size, out=np.full_like(size, 2.0), where=size > 1e-150))
