"""The range of a limit: from the tightest with a useful design to the loosest that is active."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from ninedof.optimize.reserve import FIRST, MOST, STEP
from ninedof.optimize.result import Result, Status
from ninedof.pareto.front import Front, limit_text, objective_of
from ninedof.pareto.limits import CONDITION_LIMIT, floor_of, own_value, value_of
from ninedof.pareto.solving import FrontSolver

MOST_OBJECTIVE = 3.0  # times the best objective: designs above it are ignored
WIDE = 4.0  # times the study's own limit: the loosest where the study is unbounded without it
NEAR_LEAST = 1.002  # times the least condition number; at 1 only one design is left
STEPS_DOWN = 12  # halvings; fewer steps of a tolerance
BISECTIONS, IN_REGIONS = 6, 4  # a study over a region takes seconds


def of_a_limit(solver: FrontSolver) -> tuple[float, float] | None:
    """Return the tightest and the loosest limit to solve, or None if no design exists.

    The loosest limit is the value of the best design without the limit. The tightest is, to a few per cent, the least
    limit that allows a design with an objective of at most three times the best.
    """
    without = solver.solve(None)
    if without.status == Status.INFEASIBLE:
        return None
    high = _loosest(solver, without)
    best = objective_of(solver.solve(high, [without]))
    floor = min(floor_of(solver.study, solver.against), high)
    return None if math.isnan(best) else (_tightest(solver, high, best, lambda good: max(0.5 * good, floor)), high)


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


def of_tolerances(solver: FrontSolver) -> tuple[float, float]:
    """Return the largest tolerance, to a tenth, that leaves a useful design, and 0: the machine as it is drawn."""
    drawn = solver.solve(0.0)
    if drawn.best is None or math.isnan(best := objective_of(drawn)):
        return 0.0, 0.0
    height = solver.study.zp(drawn.best.configuration)

    def larger(good: float) -> float:
        size = max(STEP * good, FIRST * height)
        return size if size <= MOST * height else good

    return _tightest(solver, 0.0, best, larger), 0.0


def between_indices(solver: FrontSolver) -> tuple[float, float] | None:
    """Return the range of the condition limit: just above its least value, up to the optimum of the other index.

    The other index alone may be unbounded or have an optimum of extreme size, so it gets a wide condition limit.
    """
    study = solver.study
    plain = replace(study.objective, index="condition_number", aggregate="worst", condition_limit=None)
    solver.open_ended = least = solver.optimum(replace(study, objective=plain))
    if least.status != Status.OPTIMAL or least.best is None:
        return None
    low = NEAR_LEAST * least.best.objective
    solver.open_ended = widest = solver.solve(max(MOST_OBJECTIVE * low, low + 1.0), [least])
    if math.isnan(objective_of(widest)) or widest.best is None:
        return None
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
