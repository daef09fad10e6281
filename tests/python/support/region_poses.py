"""Poses of a region, drawn from its definition."""

import numpy as np


def disc(rng, count, dimensions, share):
    """Points of a disc or ball, a share of them on its boundary, the others even."""
    v = rng.normal(size=(count, dimensions))
    v /= np.linalg.norm(v, axis=1, keepdims=True)
    return v * np.where(rng.random((count, 1)) < share, 1.0, rng.random((count, 1)) ** (1.0 / dimensions))


def drawn(region, zp, rng, count, share=0.5):
    """Shifts of p as lengths, tilt vectors (n, 3) and yaws (n, 1); a share on the boundary, the others even."""
    edge = np.clip(rng.uniform(-1.0, 1.0, (count, 3)) / (1.0 - share / 1.5), -1.0, 1.0)
    if region.path is not None:
        corners = np.array(region.path)
        length = np.linalg.norm(np.diff(corners, axis=0), axis=1)
        part, t = rng.choice(len(length), count, p=length / length.sum()), rng.random((count, 1))
        shift = corners[part] + t * (corners[part + 1] - corners[part])
    elif region.ball is not None:
        shift = region.ball * disc(rng, count, 3, share)
    elif region.cylinder is not None:
        shift = np.column_stack([region.cylinder[0] * disc(rng, count, 2, share), region.cylinder[1] * edge[:, 2]])
    else:
        shift = np.array(region.box or (0.0, 0.0, 0.0)) * edge
    shift = shift * (zp if region.unit == "zp" else 1.0)
    tilt = np.column_stack([region.tilt * disc(rng, count, 2, share), np.zeros(count)])
    return shift, tilt, region.yaw * edge[:, :1]
