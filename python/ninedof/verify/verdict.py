"""`check`: an independent check of a result."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.optimize.bounds import applicable_bounds
from ninedof.optimize.result import Result
from ninedof.robot.geometry import TRIPLES
from ninedof.support.arguments import whole
from ninedof.support.arrays import Floats
from ninedof.verify.objective import ObjectiveRule
from ninedof.verify.perturbation import SCALES, perturb
from ninedof.verify.placing import worst_placed
from ninedof.verify.region import mean_at_random, worst_at_random
from ninedof.verify.robot import DesignSpace
from ninedof.verify.rules import Limit, limits_of, margins
from ninedof.verify.stationarity import stationarity

EQUAL = 1e-9  # relative: two ways to one number
FEASIBLE = 1e-8  # by how much a margin may be negative
STATIONARY = 1e-6
BETTER = 1e-8  # relative: a smaller improvement is rounding or the tolerance of the limits
BETWEEN = 1e-6  # by which a limit may be passed between the poses that ruled
IN_REGION = 4000
MOST_PERTURBATIONS = 1_000_000
ERRORS = 5.0  # standard errors of a mean at random poses
PLACED = 1000  # the same where O is placed at every pose, by a search of its own
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
        for finding in self.findings:
            if finding.name == name:
                return finding
        raise KeyError(f"{name!r}; there are {', '.join(finding.name for finding in self.findings)}")

    def __repr__(self) -> str:
        """Show the verdict and the tests that failed."""
        failed = [finding.name for finding in self.findings if not finding.passed]
        return f"<Check: {len(self.findings)} tests, {'failed ' + ', '.join(failed) if failed else 'all passed'}>"

    def report(self) -> str:
        """Return the tests and their outcomes as text, one line per test."""
        failed = sum(not finding.passed for finding in self.findings)
        verdict = "all passed" if not failed else f"{failed} failed"
        width = max((len(finding.name) for finding in self.findings), default=0)
        lines = [f"{self.title}: {len(self.findings)} tests, {verdict}"]
        for finding in self.findings:
            lines.append(f"  {'passed' if finding.passed else 'FAILED'}  {finding.name:<{width}}  {finding.sentence}")
        return "\n".join(lines)

    def to_dict(self) -> dict[str, Any]:
        """Return the findings as plain JSON values."""
        return {
            "passed": self.passed,
            "title": self.title,
            "findings": [
                {"name": f.name, "passed": f.passed, "figure": f.figure, "sentence": f.sentence} for f in self.findings
            ],
        }


def check(result: Result, perturbations: int = 4000, seed: int = 0) -> Check:
    """Check the best design of a result independently of the solver.

    Condition numbers come from the general path, constraints from their definitions in plain numpy. The claim of an
    optimum is tested twice: by the least convex combination of all active gradients, ties of singular values included,
    and by random steps of six sizes. Last come the lower bounds that hold for the design.

    Parameters
    ----------
    result : Result
        A result with a design. Stationarity and random steps are tested only if its status is "optimal".
    perturbations : int
        Number of random steps from the design, 1e-1 to 1e-6 of each variable (or of l_c, if that is larger).
    seed : int
        Seed of the steps.

    Returns
    -------
    Check

    Raises
    ------
    ValueError
        If the result holds no design, or an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> found = nd.check(nd.optimize(nd.Study.paper()), perturbations=500)
    >>> found.passed, found["stationarity"].passed
    (True, True)

    """
    if getattr(result, "best", None) is None:
        got = getattr(result, "status", None)
        what = f"one without a design (status {str(got)!r})" if got is not None else type(result).__name__
        raise ValueError(f"result: got {what}, expected a Result with a design")
    findings = _findings(result, whole("perturbations", perturbations, 0, MOST_PERTURBATIONS), whole("seed", seed, 0))
    return Check(tuple(findings), f"check of a design of the {result.study.family} family")


def _findings(result: Result, count: int, seed: int) -> Iterator[Finding]:
    best: Any = result.best
    study = result.solved
    space, objective, limits = DesignSpace(study, best.variables), ObjectiveRule.of(study), limits_of(study)
    yield _design(space, best)
    average = None if result.region is None else result.region.mean
    # What the optimizer minimized: over the poses of its quadrature.
    minimized = best.objective / (1.0 if average is None else average.stated(1.0, study.objective.mean_share))
    yield from _numbers(space, objective, best, minimized)
    core = _core_margins(space)
    worst = 0.0
    for limit in limits:
        finding = _limit(space, limit, core.get(limit.label))
        worst = max(worst, -finding.figure)
        yield finding
    if result.region is not None:
        yield _region(result, seed)
    if str(result.status) == "optimal":
        found = stationarity(space, objective, limits)
        sentence = (
            f"{found.gradients} gradients of the objective and {found.limits} limits and bounds balance to "
            f"{found.residual:.1e} of the objective per unit of relative change, {STATIONARY:.0e} allowed"
        )
        yield Finding("stationarity", found.residual <= STATIONARY, found.residual, sentence)
        tried = perturb(space, objective, limits, count, seed, max(worst, 1e-12))
        allowed = f"within the limits by up to {tried.best:.1e}" if tried.best > BETTER else "none within the limits"
        sentence = (
            f"of {tried.tried} steps of {SCALES[0]:g} to {SCALES[-1]:g} of the variables, {tried.better} improve the "
            f"objective, {allowed}"
        )
        yield Finding("perturbations", tried.best <= BETTER, tried.best, sentence)
    neutral = _neutral(space)
    for bound in applicable_bounds(result):
        above = neutral / bound.value - 1.0
        proof = "proved" if bound.proved else "searched"
        yield Finding(f"bound: {bound.name}", above >= -BOUND, above, f"{above:.2%} above; {bound.sentence} ({proof})")


def _region(result: Result, seed: int) -> Finding:
    """Test limits and index at random poses of the region."""
    best: Any = result.best
    study: Any = result.study
    if study.objective.region.internal_point == "best":
        count, where = PLACED, "random poses, O being placed at each,"
        report: Any = result.region
        index, margin = worst_placed(study, best, report, count, seed)
    else:
        count, where = IN_REGION, "random poses"
        index, margin = worst_at_random(study, best.variables, count, seed)
    sentence = f"at {count} {where} the index is at most {index:.9g}, the least margin {margin:.1e}"
    above = -math.inf
    if study.objective.aggregate == "worst":
        above = index / best.objective - 1.0
    elif study.objective.aggregate == "weighted":
        space = DesignSpace(result.solved, best.variables)
        above = index / float(ObjectiveRule.of(result.solved).values(space.robot(space.x)).max()) - 1.0
    passed = above <= BETWEEN and margin >= -BETWEEN
    average = result.region.mean if result.region is not None else None
    if average is not None:
        mean, error = mean_at_random(study, best.variables, count, seed + 1)
        passed &= abs(mean - average.value) <= ERRORS * math.hypot(error, average.standard_error)
        sentence += f", the harmonic mean of as many others {mean:.6g}"
    return Finding("region", passed, max(above, -margin), sentence)


def _design(space: DesignSpace, best: Any) -> Finding:
    """Compare the variables with their bounds, and their robot with the returned one."""
    outside = np.maximum(space.low - space.x, space.x - space.high) / space.size
    figure = max(float(outside.max()), 0.0)
    robot = space.robot(space.x)
    g, h = robot.geometry, best.geometry
    apart = max(float(np.abs(getattr(g, name) - getattr(h, name)).max()) for name in TRIPLES)
    same = apart <= EQUAL * float(max(np.abs(getattr(g, name)).max() for name in TRIPLES))
    same &= np.allclose(robot.neutral.position, best.configuration.position, rtol=EQUAL, atol=0.0)
    same &= np.allclose(robot.neutral.internal_point, best.configuration.internal_point, rtol=EQUAL, atol=0.0)
    same &= np.allclose(robot.neutral.rotation, best.configuration.rotation, rtol=0.0, atol=EQUAL)
    words = "the same joints as returned" if same else "NOT the joints returned"
    sentence = f"{len(space.names)} variables within their bounds to {figure:.1e}, {words}"
    return Finding("design", bool(same) and figure <= FEASIBLE, figure, sentence)


def _numbers(space: DesignSpace, objective: ObjectiveRule, best: Any, minimized: float) -> Iterator[Finding]:
    robot = space.robot(space.x)
    poses = np.asarray(condition_number(robot.geometry, robot.poses, robot.length))
    ours = np.append(poses, _neutral(space))
    theirs = np.append(np.asarray(best.conditions, dtype=np.float64), best.condition_number)
    figure = _difference(ours, theirs) if ours.shape == theirs.shape else math.inf
    sentence = f"{len(ours)} by the general path, {ours.min():.6f} to {ours.max():.6f}: differences up to {figure:.1e}"
    yield Finding("condition numbers", figure <= EQUAL * float(ours.max()), figure, sentence)
    values = objective.values(robot)
    total = objective.total(values)
    figure = _difference(np.array([total]), np.array([minimized]))
    words = objective.aggregate.replace("_", " ")
    where = "1 pose" if len(values) == 1 else f"{len(values)} poses"
    sentence = f"{words} {objective.index.replace('_', ' ')} of {where}: {total:.9g}, difference {figure:.1e}"
    yield Finding("objective", figure <= EQUAL * max(1.0, float(ours.max())), figure, sentence)
    for name, each in objective.condition_margins(robot).items():
        margin = float(each.min())
        sentence = f"the largest condition number is {1.0 - margin:.9f} of its limit"
        yield Finding(name, margin >= -FEASIBLE, margin, sentence)


def _limit(space: DesignSpace, limit: Limit, core: float | None) -> Finding:
    """Test a limit, and compare the margin of the core with that of the definition."""
    every = margins(limit, space.robot(space.x))
    ours = float(every.min()) if every.size else math.inf
    passed = ours >= -FEASIBLE
    sentence = f"least of {every.size} margins: {ours:.3e}"
    if core is not None:
        agrees = abs(core - ours) <= EQUAL * max(1.0, abs(ours))
        passed &= agrees
        sentence += ", equal to that of the core" if agrees else f", but {core:.9e} by the core"
    return Finding(f"limit: {limit.label}", passed, ours, sentence)


def _core_margins(space: DesignSpace) -> dict[str, float]:
    out: dict[str, float] = {}
    for name, margin, _ in space.problem.evaluate(space.x.tolist())["margins"]:
        out[name] = min(out.get(name, math.inf), float(margin))
    return out


def _neutral(space: DesignSpace) -> float:
    robot = space.robot(space.x)
    return float(condition_number(robot.geometry, robot.neutral, robot.length))


def _difference(ours: Floats, theirs: Floats) -> float:
    """Return the largest relative difference; numbers that are infinite on both sides agree."""
    if np.array_equal(ours, theirs):
        return 0.0
    with np.errstate(invalid="ignore"):
        apart = np.abs(ours - theirs) / np.abs(ours)
    return float(np.where(np.isfinite(apart), apart, math.inf).max())
