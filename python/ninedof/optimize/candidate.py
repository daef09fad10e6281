"""A local optimum: its numbers as the core found them, its robot and its poses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ninedof.design.design_point import DesignPoint, robot_at
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.plain_values import plain_fields
from ninedof.support.arguments import finite
from ninedof.support.structs import Fixed, entries_of, from_core
from ninedof.support.text import short_repr

if TYPE_CHECKING:
    from ninedof import _core

DERIVED = {"derived": True}  # fields that follow from others
ROBOT = ("geometry", "configuration", "configurations")  # those of a candidate


@short_repr
@dataclass(frozen=True)
class Candidate:
    """A local optimum that passed the checks."""

    objective: float
    """The value of the study's objective."""
    neutral_condition_number: float
    """At the neutral pose."""
    conditions: tuple[float, ...]
    """Condition number at each pose of the objective; where it has none, at the neutral pose."""
    characteristic_length: float
    variables: dict[str, float]
    """Those of the family, then "characteristic_length" and offsets of O, where they are free; angles in radians."""
    geometry: Geometry = field(metadata=DERIVED)
    configuration: Configuration = field(metadata=DERIVED)
    """The neutral one."""
    configurations: Configuration = field(metadata=DERIVED)
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
    """Number of starts that ended at this objective; warm starts are not counted."""

    def __post_init__(self) -> None:
        """Make what is there by name unchangeable, as all else is."""
        for name in ("variables", "prices"):
            object.__setattr__(self, name, Fixed(getattr(self, name)))

    @property
    def condition_number(self) -> float:
        """The worst condition number over the poses of the study; of a region over the poses that ruled.

        It is what a study asks for that minimizes the worst; `Result.objective` is the value of another objective.
        """
        return max(self.conditions)

    def to_dict(self) -> dict[str, Any]:
        """Return every field as plain values, but for the robot and its poses, which follow from the variables."""
        return plain_fields(self)


def candidate_of(problem: _core.Problem, end: _core.Candidate) -> Candidate:
    """Return the candidate of the core with its robot and poses."""
    x = end.variables.tolist()
    return from_core(Candidate, end, variables=dict(zip(problem.names, x, strict=True)), **robot_at(problem, x))


def candidate_at(point: DesignPoint, residual: float) -> Candidate:
    """Return a design that no search has led to, with the residual that stands for the one that is unknown."""
    violation = max(0.0, -min(point.margins.values(), default=0.0))
    search: dict[str, Any] = {"active": (), "prices": {}, "optimality_residual": residual, "reached": 0}
    return from_core(Candidate, point, **search, constraint_violation=violation)


def candidate_from(problem: _core.Problem, data: Mapping[str, Any], where: str) -> Candidate:
    """Return the candidate of a mapping as `Candidate.to_dict` makes it, with its robot and poses."""
    entries = entries_of(Candidate, data, where, skipped=ROBOT)
    values = entries["variables"]
    missing = [name for name in problem.names if name not in values]
    if missing:
        raise ValueError(f"{where}.variables: got none of the name {missing[0]}, expected all of the study")
    x = [finite(f"{where}.variables.{name}", values[name]) for name in problem.names]
    return Candidate(**entries, **robot_at(problem, x))
