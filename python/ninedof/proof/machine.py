"""Prove that a machine keeps its limits at every pose of its region."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Any

from ninedof import _core
from ninedof.design.limits import label
from ninedof.design.region import Region
from ninedof.design.region_stack import places_o
from ninedof.design.study import Study
from ninedof.proof.machine_limits import proved_limits
from ninedof.proof.machine_record import PROVED, UNDECIDED, VIOLATED, LimitProof, MachineCertificate
from ninedof.proof.machine_seal import belongs, machine_digest, sealed
from ninedof.proof.machine_search import ConditionSearch
from ninedof.proof.point_rule import PointRule
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import finite, instance, shown, whole
from ninedof.support.arrays import MOST_THREADS
from ninedof.support.margins import margin_of
from ninedof.support.progress import Progress, phase


def certify(
    study: Study,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    *,
    condition_number: float | None = None,
    gap: float = 0.05,
    time_limit: float = 300.0,
    tolerance: float = 1e-6,
    threads: int = 0,
    rule: PointRule | Callable[[], PointRule] | None = None,
    resume: MachineCertificate | None = None,
    progress: Progress | None = None,
    keep: Callable[[MachineCertificate], object] | None = None,
) -> MachineCertificate:
    """Prove the limits of a study for one design, and enclose its worst condition number.

    The limits are those of the constraints and, of the objective, condition_limit and neutral_condition_limit.

    Parameters
    ----------
    study : Study
    geometry : Geometry
    configurations : Configuration, shape (n,)
        The neutral one, then the poses listed in the study.
    characteristic_length : float
    condition_number : float, optional
        A bound of the condition number to be proved: one more limit.
    gap : float
        Relative width of the enclosure of the worst condition number.
    time_limit : float
        Seconds for the condition number; limits take seconds.
    tolerance : float
        Relative: a limit that is passed by no more counts as kept. Designs of the optimizer lie on their limits.
    threads : int
        0: one per processor.
    rule : PointRule or callable, optional
        Where O is in the region; needed where the study places it anew at every pose, unless `resume` has it. A
        function without arguments is called for it once all else is known to fit.
    resume : MachineCertificate, optional
        An earlier one of the same design, as it was written, whose boxes left are to be gone on with.
    progress : callable, optional
        Called with boxes done, 0, and the worst condition number met; one with a method `phase` is told what begins.
    keep : callable, optional
        Called every 20 seconds with the certificate so far, as that of a run that is interrupted: another run goes on
        with it by `resume`.

    Returns
    -------
    MachineCertificate

    Raises
    ------
    ValueError
        For a bad argument.

    """
    region = study.objective.region
    finite("gap", gap, 1e-9)
    seconds = finite("time_limit", time_limit, 0.0)
    finite("tolerance", tolerance, 0.0, 0.01)
    if condition_number is not None:
        finite("condition_number", condition_number, 1.0)
    how = {"threads": whole("threads", threads, 0, MOST_THREADS), "seconds": seconds, "gap": gap, "condition": 0.0}
    if resume is not None:
        instance("resume", resume, MachineCertificate)
    if keep is not None and not callable(keep):
        raise ValueError(f"keep: got {shown(keep)}, expected a callable of one argument")
    only_neutral = region is None and len(configurations) == 1
    if resume is not None and resume.where != _where(study, only_neutral):
        raise ValueError(
            f"resume: got a certificate over {resume.where}, expected one over {_where(study, only_neutral)}"
        )
    machine = machine_digest(study, geometry, configurations, characteristic_length)
    if resume is not None and not belongs(resume, machine):
        raise ValueError(
            "resume: got a certificate of another machine or one that was changed, expected one of this machine as it "
            "was written"
        )
    begin = perf_counter()
    followed = _rule(region, configurations[0], rule, resume)
    start = perf_counter()  # finding a rule does not count for the time limit
    phase(progress, "proving the limits")
    alone = configurations[[0, 0]]
    stack = alone if only_neutral else configurations
    shape = None if region is None else region.for_core() | ({"rule": followed.for_core()} if followed else {})
    found = proved_limits(study, geometry, configurations, shape, tolerance, how)

    phase(progress, "proving the condition number")
    objective = study.objective
    bounds = {"condition_limit": objective.condition_limit, "condition_number": condition_number}
    wanted = {name: bound for name, bound in bounds.items() if bound is not None}

    def search(
        posed: Configuration,
        over: dict[str, Any] | None,
        told: Any,
        only_neutral: bool,
        keep: Callable[[], object] | None = None,
    ) -> ConditionSearch:
        arrays = (posed.position, posed.rotation, posed.internal_point)
        return ConditionSearch(
            lambda how, boxes: _core.worst_condition(geometry, *arrays, characteristic_length, over, how, boxes, told),
            how,
            start + seconds,
            only_neutral,
            keep,
        )

    at_neutral = []
    if objective.neutral_condition_limit is not None:
        of_neutral = search(alone, None, None, True)
        of_neutral.enclose([objective.neutral_condition_limit], tolerance)
        if of_neutral.interrupted:
            raise KeyboardInterrupt
        name = label("condition_limit", "neutral")
        at_neutral.append(_condition_proof(name, objective.neutral_condition_limit, of_neutral, tolerance))

    def made(interrupted: bool) -> MachineCertificate:
        of_condition = [_condition_proof(*bound, runs, tolerance) for bound in wanted.items()]
        certificate = MachineCertificate(
            where=_where(study, only_neutral),
            unit=study.unit,
            limits=(*found.limits, *of_condition, *at_neutral),
            lengths=found.lengths,
            condition=(runs.low, runs.high),
            condition_at=runs.at,
            condition_boxes=runs.boxes,
            left=tuple(map(tuple, runs.left)),
            left_count=runs.left_count,
            target=runs.target,
            tolerance=tolerance,
            seconds=perf_counter() - begin,
            interrupted=interrupted,
            rule=followed,
        )
        return sealed(certificate, machine)

    runs = search(stack, shape, progress, only_neutral, None if keep is None else lambda: keep(made(True)))
    if resume is not None:
        runs.go_on(resume, list(wanted.values()), tolerance)
    else:
        runs.enclose(list(wanted.values()), tolerance)
    return made(runs.interrupted)


def _rule(
    region: Region | None,
    neutral: Configuration,
    given: PointRule | Callable[[], PointRule] | None,
    resume: MachineCertificate | None,
) -> PointRule | None:
    """Return the rule that O follows, if it follows one."""
    placed = region is not None and not places_o(region)
    if not placed:
        if given is not None:
            raise ValueError(
                'rule: got one, expected none: O follows a rule where internal_point is "best" in a region'
            )
        return None
    earlier = None if resume is None else resume.rule
    if resume is not None and earlier is None:
        raise ValueError("resume: got a certificate without a rule for O, expected one with it")
    if isinstance(given, PointRule) and earlier is not None and given != earlier:
        raise ValueError("rule: got another one than that of the certificate to go on with, expected the same")
    if given is None and earlier is None:
        raise ValueError('rule: got none, expected one that says where O is: internal_point is "best" in the region')
    rule = earlier or (given() if callable(given) and not isinstance(given, PointRule) else given)
    if not isinstance(rule, PointRule):
        raise ValueError(f"rule: got {shown(rule)}, expected a PointRule")
    if not rule.about(neutral):
        raise ValueError("rule: got one about another neutral pose, expected that of the design")
    return rule


def _condition_proof(name: str, limit: float, runs: ConditionSearch, tolerance: float) -> LimitProof:
    low, high = runs.low, runs.high
    edge = limit * (1.0 + tolerance)
    answer = PROVED if high <= edge else VIOLATED if low > edge else UNDECIDED
    margin = float(margin_of("ratio", "max", limit, high))
    return LimitProof(name, "ratio", "max", limit, answer, (low, high), margin, "", (runs.at,), runs.boxes)


def _where(study: Study, only_neutral: bool) -> str:
    objective = study.objective
    count = len(objective.poses)
    listed = f"{count} listed pose{'s' * (count != 1)}"
    if objective.region is not None:
        return objective.region.worded(study.unit) + (f" and of {listed}" if count else "")
    return "the study, the neutral one" if only_neutral else f"the study, {listed}"
