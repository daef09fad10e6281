"""Rows of a catalogue chosen with the design: branch and bound over combinations of rows.

A node fixes the rows of the first kinds of legs; the others may have all that any of their rows can do. Its study is
continuous, and no better design can come from rows that are fixed later: its objective is a bound, as far as a local
search finds its optimum. Best first, so that the first combination that is complete is the best one, and the second the
next best.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from functools import partial
from heapq import heappop, heappush
from typing import Any

from ninedof.design.actuators import LEG_KINDS, Actuator, hull, price_words, row_limits
from ninedof.design.domains.region import Region
from ninedof.design.study import Study
from ninedof.optimize.actuator_choice import EACH, ActuatorChoice, Combination, notes_of
from ninedof.optimize.candidate import Candidate, best_of
from ninedof.optimize.result import Result, Status

FEW = 4  # starts of a study of the search, besides those from the studies before it
ROUNDING = 1e-12  # of a price: sums of decimal prices are rounded
Rows = tuple[Actuator | None, ...]
"""A row for each group of legs; None where it may be any."""
Solve = Callable[[Study, Sequence[Candidate], str, bool], Result]
"""Solves a study, from other designs too; the words name it, and the flag asks why an infeasible one is."""


class SearchEnded(Exception):  # no error
    """Ctrl-C or the time limit ended a study, the argument."""


class ActuatorSearch:
    """The search for the rows of a study."""

    def __init__(self, study: Study, solve: Solve) -> None:
        """Take the rows that may be best."""
        self.study, self._solve = study, solve
        self.groups = [LEG_KINDS] if study.actuators_for == "all" else [(kind,) for kind in LEG_KINDS]
        own, region = study.actuators, study.objective.region
        best = [row for k, row in enumerate(own) if not any(_replaces(other, j, row, k) for j, other in enumerate(own))]
        needed = [max(least_travel(region, kind) for kind in kinds) if region else 0.0 for kinds in self.groups]
        self.rows = [[row for row in best if row.longest - row.shortest >= least] for least in needed]
        self.left_out = tuple(row.name for row in own if not any(row in rows for rows in self.rows))
        self.results: dict[Rows, Result] = {}
        self.passed_over = set[Rows]()
        self.seconds = 0.0

    def result(self) -> Result:
        """Return the best design with its rows, that of an interrupted search, or why there is none.

        Every further call passes over the rows that the ones before it chose.
        """
        try:
            choices = self._best_first() if all(self.rows) else []
            result = self._chosen(choices) if choices else self._nothing_fits()
            self.passed_over.update(choices[:1])
        except SearchEnded as end:
            result = self._so_far(end.args[0])
        except KeyboardInterrupt:  # between two studies
            if not self.results:
                raise
            result = self._so_far(replace([*self.results.values()][-1], interrupted=True))
        return replace(result, seconds=self.seconds)

    def _best_first(self) -> list[Rows]:
        """Return the best combination and the next best; fewer where no others have a design."""
        choices: list[Rows] = []
        heap: list[tuple[float, float, list[int], Rows]] = []

        def push(value: float, rows: Rows) -> None:
            if value < math.inf and self._is_within_price(rows):
                order = [some.index(row) for some, row in zip(self.rows, rows, strict=True) if row is not None]
                heappush(heap, (float(f"{value:.6g}"), self._least_price(rows), order, rows))  # equal ones by price

        nothing = (None,) * len(self.groups)
        root = self._ask(nothing)
        push(self._value(root), nothing)
        if root.best is not None and self._is_within_price(guess := self._guess(root)):
            self._ask(guess)  # a design to begin with, should the search be interrupted
        while heap and len(choices) < 2:
            bound, *_, rows = heappop(heap)
            fixed = _fixed(rows)
            # The question about the last row alone is one that many combinations have in common.
            question = next((one for one in (_only(rows, fixed[-1:]), rows) if one not in self.results), None)
            if question is not None:
                push(max(bound, self._value(self._ask(question), None not in question)), rows)
            elif None not in rows:
                choices += [rows] * (rows not in self.passed_over)
            else:
                for row in self.rows[g := len(fixed)]:
                    more = (*rows[:g], row, *rows[g + 1 :])
                    known = [one for one in (_only(more, [g]), more) if one in self.results]  # more: the guess
                    values = (self._value(self.results[one], None not in one) for one in known)
                    push(max([bound, *values]), more)
        return choices

    def _guess(self, root: Result) -> Rows:
        """Return the rows that are nearest to the best design of all."""
        every = zip(self.groups, self.rows, strict=True)
        return tuple(max(rows, key=partial(self._least_margin, root, kinds)) for kinds, rows in every)

    def _is_within_price(self, rows: Rows) -> bool:
        most = self.study.greatest_price
        return most is None or self._least_price(rows) <= most * (1.0 + ROUNDING)

    def _least_price(self, rows: Rows) -> float:
        every = zip(self.groups, self.rows, rows, strict=True)
        return sum(
            EACH * len(kinds) * min(one.price or 0.0 for one in (some if row is None else [row]))
            for kinds, some, row in every
        )

    def _ask(self, rows: Rows) -> Result:
        if rows not in self.results:
            hulls = [hull(rows) for rows in self.rows]
            study = self.study.with_actuators(self._by_kind([a or b for a, b in zip(rows, hulls, strict=True)]))
            # Less strict questions that are solved before, whatever the order of the search.
            fixed = _fixed(rows)
            parts = dict.fromkeys(_only(rows, some) for some in (fixed[:0], fixed[:-1], fixed[-1:]))
            before = [self.results[part].best for part in parts if part in self.results]
            warm = [best for best in before if best is not None]
            names = ", ".join("any" if row is None else row.name for row in rows)
            self.results[rows] = self._solved(study, warm, names)
        return self.results[rows]

    def _solved(
        self, study: Study, warm: Sequence[Candidate], names: str, most_starts: int = FEW, explain: bool = False
    ) -> Result:
        study = study.with_solver(min(most_starts, self.study.starts))
        result = self._solve(study, warm, f"actuators {names} ({len(self.results)} solved)", explain)
        self.seconds += result.seconds
        return result

    def _value(self, result: Result, complete: bool = False) -> float:
        """Return the bound that a study is, infinite where it is infeasible; one without an optimum is no bound."""
        if result.best is None:
            return math.inf if complete or result.status == Status.INFEASIBLE else 0.0
        if result.region is not None and not result.region.keeps_limits:
            return math.inf if complete else 0.0
        return result.best.objective if complete or result.status == Status.OPTIMAL else 0.0

    def _by_kind(self, rows: Sequence[Actuator]) -> dict[str, Actuator]:
        return {kind: row for kinds, row in zip(self.groups, rows, strict=True) for kind in kinds}

    def _combination(self, rows: Rows, result: Result) -> Combination:
        by_kind = self._by_kind([row for row in rows if row is not None])
        return Combination(**by_kind, objective=best_of(result).objective)

    def _with_choice(self, result: Result, rows: Rows, next_best: Rows | None) -> Result:
        other = None if next_best is None else self._combination(next_best, self.results[next_best])
        count = math.prod(map(len, self.rows))
        chosen = self._combination(rows, result)
        choice = ActuatorChoice(chosen, other, count, len(self.results), self.left_out, notes_of(self.study))
        return replace(result, actuators=choice, study=result.study.with_solver(self.study.starts))

    def _chosen(self, choices: Sequence[Rows]) -> Result:
        rows, result = choices[0], self.results[choices[0]]
        names = ", ".join(row.name for row in rows if row)
        again = self._solved(result.study, result.candidates[:1], names, most_starts=self.study.starts)
        if self._value(again, complete=True) <= self._value(result, complete=True) * (1.0 + 1e-9):
            result = again
        return self._with_choice(result, rows, choices[1] if len(choices) > 1 else None)

    def _so_far(self, ended: Result) -> Result:
        """Return the best complete combination that was solved before the end; none before the first."""
        left = {rows: result for rows, result in self.results.items() if None not in rows}
        values = {rows: self._value(result, True) for rows, result in left.items() if rows not in self.passed_over}
        best = min(values, key=lambda rows: values[rows], default=())
        words = f"the search of actuators ended after {len(self.results)} studies"
        how: dict[str, Any] = {"status": Status.STOPPED, "interrupted": ended.interrupted}
        if values.get(best, math.inf) == math.inf:
            reason = f"{words}, before a combination was solved"
            return self._without_design(ended, reason=reason, **how)
        reason = f"{words}: other combinations may be better"
        return self._with_choice(replace(self.results[best], reason=reason, **how), best, None)

    def _nothing_fits(self) -> Result:
        """Return why no rows fit: of each kind of legs the nearest row, and the limit that fails."""
        unsure = any(one.best is None and one.status != Status.INFEASIBLE for one in self.results.values())
        status = Status.STOPPED if unsure else Status.INFEASIBLE
        if self.passed_over:  # some rows fit: whoever passed over them knows why
            return self._without_design(next(iter(self.results.values())), status=status)
        free = self._solved(self.study.with_actuators({}), (), "none", explain=True)
        if free.best is None:
            return replace(free, study=self.study, reason=f"without limits of actuators too: {free.reason}")
        reasons: list[str] = []
        causes: dict[str, None] = {}
        for kinds in self.groups:
            rows = sorted(self.study.actuators, key=lambda row: -self._least_margin(free, kinds, row))
            studies = [self.study.with_actuators(dict.fromkeys(kinds, row)) for row in rows]
            alone = [self._solved(one, free.candidates[:1], row.name) for one, row in zip(studies, rows, strict=True)]
            if any(result.best is not None for result in alone):
                continue
            if any(result.status != Status.INFEASIBLE for result in alone):
                status = Status.STOPPED
                reasons.append(f"no row is known to fit the {' and '.join(kinds)} legs: more starts may find a design")
            else:
                nearest = self._solved(studies[0], free.candidates[:1], rows[0].name, explain=True)
                which = f"no row fits the {' and '.join(kinds)} legs; the nearest, {rows[0].name}"
                reasons.append(f"{which}: {nearest.reason}")
                causes |= dict.fromkeys(nearest.causes)
        if not reasons:
            most, least = self.study.greatest_price, self._least_price((None,) * len(self.groups))
            price = "" if most is None else f" of at most {price_words(most)}"
            cheapest = "" if most is None else f"; the cheapest costs {price_words(least)}"
            reasons = [f"rows fit each kind of legs, but no combination{price} does{cheapest}"]
        if unsure:
            reasons.append("not every study of the search came to an answer: more starts may find a design")
        why = {"reason": "; ".join(reasons), "causes": tuple(causes) or ("actuators",)}
        return self._without_design(free, status=status, **why)

    def _without_design(self, result: Result, **how: Any) -> Result:
        return replace(result, candidates=(), region=None, study=self.study, **how)

    def _least_margin(self, free: Result, kinds: Sequence[str], row: Actuator) -> float:
        """Return the least margin of the limits of a row at the poses and the design of a study without them."""
        limits = {name: limit for kind in kinds for name, limit in row_limits(kind, row, free.study.stated).items()}
        point = replace(free.solved, constraints=limits).evaluate(best_of(free).variables)
        return float(min(point.margins.values()))


def _fixed(rows: Rows) -> list[int]:
    return [g for g, row in enumerate(rows) if row is not None]


def _only(rows: Rows, groups: Collection[int]) -> Rows:
    """Return a combination with the rows of some groups alone."""
    return tuple(row if g in groups else None for g, row in enumerate(rows))


def _replaces(other: Actuator, j: int, row: Actuator, k: int) -> bool:
    """Whether another row makes one superfluous: of two that are equal the second is."""
    return j != k and other.is_as_good_as(row) and (j < k or not row.is_as_good_as(other))


def least_travel(region: Region, kind: str) -> float:
    """Return a length by which a leg of a kind changes over a region, whatever the design: 0 where none is known.

    Its end moves through a ball about the neutral position: from a point outside of it the nearest and the farthest
    points of the ball are a diameter apart, and a leg whose other end is inside would have no length.
    """
    rule = region.internal_point
    moves = {"external": True, "upper": rule == "held", "lower": rule == "shifted"}[kind]
    if not moves or region.unit != "length":
        return 0.0
    return 2.0 * min(region.box or region.cylinder or ((region.ball or 0.0),))
