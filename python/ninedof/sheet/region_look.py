"""A region looked over for a sheet."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.design.pose import Pose
from ninedof.design.region_poses import Placing, configurations_at, places_o, poses_at
from ninedof.design.study import Study
from ninedof.robot.configuration import Configuration
from ninedof.support.structs import from_core

SAMPLES = 10_000
PLACED = 2000  # the most where O is placed anew at every pose, which takes a thousand times as long


class RegionSearch(NamedTuple):
    """The search of a region."""

    region: str
    """In words."""
    looked_at: int
    """Poses: of the sample and of the descents from the worst of it."""
    mean: float
    """Condition number, mean over the even sample: in positions, in the tilt vector and in the yaw."""
    mean_error: float
    """Standard error of it, from eight parts of the sample."""


def look_over(
    study: Study, neutral: Configuration, question: _core.SheetQuestion, count: int, placing: Placing | None = None
) -> tuple[RegionSearch, Configuration, tuple[Pose, ...]]:
    """Return how the region of a study was looked over, and its worst poses as configurations and as poses.

    Where O is placed anew at every pose, descents follow the lengths of the legs: those of the external legs do not
    depend on O, those of the others take O placed at every step. Of the other numbers it is the worst of the sample.
    """
    region = study.objective.region
    assert region is not None
    design = None if placing is None else placing.for_core()
    samples = 2 * (count if placing is None else min(count, PLACED))
    end = _core.sheet_over_region(question, region.for_core(), samples, design)
    search, at = from_core(RegionSearch, end, region=region.worded(study.unit)), end.worst
    if placing is not None:
        return search, *placing(at)
    return search, configurations_at(region, neutral, at)[1], poses_at(region, at)


def leg_ranges_of(design: Any) -> Any:
    """Return the lengths that each leg keeps where O is placed in the region of a design's study; None for others."""
    region, report = _region_of(design), getattr(design, "region", None)
    return None if region is None or places_o(region) or report is None else report.leg_ranges


def has_region(design: Any) -> bool:
    """Return whether a design has a study over a region that says where O is, or placed it."""
    region = _region_of(design)
    return region is not None and (places_o(region) or leg_ranges_of(design) is not None)


def look_over_design(
    design: Any, neutral: Configuration, question: _core.SheetQuestion, count: int
) -> tuple[RegionSearch, Configuration, tuple[Pose, ...]]:
    """Return `look_over` of the region of a design that has one."""
    ranges = leg_ranges_of(design)
    own = getattr(design, "variables", None) or {}
    place = None if ranges is None else Placing(design.study, neutral, own, design.objective, ranges)
    return look_over(design.study, neutral, question, count, place)


def _region_of(design: Any) -> Any:
    return None if getattr(design, "solved", None) is None else design.study.objective.region


def joined(c: Configuration, more: Configuration) -> Configuration:
    """Return two stacks as one."""
    names = ("position", "rotation", "internal_point")
    return Configuration(*(np.concatenate([getattr(c, name), getattr(more, name)]) for name in names))
