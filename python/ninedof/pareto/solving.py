"""Solves one study for many values of a limit, with the designs of neighbouring limits as additional starts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from ninedof.design.study import Study
from ninedof.optimize.optimize import optimize
from ninedof.optimize.result import Result, Status, result_from
from ninedof.pareto.front import SAME, objective_of
from ninedof.pareto.limited import limited, unit_of
from ninedof.support.angles import degrees_of
from ninedof.support.files import from_json_array, json_array
from ninedof.support.progress import Progress
from ninedof.support.store import Store
from ninedof.support.units import amount

WORDS = "words"  # name of a result in the store: its JSON


class Interrupted(Exception):  # ends the computation, not an error
    """Ctrl-C was pressed while a limit was being solved."""


class Sweep:
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
        self._threads, self._progress = threads, progress
        self._store, self._optimized = store, 0
        self._solved, self.planned = 0, 0

    def solve(self, limit: float | None, warm: Iterable[Result | None] = (), few: bool = False) -> Result:
        """Solve for one limit (None: no limit) and store the best result.

        Parameters
        ----------
        limit : float or None
        warm : results
            Their designs are additional starts.
        few : bool
            Whether the starts are others and fewer: the limit was solved before, or is only looked at.

        """
        study = limited(self.study, self.against, limit)
        if few:
            study = study.with_solver(max(1, study.starts // 4), study.seed + 1)
        known = [result for result in warm if result is not None and result.candidates]
        result, anew = self._result(study, known)
        self._solved += 1
        if self._progress is not None and anew:
            value = objective_of(result)
            self._progress(self._solved, max(self.planned, self._solved), None if math.isnan(value) else value)
        if limit is None:
            self.open_ended = result
            return result
        old = self.results.get(limit)
        if old is None or _rank(result) < _rank(old, better_by=1e-12):
            self.results[limit] = result
        return self.results[limit]

    def optimum(self, study: Study) -> Result:
        """Solve a study that is none of the limits."""
        return self._result(study, [])[0]

    def _result(self, study: Study, warm: list[Result]) -> tuple[Result, bool]:
        """Return the next result, and whether it was computed and not found in the store."""
        number = self._optimized
        self._optimized += 1
        if self._store is not None and (kept := self._store.read(number)) is not None:
            return result_from(study, from_json_array(kept[WORDS])), False
        result = optimize(study, threads=self._threads, warm=warm or None)
        if result.interrupted:
            raise Interrupted
        if self._store is not None:
            self._store.keep(number, {WORDS: json_array(result.to_dict())})
        return result, True

    def both_ways(self, limits: Sequence[float]) -> None:
        """Solve from the loosest limit to the tightest and back; limits in increasing order.

        The pass to tighter limits starts from designs that violate the new limit slightly, the pass back from allowed
        designs, so that a looser limit does not have a worse result.
        """
        self.planned = self._solved + 2 * len(limits)
        for k in reversed(range(len(limits))):
            self.solve(limits[k], self._beside(limits, k))
        for k in range(len(limits)):
            self.solve(limits[k], self._beside(limits, k), few=True)

    def between(self, low: float, high: float) -> float:
        """Solve for the geometric mean of two limits, starting from both designs; return it."""
        middle = math.sqrt(low * high)
        self.solve(middle, (self.results.get(low), self.results.get(high)))
        return middle

    def repair(self) -> None:
        """Solve again, or take over the design of a tighter limit, where a looser limit has a worse design."""
        best: tuple[float, Result] | None = None
        for limit in sorted(self.results):
            if best is not None and self._is_worse(limit, best[1]):
                self.solve(limit, [best[1]], few=True)
                if self._is_worse(limit, best[1]):
                    self.results[limit] = _adopted(
                        best[1], limited(self.study, self.against, limit), self._words(best[0])
                    )
            if not math.isnan(objective_of(self.results[limit])):
                best = limit, self.results[limit]

    def _is_worse(self, limit: float, tighter: Result) -> bool:
        result = self.results[limit]
        if result.status == Status.UNBOUNDED:
            return False
        return not objective_of(result) <= objective_of(tighter) * (1.0 + SAME)

    def _words(self, limit: float) -> str:
        unit = unit_of(self.study, self.against)
        return amount(f"{degrees_of(limit):g}", "deg") if unit == "rad" else amount(f"{limit:g}", unit)

    def _beside(self, limits: Sequence[float], k: int) -> list[Result | None]:
        return [self.results.get(limits[j]) for j in (k - 1, k + 1, k) if 0 <= j < len(limits)]


def _rank(result: Result, better_by: float = 0.0) -> tuple[int, float]:
    """Return a sort key: unbounded first, then optima by objective, then other designs, then no design."""
    if result.status == Status.UNBOUNDED:
        return 0, -math.inf
    if result.best is None or result.status == Status.INFEASIBLE:
        return 2, 0.0
    return int(result.status != Status.OPTIMAL), result.best.objective * (1.0 - better_by)


def _adopted(result: Result, study: Study, limit: str) -> Result:
    """Return the design of a tighter limit as the result of a looser one, not as an optimum."""
    reason = f"the design found for the limit {limit} is better than all found for this one, so it is used here too"
    return replace(result, study=study, status=Status.STOPPED, reason=reason)
