"""The range of a limit: from the tightest with a useful design to the loosest that is active."""

from __future__ import annotations

import math
from dataclasses import replace

from ninedof.optimize.result import Result, Status
from ninedof.pareto.front import objective_of
from ninedof.pareto.limited import CONDITION_LIMIT, floor_of, own_value, value_at
from ninedof.pareto.solving import Sweep

MOST_OBJECTIVE = 3.0  # times the best objective: designs above it are ignored
NEAR_LEAST = 1.002  # times the least condition number; at 1 only one design is left
STEPS_DOWN = 12  # halvings
BISECTIONS, IN_REGIONS = 6, 4  # a study over a region takes seconds


def span(sweep: Sweep) -> tuple[float, float] | None:
    """Return the tightest and the loosest limit to solve, or None if no design exists.

    The loosest limit is the value of the best design without the limit. The tightest is, to a few per cent, the least
    limit that allows a design with an objective of at most three times the best.

    Raises
    ------
    ValueError
        If the study is unbounded without the limit and has no value for it: the limits then have no scale.

    """
    sweep.planned = 4 + BISECTIONS
    if sweep.against == CONDITION_LIMIT:
        return _between_indices(sweep)
    open_ended = sweep.solve(None)
    if open_ended.status == Status.INFEASIBLE:
        return None
    high = _loosest(sweep, open_ended)
    best = sweep.solve(high, [open_ended])
    if math.isnan(objective_of(best)):
        return None
    return _tightest(sweep, high, objective_of(best)), high


def _value_taken(sweep: Sweep, result: Result) -> float:
    """Return the least limit that allows the best design of a result."""
    assert result.best is not None
    if sweep.against == CONDITION_LIMIT:
        return max(result.best.conditions)
    study = replace(sweep.study, objective=result.solved.objective)
    return value_at(study, sweep.against, result.best.variables)


def _between_indices(sweep: Sweep) -> tuple[float, float] | None:
    """Return the range of the condition limit: just above its least value, up to the optimum of the other index.

    The other index alone may be unbounded or have an optimum of extreme size, so it gets a wide condition limit.
    """
    study = sweep.study
    plain = replace(study.objective, index="condition_number", aggregate="worst", condition_limit=None)
    least = sweep.optimum(replace(study, objective=plain))
    if least.status != Status.OPTIMAL or least.best is None:
        sweep.open_ended = least
        return None
    low = NEAR_LEAST * least.best.objective
    widest = sweep.solve(max(MOST_OBJECTIVE * low, low + 1.0), [least])
    if math.isnan(objective_of(widest)):
        sweep.open_ended = widest
        return None
    high = max(_value_taken(sweep, widest), low)
    sweep.solve(high, [widest])
    return low, high


def _loosest(sweep: Sweep, open_ended: Result) -> float:
    if not math.isnan(objective_of(open_ended)):
        return max(_value_taken(sweep, open_ended), floor_of(sweep.study, sweep.against))
    own = own_value(sweep.study, sweep.against)
    if own is None:
        raise ValueError(
            f"values: got None, expected limits to sweep: without a limit on {sweep.against} the study is "
            f"{open_ended.status}, so none can be derived ({open_ended.reason})"
        )
    return 4.0 * own


def _tightest(sweep: Sweep, high: float, objective: float) -> float:
    """Halve the limit until no useful design exists, then bisect for the last limit with one."""
    floor = floor_of(sweep.study, sweep.against)
    good, bad = high, None
    for _ in range(STEPS_DOWN):
        trial = max(0.5 * good, floor)
        if trial >= good:
            return good
        if not _is_useful(sweep, trial, good, objective):
            bad = trial
            break
        good = trial
    bisections = BISECTIONS if sweep.study.objective.region is None else IN_REGIONS
    for _ in range(bisections if bad is not None else 0):
        trial = math.sqrt(good * (bad or good))
        good, bad = (trial, bad) if _is_useful(sweep, trial, good, objective) else (good, trial)
    return good


def _is_useful(sweep: Sweep, limit: float, looser: float, objective: float) -> bool:
    few = sweep.study.objective.region is not None  # seconds each, and the limit is not one of the front
    value = objective_of(sweep.solve(limit, [sweep.results[looser]], few=few))
    return value <= MOST_OBJECTIVE * objective  # False for NaN, which means no design
