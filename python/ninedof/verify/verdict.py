"""`check`: a result re-examined without believing the solver."""

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
from ninedof.support.arrays import Floats
from ninedof.verify.aim import Aim
from ninedof.verify.perturbation import SCALES, perturb
from ninedof.verify.robot import Places
from ninedof.verify.rules import Limit, limits_of, margins
from ninedof.verify.stationarity import stationarity

EQUAL = 1e-9  # relative: two ways to one number
FEASIBLE = 1e-8  # by how much a margin may be negative
STATIONARY = 1e-6
BETTER = 1e-8  # relative: less is rounding and the tolerance of the limits
BOUND = 1e-7  # close to 1 a condition number is good to half the digits only


@dataclass(frozen=True)
class Finding:
    """One thing that was tested."""

    name: str
    passed: bool
    figure: float
    """The number the verdict rests on; the sentence says what it is."""
    sentence: str


@dataclass(frozen=True)
class Check:
    """What a check of a result found."""

    findings: tuple[Finding, ...]
    title: str = ""

    @property
    def passed(self) -> bool:
        """Whether every test was passed."""
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

    def report(self) -> str:
        """Return what was tested and how it went, one line a test."""
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
    """Examine the best design of a result without believing the solver.

    Condition numbers come from the general path, constraints from their definitions in plain numpy. The claim of an
    optimum is tested twice: by the least convex combination of all active gradients, ties of singular values included,
    and by random steps of six sizes. Last come the lower bounds that hold for the design.

    Parameters
    ----------
    result : Result
        One with a design. Where its status is not "optimal" it claims no optimum, and none is tested.
    perturbations : int
        Random steps from the design, from 1e-1 to 1e-6 of each variable (of l_c, where that is larger).
    seed : int
        Of the steps.

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
    for name, value in (("perturbations", perturbations), ("seed", seed)):
        if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 0:
            raise ValueError(f"{name}: got {value!r}, expected a whole number of at least 0")
    title = f"check of a design of the {result.study.family} family"
    return Check(tuple(_findings(result, int(perturbations), int(seed))), title)


def _findings(result: Result, count: int, seed: int) -> Iterator[Finding]:
    best: Any = result.best
    study = result.study
    places, aim, limits = Places(study, best.variables), Aim.of(study), limits_of(study)
    yield _design(places, best)
    yield from _numbers(places, aim, best)
    core = _core_margins(places)
    worst = 0.0
    for limit in limits:
        finding = _limit(places, limit, core.get(limit.name))
        worst = max(worst, -finding.figure)
        yield finding
    if str(result.status) == "optimal":
        found = stationarity(places, aim, limits)
        sentence = (
            f"{found.gradients} gradients of the objective and {found.limits} limits and bounds balance to "
            f"{found.residual:.1e} of the objective per unit of relative change, {STATIONARY:.0e} allowed"
        )
        yield Finding("stationarity", found.residual <= STATIONARY, found.residual, sentence)
        tried = perturb(places, aim, limits, count, seed, max(worst, 1e-12))
        sentence = (
            f"of {tried.tried} steps of {SCALES[0]:g} to {SCALES[-1]:g} of the variables, {tried.better} lead to "
            f"something better, {'one' if tried.best > BETTER else 'none'} of it within the limits"
            + (f" and by {tried.best:.1e}" if tried.best > BETTER else "")
        )
        yield Finding("perturbations", tried.best <= BETTER, tried.best, sentence)
    neutral = _neutral(places)
    for bound in applicable_bounds(result):
        above = neutral / bound.value - 1.0
        proof = "proved" if bound.proved else "searched"
        yield Finding(f"bound: {bound.name}", above >= -BOUND, above, f"{above:.2%} above; {bound.sentence} ({proof})")


def _design(places: Places, best: Any) -> Finding:
    """Hold the variables against their bounds and against the geometry that is returned."""
    outside = np.maximum(places.low - places.x, places.x - places.high) / places.size
    figure = max(float(outside.max()), 0.0)
    robot = places.robot(places.x)
    g, h = robot.geometry, best.geometry
    apart = max(float(np.abs(getattr(g, name) - getattr(h, name)).max()) for name in TRIPLES)
    same = apart <= EQUAL * float(max(np.abs(getattr(g, name)).max() for name in TRIPLES))
    same &= np.allclose(robot.neutral.position, best.configuration.position, rtol=EQUAL, atol=0.0)
    same &= np.allclose(robot.neutral.internal_point, best.configuration.internal_point, rtol=EQUAL, atol=0.0)
    same &= np.allclose(robot.neutral.rotation, best.configuration.rotation, rtol=0.0, atol=EQUAL)
    words = "describe the joints returned" if same else "do NOT describe the joints returned"
    sentence = f"{len(places.names)} variables within their bounds to {figure:.1e}, {words}"
    return Finding("design", bool(same) and figure <= FEASIBLE, figure, sentence)


def _numbers(places: Places, aim: Aim, best: Any) -> Iterator[Finding]:
    robot = places.robot(places.x)
    poses = np.asarray(condition_number(robot.geometry, robot.poses, robot.length))
    ours = np.append(poses, _neutral(places))
    theirs = np.append(np.asarray(best.conditions, dtype=np.float64), best.condition_number)
    figure = _difference(ours, theirs) if ours.shape == theirs.shape else math.inf
    sentence = (
        f"{len(ours)} of J' by the general path, {ours.min():.6f} to {ours.max():.6f}: off by {figure:.1e} at most"
    )
    yield Finding("condition numbers", figure <= EQUAL * float(ours.max()), figure, sentence)
    values = aim.values(robot)
    total = aim.total(values)
    figure = _difference(np.array([total]), np.array([best.objective]))
    words = aim.aggregate.replace("_", " ")
    where = "1 pose" if len(values) == 1 else f"{len(values)} poses"
    sentence = f"{words} {aim.index.replace('_', ' ')} of {where}: {total:.9g}, off by {figure:.1e}"
    yield Finding("objective", figure <= EQUAL * max(1.0, float(ours.max())), figure, sentence)
    if math.isfinite(aim.condition_limit):
        margin = float(np.log(aim.condition_limit / poses.max()))
        sentence = f"worst condition number {poses.max():.6f}, limit {aim.condition_limit:g}"
        yield Finding("condition_limit", margin >= -FEASIBLE, margin, sentence)


def _limit(places: Places, limit: Limit, core: float | None) -> Finding:
    """Test a limit, and the study's own margin against the one that the definition gives."""
    every = margins(limit, places.robot(places.x))
    ours = float(every.min()) if every.size else math.inf
    passed = ours >= -FEASIBLE
    sentence = f"least of {every.size} margins {ours:.3e}"
    if core is not None:
        agrees = abs(core - ours) <= EQUAL * max(1.0, abs(ours))
        passed &= agrees
        sentence += ", as the study has it" if agrees else f", but the study has {core:.9e}"
    return Finding(f"limit: {limit.name}", passed, ours, sentence)


def _core_margins(places: Places) -> dict[str, float]:
    out: dict[str, float] = {}
    for name, margin, _ in places.problem.evaluate(places.x.tolist())["margins"]:
        out[name] = min(out.get(name, math.inf), float(margin))
    return out


def _neutral(places: Places) -> float:
    robot = places.robot(places.x)
    return float(condition_number(robot.geometry, robot.neutral, robot.length))


def _difference(ours: Floats, theirs: Floats) -> float:
    """Return the largest relative difference; numbers that are infinite on both sides agree."""
    if np.array_equal(ours, theirs):
        return 0.0
    with np.errstate(invalid="ignore"):
        apart = np.abs(ours - theirs) / np.abs(ours)
    return float(np.where(np.isfinite(apart), apart, math.inf).max())
