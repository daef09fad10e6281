"""The numbers of a sheet, at poses and over a region: the core computes them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.limit_numbers import PARTS, exempt_pairs
from ninedof.design.limits import ROWS
from ninedof.design.pose import Pose
from ninedof.design.region_placed import Placing
from ninedof.design.region_stack import configurations_at, poses_at
from ninedof.design.study import Study
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.leg_motion import Motion
from ninedof.sheet.weight import Weight
from ninedof.support.arrays import Floats, one_or_each

SAMPLES = 10_000
PLACED = 2000  # the most where O is placed anew at every pose, which takes a thousand times as long


class RegionLook(NamedTuple):
    """How a region was looked over."""

    region: str
    """In words."""
    looked_at: int
    """Poses: of the sample and of the descents from the worst of it."""
    mean: float
    """Condition number, mean over the even sample: in positions, in the tilt vector and in the yaw."""
    mean_error: float
    """Standard error of it, from eight parts of the sample."""


class Asked(NamedTuple):
    """What a sheet is asked for besides lengths, cones, clearance, condition number and determinants."""

    motion: Motion
    loads: Floats
    weight: Weight | None = None
    errors: tuple[ArrayLike, ArrayLike] | None = None
    """Of the legs and of the joints."""
    leg_stiffness: ArrayLike | None = None
    characteristic_length: float = 1.0
    """NaN or infinite where it has no value."""

    def question(self, g: Geometry, neutral: Configuration, study: Study | None) -> _core.SheetQuestion:
        """Return the question as the core takes it."""
        motion, errors, length = self.motion, self.errors, self.characteristic_length
        return _core.SheetQuestion(
            geometry=g,
            position=neutral.position[None],
            rotation=neutral.rotation[None],
            internal_point=neutral.internal_point[None],
            limits=_limits(study),
            exempt=exempt_pairs(g, study),
            motion=_core.PlatformMotion(
                internal=motion.internal,
                linear_speed=motion.linear_speed,
                angular_speed=motion.angular_speed,
                given=None if motion.twist is None else (motion.twist, motion.twist_rate),
            ),
            loads=self.loads.tolist(),
            weight=self.weight,
            errors=errors and (one_or_each("leg_errors", errors[0], 9), one_or_each("joint_errors", errors[1], 12)),
            leg_stiffness=None if self.leg_stiffness is None else one_or_each("leg_stiffness", self.leg_stiffness, 9),
            characteristic_length=length if np.isfinite(length) else None,
        )


def _limits(study: Study | None) -> list[tuple[str, Any]]:
    """Return limits at poses and axes of cones: each about the neutral directions, and about the axes of the study."""
    none = (0.0, 0.0, 0.0)
    found: list[tuple[str, Any]] = [(name, none) for name in PARTS if len(ROWS[name].sides) == 1]
    for limit in study.limits if study is not None else ():
        if limit.axis:
            found.append((limit.name, limit.for_core()["axis"]))
    return found


def numbers_at(question: _core.SheetQuestion, c: Configuration) -> dict[str, Floats]:
    """Return the numbers of each group at every pose of a stack, shape (n, k); cones are about neutral directions."""
    found: dict[str, Floats] = {}
    for name, values in _core.sheet_numbers(question, c.position, c.rotation, c.internal_point):
        found.setdefault(name, values)
    return found


def look_over(
    study: Study, neutral: Configuration, question: _core.SheetQuestion, count: int, placing: Placing | None = None
) -> tuple[RegionLook, Configuration, tuple[Pose, ...]]:
    """Return how the region of a study was looked over, and its worst poses as configurations and as poses.

    Where O is placed anew at every pose, descents follow the lengths of the legs: those of the external legs do not
    depend on O, those of the others take O placed at every step. Of the other numbers it is the worst of the sample.
    """
    region = study.objective.region
    assert region is not None
    given = None if placing is None else placing.for_core()
    samples = 2 * (count if placing is None else min(count, PLACED))
    at, poses, mean, error = _core.sheet_over_region(question, region.for_core(), samples, given)
    look = RegionLook(region.worded(study.unit), poses, mean, error)
    if placing is not None:
        return look, *placing(at)
    return look, configurations_at(region, neutral, at)[1], poses_at(region, at)
