"""Optimum design: one call to the compiled solver, and its answer in words and numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from time import perf_counter

from ninedof import _core
from ninedof.arrays import thread_argument
from ninedof.configuration import Configuration
from ninedof.geometry import Geometry
from ninedof.study import Study

__all__ = ["Candidate", "Result", "Status", "Trace", "optimize", "trace"]

Progress = Callable[[int, int, float], object]
"""Called with (starts done, starts in all, best condition number so far)."""

MAX_EVALUATIONS = 500  # of one start; a converging one takes about 30


class Status(StrEnum):
    """How an optimization ended."""

    OPTIMAL = "optimal"
    """Feasible and stationary by our own checks."""
    UNBOUNDED = "unbounded"
    """No least value: the index keeps falling as the variables in `causes` run away."""
    INFEASIBLE = "infeasible"
    """No design meets the limits; those in `causes` are in conflict."""
    STOPPED = "stopped"
    """Interrupted, or nothing passed the checks. What was found is returned, but it is no proved optimum."""


@dataclass(frozen=True)
class Candidate:
    """A local optimum that passed the checks."""

    condition_number: float
    variables: dict[str, float]
    geometry: Geometry
    configuration: Configuration
    active: tuple[str, ...]
    """Variables on a bound and constraints on their limit."""
    optimality_residual: float
    """Norm of the least combination of active gradients of log(condition number), 0 where no direction improves to
    first order. Lengths are taken on an asinh scale: linear near 0, logarithmic beyond."""
    constraint_violation: float
    """Largest negative margin; 0 if none."""
    reached: int
    """How many starts ended here."""


@dataclass(frozen=True)
class Result:
    """What an optimization found. The fields of a design are those of the best candidate, or None without one."""

    status: Status
    reason: str
    """One sentence."""
    causes: tuple[str, ...]
    """Variables or constraints behind "unbounded" or "infeasible"."""
    candidates: tuple[Candidate, ...]
    """Distinct local optima, best first. Mirror images count as one design."""
    evaluations: int
    starts_done: int
    seconds: float
    study: Study
    interrupted: bool = False
    """Whether Ctrl-C ended the run."""
    lower_bound: float | None = None
    """A proved bound, where one was asked for."""

    @property
    def best(self) -> Candidate | None:
        """The best candidate."""
        return self.candidates[0] if self.candidates else None

    @property
    def condition_number(self) -> float | None:
        """Condition number of the best candidate."""
        return self.best.condition_number if self.best else None

    @property
    def variables(self) -> dict[str, float] | None:
        """Variables of the best candidate by name."""
        return self.best.variables if self.best else None

    @property
    def geometry(self) -> Geometry | None:
        """Geometry of the best candidate."""
        return self.best.geometry if self.best else None

    @property
    def configuration(self) -> Configuration | None:
        """Neutral configuration of the best candidate."""
        return self.best.configuration if self.best else None

    @property
    def active(self) -> tuple[str, ...] | None:
        """What binds at the best candidate."""
        return self.best.active if self.best else None

    @property
    def optimality_residual(self) -> float | None:
        """Stationarity of the best candidate."""
        return self.best.optimality_residual if self.best else None

    @property
    def constraint_violation(self) -> float | None:
        """Violation of the best candidate."""
        return self.best.constraint_violation if self.best else None


def optimize(
    study: Study,
    starts: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result:
    """Find the design of least condition number.

    Multi-start sequential quadratic programming (NLopt's SLSQP) on the smooth minimax form of the problem, with exact
    gradients; every end is polished by Newton's method and judged by checks that do not believe the solver. Ctrl-C
    stops within a fraction of a second and returns what there is, with status "stopped".

    Parameters
    ----------
    study : Study
    starts, seed : int, optional
        In place of the study's own.
    threads : int, optional
        One a processor by default. The result is the same, bit for bit, for any number.
    progress : callable, optional
        Called as progress(starts done, starts in all, best condition number so far).

    Returns
    -------
    Result
        Infeasible and unbounded studies are answers, not errors: see `Status`.

    Raises
    ------
    ValueError
        If an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> result = nd.optimize(nd.Study.paper())
    >>> result.status, round(result.condition_number, 6), result.active
    (<Status.OPTIMAL: 'optimal'>, 3.762659, ('a1', 'b2', 'radius_ratio'))

    """
    if not isinstance(study, Study):
        raise ValueError(f"study: got {type(study).__name__}, expected a Study")
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: got {progress!r}, expected a callable of three arguments")
    study = study.with_solver(starts, seed)
    problem = study.problem()
    begin = perf_counter()
    core = _core.optimize(problem, study.starts, study.seed, thread_argument(threads), MAX_EVALUATIONS, progress)
    return Result(
        status=Status(core.status),
        reason=core.reason,
        causes=tuple(core.causes),
        candidates=tuple(_candidate(study, problem, c) for c in core.candidates),
        evaluations=core.evaluations,
        starts_done=core.starts_done,
        seconds=perf_counter() - begin,
        study=study,
        interrupted=core.interrupted,
    )


@dataclass(frozen=True)
class Trace:
    """One run from one start."""

    best: tuple[float, ...]
    """Least condition number of an allowed design after each evaluation; infinite before the first."""
    end: Candidate


def trace(study: Study, start: Mapping[str, float], formulation: str = "minimax") -> Trace:
    """Follow a single run from a given start.

    Parameters
    ----------
    study : Study
    start : mapping
        Name to value of the free variables; moved inside the bounds.
    formulation : {"minimax", "plain"}
        "plain" minimises log(condition number) itself, as the paper's SQP run did, and jams where two singular values
        meet.

    """
    if not isinstance(study, Study):
        raise ValueError(f"study: got {type(study).__name__}, expected a Study")
    if formulation not in ("minimax", "plain"):
        raise ValueError(f'formulation: got {formulation!r}, expected "minimax" or "plain"')
    problem = study.problem()
    best, end = _core.trace(problem, study.vector(start), formulation)
    return Trace(tuple(best), _candidate(study, problem, end))


def _candidate(study: Study, problem: _core.Problem, c: _core.Candidate) -> Candidate:
    x = c.variables.tolist()
    return Candidate(
        condition_number=c.condition_number,
        variables=dict(zip(study.variables, x, strict=True)),
        geometry=problem.geometry(x),
        configuration=Configuration(*problem.configuration(x)),
        active=tuple(c.active),
        optimality_residual=c.optimality_residual,
        constraint_violation=c.constraint_violation,
        reached=c.reached,
    )
