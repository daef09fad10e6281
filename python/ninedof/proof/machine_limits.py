"""The limits of a machine one by one: the poses of a proof, and what it says of each limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ninedof import _core
from ninedof.design.domains.region import Region
from ninedof.design.duty import Tolerances
from ninedof.design.limits import label
from ninedof.design.objective import CONDITION_LIMIT, Objective
from ninedof.design.study import Study
from ninedof.motion.rotations import from_vectors
from ninedof.proof.machine_record import PROVED, UNDECIDED, VIOLATED, LimitProof, ProofPose
from ninedof.proof.point_rule import PointRule
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.pose_words import turn_deg
from ninedof.support.margins import margin_of
from ninedof.support.structs import from_core

NEUTRAL_LIMIT = label(CONDITION_LIMIT, "neutral")
WIDE = 20.0  # an enclosure that is proved at once, where only a bound counts
Settings = Callable[[list[float]], _core.ConditionSettings]
"""Of a search for bounds of the condition number."""


def posed_robot(
    study: Study,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    rule: PointRule | None,
    built: Tolerances,
) -> _core.PosedRobot:
    """Return a design with all poses of a study, as it is drawn or as it is built: for proofs.

    The configurations are the neutral one, then the poses listed in the study.
    """
    region = study.objective.region
    return _core.PosedRobot(
        geometry,
        configurations[[0, 0]] if region is None and len(configurations) == 1 else configurations,
        float(characteristic_length),
        None if region is None else region.for_core(),
        None if rule is None else rule.for_core(),
        _core.Tolerances(legs=np.full(9, built.legs), joints=np.full(12, built.joints)),
    )


def open_limits(
    study: Study,
    design: tuple[Geometry, Configuration, float, PointRule | None],
    built: Tolerances,
    seconds: float,
    threads: int = 0,
    slack: float = 0.0,
    condition_number: float | None = None,
) -> list[LimitProof]:
    """Return the limits that are not proved of every machine within tolerances; `seconds` are of each.

    The design has geometry, configurations and characteristic length, as `certify` takes them, and a rule for O.
    """

    def settings(bounds: list[float]) -> _core.ConditionSettings:
        return _core.ConditionSettings(threads=threads, seconds=seconds, gap=WIDE, wanted=bounds, tolerance=slack)

    robot = posed_robot(study, *design, built)
    over_poses = _core.limits_over_poses(robot, study.problem(), slack, threads, seconds)
    proofs = [limit_proof(limit, False, proof_pose) for limit in over_poses.limits]
    for name, bound in ((CONDITION_LIMIT, study.objective.condition_limit), ("condition_number", condition_number)):
        if bound is not None:
            proofs.append(_searched(name, bound, robot, settings, slack))
    proofs += neutral_limit(study, design[:3], built, settings, slack)
    return [one for one in proofs if one.answer != PROVED]


def neutral_limit(
    study: Study, design: tuple[Geometry, Configuration, float], built: Tolerances, settings: Settings, slack: float
) -> list[LimitProof]:
    """Return what is proved of the limit of the condition number at the neutral pose; nothing without one."""
    if (bound := study.objective.neutral_condition_limit) is None:
        return []
    geometry, configurations, length = design
    alone = posed_robot(replace(study, objective=Objective()), geometry, configurations[[0]], length, None, built)
    return [_searched(NEUTRAL_LIMIT, bound, alone, settings, slack)]


def _searched(name: str, bound: float, machine: _core.PosedRobot, settings: Settings, slack: float) -> LimitProof:
    state = _core.search_condition(machine, settings([bound]), _core.ConditionState(), None, None)
    if state.interrupted:
        raise KeyboardInterrupt
    return condition_proof(name, bound, state, proof_pose(state.at, name == NEUTRAL_LIMIT), slack)


def limit_proof(
    limit: _core.LimitOverPoses, only_neutral: bool, named: Callable[[_core.MetAt, bool], ProofPose]
) -> LimitProof:
    """Return what is proved of one side of a limit over all poses."""
    margin = float(margin_of(limit.kind, limit.side, limit.limit, limit.value[limit.side == "max"]))
    poses = tuple(named(at, only_neutral or limit.at_neutral) for at in limit.at)
    return from_core(LimitProof, limit, margin=margin, at=poses)


def proof_pose(
    at: _core.MetAt,
    neutral: bool,
    home: Configuration | None = None,
    region: Region | None = None,
    rule: PointRule | None = None,
) -> ProofPose:
    """Return the pose of an extreme value; listed ones are counted from 1, and the neutral one alone is 0."""
    if at.pose >= 0 or home is None or region is None:
        return ProofPose(at.shift, at.tilt, at.yaw, None if at.pose < 0 else 0 if neutral else at.pose + 1)
    shift, turn = np.array(at.shift), np.array([at.tilt, (0.0, 0.0, at.yaw)])
    o = home.internal_point + shift * (region.internal_point == "shifted")
    if rule is not None:
        o = rule.at([*at.shift, *at.tilt[:2], at.yaw])
    tilt, yaw = from_vectors(turn)
    there = Configuration(home.position + shift, tilt @ yaw @ home.rotation, o)
    parts = (there.position, there.internal_point, turn_deg(there, home.rotation))
    p, o, turned = ((x, y, z) for x, y, z in map(np.ndarray.tolist, parts))
    return ProofPose(at.shift, at.tilt, at.yaw, place=(p, o, turned))


def condition_proof(name: str, limit: float, state: _core.ConditionState, at: ProofPose, slack: float) -> LimitProof:
    """Return what is proved of a limit of the condition number."""
    low, high = state.low, state.high
    edge = limit * (1.0 + slack)
    answer = PROVED if high <= edge else VIOLATED if low > edge else UNDECIDED
    margin = float(margin_of("ratio", "max", limit, high))
    return LimitProof(name, "ratio", "max", limit, answer, (low, high), margin, "", (at,), state.boxes)
