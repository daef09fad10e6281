"""Distances between the axes of legs that share no joint."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.support.arrays import Floats

SAME = 1e-9  # of the largest coordinate of a body: joints nearer than that are one


def leg_ends(g: Geometry, c: Configuration) -> tuple[Floats, Floats]:
    """Return where the nine legs start and end, shape (..., 9, 3), base frame: base to platform, platform or base to O.

    External legs go from base to platform, upper internal ones from the platform to O, lower ones from the base to O.
    """
    turned, p = np.swapaxes(c.rotation, -1, -2), c.position[..., None, :]
    external, internal = p + g.platform_external @ turned, p + g.platform_internal @ turned
    o = np.broadcast_to(c.internal_point[..., None, :], external.shape)
    low, inner = (np.broadcast_to(triple, external.shape) for triple in (g.base_external, g.base_internal))
    return np.concatenate([low, internal, inner], axis=-2), np.concatenate([external, o, o], axis=-2)


def apart(g: Geometry) -> list[tuple[int, int]]:
    """Return the pairs of legs, 0 to 8, that share neither O nor a joint of base or platform."""
    base, platform = (g.base_external, g.base_internal), (g.platform_external, g.platform_internal)
    place: dict[str, list[Floats]] = {"base": [], "platform": []}
    for k in range(9):
        kind, i = divmod(k, 3)
        place["base"].append(base[kind // 2][i] if kind != 1 else np.full(3, np.nan))
        place["platform"].append(platform[kind][i] if kind != 2 else np.full(3, np.nan))
    size = {"base": np.abs(base).max(), "platform": np.abs(platform).max()}

    def meet(a: int, b: int) -> bool:
        near = (np.linalg.norm(place[body][a] - place[body][b]) <= SAME * size[body] for body in place)
        return a >= 3 or any(near)  # two internal legs meet in O; NaN, where a leg has no joint, compares as apart

    return [(a, b) for a, b in combinations(range(9), 2) if not meet(a, b)]


def least_clearance(g: Geometry, c: Configuration) -> tuple[float, int, tuple[str, str]]:
    """Return the least distance over a stack of poses, its pose and its pair."""
    found = clearances(g, c)
    pose, pair = np.unravel_index(int(np.argmin(found)), found.shape)
    a, b = apart(g)[pair]
    return float(found[pose, pair]), int(pose), (LEGS[a], LEGS[b])


def clearances(g: Geometry, c: Configuration) -> Floats:
    """Return the distance of each pair of `apart` over a stack of poses, shape (n, pairs)."""
    first, second = np.array(apart(g), dtype=np.intp).T  # never none: the joints of a triple span a triangle
    start, end = leg_ends(g, c)
    return between(start[:, first], end[:, first], start[:, second], end[:, second])


def between(a: Floats, b: Floats, c: Floats, d: Floats) -> Floats:
    """Return the distance of the segments ab and cd, shape (...).

    The nearest points are an end of a segment and its foot on the other, or the feet of the common normal.
    """
    ends = np.min([_to_segment(a, c, d), _to_segment(b, c, d), _to_segment(c, a, b), _to_segment(d, a, b)], axis=0)
    u, v, w = b - a, d - c, c - a
    uu, uv, vv = _dot(u, u), _dot(u, v), _dot(v, v)
    area = uu * vv - uv**2
    crossing = area > 1e-14 * uu * vv
    safe = np.where(crossing, area, 1.0)
    s, t = (_dot(u, w) * vv - _dot(v, w) * uv) / safe, (_dot(u, w) * uv - _dot(v, w) * uu) / safe
    inside = crossing & (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)
    along = _size(w + t[..., None] * v - s[..., None] * u)
    return np.asarray(np.where(inside, np.minimum(along, ends), ends))


def _dot(x: Floats, y: Floats) -> Floats:
    return np.asarray(np.einsum("...k,...k->...", x, y))


def _to_segment(point: Floats, a: Floats, b: Floats) -> Floats:
    along = b - a
    square = _dot(along, along)
    share = np.clip(_dot(point - a, along) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    return _size(point - a - share[..., None] * along)


def _size(x: Floats) -> Floats:
    return np.asarray(np.sqrt(_dot(x, x)))
