"""Poses of a region as configurations of one design: O by a rule, or placed anew as the solver of the study does."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.domains.poses import Pose
from ninedof.design.domains.region import Region
from ninedof.design.study import Study
from ninedof.motion.rotations import from_vectors
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats

Ranges = Sequence[tuple[float, float]]


@dataclass(frozen=True)
class Placing:
    """O where the worst of the index, of the limits and of the ranges of the legs is least."""

    study: Study
    neutral: Configuration
    variables: Mapping[str, float]
    """Of the design, with O at the poses that ruled."""
    objective: float
    leg_ranges: Ranges
    """The least and greatest length of each leg; empty if no limit compares poses."""

    def __call__(self, at: Floats) -> tuple[Configuration, tuple[Pose, ...]]:
        """Return the configurations and poses at given coordinates, shape (n, 6)."""
        region: Region = self.study.objective.region  # type: ignore[assignment]
        near, shift = _core.place_in_region(self.for_core(), region.for_core(), at, 0)
        there = configurations_at(region, self.neutral, near)
        zp = self.study.zp(self.neutral)
        size = 1.0 if region.unit == "zp" else zp
        rows = _core.region_poses(region.for_core(), near)
        poses = _poses(region, np.column_stack([rows[:, :12], size * shift]))
        return Configuration(there.position, there.rotation, self.neutral.internal_point + zp * shift), poses

    def for_core(self) -> _core.PlacedDesign:
        """Return the design as the core takes it, its problem without poses."""
        ruled = [name.removesuffix(".s_x") for name in self.variables if name.endswith(".s_x")]
        plain = replace(self.study, objective=replace(self.study.objective, poses=(), region=None)).problem()
        return _core.PlacedDesign(
            problem=plain,
            variables=[self.variables[name] for name in plain.names],
            log_index=math.log(self.objective),
            leg_ranges=leg_limits_of(self.leg_ranges),
            known=[[self.variables[f"{pose}.s_{axis}"] for axis in "xyz"] for pose in ruled],  # shifts of O in zp
        )


def leg_limits_of(ranges: Ranges) -> _core.LegLimits | None:
    """Return the ranges of the nine legs as the core takes them; None without any."""
    if not ranges:
        return None
    low, high = np.transpose(ranges)
    return _core.LegLimits(low=low, high=high)


def placing_of(design: Any, neutral: Configuration | None) -> Placing | None:
    """Return how O is placed in the region of a design's study, where that places it anew at every pose."""
    if neutral is None or not o_is_placed(design.study):
        return None
    ranges = () if getattr(design, "region", None) is None else design.region.leg_ranges
    return Placing(design.study, neutral, design.variables, design.objective, ranges)


def o_is_placed(study: Study) -> bool:
    """Return whether O is placed anew at every pose of the region of a study."""
    return study.objective.region is not None and study.objective.region.internal_point == "best"


def posed(study: Study, poses: tuple[Pose, ...]) -> Study:
    """Return a study with further listed poses in the place of its region."""
    objective = study.objective
    return replace(study, objective=replace(objective, poses=(*objective.poses, *poses), region=None))


def configurations_at(region: Region, neutral: Configuration, at: Floats) -> Configuration:
    """Return the poses nearest to given coordinates, shape (n, 6), in a region that says where O is.

    Coordinates are the shift of p (on a path the first from -1 to 1), the tilt about x and y, and the yaw.
    """
    rows = _core.region_poses(region.for_core(), np.ascontiguousarray(at))
    _, shift, turn, internal = np.split(rows, [6, 9, 12], axis=1)
    unit = region.size_at(neutral)
    q = from_vectors(turn) @ neutral.rotation
    return Configuration(neutral.position + unit * shift, q, neutral.internal_point + unit * internal)


def poses_at(region: Region, at: Floats) -> tuple[Pose, ...]:
    """Return the poses nearest to given coordinates, for the poses of an objective."""
    return _poses(region, _core.region_poses(region.for_core(), np.ascontiguousarray(at)))


def _poses(region: Region, rows: Floats) -> tuple[Pose, ...]:
    """Return the poses of rows of the core: coordinates, shift of p, rotation vector, shift of O."""
    return tuple(Pose(row[6:9], row[9:12], row[12:15], region.unit) for row in rows.tolist())
