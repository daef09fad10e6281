"""Prove that a machine keeps its limits at every pose of its region."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import Any, TypedDict, Unpack

import numpy as np

from ninedof import _core
from ninedof.design.domains.region import Region
from ninedof.design.domains.region_poses import o_is_placed
from ninedof.design.duty import LARGEST_TOLERANCE, Tolerances
from ninedof.design.limits import label
from ninedof.design.objective import CONDITION_LIMIT, Objective
from ninedof.design.study import Study
from ninedof.motion.rotations import from_vectors
from ninedof.proof.machine_record import PROVED, UNDECIDED, VIOLATED, LimitProof, MachineCertificate, ProofPose
from ninedof.proof.point_rule import PointRule
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import LEGS, Geometry, triples
from ninedof.sheet.pose_words import turn_deg
from ninedof.support.arguments import finite, instance, shown, whole
from ninedof.support.arrays import MOST_THREADS as MOST
from ninedof.support.kept.files import sha256
from ninedof.support.margins import margin_of
from ninedof.support.running import Progress, phase
from ninedof.support.structs import entries, from_core, options_of

DRAWN = Tolerances()
NEUTRAL_LIMIT = label(CONDITION_LIMIT, "neutral")
WIDE = 20.0  # an enclosure that is proved at once, where only a bound counts
FOR_ERRORS = 0.2  # of the time
FOR_LIMITS = 5.0  # seconds of each: their enclosures are not gone on with, those of the condition number are


class CertifyArguments(TypedDict, total=False):
    """Options of `certify`, which says what they mean."""

    condition_number: float | None
    gap: float
    time_limit: float
    slack: float
    tolerance: float | Tolerances | None
    threads: int
    rule: PointRule | Callable[[], PointRule] | None
    resume: MachineCertificate | None
    progress: Progress | None
    keep: Callable[[MachineCertificate], object] | None


def certify(
    study: Study,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    **options: Unpack[CertifyArguments],
) -> MachineCertificate:
    """Prove the limits of a study for one design, and enclose its worst condition number.

    The limits are those of the constraints and, of the objective, condition_limit and neutral_condition_limit. The
    configurations are the neutral one, then the poses listed in the study. `Result.certify` says what the options mean;
    a `rule` that is a function without arguments is called for it once all else is known to fit.
    """
    values = options_of(certify, CertifyArguments, options, gap=0.05, time_limit=300.0, slack=1e-6, threads=0)
    region = study.objective.region
    gap, seconds, slack, built, threads, condition_number = checked_numbers(values, study, configurations)
    resume, progress, keep = values["resume"], values["progress"], values["keep"]
    if keep is not None and not callable(keep):
        raise ValueError(f"keep: got {shown(keep)}, expected a callable of one argument")
    only_neutral = region is None and len(configurations) == 1
    where = _where(study, only_neutral)
    digest = machine_digest(study, geometry, configurations, characteristic_length, built)
    if resume is not None:
        if instance("resume", resume, MachineCertificate).where != where:
            raise ValueError(f"resume: got a certificate over {resume.where}, expected one over {where}")
        if resume.machine != digest:
            raise ValueError("resume: got a certificate of another machine, expected one of this machine")
    begin = perf_counter()
    rule = _rule(study, configurations[0], values["rule"], resume)

    def settings(bounds: list[float]) -> _core.ConditionSettings:
        remaining = end - perf_counter()
        return _core.ConditionSettings(threads=threads, seconds=remaining, gap=gap, wanted=bounds, tolerance=slack)

    phase(progress, "proving the limits")
    machine = posed_robot(study, geometry, configurations, characteristic_length, rule, built)
    start, of_limits = perf_counter(), max(seconds, FOR_LIMITS)
    over_poses = _core.limits_over_poses(machine, study.problem(), slack, threads, of_limits)
    limits_ended = perf_counter() - start >= of_limits / len(LEGS)  # the legs of a limit share its time
    named = partial(_proof_pose, home=configurations[0], region=region, rule=rule)
    limits = [_limit_proof(limit, only_neutral, named) for limit in over_poses.limits]
    question = sha256(repr((study.to_dict(), slack)).encode()).hexdigest()
    if resume is not None and rule is None and resume.question == question:  # decided with more time it stays so
        pairs = zip(limits, resume.limits[: len(limits)], strict=True)  # those of the condition number follow
        limits = [before if one.answer == UNDECIDED != before.answer else one for one, before in pairs]

    errors, errors_timed = None, False
    if built:
        phase(progress, "proving the error of the platform")
        of_errors, start = max(FOR_ERRORS * seconds, FOR_LIMITS), perf_counter()
        errors = _core.error_over_poses(machine, 2.0 * gap, threads, of_errors)
        errors_timed = not np.isfinite(errors).all() and perf_counter() - start >= of_errors

    phase(progress, "proving the condition number")
    end = perf_counter() + seconds  # what was before does not count: it is done again whenever a proof is gone on with
    objective = study.objective
    bounds = {CONDITION_LIMIT: objective.condition_limit, "condition_number": condition_number}
    limits_of_index = {name: bound for name, bound in bounds.items() if bound is not None}
    at_neutral = []
    if (bound := objective.neutral_condition_limit) is not None:
        alone = replace(study, objective=Objective())
        at_home = posed_robot(alone, geometry, configurations[[0]], characteristic_length, None, built)
        of_neutral = _core.search_condition(at_home, settings([bound]), _core.ConditionState(), None, None)
        if of_neutral.interrupted:
            raise KeyboardInterrupt
        at_neutral.append(_condition_proof(NEUTRAL_LIMIT, bound, of_neutral, named(of_neutral.at, True), slack))

    def certificate(state: _core.ConditionState, interrupted: bool) -> MachineCertificate:
        at = named(state.at, only_neutral)
        of_condition = [_condition_proof(*bound, state, at, slack) for bound in limits_of_index.items()]
        return MachineCertificate(
            where=where,
            unit=study.unit,
            force_unit=study.force_unit,
            limits=(*limits, *of_condition, *at_neutral),
            lengths=over_poses.lengths,
            condition=(state.low, state.high),
            condition_at=at,
            condition_boxes=state.boxes,
            left=tuple(map(tuple, state.left)),
            left_count=state.left_count,
            target=state.target,
            slack=slack,
            joint_tolerance=built.joints,
            leg_tolerance=built.legs,
            errors=errors,
            question=question,
            errors_timed=errors_timed,
            limits_timed=limits_ended and any(one.answer == UNDECIDED for one in limits),
            seconds=perf_counter() - begin,
            interrupted=interrupted,
            rule=rule,
            machine=digest,
        )

    keep_state = None if keep is None else lambda state: keep(certificate(state, True))
    state = _core.search_condition(
        machine, settings(list(limits_of_index.values())), _state_of(resume), keep_state, progress
    )
    return certificate(state, state.interrupted)


def checked_numbers(
    values: Mapping[str, Any], study: Study, configurations: Configuration
) -> tuple[float, float, float, Tolerances, int, float | None]:
    """Return the gap, seconds, slack, tolerances, threads and bound of the condition number that `certify` takes."""
    gap, seconds = finite("gap", values["gap"], 1e-9), finite("time_limit", values["time_limit"], 0.0)
    slack = finite("slack", values["slack"], 0.0, 0.01)
    built = tolerances_of(values["tolerance"], study)
    threads = whole("threads", values["threads"], 0, MOST)
    if (condition_number := values["condition_number"]) is not None:
        condition_number = finite("condition_number", condition_number, 1.0)
    size, most = max(built.joints, built.legs), LARGEST_TOLERANCE * study.zp(configurations[0])
    if not size < most:
        raise ValueError(f"tolerance: got {size:g}, expected less than a tenth of the machine's height, {most:.6g}")
    return gap, seconds, slack, built, threads, condition_number


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
    slack, threads = finite("slack", slack, 0.0, 0.01), whole("threads", threads, 0, MOST)
    if condition_number is not None:
        condition_number = finite("condition_number", condition_number, 1.0)
    robot = posed_robot(study, *design, built)
    over_poses = _core.limits_over_poses(robot, study.problem(), slack, threads, seconds)
    proofs = [_limit_proof(limit, False, _proof_pose) for limit in over_poses.limits]
    objective = study.objective
    geometry, configurations, length, _ = design
    alone = posed_robot(replace(study, objective=Objective()), geometry, configurations[[0]], length, None, built)
    for name, machine, bound in (
        (CONDITION_LIMIT, robot, objective.condition_limit),
        ("condition_number", robot, condition_number),
        (NEUTRAL_LIMIT, alone, objective.neutral_condition_limit),
    ):
        if bound is not None:
            how = _core.ConditionSettings(threads=threads, seconds=seconds, gap=WIDE, wanted=[bound], tolerance=slack)
            state = _core.search_condition(machine, how, _core.ConditionState(), None, None)
            if state.interrupted:
                raise KeyboardInterrupt
            proofs.append(_condition_proof(name, bound, state, _proof_pose(state.at, False), slack))
    return [one for one in proofs if one.answer != PROVED]


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


def machine_digest(
    study: Study,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    built: Tolerances = DRAWN,
) -> str:
    """Return a digest of every number on which a proof of the condition number depends."""
    region = study.objective.region
    # Its repr is for people, with six digits.
    exact = None if region is None else tuple(getattr(region, one.name) for one in entries(Region))
    digest = sha256(repr((float(characteristic_length), exact)).encode())
    if built:
        digest.update(repr((built.joints, built.legs)).encode())
    if study.tool:
        digest.update(repr((study.tool.position, study.tool.rotation)).encode())
    for array in (*triples(geometry).values(), *arrays_of(configurations).values()):
        digest.update(repr(array.tolist()).encode())
    return digest.hexdigest()


def tolerances_of(tolerance: float | Tolerances | None, study: Study) -> Tolerances:
    """Return the tolerances of a question: those of the study where it has none of its own."""
    if tolerance is None:
        return study.tolerances
    if isinstance(tolerance, Tolerances):
        return tolerance
    size = finite("tolerance", tolerance, 0.0)
    return Tolerances(joints=size, legs=size)


def _state_of(earlier: MachineCertificate | None) -> _core.ConditionState:
    """Return the state of the search that an earlier certificate goes on from; that of a new search without one."""
    state = _core.ConditionState()
    if earlier is not None:
        (state.low, state.high), state.at = earlier.condition, earlier.condition_at.for_core()
        state.boxes, state.left, state.target = earlier.condition_boxes, earlier.left, earlier.target
    return state


def _rule(
    study: Study,
    neutral: Configuration,
    option: PointRule | Callable[[], PointRule] | None,
    resume: MachineCertificate | None,
) -> PointRule | None:
    if not o_is_placed(study):
        if option is not None:
            raise ValueError(
                'rule: got one, expected none: O follows a rule where internal_point is "best" in a region'
            )
        return None
    earlier = None if resume is None else resume.rule
    if resume is not None and earlier is None:
        raise ValueError("resume: got a certificate without a rule for O, expected one with it")
    if isinstance(option, PointRule) and earlier is not None and option != earlier:
        raise ValueError("rule: got another one than that of the certificate to go on with, expected the same")
    if option is None and earlier is None:
        raise ValueError('rule: got none, expected one that says where O is: internal_point is "best" in the region')
    rule = earlier or (option() if callable(option) and not isinstance(option, PointRule) else option)
    if not isinstance(rule, PointRule):
        raise ValueError(f"rule: got {shown(rule)}, expected a PointRule")
    if not rule.about(neutral):
        raise ValueError("rule: got one about another neutral pose, expected that of the design")
    return rule


def _limit_proof(
    limit: _core.LimitOverPoses, only_neutral: bool, named: Callable[[_core.MetAt, bool], ProofPose]
) -> LimitProof:
    margin = float(margin_of(limit.kind, limit.side, limit.limit, limit.value[limit.side == "max"]))
    poses = tuple(named(at, only_neutral or limit.at_neutral) for at in limit.at)
    return from_core(LimitProof, limit, margin=margin, at=poses)


def _proof_pose(
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


def _condition_proof(name: str, limit: float, state: _core.ConditionState, at: ProofPose, slack: float) -> LimitProof:
    low, high = state.low, state.high
    edge = limit * (1.0 + slack)
    answer = PROVED if high <= edge else VIOLATED if low > edge else UNDECIDED
    margin = float(margin_of("ratio", "max", limit, high))
    return LimitProof(name, "ratio", "max", limit, answer, (low, high), margin, "", (at,), state.boxes)


def _where(study: Study, only_neutral: bool) -> str:
    objective = study.objective
    count = len(objective.poses)
    poses = f"{count} listed pose{'s' * (count != 1)}"
    if objective.region is not None:
        return objective.region.worded(study.unit) + (f" and of {poses}" if count else "")
    return "the study, the neutral one" if only_neutral else f"the study, {poses}"
