"""The rule for O of a study that places it anew at every pose of its region, checked by proofs of its limits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from ninedof import _core
from ninedof.design.region import Region
from ninedof.design.region_placed import Placing
from ninedof.design.region_stack import configurations_at
from ninedof.design.study import Study
from ninedof.proof.machine_limits import met_at, proved_limits
from ninedof.proof.machine_record import PROVED, LimitProof, Met
from ninedof.proof.point_rule import PointRule
from ninedof.proof.rule_fit import Checked, fit_rule
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.support.progress import Progress, phase

SECONDS = 4.0  # of a check: where bounds are met counts, not what is proved
WIDE = 20.0  # a gap that is proved at once
PARTS = 4001  # of a path


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
    study = place.study
    region = study.objective.region
    assert region is not None
    of_condition = study.objective.index == "condition_number"

    def check(rule: PointRule) -> Checked:
        limits, condition, met = _worst_by_rule(study, geometry, configurations, characteristic_length, rule, threads)
        passed = -math.inf
        for limit in limits:
            if limit.at and limit.answer != PROVED:
                worst = limit.value[limit.side == "min"]
                # A determinant has no limit to be a part of.
                part = worst / limit.limit - 1.0 if limit.limit else worst
                passed = max(passed, part if limit.side == "max" else -part)
        index = math.log(condition / place.objective) if of_condition else -math.inf
        return Checked(index, passed, _coordinates(region, place.neutral, met))

    return fit_rule(place, geometry, check, threads, partial(phase, progress))


def _worst_by_rule(
    study: Study,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    rule: PointRule,
    threads: int,
) -> tuple[list[LimitProof], float, list[Met]]:
    """Return the limits as far as they are proved in a short time, the worst condition number met, and where.

    The poses: where a number that a limit is about, or the condition number, is largest or least.
    """
    region = study.objective.region
    assert region is not None
    shape = region.for_core() | {"rule": rule.for_core()}
    how = {"threads": threads, "seconds": SECONDS, "gap": WIDE, "condition": 0.0}
    found = proved_limits(study, geometry, configurations, shape, 0.0, how)
    arrays = (configurations.position, configurations.rotation, configurations.internal_point)
    worst, _, at, *_, interrupted = _core.worst_condition(
        geometry, *arrays, characteristic_length, shape, how, [], None
    )
    if interrupted:  # what a proof would keep is of no use to a fit
        raise KeyboardInterrupt
    met = [*found.met, met_at(at, False)]
    return list(found.limits), worst, [one for one in met if one.listed is None]


def _coordinates(region: Region, neutral: Configuration, met: Sequence[Met]) -> Floats:
    """Return the coordinates of poses in a region, shape (n, 6)."""
    size = float(neutral.position[2]) if region.unit == "zp" else 1.0
    rows = np.array([(*one.shift, *one.tilt[:2], one.yaw) for one in met]).reshape(-1, 6)
    if region.path is None:
        rows[:, :3] /= size
        return rows
    along = np.zeros((PARTS, 6))
    along[:, 0] = np.linspace(-1.0, 1.0, PARTS)
    places = configurations_at(region, neutral, along)[1].position - neutral.position
    for row in rows:
        row[:3] = along[np.linalg.norm(places - row[:3], axis=1).argmin(), :3]
    return rows
