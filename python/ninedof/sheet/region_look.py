"""The poses that a sheet is over: those of a study, and the worst of its region."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.conditioning.characteristic_length import length_at
from ninedof.design.domains.poses import Pose
from ninedof.design.domains.region_poses import Placing, configurations_at, o_is_placed, placing_of, poses_at
from ninedof.design.limit_numbers import compared
from ninedof.robot.configuration import Configuration, flat
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import shown
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


class Looked(NamedTuple):
    """The poses that were looked at."""

    configurations: Configuration
    """The neutral one, the study's, and the worst of a region: a stack."""
    search: RegionSearch | None = None
    """Of a region."""
    worst: tuple[Pose, ...] = ()
    """Of the region, as poses of an objective."""
    placing: Placing | None = None
    """Of O, where the region does not say where it is."""

    @property
    def leg_ranges(self) -> Any:
        """The lengths that each leg keeps where O is placed in a region; None for others."""
        return None if self.placing is None else self.placing.leg_ranges


def look_over(design: Any, c: Configuration, question: _core.SheetQuestion, count: int) -> Looked:
    """Return the poses `c` of a design, with the worst of the region of its study, if it has one that says where O is.

    Where O is placed anew at every pose, descents follow the lengths of the legs: those of the external legs do not
    depend on O, those of the others take O placed at every step. Of the other numbers it is the worst of the sample.
    """
    study: Any = getattr(design, "study", None)
    region = None if study is None else study.objective.region
    if region is None or (o_is_placed(study) and getattr(design, "region", None) is None and compared(study)):
        return Looked(c)
    place = placing_of(design, c[0])
    samples = 2 * (count if place is None else min(count, PLACED))
    end = _core.sheet_over_region(question, region.for_core(), samples, None if place is None else place.for_core())
    search, at = from_core(RegionSearch, end, region=region.worded(study.unit)), end.worst
    worst, poses = (configurations_at(region, c[0], at), poses_at(region, at)) if place is None else place(at)
    return Looked(_joined(c, worst), search, poses, place)


def even_poses(design: Any, looked: Looked, count: int) -> Configuration:
    """Return even poses of the region of a design's study, fewer where O is placed."""
    region, place = design.study.objective.region, looked.placing
    at = _core.even_poses(region.for_core(), count if place is None else min(count, PLACED))
    return configurations_at(region, looked.configurations[0], at) if place is None else place(at)[0]


def robot_of(
    design: Any, poses: Configuration | None = None, length: float | str | None = None
) -> tuple[Geometry, Configuration, float]:
    """Return geometry, stack of poses with the neutral one first, and characteristic length.

    The length is that of the design by default; a kind is taken at the neutral pose, NaN where it has no value there.
    """
    if poses is not None and (not isinstance(poses, Configuration) or len(poses.shape) != 1 or not len(poses)):
        raise ValueError(f"poses: got {shown(poses)}, expected a stack of configurations of shape (n,)")
    if isinstance(design, Geometry):
        if poses is None:
            raise ValueError("poses: got none, expected configurations for a Geometry, the neutral one first")
        return design, poses, length_at(design, poses[0], 1.0 if length is None else length)
    try:
        g, neutral, own = design.geometry, design.configuration, design.characteristic_length
    except AttributeError:
        raise ValueError(f"design: got {type(design).__name__}, expected a result, a design or a Geometry") from None
    if g is None or neutral is None:
        raise ValueError("design: got a result without a design, expected one")
    if poses is None and hasattr(design, "configurations"):
        poses = design.configurations[1:]
    c = _joined(neutral, *([] if poses is None else [poses]))
    return g, c, length_at(g, neutral, own if length is None else length)


def _joined(*stacks: Configuration) -> Configuration:
    """Return configurations and stacks as one stack."""
    return Configuration(*map(np.concatenate, zip(*map(flat, stacks), strict=True)))
