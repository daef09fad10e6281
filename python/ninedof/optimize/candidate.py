"""Parts of a result: local optima, and the report on the best one over its region."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ninedof import _core
from ninedof.design.design_point import DERIVED, DesignPoint, robot_at
from ninedof.design.domains.poses import Pose
from ninedof.design.domains.region_poses import posed
from ninedof.design.study import Study
from ninedof.motion.follow import Followed
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.path_limits import PathLimits, path_limits
from ninedof.support.arrays import Floats
from ninedof.support.structs import Fixed, entries_of, from_core, plain_fields
from ninedof.support.text import short_repr

ROBOT = ("geometry", "configuration", "configurations")  # those of a candidate
DENSE = 100_000  # poses of a dense search
LEFT = 1e-6  # of the objective
PASSED = 1e-7  # by which a limit or the index may be exceeded between the poses, relative


class OfStudy:
    """A design with the study that it is of: loads, masses, tool, region and limits of it are the study's."""

    study: Any
    region: Any
    configuration: Any

    @property
    def solved(self) -> Any:
        """The study with the poses that were solved for: those listed and, of a region, those that ruled."""
        return self.study if self.study is None or self.region is None else posed(self.study, self.region.poses)

    @property
    def permitted_lengths(self) -> tuple[Floats, Floats] | None:
        """Least and greatest length of each leg, shapes (9,), None without a design or its study.

        By the limits of the study on lengths and, where placing O over a region is permitted a range for each leg,
        within that; 0 and infinity where nothing limits it.
        """
        if self.study is None or self.configuration is None:
            return None
        study: Study = self.study
        return study.leg_limits(self.configuration, (self.region and self.region.leg_ranges) or None)

    def path_limits(self, followed: Followed, home: Configuration) -> PathLimits:
        """Return the limits of its study along a motion of it, as `ninedof.path_limits` does."""
        return path_limits(self.study, followed, home)


@short_repr
@dataclass(frozen=True)
class Candidate(OfStudy):
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
    study: Study | None = field(default=None, repr=False, compare=False, metadata=DERIVED)
    """It is a design of this study: its sheet, payload, ... have the loads, tool and region. None where unknown."""
    region: RegionReport | None = field(default=None, repr=False, compare=False, metadata=DERIVED)
    """That of the result that it is in, if it is in one."""

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
        """Return every field as plain values, but for the study, and for robot and poses, which the variables give."""
        return plain_fields(self)


def best_of(result: Any) -> Candidate:
    """Return the best design of a Result; ValueError says why there is none."""
    best: Candidate | None = result.best
    if best is None:
        got = f"got one without a design ({result.status}: {result.reason})"
        raise ValueError(f"result: {got}, expected one with a design")
    return best


def candidate_of(problem: _core.Problem, end: _core.Candidate) -> Candidate:
    """Return the candidate of the core with its robot and poses."""
    x = end.variables.tolist()
    variables = dict(zip(problem.names, x, strict=True))
    return from_core(Candidate, end, variables=variables, **robot_at(problem, x), study=None, region=None)


def candidate_at(point: DesignPoint, residual: float) -> Candidate:
    """Return a design that no search has led to, with the residual that stands for the one that is unknown."""
    violation = max(0.0, -min(point.margins.values(), default=0.0))
    search: dict[str, Any] = {"active": (), "prices": {}, "optimality_residual": residual, "reached": 0}
    return from_core(Candidate, point, **search, constraint_violation=violation, region=None)


def candidate_from(problem: _core.Problem, data: Mapping[str, Any]) -> Candidate:
    """Return the candidate of a mapping as `Candidate.to_dict` makes it, with its robot and poses."""
    entries = entries_of(Candidate, data, skipped=ROBOT)
    return Candidate(**entries, **robot_at(problem, [entries["variables"][name] for name in problem.names]))


@short_repr
@dataclass(frozen=True)
class RegionMean:
    """The harmonic mean of an index over a region."""

    nodes: int
    """Poses of the quadrature that the optimizer used."""
    quadrature: float
    """The mean over them."""
    value: float
    """The mean over 8192 other poses, on which the optimizer had no influence: the mean of the region."""
    error: float
    """Of the quadrature: its distance from `value`, and two standard errors of that."""
    standard_error: float = math.nan
    """Of `value`."""

    @property
    def words(self) -> str:
        """The mean in a few words."""
        return (
            f"harmonic mean {self.value:.6f}, standard error {self.standard_error:.1e}, over poses that were not used "
            f"({self.quadrature:.6f} over the {self.nodes} that were minimized over)"
        )


@short_repr
@dataclass(frozen=True)
class RegionReport:
    """The poses that ruled a region study, how densely the best design was looked at, and the worst found."""

    poses: tuple[Pose, ...]
    """Those at which the limits and the index were imposed, besides the poses of the study; first, with weight 1, those
    of the quadrature where the objective is a mean."""
    rounds: int
    """Designs that were searched over the region."""
    looked_at: int
    """Poses at which the best design was evaluated in the last search; 0 where an interruption came before it."""
    objective: float
    """The largest value of the index found."""
    objective_at: Pose
    margin: float
    """The least margin of a limit found: below zero it is violated, in parts of it. Infinite without limits."""
    limit: str
    """The name of that limit; "" without limits."""
    mean: RegionMean | None = None
    """Of an objective that is a mean over the region."""
    gain: float = math.inf
    """By how much the objective could still fall near this design, relative and to first order: it cannot be less than
    at these poses, and what violates a limit between them is paid for at its price."""
    leg_ranges: tuple[tuple[float, float], ...] = ()
    """If O is placed at every pose and limits compare poses: the shortest and longest length of each leg (l, q, r)
    that O keeps in all of the region."""

    @property
    def keeps_limits(self) -> bool:
        """Whether no limit is violated by more than 1e-7 of it, as far as a dense search of the region shows."""
        return self.looked_at >= DENSE and self.margin >= -PASSED

    @property
    def is_settled(self) -> bool:
        """Whether limits are kept and next to nothing is left to gain: then the objective is that of the region."""
        return self.keeps_limits and self.gain <= LEFT

    @property
    def words(self) -> str:
        """The report in a sentence."""
        if self.looked_at == 0:
            return f"limits were imposed at {self._ruling} of the region; the design was not looked at between them"
        verdict = f"{self.limit} is violated by {-self.margin:.1e} of it"
        if self.margin >= -PASSED:
            verdict = "no limit is violated"
        average = "" if self.mean is None else f"{self.mean.words}; "
        return (
            f"{average}{self._ruling} of the region ruled; of {self.looked_at} looked at the worst has "
            f"{self.objective:.6f}, and {verdict}{self._ranges}"
        )

    @property
    def _ruling(self) -> str:
        nodes = [pose.weight > 0.0 for pose in self.poses]
        count = len(nodes) if all(nodes) else nodes.count(False)
        return "1 pose" if count == 1 else f"{count} poses"

    @property
    def _ranges(self) -> str:
        if not self.leg_ranges:
            return ""
        short, long = (f(x) for f, x in zip((min, max), zip(*self.leg_ranges, strict=True), strict=True))
        return (
            f"; placing O is permitted leg lengths from {short:.6g} to {long:.6g}, in the unit of the study; "
            "the sheet has those that the region needs"
        )

    @classmethod
    def from_core(cls, report: _core.RegionReport) -> RegionReport:
        """Return the report of the core."""
        legs, mean = report.leg_ranges, report.mean
        return from_core(
            cls,
            report,
            poses=tuple(map(_posed, report.poses)),
            objective_at=_posed(report.objective_at),
            mean=None if mean is None else from_core(RegionMean, mean),
            leg_ranges=() if legs is None else tuple(zip(legs.low.tolist(), legs.high.tolist(), strict=True)),
        )


def _posed(pose: Any) -> Pose:
    point = "best" if pose.best_internal else pose.internal
    return Pose(pose.position, pose.rotation, point, "zp" if pose.in_zp else "length", pose.weight)
