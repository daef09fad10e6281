"""A region study at random poses of its region, by the definitions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ninedof.design.pose import Pose
from ninedof.design.region import Region
from ninedof.design.study import Study
from ninedof.optimize.region_report import posed
from ninedof.support.arrays import Floats
from ninedof.verify.objective import ObjectiveRule
from ninedof.verify.robot import DesignSpace
from ninedof.verify.rules import limits_of, margins

ON_BOUNDARY = 0.4  # share of the poses drawn there, where most designs are worst


def worst_at_random(study: Study, variables: Mapping[str, float], count: int, seed: int) -> tuple[float, float]:
    """Return the largest index and the least margin of a design at random poses of its region."""
    region = study.objective.region
    assert region is not None
    there = posed(study, random_poses(region, count, np.random.default_rng(seed)))
    space = DesignSpace(there, variables)
    robot = space.robot(space.x)
    every = [float(m.min()) for limit in limits_of(there) if (m := margins(limit, robot)).size]
    every += [float(m.min()) for m in ObjectiveRule.of(there).condition_margins(robot).values()]
    return float(ObjectiveRule.of(there).values(robot).max()), min(every, default=np.inf)


def mean_at_random(study: Study, variables: Mapping[str, float], count: int, seed: int) -> tuple[float, float]:
    """Return the harmonic mean of the index at uniformly random poses of the region, and its standard error."""
    region = study.objective.region
    assert region is not None
    there = posed(study, random_poses(region, count, np.random.default_rng(seed), 0.0))
    space = DesignSpace(there, variables)
    inverse = 1.0 / ObjectiveRule.of(there).values(space.robot(space.x))
    mean = 1.0 / float(inverse.mean())
    return mean, mean * mean * float(inverse.std()) / count**0.5


def random_poses(
    region: Region, count: int, rng: np.random.Generator, on_boundary: float = ON_BOUNDARY
) -> tuple[Pose, ...]:
    """Return poses of a region, a share of them on its boundary."""
    tilt = _in_disc(count, rng, on_boundary) * region.tilt
    yaw = region.yaw * _in_interval(count, rng, on_boundary)
    shifts = _positions(region, count, rng, on_boundary)
    out = []
    for p, (a, b), turn in zip(shifts, tilt, yaw, strict=True):
        shift = (float(p[0]), float(p[1]), float(p[2]))
        internal = shift if region.internal_point == "shifted" else (0.0, 0.0, 0.0)
        out.append(Pose(shift, _turned(np.array([a, b, 0.0]), turn), internal, region.unit))
    return tuple(out)


def _positions(region: Region, count: int, rng: np.random.Generator, share: float) -> Floats:
    if region.path is not None:
        corners = np.array(region.path)
        length = np.linalg.norm(np.diff(corners, axis=0), axis=1)
        leg = rng.choice(len(corners) - 1, count, p=length / length.sum())
        way = rng.uniform(size=(count, 1))
        return np.asarray(corners[leg] + way * (corners[leg + 1] - corners[leg]))
    if region.ball is not None:
        ways = rng.normal(size=(count, 3))
        radius = np.where(rng.uniform(size=count) < share, 1.0, rng.uniform(size=count) ** (1.0 / 3.0))
        return np.asarray(region.ball * radius[:, None] * ways / np.linalg.norm(ways, axis=1, keepdims=True))
    if region.cylinder is not None:
        wide, high = region.cylinder
        return np.column_stack([wide * _in_disc(count, rng, share), high * _in_interval(count, rng, share)])
    half = np.array(region.box or (0.0, 0.0, 0.0))
    return np.asarray(half * np.column_stack([_in_interval(count, rng, share) for _ in range(3)]))


def _in_interval(count: int, rng: np.random.Generator, share: float) -> Floats:
    return np.clip(rng.uniform(-1.0, 1.0, count) / (1.0 - share), -1.0, 1.0)


def _in_disc(count: int, rng: np.random.Generator, share: float) -> Floats:
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    radius = np.where(rng.uniform(size=count) < share, 1.0, np.sqrt(rng.uniform(size=count)))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def _turned(tilt: Floats, yaw: Any) -> tuple[float, float, float]:
    """Return the rotation vector of exp(tilt) Rz(yaw), by the product of the quaternions."""
    angle = np.linalg.norm(tilt)
    axis = tilt / angle if angle > 0.0 else np.zeros(3)
    c, s = np.cos(0.5 * yaw), np.sin(0.5 * yaw)
    w, v = np.cos(0.5 * angle), np.sin(0.5 * angle) * axis
    scalar = w * c - v[2] * s
    vector = np.array([v[0] * c + v[1] * s, v[1] * c - v[0] * s, w * s + v[2] * c])
    sine: Any = np.linalg.norm(vector)
    if sine == 0.0:
        return (0.0, 0.0, 0.0)
    x, y, z = 2.0 * np.arctan2(sine, scalar) / sine * vector
    return float(x), float(y), float(z)
