"""The rule for O of a study that places it anew at every pose of its region."""

from __future__ import annotations

from functools import partial

from ninedof import _core
from ninedof.design.region_poses import Placing
from ninedof.proof.point_rule import PointRule
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.progress import Progress, phase


def rule_of(
    place: Placing,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    threads: int = 0,
    progress: Progress | None = None,
) -> PointRule:
    """Fit a rule for O, and mend it where proofs of its limits fail.

    A progress with a method `phase` is told what begins. Ctrl-C raises: half a rule is none.
    """
    region = place.study.objective.region
    assert region is not None
    c, length = configurations, float(characteristic_length)
    machine = _core.PosedRobot(geometry, c, length, region.for_core(), None)
    found = _core.fit_rule(machine, place.for_core(), threads, partial(phase, progress))
    return PointRule.of(place.neutral, found)
