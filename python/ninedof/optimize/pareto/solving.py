"""Solving the limits of a front: each from its neighbours, and the range of those that are not given."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from ninedof.design.objective import CONDITION_LIMIT
from ninedof.design.study import Study
from ninedof.optimize.optimize import optimize
from ninedof.optimize.pareto.front import SAME, Front, limit_text, objective_of
from ninedof.optimize.pareto.limits import floor_of, own_value, tightest_first, unit_of, value_of, with_limit
from ninedof.optimize.pieces import Pieces
from ninedof.optimize.reserve import FIRST, MOST, STEP
from ninedof.optimize.result import Result, Status
from ninedof.support.kept.store import Store
from ninedof.support.running import Progress, notes_told
from ninedof.support.units import amount, degrees_of

BETTER = 1e-12  # relative: what the objective of an optimum must gain to replace another
MOST_OBJECTIVE = 3.0  # times the best objective: designs above it are ignored
WIDE = 4.0  # times the study's own limit: the loosest where the study is unbounded without it
NEAR_LEAST = 1.002  # times the least condition number; at 1 only one design is left
STEPS_DOWN = 12  # halvings; fewer steps of a tolerance
BISECTIONS, IN_REGIONS = 6, 4  # a study over a region takes seconds


class FrontSolver:
    """The limits solved so far and the best result for each.

    Every optimization follows from those before it, so an interrupted run is continued by doing everything again with
    the results that were kept: the same front, bit for bit.
    """

    def __init__(
        self, study: Study, against: str, threads: int | None, progress: Progress | None, store: Store | None = None
    ) -> None:
        """Begin without results, or with those of a store."""
        self.study, self.against = study, against
        self.results: dict[float, Result] = {}
        self._thorough: set[float | None] = set()
        self._threads, self._progress, self._pieces = threads, progress, Pieces(store)
        self._solved, self.planned = 0, 0

    def solve(self, limit: float | None, warm: Iterable[Result | None] = (), few: bool = False) -> Result:
        """Solve for one limit (None: none), with designs of results as additional starts, and store the best result.

        With `few` the starts are others and fewer: the limit was solved before, or is only looked at. Over a region,
        where a start is dear, one is enough besides the warm ones where all were tried before.
        """
        study = with_limit(self.study, self.against, limit)
        if few:
            known = limit in self._thorough and study.objective.region is not None
            study = study.with_solver(1 if known else max(1, study.starts // 4), study.seed + 1)
        else:
            self._thorough.add(limit)
        before = self._pieces.new_pieces
        result = self.optimum(study, [one for one in warm if one is not None and one.candidates])
        self._solved += 1
        if self._progress is not None and self._pieces.new_pieces > before:
            value = objective_of(result)
            self._progress(self._solved, max(self.planned, self._solved), None if math.isnan(value) else value)
        if limit is None:
            return result
        old = self.results.get(limit)
        if old is None or _rank(result) < _rank(old, better_by=BETTER):
            self.results[limit] = result
        return self.results[limit]

    def optimum(self, study: Study, warm: Sequence[Result] = ()) -> Result:
        """Return the result of a study, whether it is one of the limits or not."""
        with notes_told():
            result = self._pieces.result(study, lambda: optimize(study, threads=self._threads, warm=list(warm) or None))
        if result.interrupted:
            raise KeyboardInterrupt
        return result

    def both_ways(self, limits: Sequence[float]) -> None:
        """Solve from the loosest limit to the tightest and back; the tightest is given first.

        The pass to tighter limits starts from designs that violate the new limit slightly, the pass back from allowed
        designs, so that a looser limit does not have a worse result.
        """
        self.planned = self._solved + 2 * len(limits)
        for k in (*reversed(range(len(limits))), *range(len(limits))):
            beside = [self.results.get(limits[j]) for j in (k - 1, k + 1) if 0 <= j < len(limits)]
            known = limits[k] in self._thorough
            if known and not any(beside):  # nothing new to start from
                self.planned -= 1
                continue
            self.solve(limits[k], [*beside, self.results.get(limits[k])], few=known)

    def between(self, low: float, high: float) -> float:
        """Solve for the geometric mean of two limits, starting from both designs; return it."""
        middle = math.sqrt(low * high)
        self.solve(middle, (self.results.get(low), self.results.get(high)))
        return middle

    def repair(self) -> None:
        """Solve again, or take over the design of a tighter limit, where a looser limit has a worse design."""
        best: tuple[float, Result] | None = None
        for limit in tightest_first(self.against, self.results):
            if best is not None and self._is_worse(limit, best[1]):
                self.solve(limit, [best[1]], few=True)
                if self._is_worse(limit, best[1]):  # not an optimum of this limit
                    study, words = with_limit(self.study, self.against, limit), self._words(best[0])
                    reason = f"the design found for the limit {words} is better than all found for this one"
                    changes = {"study": study, "status": Status.STOPPED, "reason": f"{reason}, so it is used here too"}
                    self.results[limit] = replace(best[1], **changes)  # type: ignore[arg-type]
            if not math.isnan(objective_of(self.results[limit])):
                best = limit, self.results[limit]

    def _is_worse(self, limit: float, tighter: Result) -> bool:
        result = self.results[limit]
        unbounded = result.status == Status.UNBOUNDED
        return not unbounded and not objective_of(result) <= objective_of(tighter) * (1.0 + SAME)

    def _words(self, limit: float) -> str:
        unit = unit_of(self.study, self.against)
        return amount(f"{degrees_of(limit):g}", "deg") if unit == "rad" else amount(f"{limit:g}", unit)


def _rank(result: Result, better_by: float = 0.0) -> tuple[int, float]:
    """Return a sort key: unbounded first, then optima by objective, then other designs, then no design."""
    if result.status == Status.UNBOUNDED:
        return 0, -math.inf
    if result.best is None or result.status == Status.INFEASIBLE:
        return 2, 0.0
    return int(result.status != Status.OPTIMAL), result.best.objective * (1.0 - better_by)


Ends = tuple[float, float] | Result
"""The tightest and the loosest limit to solve, or the result that says why there are none."""


def of_a_limit(solver: FrontSolver) -> Ends:
    """Return the limits between which designs are to be looked for.

    The loosest limit is the value of the best design without the limit. The tightest is, to a few per cent, the least
    limit that allows a design with an objective of at most three times the best.
    """
    without = solver.solve(None)
    if without.status == Status.INFEASIBLE:
        return without
    high = _loosest(solver, without)
    best = objective_of(solver.solve(high, [without]))
    floor = min(floor_of(solver.study, solver.against), high)
    return without if math.isnan(best) else (_tightest(solver, high, best, lambda good: max(0.5 * good, floor)), high)


def range_words(front: Front) -> str:
    """Return where the limits of a front that were not given end, and what is beyond; "" where no design is there."""
    with_design = [x for x, value in zip(front.limits, front.objectives, strict=True) if not math.isnan(value)]
    if not with_design or front.limit_name == CONDITION_LIMIT:
        return ""
    first, last = (limit_text(front, x) for x in (with_design[0], front.limits[-1]))
    words = []
    if front.of_tolerances or with_design[0] > _scale(front) * floor_of(front.study, front.limit_name) * (1.0 + 1e-9):
        beyond = "Larger tolerances" if front.of_tolerances else f"Limits below {first}"
        end = f"no design was found, or only some of {MOST_OBJECTIVE:g} times the least objective and more"
        words.append(f"{beyond} may have designs too: the rows end, roughly, where {end}.")
    own = None if front.of_tolerances else own_value(front.study, front.limit_name)
    is_multiple = own is not None and math.isclose(front.limits[-1], WIDE * _scale(front) * own)  # and of no design
    if not (front.of_tolerances or front.study.tolerances or is_multiple):
        words.append(f"From {last} on nothing changes: the best design without this limit keeps it.")
    return " ".join(words)


def _scale(front: Front) -> float:
    """Return by what the limits of a front are larger than those of its studies."""
    return math.degrees(1.0) if front.unit == "deg" else 1.0


def of_tolerances(solver: FrontSolver) -> Ends:
    """Return the largest tolerance, to a tenth, that leaves a useful design, and 0: the machine as it is drawn."""
    drawn = solver.solve(0.0)
    if drawn.best is None or math.isnan(best := objective_of(drawn)):
        return 0.0, 0.0
    height = solver.study.zp(drawn.best.configuration)

    def larger(good: float) -> float:
        size = max(STEP * good, FIRST * height)
        return size if size <= MOST * height else good

    return _tightest(solver, 0.0, best, larger), 0.0


def between_indices(solver: FrontSolver) -> Ends:
    """Return the range of the condition limit: just above its least value, up to the optimum of the other index.

    The other index alone may be unbounded or have an optimum of extreme size, so it gets a wide condition limit.
    """
    study = solver.study
    plain = replace(study.objective, index="condition_number", aggregate="worst", condition_limit=None)
    least = solver.optimum(replace(study, objective=plain))
    if least.status != Status.OPTIMAL or least.best is None:
        return least
    low = NEAR_LEAST * least.best.objective
    widest = solver.solve(max(MOST_OBJECTIVE * low, low + 1.0), [least])
    if math.isnan(objective_of(widest)) or widest.best is None:
        return widest
    high = max(*widest.best.conditions, low)
    solver.solve(high, [widest])
    return low, high


def _loosest(solver: FrontSolver, without: Result) -> float:
    if not math.isnan(objective_of(without)) and without.best is not None:
        return max(value_of(solver.study, solver.against, without), floor_of(solver.study, solver.against))
    own = own_value(solver.study, solver.against)
    if own is None:
        raise ValueError(
            f"values: got None, expected limits to sweep: without a limit on {solver.against} the study is "
            f"{without.status}, so none can be derived ({without.reason})"
        )
    return WIDE * own


def _tightest(solver: FrontSolver, loose: float, objective: float, tighter: Callable[[float], float]) -> float:
    """Tighten the limit until no useful design exists, then bisect for the last limit with one."""
    in_region = solver.study.objective.region is not None  # seconds each, and the limit is not one of the front

    def is_useful(limit: float, looser: float) -> bool:
        value = objective_of(solver.solve(limit, [solver.results[looser]], few=in_region))
        return value <= MOST_OBJECTIVE * objective  # False for NaN, which means no design

    good = loose
    for _ in range(STEPS_DOWN):
        bad = tighter(good)
        if bad == good:
            return good
        if not is_useful(bad, good):
            break
        good = bad
    else:
        return good
    for _ in range(IN_REGIONS if in_region else BISECTIONS):
        trial = math.sqrt(good * bad) or bad / STEP
        good, bad = (trial, bad) if is_useful(trial, good) else (good, trial)
    return good
