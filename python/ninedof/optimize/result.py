"""What an optimization returns: distinct local optima and how the search ended."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING

from ninedof.design.study import Study
from ninedof.optimize.prices import price_words
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry

if TYPE_CHECKING:
    from ninedof import _core

__all__ = ["Candidate", "Result", "Status", "candidate_of"]


class Status(StrEnum):
    """How an optimization ended."""

    OPTIMAL = "optimal"
    """Feasible and stationary by our own checks."""
    UNBOUNDED = "unbounded"
    """No least value: the objective keeps falling as the variables in `causes` run away."""
    INFEASIBLE = "infeasible"
    """No design meets the limits; those in `causes` are in conflict."""
    STOPPED = "stopped"
    """Interrupted, or nothing passed the checks. What was found is returned, but it is no proved optimum."""


@dataclass(frozen=True)
class Candidate:
    """A local optimum that passed the checks."""

    objective: float
    """What the study makes least."""
    condition_number: float
    """At the neutral pose."""
    conditions: tuple[float, ...]
    """Condition number at each pose of the objective."""
    characteristic_length: float
    variables: dict[str, float]
    """Those of the family, then "characteristic_length" and the places of O, where they are free."""
    geometry: Geometry
    configuration: Configuration
    """The neutral one."""
    configurations: Configuration
    """The neutral one, then the poses of the objective: a stack."""
    active: tuple[str, ...]
    """Variables on a bound and constraints on their limit."""
    prices: dict[str, float]
    """Per cent by which the objective falls when that limit or bound is relaxed by 1 %, to first order."""
    optimality_residual: float
    """Norm of the least combination of active gradients of log(objective), 0 where no direction improves to first
    order. Lengths are taken on an asinh scale: linear near 0, logarithmic beyond."""
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
    stopped_early: int = field(default=0, kw_only=True)
    """Starts among those done that were given up as hopeless."""
    followed: int | None = field(default=None, kw_only=True)
    """Starts followed to their end in the round that found the best design, where that is known."""

    @property
    def best(self) -> Candidate | None:
        """The best candidate."""
        return self.candidates[0] if self.candidates else None

    @property
    def confidence(self) -> float:
        """Fraction of the starts followed to their end that reached the best candidate, from 0 to 1; 0 without one."""
        followed = self.starts_done - self.stopped_early if self.followed is None else self.followed
        return min(1.0, self.best.reached / followed) if self.best and followed > 0 else 0.0

    @property
    def objective(self) -> float | None:
        """What the study makes least, of the best candidate."""
        return self.best.objective if self.best else None

    @property
    def condition_number(self) -> float | None:
        """Condition number of the best candidate at the neutral pose."""
        return self.best.condition_number if self.best else None

    @property
    def conditions(self) -> tuple[float, ...] | None:
        """Condition numbers of the best candidate at the poses of the objective."""
        return self.best.conditions if self.best else None

    @property
    def characteristic_length(self) -> float | None:
        """Characteristic length of the best candidate."""
        return self.best.characteristic_length if self.best else None

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
    def configurations(self) -> Configuration | None:
        """Neutral configuration and poses of the best candidate: a stack."""
        return self.best.configurations if self.best else None

    @property
    def active(self) -> tuple[str, ...] | None:
        """What binds at the best candidate."""
        return self.best.active if self.best else None

    @property
    def prices(self) -> dict[str, float] | None:
        """What relaxing each binding limit of the best candidate by 1 % would buy, in per cent of the objective."""
        return self.best.prices if self.best else None

    @property
    def optimality_residual(self) -> float | None:
        """Stationarity of the best candidate."""
        return self.best.optimality_residual if self.best else None

    @property
    def constraint_violation(self) -> float | None:
        """Violation of the best candidate."""
        return self.best.constraint_violation if self.best else None

    def summary(self) -> str:
        """Return a few lines: status, objective, what binds and at what price, how many starts agree."""
        lines = [f"{self.status}: {self.reason}"]
        best = self.best
        if best is None:
            return lines[0]
        objective = self.study.objective
        value = f"{objective.words} {best.objective:.6f}"
        if objective.index != "condition_number" or objective.poses:
            value += f"; condition number {best.condition_number:.6f} at the neutral pose"
        if len(best.conditions) > 1:
            value += f", {min(best.conditions):.6f} to {max(best.conditions):.6f} over the poses"
        lines.append(value)
        lines.append(f"limits reached: {', '.join(best.active) or 'nothing'}")
        lines.extend(price_words(self.study, best.variables, best.prices))
        found = f"{best.reached} of {self.starts_done} starts ended here ({100.0 * self.confidence:.0f} %)"
        if len(self.candidates) > 1:
            found += f"; the next best optimum has {self.candidates[1].objective:.6f}"
        lines.append(found)
        return "\n".join(lines)


def candidate_of(problem: _core.Problem, found: _core.Candidate) -> Candidate:
    """Return a candidate of the core with its robot, poses and names."""
    x = found.variables.tolist()
    configurations = Configuration(*problem.configurations(x))
    return Candidate(
        objective=found.objective,
        condition_number=found.condition_number,
        conditions=tuple(found.conditions),
        characteristic_length=found.characteristic_length,
        variables=dict(zip(problem.names, x, strict=True)),
        geometry=problem.geometry(x),
        configuration=configurations[0],
        configurations=configurations,
        active=tuple(found.active),
        prices=dict(found.prices),
        optimality_residual=found.optimality_residual,
        constraint_violation=found.constraint_violation,
        reached=found.reached,
    )
