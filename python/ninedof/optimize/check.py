"""`check`: a result looked at once more, from the variables of its best design alone.

Two ways to one number are in the tests, where numpy has the definition of every limit and index: see
tests/python/support/limit_oracle.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.conditioning.conditioning import condition_number
from ninedof.design.design_point import DesignPoint
from ninedof.design.domains.region_poses import leg_limits_of
from ninedof.design.objective import CONDITION_LIMIT
from ninedof.design.study import LENGTH
from ninedof.optimize.bounds import CERTIFICATE, applicable_bounds
from ninedof.optimize.candidate import best_of
from ninedof.optimize.result import Result, Status
from ninedof.proof.machine_record import PROVED
from ninedof.robot.configuration import arrays_of
from ninedof.robot.geometry import triples
from ninedof.support.arguments import flag, instance, whole
from ninedof.support.arrays import Floats

EQUAL = 1e-9  # relative: two ways to one number
FEASIBLE = 1e-8  # by how much a margin may be negative
STATIONARY = 1e-6
BETTER = 1e-8  # relative: a smaller improvement is rounding or the tolerance of the limits
LEFT = 1e-7  # the same over a region, where "optimal" leaves as much between the poses
BETWEEN = 1e-6  # by which a limit may be violated between the poses that ruled
MOST_PERTURBATIONS = 1_000_000
ERRORS = 5.0  # standard errors of a mean at random poses
BOUND = 1e-7  # close to 1 a condition number has half the digits only


@dataclass(frozen=True)
class Finding:
    """One test and its outcome."""

    name: str
    passed: bool
    figure: float
    """The number that decides the test; the sentence describes it."""
    sentence: str


@dataclass(frozen=True)
class Check:
    """The findings of a check."""

    findings: tuple[Finding, ...]
    title: str = ""

    @property
    def passed(self) -> bool:
        """Whether all tests passed."""
        return all(finding.passed for finding in self.findings)

    def __bool__(self) -> bool:
        """Return True if all tests passed."""
        return self.passed

    def __getitem__(self, name: str) -> Finding:
        """Return a finding by name."""
        by_name = {finding.name: finding for finding in self.findings}
        if name not in by_name:
            raise KeyError(f"{name!r}; there are {', '.join(by_name)}")
        return by_name[name]

    def __repr__(self) -> str:
        """Show the verdict and the tests that failed."""
        failed = [finding.name for finding in self.findings if not finding.passed]
        return f"<Check: {len(self.findings)} tests, {'failed ' + ', '.join(failed) if failed else 'all passed'}>"

    def report(self) -> str:
        """Return the tests and their outcomes as text, one line per test."""
        failed = sum(not one.passed for one in self.findings)
        verdict = f"{failed} failed" if failed else "all passed"
        width = max((len(one.name) for one in self.findings), default=0)
        lines = [f"{self.title}: {len(self.findings)} tests, {verdict}"]
        for one in self.findings:
            lines.append(f"  {'passed' if one.passed else 'FAILED'}  {one.name:<{width}}  {one.sentence}")
        return "\n".join(lines)

    def to_dict(self) -> dict[str, Any]:
        """Return the findings as plain JSON values."""
        findings = [dict(finding.__dict__) for finding in self.findings]
        return {"passed": self.passed, "title": self.title, "findings": findings}


def check(result: Result, perturbations: int = 4000, seed: int = 0, *, certify: bool = False) -> Check:
    """Check the best design of a result from its variables, without the run that found it.

    Every number is computed anew, condition numbers by the general path. The claim of an optimum is tested twice: by
    the least convex combination of all active gradients, ties of singular values included, and by random steps of six
    sizes. A region is searched densely, with a seed of its own. A proof of the optimum is read by its independent
    checker, which takes seconds. Last come the lower bounds that hold for the design.

    Parameters
    ----------
    result : Result
        A result with a design. Stationarity and random steps are tested only if its status is "optimal".
    perturbations : int
        Number of random steps from the design, 1e-1 to 1e-6 of each variable (or of l_c, if that is larger).
    seed : int
        Seed of the steps, and of the search of a region.
    certify : bool
        Whether to prove the limits too, as `Result.certify` does: it takes up to minutes.

    Raises
    ------
    ValueError
        If the result holds no design, or an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> verdict = nd.check(nd.optimize(nd.Study.paper()), perturbations=500)
    >>> verdict.passed, verdict["stationarity"].passed
    (True, True)

    """
    best_of(instance("result", result, Result))
    if result.reserve is not None:  # an optimum of the study that was solved
        result = replace(result, study=result.reserve.study(result.study), reserve=None)
    steps = whole("perturbations", perturbations, 0, MOST_PERTURBATIONS)
    findings = [*_of_design(result), *_of_claims(result, steps, whole("seed", seed, 0))]
    for limit in result.certify().limits if flag("certify", certify) else ():
        sentence = f"{limit.side} {limit.shown(limit.limit):g}: {limit.answer}, the worst value is {limit.worded()}"
        findings.append(Finding(f"proof: {limit.name}", limit.answer == PROVED, limit.margin, sentence))
    return Check(tuple([*findings, *_bounds(result)]), f"check of a design of the {result.study.family} family")


def _of_design(result: Result) -> Iterator[Finding]:
    """Compare the stated robot and numbers with those of the variables, and the limits with these."""
    best = best_of(result)
    point = result.solved.evaluate(best.variables)
    yield _robot(result, point)
    every = condition_number(point.geometry, point.configurations, point.characteristic_length)
    conditions = np.append(every[1:] if len(every) > 1 else every, every[0])
    claims = np.append(np.asarray(best.conditions, dtype=np.float64), best.neutral_condition_number)
    figure = _difference(conditions, claims) if conditions.shape == claims.shape else math.inf
    ends = f"{conditions.min():.6f} to {conditions.max():.6f}"
    sentence = f"{len(conditions)} by the general path, {ends}: differences up to {figure:.1e}"
    allowed = EQUAL * max(1.0, float(conditions.max()))
    yield Finding("condition numbers", figure <= allowed, figure, sentence)
    objective = result.study.objective
    mean = None if result.region is None else result.region.mean
    # The optimizer minimized over the poses of its quadrature; of the logarithm the mean has its share.
    minimized = best.objective / (1.0 if mean is None else (mean.value / mean.quadrature) ** objective.mean_share)
    figure = _difference(np.array([point.objective]), np.array([minimized]))
    index = f"{objective.aggregate} {objective.index}".replace("_", " ")
    poses = "1 pose" if len(best.conditions) == 1 else f"{len(best.conditions)} poses"
    sentence = f"{index} of {poses}: {point.objective:.9g}, difference {figure:.1e}"
    yield Finding("objective", figure <= allowed, figure, sentence)
    for name, margin in point.margins.items():
        label = name if name.startswith(CONDITION_LIMIT) else f"limit: {name}"
        sentence = f"the least margin is {margin:.3e}, where the value is {point.values[name]:.9g}"
        yield Finding(label, margin >= -FEASIBLE, margin, sentence)


def _robot(result: Result, point: DesignPoint) -> Finding:
    """Compare the variables with their bounds, and their robot with the returned one."""
    best = best_of(result)
    study = result.study
    length = {} if isinstance(study.characteristic_length, str) else {LENGTH: study.characteristic_length}
    bounds = {name: b if isinstance(b, tuple) else (b, b) for name, b in {**study.variables, **length}.items()}
    outside = 0.0
    for name, x in best.variables.items():
        low, high = bounds.get(name, (-math.inf, math.inf))  # a length by its kind, or an offset of O at a pose
        size = 1.0 if name in study.angles else math.hypot(x, point.characteristic_length)
        outside = max(outside, (low - x) / size, (x - high) / size)
    ours, theirs = (np.stack([*triples(d.geometry).values()]) for d in (point, best))
    same = bool(np.abs(ours - theirs).max() <= EQUAL * np.abs(theirs).max())
    for name, array in arrays_of(point.configuration).items():
        absolute = EQUAL if name == "rotation" else 0.0
        same &= np.allclose(array, getattr(best.configuration, name), rtol=EQUAL, atol=absolute)
    words = "the same joints as returned" if same else "NOT the joints returned"
    sentence = f"{len(best.variables)} variables within their bounds to {outside:.1e}, {words}"
    return Finding("design", same and outside <= FEASIBLE, outside, sentence)


def _of_claims(result: Result, steps: int, seed: int) -> Iterator[Finding]:
    """Test that the design holds in all of its region, and that it is an optimum."""
    best = best_of(result)
    study = result.solved
    problem, x = study.problem(), study.vector(best.variables)
    if result.region is not None:
        yield _region(result, problem, x, seed)
    if result.status != Status.OPTIMAL:
        return
    optimum = _core.check_optimum(problem, x, steps, seed)
    sentence = (
        f"the gradients of the objective and of {optimum.active} limits and bounds balance to {optimum.residual:.1e} "
        f"of the objective per unit of relative change, {STATIONARY:.0e} allowed"
    )
    yield Finding("stationarity", optimum.residual <= STATIONARY, optimum.residual, sentence)
    most = BETTER if result.region is None else LEFT
    within = f"within the limits by up to {optimum.gain:.1e}" if optimum.gain > most else "none within the limits"
    sentence = (
        f"of {optimum.steps} steps of 0.1 to 1e-06 of the variables, {optimum.better} improve the objective, {within}"
    )
    yield Finding("perturbations", optimum.gain <= most, optimum.gain, sentence)


def _region(result: Result, problem: _core.Problem, x: list[float], seed: int) -> Finding:
    report: Any = result.region
    region: Any = result.study.objective.region
    worst = _core.check_region(problem, region.for_core(), x, leg_limits_of(report.leg_ranges), seed)
    where = "poses, O being placed at each," if region.internal_point == "best" else "poses"
    sentence = f"at {worst.poses} {where} the index is at most {worst.index:.9g}, the least margin {worst.margin:.1e}"
    holds = worst.excess <= BETWEEN
    if report.mean is not None:
        error = math.hypot(worst.standard_error, report.mean.standard_error)
        holds &= abs(worst.mean - report.mean.value) <= ERRORS * error
        sentence += f", the harmonic mean over 8192 others {worst.mean:.6g}"
    return Finding("region", holds, worst.excess, sentence)


def _bounds(result: Result) -> Iterator[Finding]:
    if result.proof is not None and result.proof.certificate:
        verdict = _core.check_certificate(result.proof.certificate, None)
        yield Finding("certificate", verdict.proved, float(verdict.boxes), verdict.words)
    best = best_of(result)
    neutral = float(condition_number(best.geometry, best.configuration, best.characteristic_length))
    for bound in applicable_bounds(result):  # a proof is about the worst of all poses
        above = (best.condition_number if bound.name == CERTIFICATE else neutral) / bound.value - 1.0
        proof = "proved" if bound.proved else "searched"
        yield Finding(f"bound: {bound.name}", above >= -BOUND, above, f"{above:.2%} above; {bound.sentence} ({proof})")


def _difference(ours: Floats, theirs: Floats) -> float:
    """Return the largest relative difference; numbers that are infinite on both sides agree."""
    if np.array_equal(ours, theirs):
        return 0.0
    with np.errstate(invalid="ignore"):
        apart = np.abs(ours - theirs) / np.abs(ours)
    return float(np.where(np.isfinite(apart), apart, math.inf).max())
