"""Workspaces once more: each criterion typed from its definition in plain numpy, for many poses at once.

Shares with the package only the paper, the struct of joints, and nothing of its formulas; the robot is numpy_model's.
"""

import numpy as np
import numpy_model as model
from singular_robots import unit_rows

import ninedof as nd


def some_robot(rng):
    """A robot near threefold symmetry with joints off their planes."""

    def triple(radius):
        at = rng.uniform(0.0, 2.0 * np.pi) + 2.0 * np.pi / 3.0 * np.arange(3) + 0.2 * rng.normal(size=3)
        return np.stack([radius * np.cos(at), radius * np.sin(at), 0.1 * radius * rng.normal(size=3)], axis=-1)

    return nd.Geometry(triple(4.0), triple(3.0), triple(3.0), triple(2.0))


def robots(g, p, q, s):
    """The robot at n poses."""
    n = len(p)
    fixed = (
        np.broadcast_to(t, (n, 3, 3))
        for t in (g.base_external, g.base_internal, g.platform_external, g.platform_internal)
    )
    return model.Robot(*fixed, p, np.broadcast_to(q, (n, 3, 3)), np.broadcast_to(s, (n, 3)))


def half_way(g, p, q):
    """O in the middle between the centroids of the internal joints."""
    upper = p + np.broadcast_to(q, (len(p), 3, 3)) @ g.platform_internal.mean(axis=0)
    return 0.5 * (g.base_internal.mean(axis=0) + upper)


def legs_allowed(m, low, high):
    length = model.lengths(m)
    return ((length >= low) & (length <= high)).all(axis=-1)


def angles(m, platform, axis=None, home=None):
    """Of the six legs at a body with an axis of that body, or with their own directions at home, shape (n, 6)."""

    def directions(r):
        external, upper, lower, _, _ = model.legs(r)
        d = np.concatenate([-external, upper] if platform else [external, lower], axis=-2)
        return d @ r.Q if platform else d

    d = directions(m)
    a = np.broadcast_to(axis, d.shape) if axis is not None else directions(home)
    cosine = np.sum(d * a, axis=-1) / np.linalg.norm(d, axis=-1) / np.linalg.norm(a, axis=-1)
    return np.arccos(np.clip(cosine, -1.0, 1.0))


def clearance(m, samples=80):
    """Least distance of legs that share no joint: points along one leg against the other leg, shape (n,)."""
    head, upper_joint = m.p[:, None] + m.u @ np.swapaxes(m.Q, -1, -2), m.p[:, None] + m.ut @ np.swapaxes(m.Q, -1, -2)
    o = np.broadcast_to(m.s[:, None], head.shape)
    start, end = np.concatenate([m.r, upper_joint, m.rh], axis=1), np.concatenate([head, o, o], axis=1)
    least = np.full(len(m.p), np.inf)
    t = np.linspace(0.0, 1.0, samples)[:, None]
    for i in range(3):
        for j in range(9):
            if j == i or (j < 3 and j < i):
                continue
            if j != i and any(np.allclose(a[0, i], b[0, j], atol=1e-9) for a, b in ((start, start), (end, end))):
                continue
            if 3 <= j < 6 and np.allclose(end[0, i], start[0, j], atol=1e-9):
                continue
            points = start[:, None, i] + t * (end[:, None, i] - start[:, None, i])
            a, d = start[:, None, j], end[:, None, j] - start[:, None, j]
            along = np.clip(np.sum((points - a) * d, axis=-1) / np.sum(d * d, axis=-1), 0.0, 1.0)
            least = np.minimum(least, np.linalg.norm(points - a - along[..., None] * d, axis=-1).min(axis=-1))
    return least


def signs(m):
    """Signs of det N, det B and det C."""
    return np.sign(np.stack([np.linalg.det(rows) for rows in unit_rows(m)], axis=-1))


def states_at(cells, origin, points):
    """State of the cell that holds each point, -1 where none does. Cells of one size lie on a grid from `origin`."""
    state = np.full(len(points), -1)
    for one in np.unique(cells.size, axis=0):
        of_size = (cells.size == one).all(axis=1)
        first = np.rint((cells.centre[of_size] - origin) / one - 0.5).astype(np.int64)
        at = np.floor((points - origin) / one).astype(np.int64)
        shape = np.maximum(first.max(axis=0), at.max(axis=0)) + 1
        keys, wanted = (np.ravel_multi_index(k.T, shape) for k in (first, at))
        order = np.argsort(keys)
        place = order[np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1)]
        hit = keys[place] == wanted
        state[hit] = cells.state[of_size][place[hit]]
    return state


def volume_of_balls(inside, outside, low, high, steps):
    """Volume of the points of a box inside every ball (centre, radius) and outside every other, exact along x."""
    y, z = (low[k] + (np.arange(steps) + 0.5) / steps * (high[k] - low[k]) for k in (1, 2))
    y, z = np.meshgrid(y, z, indexing="ij")

    def chord(centre, radius):
        half = np.sqrt(np.maximum(radius**2 - (y - centre[1]) ** 2 - (z - centre[2]) ** 2, 0.0))
        return centre[0] - half, centre[0] + half

    start, end = np.full(y.shape, low[0]), np.full(y.shape, high[0])
    for ball in inside:
        a, b = chord(*ball)
        start, end = np.maximum(start, a), np.minimum(end, b)
    end = np.maximum(start, end)
    holes = np.sort(
        np.stack([np.clip(chord(*ball), start, end) for ball in outside], axis=-1).reshape(2, *y.shape, -1), axis=0
    )
    order = np.argsort(holes[0], axis=-1)
    a, b = (np.take_along_axis(h, order, axis=-1) for h in holes)
    length, reached = end - start, start
    for k in range(len(outside)):
        length = length - np.maximum(b[..., k] - np.maximum(a[..., k], reached), 0.0)
        reached = np.maximum(reached, b[..., k])
    return length.sum() * (high[1] - low[1]) * (high[2] - low[2]) / steps**2
