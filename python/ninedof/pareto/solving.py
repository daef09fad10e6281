"""Solves one study for many values of a limit, with the designs of neighbouring limits as additional starts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from ninedof.design.study import Study
from ninedof.optimize.optimize import optimize
from ninedof.optimize.pieces import Pieces
from ninedof.optimize.result import Result, Status
from ninedof.pareto.front import SAME, objective_of
from ninedof.pareto.limits import tightest_first, unit_of, with_limit
from ninedof.support.running import Progress
from ninedof.support.store import Store
from ninedof.support.units import amount, degrees_of

BETTER = 1e-12  # relative: what the objective of an optimum must gain to replace another


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
        self.open_ended: Result | None = None
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
            self.open_ended = result
            return result
        old = self.results.get(limit)
        if old is None or _rank(result) < _rank(old, better_by=BETTER):
            self.results[limit] = result
        return self.results[limit]

    def optimum(self, study: Study, warm: Sequence[Result] = ()) -> Result:
        """Return the result of a study, whether it is one of the limits or not."""
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
            beside = [self.results.get(limits[j]) for j in (k - 1, k + 1, k) if 0 <= j < len(limits)]
            self.solve(limits[k], beside, few=limits[k] in self._thorough)

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
