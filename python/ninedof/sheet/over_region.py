"""The poses of a region at which the numbers of a sheet are worst, and the mean of the condition number over it."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof.conditioning.conditioning import condition_number
from ninedof.design.limit_numbers import CONES, apart, clearances, limit_numbers
from ninedof.design.limits import each, for_core
from ninedof.design.pose import Pose
from ninedof.design.region import Region
from ninedof.design.region_stack import configurations_at, poses_at, samples
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.leg_motion import Motion, leg_accelerations, leg_speeds, twist_accelerations, twist_rates
from ninedof.sheet.legs import forces_of
from ninedof.sheet.near_singularity import near_singularities
from ninedof.sheet.region_search import Numbers, Poses, extreme_poses, finite_or_high
from ninedof.sheet.softest import softest
from ninedof.sheet.weight import Weight
from ninedof.statics.accuracy import error_bounds
from ninedof.support.arrays import Floats

SAMPLES = 10_000
PLACED = 2000  # the most where O is placed anew at every pose, which takes a thousand times as long
TILTS = 24  # directions of the greatest tilt, at each corner
PLACED_DESCENT = 5, 1e-3  # starts of a number, and the last step in parts of the region, where O is placed at each
PARTS = 8  # of the even sample, for the error of its mean


Place = Callable[[Floats], tuple[Configuration, tuple[Pose, ...]]]
"""From coordinates, shape (n, 6), to the poses with O placed."""


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
    weight: Weight | None
    errors: tuple[ArrayLike, ArrayLike] | None
    """Of the legs and of the joints."""
    leg_stiffness: ArrayLike | None
    characteristic_length: float
    """NaN or infinite where it has no value."""


def look_over(
    study: Study, g: Geometry, neutral: Configuration, asked: Asked, count: int
) -> tuple[RegionLook, Configuration, tuple[Pose, ...]]:
    """Return how the region of a study was looked over, and its worst poses as configurations and as poses."""
    region: Region = study.objective.region  # type: ignore[assignment]
    at = samples(region, count)
    poses = Poses.of(region, neutral)
    worst, descended = extreme_poses(poses, *poses.place(at), _numbers(study, g, neutral, asked))
    worst = np.concatenate([worst, _near_singular(region, g, neutral, asked.motion)])
    even = configurations_at(region, neutral, at[:count])[1]
    look = _look(region, study, g, asked, even, len(at) + descended)
    return look, configurations_at(region, neutral, worst)[1], poses_at(region, worst)


def look_over_placed(
    study: Study, g: Geometry, neutral: Configuration, asked: Asked, place: Place, count: int
) -> tuple[RegionLook, Configuration, tuple[Pose, ...]]:
    """Return the same where O is placed anew at every pose.

    Descents follow the lengths of the legs: those of the external legs do not depend on O, those of the others take O
    placed at every step, so they have fewer starts and end earlier. Of the other numbers it is the worst of the sample.
    """
    region: Region = study.objective.region  # type: ignore[assignment]
    at = samples(region, count)
    c, _ = place(at)
    numbers = _numbers(study, g, neutral, asked)
    rows = sorted({int(k) for group in numbers for k in np.argmin(finite_or_high(group(c)), axis=0)})
    placed = Poses(region, lambda at: (configurations_at(region, neutral, at)[0], place(at)[0]), *PLACED_DESCENT)
    near = configurations_at(region, neutral, at)[0]
    external, descended = extreme_poses(Poses.of(region, neutral), near, c, [_both(lambda c: leg_lengths(g, c)[:, :3])])
    internal, more = extreme_poses(placed, near, c, [_both(lambda c: leg_lengths(g, c)[:, 3:])])
    worst, poses = place(np.concatenate([at[rows], external, internal]))
    return _look(region, study, g, asked, c[:count], len(at) + descended + more), worst, poses


def _near_singular(region: Region, g: Geometry, neutral: Configuration, motion: Motion) -> Floats:
    """Return the poses of the boundary, shape (3, 6), from which a singularity is nearest, one for each way of moving.

    They need not be those of the least determinants.
    """
    reach, turns = np.asarray(region.reach), np.arange(TILTS) * 2.0 * np.pi / TILTS
    signs = np.array(list(product(*((-1.0, 1.0) if length > 0.0 else (0.0,) for length in reach[[0, 1, 2, 5]]))))
    at = np.repeat(reach * np.insert(signs, [3, 3], 0.0, axis=1), TILTS, axis=0)
    at[:, 3:5] = region.tilt * np.tile(np.column_stack([np.cos(turns), np.sin(turns)]), (len(signs), 1))
    near, c = configurations_at(region, neutral, at)
    found = near_singularities(g, c, motion.internal)
    return near[[one.pose for one in found.values()]]


def _look(region: Region, study: Study, g: Geometry, asked: Asked, even: Configuration, looked_at: int) -> RegionLook:
    kappa = np.full(len(even), np.inf)
    if np.isfinite(asked.characteristic_length):
        kappa = np.asarray(condition_number(g, even, asked.characteristic_length))
    means = np.array([part.mean() for part in np.array_split(kappa, PARTS) if len(part)])
    error = float(means.std(ddof=1) / np.sqrt(len(means))) if len(means) > 1 and np.isfinite(means).all() else np.inf
    return RegionLook(region.worded(study.unit), looked_at, float(kappa.mean()), error)


def _numbers(study: Study, g: Geometry, neutral: Configuration, asked: Asked) -> list[Numbers]:
    """Return the numbers of a sheet, each the worse the lower."""
    motion, loads, pairs = asked.motion, asked.loads, apart(g, study)
    found: list[Numbers] = [
        _both(lambda c: leg_lengths(g, c)),
        lambda c: clearances(g, c, pairs),
        lambda c: limit_numbers("singularity_free", g, c, neutral),
        _largest(lambda c: leg_speeds(g, c, motion)),
        _largest(lambda c: leg_accelerations(g, c, motion)),
    ]
    found += [_largest(_cones(g, neutral, name, ())) for name in CONES]
    for name, entry in each(study.constraints):
        if name in CONES and len(axis := for_core(name, entry)["axis"]):
            found.append(_largest(_cones(g, neutral, name, axis)))
    if np.isfinite(length := asked.characteristic_length):
        found.append(_largest(lambda c: np.asarray(condition_number(g, c, length))[:, None]))
    if motion.twist is not None:
        found += [_both(lambda c: twist_rates(g, c, motion)), _both(lambda c: twist_accelerations(g, c, motion))]
    if len(loads):
        found.append(_both(lambda c: np.concatenate(forces_of(g, c, loads, asked.weight), axis=1)))
    if (errors := asked.errors) is not None:
        found.append(_largest(_errors(g, *errors)))
    if (stiffness := asked.leg_stiffness) is not None:
        found.append(lambda c: np.stack(softest(g, c, stiffness), axis=1))
    return found


def _cones(g: Geometry, neutral: Configuration, name: str, axis: Any) -> Numbers:
    return lambda c: limit_numbers(name, g, c, neutral, axis)


def _errors(g: Geometry, legs: ArrayLike, joints: ArrayLike) -> Numbers:
    def largest(c: Configuration) -> Floats:
        found = error_bounds(g, c, legs, joints)
        return np.stack([found.position, found.rotation, found.internal_point], axis=1)

    return largest


def _largest(numbers: Callable[[Configuration], Floats]) -> Numbers:
    return lambda c: -numbers(c)


def _both(numbers: Callable[[Configuration], Floats]) -> Numbers:
    def ends(c: Configuration) -> Floats:
        values = numbers(c)
        return np.concatenate([values, -values], axis=1)

    return ends
