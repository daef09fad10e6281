"""Optimum design: one call to the compiled solver."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

from ninedof import _core
from ninedof.chunks.store import Store
from ninedof.design.study import Study
from ninedof.optimize.exchange import optimize_region
from ninedof.optimize.exchange_placed import optimize_placed
from ninedof.optimize.pieces import Pieces
from ninedof.optimize.result import Candidate, Result, Status, candidate_from, result_from
from ninedof.optimize.rounds import Rounds
from ninedof.optimize.warm import Warm, listed, warm_starts
from ninedof.proof.optimum import GAPS, OptimumProof, left_out_of, prove_optimum
from ninedof.support.arguments import choice, flag, instance, path_argument
from ninedof.support.arrays import thread_argument
from ninedof.support.progress import Progress, phase, progress_argument
from ninedof.support.short import short_repr

LONGEST = 600.0  # seconds of a proof


def optimize(
    study: Study,
    starts: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    warm: Warm | Iterable[Warm] | None = None,
    *,
    certify: bool = False,
    out: str | os.PathLike[str] | None = None,
) -> Result:
    """Minimize the objective of a study: by default, the condition number.

    Multi-start sequential quadratic programming (NLopt's SLSQP) on the smooth minimax form of the problem, with exact
    gradients. Every end point is polished by Newton's method and checked independently of the solver. Ctrl-C stops
    within a fraction of a second and returns the best designs so far, with status "stopped".

    Parameters
    ----------
    study : Study
    starts, seed : int, optional
        In place of the study's own. If fewer than 16, and at most half, of the starts run to their end reach the best
        objective, as many starts again follow, up to four times `starts` in all: 256 by default. `starts = 1` is one.
    threads : int, optional
        One per processor by default. The result is the same, bit for bit, for any number.
    progress : callable, optional
        Called as progress(runs done, runs in all, best objective so far); infinite before a start has found a feasible
        design. A start is one run, or two where it is followed to its end after a short run. Runs in all grow where
        more starts follow, and, over a region, with every round; they count the last round from the first. If it has a
        method `phase`, that is called with a few words when a round begins.
    warm : Result, Candidate, mapping of names to values, or a sequence of them, optional
        Additional starts, tried first: a result of a similar study (its best four candidates), or a known design. They
        are moved inside the bounds.
    certify : bool
        Whether to prove afterwards how much better a design of the study can be at most, see `prove_optimum`:
        `Result.lower_bound` and `Result.proof`. Of hexagons to 1e-12 in a second or two, of other symmetric designs to
        3 per cent in minutes.
    out : path, optional
        Folder that keeps what is finished, made if it is missing: of a region study every round, of any study the
        result before its proof, and the proof. The same call with the same folder goes on there, however the last one
        ended, and gives the same result.

    Returns
    -------
    Result
        Infeasible and unbounded studies raise nothing: see `Status`.

    Raises
    ------
    ValueError
        If an argument does not fit; with `certify`, if no proof is known for the study; if `out` holds something else.

    Examples
    --------
    >>> import ninedof as nd
    >>> result = nd.optimize(nd.Study.paper(), certify=True)
    >>> result.status, round(result.condition_number, 6), result.active
    (<Status.OPTIMAL: 'optimal'>, 3.762659, ('a1', 'b2', 'radius_ratio'))
    >>> result.condition_number - result.lower_bound < 1e-11
    True

    """
    instance("study", study, Study)
    if study.length_note:
        warnings.warn(study.length_note, stacklevel=2)
    progress_argument(progress)
    study = study.with_solver(starts, seed)
    count = thread_argument(threads)
    if flag("certify", certify):
        left_out_of(study)  # raises where no proof is known, before the work
    given = listed(warm)
    if out is not None:
        out = path_argument("out", out)
        warm_starts(study, given)  # raises, before there is a folder
    question = {"kind": "optimize", "study": study.to_dict(), "warm": [dict(one) for one in given], "proof": certify}
    with nullcontext() if out is None else Store(out, question, 1) as store:
        pieces = Pieces(store)
        found = _optimized(study, count, progress, given, pieces)
        return (
            found if not certify or found.best is None or found.interrupted else _proved(found, count, progress, pieces)
        )


def _optimized(
    study: Study, threads: int, progress: Progress | None, warm: Sequence[Mapping[str, float]], pieces: Pieces
) -> Result:
    rounds = Rounds(progress, study.starts) if study.objective.region is not None and progress is not None else None

    def solve(posed: Study, starts: int, warm: Warm | Iterable[Warm] | None) -> Result:
        return pieces.result(posed, lambda: anew(posed, starts, warm))

    def anew(posed: Study, starts: int, warm: Warm | Iterable[Warm] | None) -> Result:
        settings = _core.Settings(starts=starts, seed=study.seed, threads=threads, warm=warm_starts(posed, warm))
        begin = perf_counter()
        report = progress if rounds is None else rounds.begin(starts, len(posed.objective.poses))
        found = _core.optimize(posed.problem(), settings, report)
        if found["status"] == Status.INFEASIBLE and posed.unit:
            found["reason"] += f" (lengths in {posed.unit})"
        return result_from(posed, found | {"seconds": perf_counter() - begin})

    region = study.objective.region
    if region is None:
        return solve(study, study.starts, warm)
    if region.internal_point == "best":
        return optimize_placed(study, solve, warm, threads, pieces)
    return optimize_region(study, solve, warm, threads, pieces)


def _proved(result: Result, threads: int, progress: Progress | None, pieces: Pieces) -> Result:
    """Return a result with a proof of how much better a design of its study can be at most.

    Where the proof leaves limits out, the optimum of the study without them is what it can come up to. After Ctrl-C the
    result is `interrupted`.
    """
    study, known = result.study, float(result.condition_number)  # type: ignore[arg-type]
    left_out = {label.removesuffix(" at neutral").removesuffix(".min") for label in left_out_of(study)}
    if left_out:
        kept = {name: limit for name, limit in study.constraints.items() if name not in left_out}
        relaxed = _optimized(replace(study, constraints=kept), threads, progress, listed(result), pieces)
        if relaxed.interrupted:
            return replace(result, interrupted=True)
        known = min(known, relaxed.condition_number or known)
    if progress is not None:
        phase(progress, "proving that no design is better")

    def prove(known: float, gap: float) -> OptimumProof:
        how: dict[str, Any] = {"time_limit": LONGEST, "threads": threads or None, "progress": progress}
        return pieces.proof(lambda: prove_optimum(study, known, gap=gap, **how))

    gap = GAPS[study.family]
    proof = prove(known, gap)
    while proof.better is not None and not proof.interrupted:  # one that keeps what the proof sees of the bounds
        known, gap = proof.better, min(max(10.0 * gap, 1e-3), 0.5)
        if known * (1.0 - gap) <= 1.0:
            break  # what was proved so far is all that can be aimed at
        proof = prove(known, gap)
    return replace(result, proof=proof, interrupted=proof.interrupted)


@short_repr
@dataclass(frozen=True)
class Trace:
    """One run from one start."""

    best: tuple[float, ...]
    """Least objective of a feasible design after each evaluation; infinite before the first."""
    end: Candidate


def trace(study: Study, start: Mapping[str, float], formulation: str = "minimax") -> Trace:
    """Follow a single run from a given start.

    Parameters
    ----------
    study : Study
    start : mapping
        Name to value of the free variables; moved inside the bounds.
    formulation : {"minimax", "plain"}
        "plain" minimizes log(objective) itself, as in the paper's SQP run; it stops early where singular values meet.

    """
    instance("study", study, Study)
    choice("formulation", formulation, ("minimax", "plain"))
    problem = study.problem()
    best, end = _core.trace(problem, _start(study, start), formulation)
    return Trace(tuple(best), candidate_from(problem, end))


def _start(study: Study, start: Mapping[str, float]) -> list[float]:
    try:
        return study.vector(start)
    except ValueError as error:
        raise ValueError(f"start: {error}") from None
