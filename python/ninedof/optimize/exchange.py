"""A study over a region of poses: a semi-infinite program, solved by exchange.

The limits and the index are imposed at a few poses first. The design found is searched over the whole region, and the
poses at which it is worse than it may be join. That is repeated until there are none.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.leg_limits import SPREADS
from ninedof.design.pose import Pose
from ninedof.design.region import Region
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.pieces import Pieces
from ninedof.optimize.region_mean import MOST_NODES, NODES, TOLERANCE, region_mean, uniform_poses
from ninedof.optimize.region_report import PASSED, RegionMean, RegionReport, posed
from ninedof.optimize.result import Candidate, Result, Status
from ninedof.optimize.warm import Warm
from ninedof.support.arrays import Floats

At = tuple[float, ...]
"""The six coordinates of a pose of a region."""
Cause = tuple[str, int]
"""The index, or a limit and its leg or pair of legs."""
Solve = Callable[[Study, int, Any], Result]

QUICK, DENSE = 4_000, 100_000  # poses of a search: while the design still moves, and at the end
MOST_ROUNDS = 60
SAME = 1e-6  # of the region: nearer poses are one
BRANCH = 0.25  # of the region: a pose where the same thing is worst, nearer than that, has only moved
NEAR = 1e-5  # relative: a pose where nothing is as near to its limit or to the worst does not rule
SETTLED = 25  # rounds after which poses are added only, so that the exchange comes to an end


@dataclass(frozen=True)
class Look:
    """A search of the region for where a design is worst."""

    objective: float
    objective_at: At
    margin: float
    limit: str
    looked_at: int
    worse: tuple[tuple[Cause, At], ...]
    """What is worse than it may be and where, the worst first."""


def optimize_region(
    study: Study, solve: Solve, warm: Warm | Iterable[Warm] | None, threads: int, pieces: Pieces
) -> Result:
    """Solve a region study by `solve`, which takes a study with poses, a number of starts and designs to start from.

    Starts and confidence of the result are those of the last round; evaluations and seconds are of all.
    """
    region = study.objective.region
    assert region is not None
    begin = perf_counter()
    ruling = [(("", 0), at) for at in first_poses(region)]
    mean = study.objective.aggregate != "worst"
    nodes = uniform_poses(region, NODES, study.seed) if mean else ()
    starts, thorough, evaluations = study.starts, False, 0
    result: Result | None = None
    look: Look | None = None
    average: RegionMean | None = None
    try:
        for rounds in range(1, MOST_ROUNDS + 1):
            poses = (*nodes, *(_pose(region, at, 0.0 if mean else 1.0) for _, at in ruling))
            found = solve(posed(study, poses), starts, warm)
            if found.best is None and starts < study.starts and not found.interrupted:
                found = solve(posed(study, poses), study.starts, warm)  # no verdict from a single start
            evaluations += found.evaluations
            if found.best is None and found.interrupted and result is not None:
                raise KeyboardInterrupt  # the round before has a design
            result, imposed, look = found, poses, None
            if found.best is None or found.interrupted:
                break
            look = search(study, poses, found.best, QUICK, rounds, threads, pieces)
            if not look.worse:
                look = search(study, poses, found.best, DENSE, rounds, threads, pieces)
            if not look.worse and (thorough or starts == 1 == study.starts):
                average = _mean(study, nodes, found.best, pieces) if mean else None
                if average is None or average.error <= TOLERANCE * average.value or len(nodes) >= MOST_NODES:
                    break
                nodes, average = uniform_poses(region, 2 * len(nodes), study.seed), None
                starts, warm, thorough = 1, found.candidates[:4], False
                continue
            # The last run from all starts has all poses: it shows whether another design is better with them.
            thorough = not look.worse
            starts, warm = (study.starts if thorough else 1), found.candidates[:4]
            ruling = _joined(region, ruling, look.worse, rounds > SETTLED)
    except KeyboardInterrupt:
        if result is None:
            raise
        look, result = None, replace(result, status=Status.STOPPED, interrupted=True)
    assert result is not None
    if result.interrupted and result.best is not None:
        reason = f"interrupted in round {rounds}; the best so far at the poses imposed, not an optimum of the region"
        result = replace(result, reason=reason)
    report = None
    if result.best is not None:
        if look is None:
            report = RegionReport(imposed, rounds, 0, result.best.objective, imposed[0], math.inf, "", average)
        else:
            if not look.worse:
                result, imposed = _only_ruling(study, result, imposed)
            elif result.status == Status.OPTIMAL:
                reason = f"after {rounds} rounds the design is still worse between the poses than at them"
                result = replace(result, status=Status.STOPPED, reason=reason)
            at = _pose(region, look.objective_at)
            report = RegionReport(imposed, rounds, look.looked_at, look.objective, at, look.margin, look.limit, average)
            if average is not None:
                best = result.candidates[0]
                stated = average.stated(best.objective, study.objective.mean_share)
                result = replace(result, candidates=(replace(best, objective=stated),))
    return replace(
        result,
        study=study,
        region=report,
        candidates=result.candidates[:1],
        evaluations=evaluations,
        seconds=perf_counter() - begin,
    )


def _mean(study: Study, nodes: tuple[Pose, ...], best: Candidate, pieces: Pieces) -> RegionMean:
    return RegionMean(**pieces.plain(lambda: dict(region_mean(study, nodes, best.variables).__dict__)))


def search(
    study: Study, imposed: tuple[Pose, ...], best: Candidate, samples: int, seed: int, threads: int, pieces: Pieces
) -> Look:
    """Search a region for where a design is worse than its limits and than at the imposed poses."""
    region = study.objective.region
    assert region is not None
    plain = replace(study, objective=replace(study.objective, poses=(), region=None)).problem()
    x = [best.variables[name] for name in plain.names]
    found = pieces.plain(lambda: _core.search_region(plain, region.for_core(), x, samples, seed, threads))
    limits = [
        (margin, (name, row), tuple(at))
        for name, row, margin, at in found["limits"]
        if name not in SPREADS and not name.endswith(" at neutral")
    ]
    extremes = [tuple(at) for at in (*found["longest_at"], *found["shortest_at"])]
    there = posed(study, tuple(_pose(region, at) for at in extremes))
    point = there.evaluate(best.variables)
    lengths = leg_lengths(point.geometry, point.configurations[-18:])
    limits += [(margin, (name, k), extremes[k]) for name, k, margin in _spreads(lengths, point.margins)]
    worse = [(-margin, cause, at) for margin, cause, at in limits if margin < -PASSED]
    may_be = worst_index(study, imposed, best)
    excess = [(logarithm - math.log(may_be), tuple(at)) for logarithm, at in found["index"]]
    worse += [(by, ("index", 0), at) for by, at in excess if by > PASSED]
    largest, largest_at = max((value, tuple(at)) for value, at in found["index"])
    margin, (limit, _), _ = min(limits, default=(math.inf, ("", 0), ()))
    ordered = sorted(worse, key=lambda entry: -entry[0])
    return Look(
        math.exp(largest), largest_at, margin, limit, found["poses"], tuple((cause, at) for _, cause, at in ordered)
    )


def worst_index(study: Study, imposed: tuple[Pose, ...], best: Candidate) -> float:
    """Return the largest index at the imposed poses; infinity where the objective is a mean alone."""
    objective = study.objective
    if objective.aggregate == "worst":
        return best.objective
    if objective.aggregate == "mean_inverse":
        return math.inf
    worst = replace(study, objective=replace(objective, aggregate="worst"))
    return float(posed(worst, imposed).evaluate(best.variables).objective)


def _only_ruling(study: Study, result: Result, poses: tuple[Pose, ...]) -> tuple[Result, tuple[Pose, ...]]:
    """Return a result without the poses that are far from deciding anything: it stays an optimum without them."""
    best = result.candidates[0]
    alone = replace(study, objective=replace(study.objective, aggregate="worst", poses=()))
    names = alone.problem().names
    variables = {name: value for name, value in best.variables.items() if name in names}
    single = [posed(alone, (pose,)).evaluate(variables) for pose in poses]
    mean, worst = study.objective.aggregate != "worst", worst_index(study, poses, best)
    lengths = np.array([leg_lengths(best.geometry, point.configurations[-1]) for point in single])
    extreme = (lengths >= lengths.max(axis=0) * (1.0 - NEAR)) | (lengths <= lengths.min(axis=0) * (1.0 + NEAR))
    # Limits of the design itself are the same at every pose.
    of_poses = [name for name, margin in single[0].margins.items() if any(p.margins[name] != margin for p in single)]
    ruling = tuple(
        pose
        for pose, point, ends in zip(poses, single, extreme.any(axis=1), strict=True)
        if ends
        or (mean and pose.weight > 0.0)
        or point.objective >= worst * (1.0 - NEAR)
        or min((point.margins[name] for name in of_poses), default=1.0) <= NEAR
    )
    count = len(study.objective.poses)
    kept = [*range(count), *(count + k for k, pose in enumerate(poses) if pose in ruling)]
    fewer = replace(
        best,
        conditions=tuple(best.conditions[k] for k in kept),
        configurations=best.configurations[[0, *(k + 1 for k in kept)]],
    )
    return replace(result, candidates=(fewer, *result.candidates[1:])), ruling


def _spreads(lengths: Floats, margins: Mapping[str, float]) -> Iterator[tuple[str, int, float]]:
    """Return, for limits that compare poses, the margin that each extreme pose has with the others.

    `lengths`, shape (18, 9), are those at the poses where each leg is longest, then where each is shortest; `margins`
    those of all poses together.
    """
    longest, shortest = np.diag(lengths[:9]), np.diag(lengths[9:])
    strokes, ratios = longest - shortest, longest / shortest
    # Shares of the largest spread that the limit is on, the longest legs first.
    shares = {
        "leg_ratio": [*(longest / longest.max()), *(shortest.min() / shortest)],
        "stroke": [*(strokes / max(strokes.max(), 1e-300))] * 2,
        "stroke_ratio": [*(ratios / ratios.max())] * 2,
    }
    for name in SPREADS:
        for k, share in enumerate(shares[name] if name in margins else ()):
            yield name, k, 1.0 - (1.0 - margins[name]) * float(share)


def _joined(
    region: Region, ruling: list[tuple[Cause, At]], worse: Sequence[tuple[Cause, At]], add_only: bool
) -> list[tuple[Cause, At]]:
    """Return the ruling poses with those where the design is worse; one that has only moved takes its old place."""
    reach = np.maximum(region.reach, 1e-300)

    def apart(one: At, other: At) -> float:
        return float(np.abs(np.subtract(one, other) / reach).max())

    out, joined = list(ruling), list[tuple[Cause, At]]()
    for cause, at in worse:
        if any(apart(at, other) <= SAME for _, other in out):
            continue
        if any(c == cause and apart(at, other) <= BRANCH for c, other in joined):
            continue  # a worse one of the same branch has joined
        joined.append((cause, at))
        near = [k for k, (c, other) in enumerate(out) if c == cause and apart(at, other) <= BRANCH]
        if near and not add_only:
            out[min(near, key=lambda k: apart(at, out[k][1]))] = (cause, at)
        else:
            out.append((cause, at))
    return out


def first_poses(region: Region) -> list[At]:
    """Return the coordinates of the neutral pose, the corners of the positions and the greatest tilts and yaws.

    On a path the pose half-way stands for the neutral one, which need not be on it.
    """
    reach = np.asarray(region.reach)
    corners: Iterable[tuple[float, ...]]
    if region.path is None:
        corners = itertools.product(*([-r, r] if r > 0.0 else [0.0] for r in reach[:3]))
    else:
        along = np.cumsum([0.0, *np.linalg.norm(np.diff(region.path, axis=0), axis=1)])
        corners = [(2.0 * float(at / along[-1]) - 1.0, 0.0, 0.0) for at in along]
    turns = [sign * r * np.eye(6)[k] for k, r in enumerate(reach) if k >= 3 and r > 0.0 for sign in (1.0, -1.0)]
    rows = [np.zeros(6), *(np.array([*corner, 0.0, 0.0, 0.0]) for corner in corners), *turns]
    # The corners of a ball and a cylinder are outside of them: the nearest poses of the region stand for them.
    nearest = _core.region_poses(region.for_core(), np.array(rows))[:, :6]
    return list(dict.fromkeys(tuple(row) for row in nearest.tolist()))


def _pose(region: Region, at: At, weight: float = 1.0) -> Pose:
    position, rotation, internal = _core.region_pose(region.for_core(), at)
    return Pose(position, rotation, internal, region.unit, weight)
