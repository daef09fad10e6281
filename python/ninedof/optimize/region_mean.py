"""The mean of an index over a region: quadrature by evenly spread poses, and its error by fresh ones."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ninedof import _core
from ninedof.design.pose import Pose
from ninedof.design.region import Region
from ninedof.design.region_stack import ROOT
from ninedof.design.study import Study
from ninedof.optimize.region_report import RegionMean, posed
from ninedof.support.arrays import Floats

NODES, MOST_NODES = 64, 256  # poses of the quadrature; doubled while its error is larger than TOLERANCE
TOLERANCE = 2e-3  # relative
REPLICATES, IN_REPLICATE = 8, 1024  # fresh poses, from which the mean and its standard error are estimated


def uniform_poses(region: Region, count: int, seed: int) -> tuple[Pose, ...]:
    """Return poses spread evenly: positions uniform in the volume or along the path, tilts in their disc, yaws."""
    steps = np.array([ROOT ** -(k + 1) for k in range(6)])
    u = (np.random.default_rng(seed).uniform(size=6) + np.outer(np.arange(1, count + 1), steps)) % 1.0
    at = np.column_stack([_positions(region, u[:, :3]), region.tilt * _disc(u[:, 3:5]), _even(u[:, 5]) * region.yaw])
    return tuple(Pose(*_core.region_pose(region.for_core(), tuple(row)), region.unit) for row in at.tolist())


def region_mean(study: Study, nodes: tuple[Pose, ...], variables: Mapping[str, float]) -> RegionMean:
    """Return the mean of a design over the nodes, and over replicates of fresh poses."""
    region = study.objective.region
    assert region is not None
    plain = replace(study, constraints={}, objective=replace(study.objective, aggregate="mean_inverse", poses=()))

    def mean(poses: tuple[Pose, ...]) -> float:
        return float(posed(plain, poses).evaluate(variables).objective)

    fresh = [mean(uniform_poses(region, IN_REPLICATE, 1_000_003 + study.seed + k)) for k in range(REPLICATES)]
    value, standard = float(np.mean(fresh)), float(np.std(fresh, ddof=1)) / math.sqrt(REPLICATES)
    quadrature = mean(nodes)
    return RegionMean(len(nodes), quadrature, value, abs(quadrature - value) + 2.0 * standard, standard)


def _even(u: Floats) -> Floats:
    return np.asarray(2.0 * u - 1.0)


def _disc(u: Floats) -> Floats:
    angle = 2.0 * math.pi * u[:, 0]
    return np.asarray(np.sqrt(u[:, 1])[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))


def _positions(region: Region, u: Floats) -> Floats:
    if region.ball is not None:
        z, angle = _even(u[:, 0]), 2.0 * math.pi * u[:, 1]
        across = np.sqrt(1.0 - z * z)
        way = np.column_stack([across * np.cos(angle), across * np.sin(angle), z])
        return np.asarray(region.ball * np.cbrt(u[:, 2])[:, None] * way)
    if region.cylinder is not None:
        radius, height = region.cylinder
        return np.column_stack([radius * _disc(u[:, :2]), height * _even(u[:, 2])])
    return np.asarray(_even(u) * np.asarray(region.reach[:3]))
