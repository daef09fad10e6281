"""A region study with O at given places: the index and the limits as rows, the worse the larger."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.leg_limits import SPREADS
from ninedof.design.limits import each, for_core
from ninedof.design.region import Region
from ninedof.design.region_placed import Placing
from ninedof.design.region_stack import configurations_at, samples
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats

MARGIN = 5e-4  # what a rule is to leave of every limit at the sampled poses, since others lie between them
WEIGHT = 10.0  # of limits against the index, which may be a little worse
SAMPLES = 400  # half of each of two kinds


@dataclass(frozen=True)
class Spread:
    """A limit that compares poses: how far something of each leg may be from a middle."""

    logarithm: bool
    half: float
    size: float
    common: bool
    """Whether all legs have the same middle."""


class Rows:
    """The index and the limits as rows, the worse the larger, with O at given shifts."""

    def __init__(self, place: Placing, geometry: Geometry, threads: int) -> None:
        study = place.study
        region = study.objective.region
        assert region is not None
        self.place, self.region, self.geometry, self.threads = place, region, geometry, threads
        self.neutral, self.zp = place.neutral, float(place.neutral.position[2])
        self._problem = replace(study, objective=replace(study.objective, poses=(), region=None)).problem()
        self._x = [place.variables[name] for name in self._problem.names]
        self.goal = math.log(place.objective)
        self.margin = MARGIN
        self.spreads = [
            _spread(name, limit, self.zp)
            for name, limit in ((name, for_core(name, limit)) for name, limit in each(study.constraints))
            if name in SPREADS and limit["at"] != "neutral" and math.isfinite(limit["high"])
        ]

    def best(self, at: Floats) -> tuple[Floats, Floats]:
        """Return the nearest poses of the region and the shifts of O in zp that are best there."""
        near = configurations_at(self.region, self.neutral, at)[0]
        there = self.place(near)[0]
        return near, (there.internal_point - self.neutral.internal_point) / self.zp

    def coordinates(self, near: Floats) -> Floats:
        """Return the coordinates of a rule: the shift of p as lengths, tilt, yaw."""
        position = configurations_at(self.region, self.neutral, near)[1].position
        return np.concatenate([position - self.neutral.position, near[:, 3:]], axis=1)

    def single(self, near: Floats, shift: Floats) -> tuple[Floats, Floats]:
        """Return rows of one pose each, shape (n, r), and their derivatives by the shift of O, shape (n, r, 3)."""
        value, slope, index = _core.placed_rows(
            self._problem, self.region.for_core(), self._x, near, np.ascontiguousarray(shift), self.threads
        )
        value[:, :index] -= self.goal
        # Limits that O has no part in are what they are.
        value[:, index:][~slope[:, index:].any(axis=2)] = -np.inf
        value[:, index:] = WEIGHT * (value[:, index:] + self.margin)
        slope[:, index:] *= WEIGHT
        return value, slope

    def lengths(self, near: Floats, shift: Floats) -> tuple[Floats, Floats]:
        """Return the lengths of all legs, shape (n, 9), and their derivatives by the shift of O."""
        c = configurations_at(self.region, self.neutral, near)[1]
        g, s = self.geometry, self.neutral.internal_point + self.zp * shift

        def platform(joints: Floats) -> Floats:
            return np.asarray(c.position[:, None] + np.einsum("nij,kj->nki", c.rotation, joints))

        external = platform(g.platform_external) - g.base_external
        upper = s[:, None] - platform(g.platform_internal)
        lower = s[:, None] - g.base_internal
        v = np.concatenate([external, upper, lower], axis=1)
        length = np.linalg.norm(v, axis=2)
        slope = self.zp * v / length[..., None]
        slope[:, :3] = 0.0
        return length, slope


def _spread(name: str, limit: dict[str, Any], zp: float) -> Spread:
    high = float(limit["high"])
    if name == "stroke":
        return Spread(False, 0.5, high * (zp if limit["of"] == "zp" else 1.0), False)
    return Spread(True, 0.5 * math.log(high), 1.0, name == "leg_ratio")


def of_spread(spread: Spread, length: Floats) -> Floats:
    """Return what a limit that compares poses is about, of each leg."""
    return np.log(length) if spread.logarithm else length / spread.size


def middles_of(spread: Spread, length: Floats) -> Floats:
    """Return the middles of the ranges that lengths take."""
    value = of_spread(spread, length)
    low, high = value.min(axis=0), value.max(axis=0)
    if spread.common:
        return np.full(9, 0.5 * (low.min() + high.max()))
    return np.asarray(0.5 * (low + high))


def first_samples(region: Region) -> Floats:
    """Return coordinates: the middle, sides and corners of the region with tilts all around, and points between."""
    moved = [np.linspace(-1.0, 1.0, 41).tolist()] if region.path is not None else [[-1.0, 0.0, 1.0]] * 3
    reach = np.asarray(region.reach)
    turns = np.linspace(0.0, 2.0 * np.pi, 9)[:-1]
    tilts = [(0.0, 0.0), *np.column_stack([np.cos(turns), np.sin(turns)]).tolist()] if region.tilt else [(0.0, 0.0)]
    rows = []
    for shift in itertools.product(*(m if r else [0.0] for m, r in zip(moved, reach, strict=False))):
        for tilt in tilts:
            for yaw in (-1.0, 0.0, 1.0) if region.yaw else (0.0,):
                rows.append([*shift, *(0.0,) * (3 - len(shift)), *tilt, yaw])
    return np.concatenate([reach * np.array(rows), samples(region, SAMPLES)])
