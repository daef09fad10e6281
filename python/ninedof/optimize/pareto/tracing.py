"""`pareto`: the front of a study's objective against one of its limits."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace
from time import perf_counter

import numpy as np

from ninedof.design.objective import CONDITION_LIMIT
from ninedof.design.study import Study
from ninedof.optimize.pareto.front import Front, objective_of
from ninedof.optimize.pareto.limits import TOLERANCE, resolve, tightest_first, with_degrees, without_degrees
from ninedof.optimize.pareto.solving import BISECTIONS, FrontSolver, between_indices, of_a_limit, of_tolerances
from ninedof.optimize.result import Result, Status
from ninedof.support.arguments import finite, instance, items, path_argument, shown, whole
from ninedof.support.arrays import thread_argument
from ninedof.support.kept.store import Store
from ninedof.support.running import Progress, progress_argument
from ninedof.support.units import degrees_of

MOST_POINTS = 1000
FIRST = 0.6  # share of the points that is evenly spaced; the others go where the front is steep
SPANS = {CONDITION_LIMIT: between_indices, TOLERANCE: of_tolerances}


def pareto(
    study: Study,
    against: str,
    values: Sequence[float] | None = None,
    *,
    points: int = 13,
    threads: int | None = None,
    progress: Progress | None = None,
    out: str | os.PathLike[str] | None = None,
) -> Front:
    """Return the best objective for each value of a limit: a trade-off.

    One study is solved for many limits (the epsilon-constraint method), from loose to tight and back, each time from
    its own starts and from the designs of its neighbours. A looser limit never has a worse design. Ctrl-C returns the
    limits solved so far, with `interrupted` set.

    Parameters
    ----------
    study : Study
        Its own value of the limit is replaced; the min and the other options of the limit are kept.
    against : str
        A constraint with a max, by its name in studies ("leg_ratio at neutral" for the limit at the neutral pose
        alone; "base_cone_deg" for an angle in degrees), or a second index: with
        "condition_limit" the study's own index is minimized under limits on the condition number at every pose; with
        "speed" or "frobenius", for a study of the condition number, that index is minimized. "tolerance" is the price
        of accuracy: every machine within the tolerances keeps the limits, the larger one of joints and legs takes the
        values, and their ratio is that of the study's [tolerances] (alike where it has none).
    values : sequence of float, optional
        Limits to solve, in the unit of the constraint: radians for an angle, degrees with "base_cone_deg". The limits
        of the front are in the same unit. By default from the value of the best design without the limit down to the
        least limit with a design, evenly spaced in logarithms and closer together where the objective changes fast, and
        the largest limit found to be infeasible. Of a tolerance from 0 to the largest with a design, evenly spaced, and
        the least one found to be infeasible.
    points : int
        Number of limits with a design, if `values` is None; 13 by default.
    threads : int, optional
        One per processor by default. The result does not depend on it.
    progress : callable, optional
        Called as progress(solved so far, to be solved as far as known, last objective, None without a design), not for
        what is found in `out`.
    out : path, optional
        Folder in which every solved limit is kept, made if it is missing. The same call with the same folder continues
        there, however the last one ended, and gives the same front.

    Raises
    ------
    ValueError
        If an argument does not fit, if `out` holds something else, or if the study is unbounded without a limit, so
        that none can be derived.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.optimize.pareto import pareto
    >>> front = pareto(nd.Study.paper(), "radius_ratio", values=[1.5, 2.0, 3.0])
    >>> [round(value, 4) for value in front.objectives]
    [3.9412, 3.7627, 3.5486]

    """
    instance("study", study, Study).require_no_choice()
    progress_argument(progress)
    thread_argument(threads)
    whole("points", points, 2, MOST_POINTS)
    plain, degrees = without_degrees(against)
    for note in study.notes:
        warnings.warn(note, stacklevel=2)
    study, limit = resolve(replace(study), plain)  # a copy has no note of its own
    fixed = None if values is None else _values(values, limit, degrees)
    begin, interrupted, limits = perf_counter(), False, fixed
    question = {"study": study.to_dict(), "against": limit, "values": fixed, "points": points}
    with nullcontext() if out is None else Store(path_argument("out", out), question, 1) as store:
        solver = FrontSolver(study, limit, threads, progress, store)
        try:
            if fixed is None:
                limits = _trace(solver, points)
            else:
                solver.both_ways(fixed)
            solver.repair()
        except KeyboardInterrupt:
            interrupted = True
    order = tightest_first(limit, solver.results if limits is None else set(limits) & set(solver.results))
    results = tuple(solver.results[value] for value in order)
    labels = tuple(degrees_of(value) if degrees else value for value in order)
    return Front(study, against if degrees else limit, labels, results, interrupted, perf_counter() - begin)


def _values(values: Sequence[float], limit: str, degrees: bool) -> list[float]:
    """Return the limits, the tightest first, angles in radians."""
    limits = {finite(f"values[{k}]", value) for k, value in enumerate(items("values", values, "a sequence of limits"))}
    zero = limit == TOLERANCE  # the machine as it is drawn
    if not limits or min(limits) < 0.0 or (0.0 in limits and not zero):
        raise ValueError(
            f"values: got {shown(values)}, expected one or more limits {'from 0 on' if zero else 'above 0'}"
        )
    if not degrees and with_degrees(limit) != limit and max(limits) > math.pi:
        in_degrees = f'degrees are given with against="{with_degrees(limit)}"'
        raise ValueError(f"values: got {max(limits):g} radians, expected at most pi ({in_degrees})")
    return tightest_first(limit, (math.radians(value) if degrees else value for value in limits))


def _trace(solver: FrontSolver, count: int) -> list[float]:
    """Find the range, solve evenly spaced limits, then halve the widest gaps."""
    solver.planned = 4 + BISECTIONS
    ends = SPANS.get(solver.against, of_a_limit)(solver)
    if isinstance(ends, Result):  # one row with the reason: the study without the limit
        solver.results[math.inf] = ends
        return [math.inf]
    low, high = ends
    even, first = (np.linspace, count) if high < low else (np.geomspace, max(2, round(FIRST * count)))  # down to 0
    limits = [low, *even(low, high, first)[1:-1].tolist(), high] if abs(high - low) > 1e-6 * low else [high]
    solver.both_ways(limits)
    while 1 < len(limits) < count and (gap := _widest(solver, limits)) is not None:
        limits = sorted([*limits, solver.between(*gap)])
    order = tightest_first(solver.against, {*solver.results, low})
    edge = order[: order.index(low)][-1:]  # the next one that is tighter
    return [*edge, *limits] if edge and solver.results[edge[0]].status == Status.INFEASIBLE else limits


def _widest(solver: FrontSolver, limits: Sequence[float]) -> tuple[float, float] | None:
    """Return the neighbours farthest apart in limit and objective, each relative to its range; None if all are close.

    Gaps in the objective have three times the weight: steep parts get more points.
    """
    points = np.array(
        [(limit, value) for limit in limits if not math.isnan(value := objective_of(solver.results[limit]))]
    )
    if len(points) < 2:
        return None
    x, y = np.log(points).T
    apart = np.hypot(np.diff(x) / max(np.ptp(x), 1e-12), 3.0 * np.diff(y) / max(np.ptp(y), 1e-12))
    low, high = points[int(np.argmax(apart)) :, 0][:2].tolist()
    return (low, high) if high > low * (1.0 + 1e-4) else None
