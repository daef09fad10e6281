"""The limits of a study over all poses of a machine, as the core encloses and answers them."""

from __future__ import annotations

from ninedof import _core
from ninedof.design.study import Study
from ninedof.proof.machine_record import LimitProof, Met
from ninedof.support.margins import margin_of
from ninedof.support.structs import from_core


def proved_limits(
    study: Study, machine: _core.PosedRobot, only_neutral: bool, tolerance: float, threads: int, seconds: float
) -> tuple[tuple[LimitProof, ...], tuple[tuple[float, float], ...]]:
    """Enclose what every limit is about, over all poses of a machine; without any at the neutral pose.

    Parameters
    ----------
    study : Study
    machine : PosedRobot
    only_neutral : bool
        Whether its only pose is the neutral one.
    tolerance : float
        Relative: a limit that is passed by no more counts as kept.
    threads : int
    seconds : float
        For each search.

    Returns
    -------
    limits : tuple of LimitProof
        First that no pose is singular, then the limits of the study.
    lengths : tuple of pairs
        Every leg (l, q, r) stays between these lengths.

    """
    found = _core.limits_over_poses(machine, study.problem(), tolerance, threads, seconds)
    proofs = []
    for one in found.limits:
        margin = float(margin_of(one.kind, one.side, one.limit, one.value[one.side == "max"]))
        poses = tuple(met_at(place, only_neutral or one.at_neutral) for place in one.at)
        proofs.append(from_core(LimitProof, one, margin=margin, at=poses))
    return tuple(proofs), found.lengths


def met_at(at: _core.MetAt, neutral: bool) -> Met:
    """Return the pose of an extreme value; listed ones are counted from 1, and the neutral one alone is 0."""
    return Met(at.shift, at.tilt, at.yaw, None if at.pose < 0 else 0 if neutral else at.pose + 1)
