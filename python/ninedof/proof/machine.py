"""Prove that a machine keeps its limits at every pose of its region."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.domains.region import Region
from ninedof.design.domains.region_poses import o_is_placed
from ninedof.design.duty import LARGEST_TOLERANCE, Tolerances, tolerances_like
from ninedof.design.objective import CONDITION_LIMIT
from ninedof.design.study import Study
from ninedof.proof.machine_limits import condition_proof, limit_proof, neutral_limit, posed_robot, proof_pose
from ninedof.proof.machine_record import UNDECIDED, MachineCertificate
from ninedof.proof.point_rule import PointRule
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import LEGS, Geometry, triples
from ninedof.support.arguments import finite, instance, shown, whole
from ninedof.support.arrays import MOST_THREADS as MOST
from ninedof.support.kept.files import sha256
from ninedof.support.running import Progress, phase, progress_argument
from ninedof.support.structs import StudyTable, entries, entry, read

DRAWN = Tolerances()
FOR_ERRORS = 0.2  # of the time
FOR_LIMITS = 5.0  # seconds of each: their enclosures are not gone on with, those of the condition number are


def _tolerance(name: str, value: Any) -> Tolerances:
    return value if isinstance(value, Tolerances) else tolerances_like(DRAWN, finite(name, value, 0.0))


def _callable(name: str, value: Any) -> Any:
    if not callable(value):
        raise ValueError(f"{name}: got {shown(value)}, expected a callable of one argument")
    return value


@dataclass(frozen=True)
class Certify(StudyTable):
    """Options of `certify`; `Result.certify` says what they mean."""

    condition_number: float | None = entry(partial(finite, least=1.0), None)
    gap: float = entry(partial(finite, least=1e-9), 0.05)
    time_limit: float = entry(partial(finite, least=0.0), 300.0)
    slack: float = entry(partial(finite, least=0.0, most=0.01), 1e-6)
    tolerance: Tolerances | None = entry(_tolerance, None)
    threads: int = entry(partial(whole, least=0, most=MOST), 0)
    rule: PointRule | Callable[[], PointRule] | None = entry(lambda _, value: value, None)
    resume: MachineCertificate | None = entry(partial(instance, kind=MachineCertificate), None)
    progress: Progress | None = entry(lambda _, value: progress_argument(value), None)
    keep: Callable[[MachineCertificate], object] | None = entry(_callable, None)

    def built(self, study: Study, configurations: Configuration) -> Tolerances:
        """Return the tolerances of a machine, those of its study where none are given; raise unless they are small."""
        out = study.tolerances if self.tolerance is None else self.tolerance
        size, most = max(out.joints, out.legs), LARGEST_TOLERANCE * study.zp(configurations[0])
        if not size < most:
            raise ValueError(f"tolerance: got {size:g}, expected less than a tenth of the machine's height, {most:.6g}")
        return out


def certify(
    study: Study,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    **options: Any,
) -> MachineCertificate:
    """Prove the limits of a study for one design, and enclose its worst condition number.

    The limits are those of the constraints and, of the objective, condition_limit and neutral_condition_limit. The
    configurations are the neutral one, then the poses listed in the study. `Result.certify` says what the options mean;
    a `rule` that is a function without arguments is called for it once all else is known to fit.
    """
    request: Certify = read(Certify, options)
    region, slack, built = study.objective.region, request.slack, request.built(study, configurations)
    threads, seconds, resume, progress = request.threads, request.time_limit, request.resume, request.progress
    only_neutral = region is None and len(configurations) == 1
    where = _where(study, only_neutral)
    digest = machine_digest(study, geometry, configurations, characteristic_length, built)
    if resume is not None:
        if resume.where != where:
            raise ValueError(f"resume: got a certificate over {resume.where}, expected one over {where}")
        if resume.machine != digest:
            raise ValueError("resume: got a certificate of another machine, expected one of this machine")
    begin = perf_counter()
    rule = _rule(study, configurations[0], request.rule, resume)

    def settings(bounds: list[float]) -> _core.ConditionSettings:
        remaining = end - perf_counter()
        return _core.ConditionSettings(
            threads=threads, seconds=remaining, gap=request.gap, wanted=bounds, tolerance=slack
        )

    phase(progress, "proving the limits")
    machine = posed_robot(study, geometry, configurations, characteristic_length, rule, built)
    start, of_limits = perf_counter(), max(seconds, FOR_LIMITS)
    over_poses = _core.limits_over_poses(machine, study.problem(), slack, threads, of_limits)
    limits_ended = perf_counter() - start >= of_limits / len(LEGS)  # the legs of a limit share its time
    named = partial(proof_pose, home=configurations[0], region=region, rule=rule)
    limits = [limit_proof(limit, only_neutral, named) for limit in over_poses.limits]
    question = sha256(repr((study.to_dict(), slack)).encode()).hexdigest()
    if resume is not None and rule is None and resume.question == question:  # decided with more time it stays so
        pairs = zip(limits, resume.limits[: len(limits)], strict=True)  # those of the condition number follow
        limits = [before if one.answer == UNDECIDED != before.answer else one for one, before in pairs]

    errors, errors_timed = None, False
    if built:
        phase(progress, "proving the error of the platform")
        of_errors, start = max(FOR_ERRORS * seconds, FOR_LIMITS), perf_counter()
        errors = _core.error_over_poses(machine, 2.0 * request.gap, threads, of_errors)
        errors_timed = not np.isfinite(errors).all() and perf_counter() - start >= of_errors

    phase(progress, "proving the condition number")
    end = perf_counter() + seconds  # what was before does not count: it is done again whenever a proof is gone on with
    objective = study.objective
    bounds = {CONDITION_LIMIT: objective.condition_limit, "condition_number": request.condition_number}
    limits_of_index = {name: bound for name, bound in bounds.items() if bound is not None}
    at_neutral = neutral_limit(study, (geometry, configurations, characteristic_length), built, settings, slack)

    def certificate(state: _core.ConditionState, interrupted: bool) -> MachineCertificate:
        at = named(state.at, only_neutral)
        of_condition = [condition_proof(*bound, state, at, slack) for bound in limits_of_index.items()]
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

    keep = request.keep
    keep_state = None if keep is None else lambda state: keep(certificate(state, True))
    state = _core.search_condition(
        machine, settings(list(limits_of_index.values())), _state_of(resume), keep_state, progress
    )
    return certificate(state, state.interrupted)


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


def _where(study: Study, only_neutral: bool) -> str:
    objective = study.objective
    count = len(objective.poses)
    poses = f"{count} listed pose{'s' * (count != 1)}"
    if objective.region is not None:
        return objective.region.worded(study.unit) + (f" and of {poses}" if count else "")
    return "the study, the neutral one" if only_neutral else f"the study, {poses}"
