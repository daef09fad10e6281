"""Optimum design: one call to the compiled solver."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter
from typing import TypedDict, Unpack

from ninedof import _core
from ninedof.design.domains.region_poses import posed
from ninedof.design.limit_numbers import FORCES
from ninedof.design.study import Study
from ninedof.optimize.actuators import ActuatorSearch, SearchEnded
from ninedof.optimize.candidate import Candidate, RegionReport, best_of, candidate_of
from ninedof.optimize.pieces import Pieces, Warm, warm_starts, warm_variables
from ninedof.optimize.reserve import with_reserve
from ninedof.optimize.result import Result, Status
from ninedof.optimize.tables import axis_hint
from ninedof.proof.optimum import prove, relaxed
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.proof.optimum_steps import ways_of
from ninedof.support.arguments import choice, flag, instance, number, path_argument, shown
from ninedof.support.arrays import thread_argument
from ninedof.support.kept.store import Store
from ninedof.support.running import Progress, part_of, phase, progress_argument
from ninedof.support.structs import from_core, options_of, within
from ninedof.support.text import short_repr
from ninedof.support.units import kind_unit

LONGEST, LEAST = 600.0, 1.0  # seconds of a proof without a time limit, and where the search took all of one


class OptimizeOptions(TypedDict, total=False):
    """Options of `optimize`, which says what they mean."""

    warm: Warm | Iterable[Warm] | None
    time_limit: float
    out: str | os.PathLike[str] | None


def optimize(
    study: Study,
    starts: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    *,
    certify: bool = False,
    **options: Unpack[OptimizeOptions],
) -> Result:
    """Minimize the objective of a study: by default, the condition number.

    Multi-start sequential quadratic programming (NLopt's SLSQP) on the smooth minimax form of the problem, with exact
    gradients. Every end point is polished by Newton's method and checked independently of the solver. Ctrl-C stops
    within a fraction of a second and returns the best designs so far, with status "stopped".

    Parameters
    ----------
    study : Study
        With tolerances: its limits are kept, and proved, of every machine within them, with a reserve that the proof
        asks for (`Result.reserve`).
    starts, seed : int, optional
        In place of the study's own. If fewer than 16, and at most half, of the starts run to their end reach the best
        objective, as many starts again follow, up to four times `starts` in all: 256 by default. `starts = 1` is one.
    threads : int, optional
        One per processor by default. The result is the same, bit for bit, for any number.
    progress : callable, optional
        Called as progress(runs done, runs in all, best objective so far); infinite before a start has found a feasible
        design. A start is one run, or two where it is followed to its end after a short run. Runs in all grow where
        more starts follow. If it has a method `phase`, that is called with a few words where a part of the work begins:
        over a region, all starts and every round behind them, and the proofs that a reserve needs, which are no runs.
    certify : bool
        Whether to prove afterwards how much better a design of the study can be at most, see `prove_optimum`:
        `Result.lower_bound` and `Result.proof`. Of hexagons to 1e-12 in a second or two, of other planar designs to
        3 per cent and of non-planar ones to 0.2 per cent in minutes, over a region with up to four free variables to
        0.1 per cent in a minute or so.
    warm : Result, Candidate, mapping of names to values, or a sequence of them, optional
        Additional starts, tried first: a result of a similar study (its best four candidates), or a known design. They
        are moved inside the bounds.
    time_limit : float
        Seconds after which the search ends with the best design so far and status "stopped"; infinite by default. Of a
        region study that design is then searched over the region once more, which takes a second or two longer: what
        is left to gain near it is `Result.region.gain`. A proof ends with what is proved by then, after one second at
        least; without a limit it has ten minutes.
    out : path, optional
        Folder that keeps what is finished, made if it is missing: the result before its proof, and the proof. The same
        call with the same folder goes on there, however the last one ended, and gives the same result. A study over a
        region is one piece. A search that the time limit ended is not kept: the next call, with any limit, solves it
        anew; a proof over poses goes on behind its last bound.

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
    values = options_of(optimize, OptimizeOptions, options, time_limit=math.inf)
    instance("study", study, Study)
    for note in study.notes:
        warnings.warn(note, stacklevel=2)
    progress_argument(progress)
    study = study.with_solver(starts, seed)
    count = thread_argument(threads)
    if flag("certify", certify):
        ways_of(study)  # raises where no proof is known, before the work
    additional = warm_variables(values["warm"])
    seconds = number("time_limit", values["time_limit"])
    if not seconds > 0.0:
        raise ValueError(f"time_limit: got {shown(values['time_limit'])}, expected seconds, more than 0")
    out = None if values["out"] is None else path_argument("out", values["out"])
    if out is not None:
        warm_starts(study, additional)  # raises, before there is a folder
    question = {
        "kind": "optimize",
        "study": study.to_dict(),
        "warm": [dict(one) for one in additional],
        "proof": certify,
    }
    with nullcontext() if out is None else Store(out, question, 1) as store:
        run = _Run(count, progress, Pieces(store), perf_counter() + seconds)
        solve = _with_actuators if study.actuators else _Run.of
        result = solve(run, study, additional)
        if not certify or result.best is None or result.interrupted:
            return result
        return _proved(result, run)


@dataclass
class _Run:
    """Settings that all studies of one call have in common."""

    threads: int
    progress: Progress | None
    pieces: Pieces
    end: float
    """Of the time, as perf_counter counts it."""

    def result(self, study: Study, warm: Sequence[Mapping[str, float]], part: str = "", explain: bool = True) -> Result:
        """Solve a study, a part of the work that may have a name, or return the result that was kept of it."""
        left = max(self.end - perf_counter(), 1e-9)
        progress = part_of(self.progress, part) if part else self.progress
        settings = _core.Settings(
            starts=study.starts,
            seed=study.seed,
            warm=warm_starts(study, warm),
            threads=self.threads,
            time_limit=left,
            explain=explain,
        )
        return self.pieces.result(study, lambda: _anew(study, settings, progress), left)

    def of(self, study: Study, warm: Sequence[Mapping[str, float]]) -> Result:
        """Solve a study with the reserve that its tolerances need."""
        return self.built(self.result(study, warm))

    def built(self, result: Result) -> Result:
        """Return a result with the reserve that the tolerances of its study need."""

        def again(one: Study, known: Result) -> Result:
            return self.result(one, warm_variables(known), "a reserve for tolerances")

        if not result.study.tolerances:
            return result
        made: Result = with_reserve(result, again, self.threads, self.progress, lambda: perf_counter() >= self.end)
        return made


OTHERS = 3  # combinations of actuators that are tried where the best one leaves no room for tolerances


def _with_actuators(run: _Run, study: Study, warm: Sequence[Mapping[str, float]]) -> Result:
    """Return the best design with its actuators, or the next ones where these leave no room for the tolerances."""

    def solve(one: Study, others: Sequence[Candidate], words: str, explain: bool) -> Result:
        result = run.result(one, [*warm, *(other.variables for other in others)], words, explain)
        if result.interrupted or perf_counter() >= run.end:
            raise SearchEnded(result)
        return result

    search = ActuatorSearch(study, solve)
    drawn = search.result()
    first = result = run.built(drawn)
    passed_over = list[str]()
    while drawn.actuators is not None and result.status == Status.INFEASIBLE:
        passed_over.append(drawn.actuators.chosen.words)
        none = f"{first.reason}; the actuators are {passed_over[0]}"
        if len(passed_over) > OTHERS:
            reason = f"{none}, the next {OTHERS} combinations leave no room either, and no others were tried"
            return replace(first, status=Status.STOPPED, reason=reason)
        drawn = search.result()
        if drawn.actuators is None:
            no_others = "no others leave room for the tolerances"
            words = no_others if drawn.status == Status.INFEASIBLE else "the search of others came to no answer"
            reason = f"{none}, and {words}"
            return replace(first, status=drawn.status, reason=reason, interrupted=drawn.interrupted)
        result = run.built(drawn)
    if passed_over and result.actuators is not None:
        note = f"passed over, as they leave no room for the tolerances: {'; '.join(passed_over)}"
        return replace(result, actuators=replace(result.actuators, notes=(*result.actuators.notes, note)))
    return result


def _anew(study: Study, settings: _core.Settings, progress: Progress | None) -> Result:
    begin, region = perf_counter(), study.objective.region
    report, problem = None, study.problem(region is not None)
    if region is None:
        end = _core.optimize(problem, settings, progress)
    else:
        over = _core.optimize_region(problem, region.for_core(), settings, progress, partial(phase, progress))
        end = over.result
        report = RegionReport.from_core(over.region) if end.candidates else None
        problem = (study if report is None else posed(study, report.poses)).problem()
    reason = end.reason
    if end.status == Status.INFEASIBLE:
        kinds = {one.kind for one in study.limits}
        units = {"lengths": "inches" if study.unit == "in" else study.unit}
        for kind, name in (("rate", "rates"), (FORCES, "forces"), ("power", "powers")):
            units[name] = kind_unit(kind, study.unit, study.force_unit) if kind in kinds else ""
        words = ", ".join(f"{name} in {unit}" for name, unit in units.items() if unit)
        reason += (f" ({words})" if words else "") + axis_hint(study)
    return from_core(
        Result,
        end,
        status=Status(end.status),
        reason=reason,
        candidates=tuple(candidate_of(problem, one) for one in end.candidates),
        seconds=perf_counter() - begin,
        study=study,
        region=report,
        proof=None,
        actuators=None,
        reserve=None,
    )


def _proved(result: Result, run: _Run) -> Result:
    """Return a result with a proof of how much better a design of its study can be at most.

    Where the proof leaves limits out, the optimum of the study without them is what it can come up to. After Ctrl-C the
    result is `interrupted`.
    """
    study, best = result.study, best_of(result).condition_number
    if (others := relaxed(study)) is not study:
        eased = run.result(others, warm_variables(result))
        if eased.interrupted:
            return replace(result, interrupted=True)
        best = min(best, eased.condition_number or best)
    phase(run.progress, "proving that no design is better")

    def proved(best: float, gap: float | None, known: OptimumProof | None = None) -> OptimumProof:
        left = run.end - perf_counter()
        seconds = LONGEST if left == math.inf else max(left, LEAST)

        def compute(earlier: OptimumProof | None) -> OptimumProof:
            return prove(study, best, gap, seconds, run.threads or None, run.progress, earlier or known)

        return run.pieces.proof(compute, left)

    gap = ways_of(study).gap
    proof = proved(best, None)
    while proof.better is not None and not proof.interrupted:  # one that keeps what the proof sees of the bounds
        best, gap = proof.better, min(max(10.0 * gap, 1e-3), 0.5)
        if best * (1.0 - gap) <= 1.0 or perf_counter() >= run.end:
            break  # what was proved so far is all that can be aimed at, or that there is time for
        proof = proved(best, gap, proof)
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
    with within("start", ": "):
        x = study.vector(start)
    run = _core.trace(problem, x, formulation)
    return Trace(run.best, replace(candidate_of(problem, run.end), study=study))
