"""The smallest margin of every constraint, in plain numpy; design_oracle says what is shared with whom."""

import itertools
import math
from typing import NamedTuple

import numpy as np
import numpy_model as model

LEGS = {
    "leg_length": slice(0, 9),
    "external_length": slice(0, 3),
    "upper_length": slice(3, 6),
    "lower_length": slice(6, 9),
}


class Case(NamedTuple):
    """What margins look at. Joints (..., 3, 3); robots with one axis of places before the joints."""

    joints: tuple  # r, r^, u, u~ in their own frames
    zp: np.ndarray
    zs: np.ndarray
    neutral: model.Robot  # one place
    posed: model.Robot  # the poses looked at
    meets: tuple  # (3, 3) of booleans, base and platform: external joint i is internal joint j in every design


def segment_distance(a, b, c, d):
    """Least distance of the segments ab and cd: the best of the one interior stationary point and the four edges.

    |a + x (b-a) - c - y (d-c)|^2 is convex in (x, y), so over the unit square its minimum is one of those five.
    """
    f, g, w = b - a, d - c, a - c
    ff, gg, fg = (f * f).sum(-1), (g * g).sum(-1), (f * g).sum(-1)
    fw, gw = (f * w).sum(-1), (g * w).sum(-1)

    def gap(x, y):
        return np.linalg.norm(w + x[..., None] * f - y[..., None] * g, axis=-1)

    zero, one = np.zeros_like(fg), np.ones_like(fg)
    ends = [gap(x, np.clip((gw + x * fg) / gg, 0.0, 1.0)) for x in (zero, one)]
    ends += [gap(np.clip((y * fg - fw) / ff, 0.0, 1.0), y) for y in (zero, one)]
    with np.errstate(divide="ignore", invalid="ignore"):  # parallel: an edge is as good
        x, y = (fg * gw - gg * fw) / (ff * gg - fg * fg), (ff * gw - fg * fw) / (ff * gg - fg * fg)
    inside = (x > 0.0) & (x < 1.0) & (y > 0.0) & (y < 1.0)
    middle = np.where(inside, gap(np.where(inside, x, 0.0), np.where(inside, y, 0.0)), np.inf)
    return np.min([*ends, middle], axis=0)


def angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(-1))


def determinants(m):
    """det B, det C, det M of unit rows, (..., places, 3)."""
    x, y, z, u, _ = model.legs(m)
    w = m.p[..., None, :] + u - m.s[..., None, :]
    rows = (z, y, np.cross(w, x))
    return np.stack([np.linalg.det(a / np.linalg.norm(a, axis=-1, keepdims=True)) for a in rows], axis=-1)


def leg_gaps(case):
    """Distances of all pairs of legs that share neither a joint nor O, (..., places, pairs)."""
    m = case.posed
    _, y, z, u, _ = model.legs(m)
    s = m.s[..., None, :]
    platform, upper, lower = m.p[..., None, :] + u, s - y, s - z
    base = np.broadcast_to(m.r, platform.shape)
    gaps = [
        segment_distance(base[..., i, :], platform[..., i, :], base[..., j, :], platform[..., j, :])
        for i, j in ((0, 1), (0, 2), (1, 2))
    ]
    for i, j in itertools.product(range(3), range(3)):
        for foot, meets in zip((lower, upper), case.meets, strict=True):
            if not meets[i, j]:
                gaps.append(segment_distance(base[..., i, :], platform[..., i, :], foot[..., j, :], s[..., 0, :]))
    return np.stack(gaps, axis=-1)


def cone_angles(name, axis, case):
    """Angle of each leg that ends on a body with its axis there, in the body's frame; legs point away from the body."""

    def directions(m):
        x, y, z, _, _ = model.legs(m)
        if name == "base_cone":
            return np.concatenate([x, z], axis=-2)
        return np.concatenate([-x, y], axis=-2) @ m.Q  # rows: Q^T d

    home = directions(case.neutral) if axis is None else np.array(axis, dtype=float)
    return angle(directions(case.posed), home)


def singularity_margin(case, ways, low):
    home = determinants(case.neutral)
    found = np.concatenate([home, *([determinants(ways)] if ways else [])], axis=-2)
    return (found * np.sign(home)).min(axis=(-2, -1)) - low


def from_axis(joints):
    """Largest distance of a joint from the z axis of its frame."""
    return np.linalg.norm(joints[..., :2], axis=-1).max(axis=-1)


def margin(name, options, case):
    """Smallest margin of one constraint, (...)."""
    limits = [
        math.radians(options[f"{side}_deg"]) if f"{side}_deg" in options else options.get(side)
        for side in ("min", "max")
    ]
    low, high = limits
    base, platform = (np.concatenate(pair, axis=-2) for pair in (case.joints[:2], case.joints[2:]))  # (..., 6, 3)
    reach = from_axis(base), from_axis(platform)
    legs = model.lengths(case.posed)  # (..., places, 9)

    def in_unit(a, radius=None):
        """Lengths as fractions of what they are asked in."""
        kind = options.get("of", "length")
        if kind == "length":
            return a
        size = case.zp if kind == "zp" else np.maximum(*reach) if radius is None else radius
        return a / size.reshape(size.shape + (1,) * (a.ndim - size.ndim))

    def smallest(a):
        return a.reshape(*case.zp.shape, -1).min(axis=-1)

    def logs(a):
        """Both sides of a ratio or of lengths."""
        sides = [np.log(a / low)] if low is not None else []
        sides += [np.log(high / a)] if high is not None else []
        return smallest(np.stack(sides, axis=-1))

    longest, shortest = legs.max(axis=-2), legs.min(axis=-2)  # of each leg over the poses
    if name == "radius_ratio":
        return logs(reach[0] / reach[1])
    if name == "leg_ratio":
        return logs(longest.max(axis=-1) / shortest.min(axis=-1))
    if name == "stroke_ratio":
        return logs(longest / shortest)
    if name == "zs_fraction":
        return logs(case.zs / case.zp)
    if name == "height":
        return logs(case.zp)
    if name == "footprint":
        return logs(reach[0])
    if name in LEGS:
        return logs(in_unit(legs[..., LEGS[name]]))
    if name == "stroke":
        return smallest(1.0 - in_unit(longest - shortest) / high)
    if name == "joint_height":
        return smallest(1.0 - in_unit(np.abs(np.concatenate([base[..., 2], platform[..., 2]], axis=-1))) / high)
    if name == "joint_spacing":
        pairs = itertools.combinations(range(6), 2)
        gaps = [
            in_unit(np.linalg.norm(body[..., i, :] - body[..., j, :], axis=-1), radius)
            for i, j in pairs
            for body, radius in zip((base, platform), reach, strict=True)
        ]
        return smallest(np.stack(gaps, axis=-1) / low - 1.0)
    if name == "leg_clearance":
        return smallest(in_unit(leg_gaps(case)) / (2.0 * options["radius"] if "radius" in options else low) - 1.0)
    assert name in ("base_cone", "platform_cone"), name
    return smallest(1.0 - cone_angles(name, options.get("axis"), case) / high)
