"""The limits of a study over all poses of a machine, as the core encloses and answers them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ninedof import _core
from ninedof.design.study import Study
from ninedof.proof.machine_record import LimitProof, Met
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.margins import margin_of


class ProvedLimits(NamedTuple):
    """What `proved_limits` returns."""

    limits: tuple[LimitProof, ...]
    """First that no pose is singular, then the limits of the study."""
    lengths: tuple[tuple[float, float], ...]
    """Every leg (l, q, r) stays between these lengths."""
    met: list[Met]
    """Poses of the region where a number that a limit is about is largest or least."""


def proved_limits(
    study: Study,
    geometry: Geometry,
    configurations: Configuration,
    shape: Mapping[str, Any] | None,
    tolerance: float,
    how: Mapping[str, Any],
) -> ProvedLimits:
    """Enclose what every limit is about, over a region and the poses of a study; without either at the neutral pose.

    Parameters
    ----------
    study : Study
    geometry : Geometry
    configurations : Configuration, shape (n,)
        The neutral one, then the listed ones.
    shape : mapping, optional
        The region, with the rule that O follows in it, if it follows one.
    tolerance : float
        Relative: a limit that is passed by no more counts as kept.
    how : mapping
        Threads, seconds, gap and condition.

    """
    only_neutral = shape is None and len(configurations) == 1
    posed = configurations[[0, 0]] if only_neutral else configurations
    arrays = (posed.position, posed.rotation, posed.internal_point)
    limits, lengths, met = _core.limits_over_poses(geometry, *arrays, shape, study.problem(), tolerance, how)
    proofs = []
    for name, kind, side, bound, value, answer, which, at, at_neutral, boxes in limits:
        margin = float(margin_of(kind, side, bound, value[side == "max"]))
        poses = tuple(met_at(one, only_neutral or at_neutral) for one in at)
        proofs.append(LimitProof(name, kind, side, bound, answer, value, margin, which, poses, boxes))
    return ProvedLimits(
        tuple(proofs),
        tuple(lengths),
        [met_at(at, False) for at in met],
    )


def met_at(at: Any, neutral: bool) -> Met:
    """Return the pose of an extreme value; listed ones are counted from 1, and the neutral one alone is 0."""
    shift, tilt, yaw, listed = at
    return Met(shift, tilt, yaw, None if listed < 0 else 0 if neutral else listed + 1)
