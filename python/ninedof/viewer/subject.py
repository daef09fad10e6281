"""What a viewer shows: a design, the study that it belongs to, and the variables of its family."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ninedof.conditioning.characteristic_length import characteristic_length
from ninedof.design.family_variables import variables_of
from ninedof.design.leg_limits import leg_limits_of
from ninedof.design.region import Region
from ninedof.design.study import Study, variable_kinds
from ninedof.optimize.result import Result
from ninedof.paper.published import published_variables
from ninedof.pareto import Front
from ninedof.robot.configuration import Configuration, single
from ninedof.robot.geometry import TRIPLES, Geometry
from ninedof.runs.design_file import Design, hexagonal_design
from ninedof.runs.objects import load
from ninedof.support.arguments import shown
from ninedof.support.arrays import Floats


@dataclass(frozen=True)
class Variable:
    """A variable of the family, with the ends of its slider."""

    name: str
    value: float
    """In the unit of the study; angles in radians."""
    low: float
    high: float
    is_angle: bool


@dataclass(frozen=True, eq=False)
class Subject:
    """A design and what is known about it. Immutable."""

    geometry: Geometry
    home: Configuration
    """The neutral configuration, a single one."""
    characteristic_length: float | str = 1.0
    unit: str = ""
    result: Result | None = None

    @cached_property
    def study(self) -> Study | None:
        """The study that found it, with the poses that it was solved for; None without one."""
        return None if self.result is None else self.result.solved

    @property
    def region(self) -> Region | None:
        """The region of the study; None without one."""
        return None if self.result is None else self.result.study.objective.region

    @property
    def rule(self) -> str:
        """The rule for O of the region; without one O is carried."""
        return "carried" if self.region is None else self.region.internal_point

    @cached_property
    def problem(self) -> Any:
        """What makes designs of variables; None without a family."""
        if not self.family:
            return None
        study = Study(self.family, variables=self.variables) if self.study is None else self.study
        return study.problem()

    @cached_property
    def size(self) -> float:
        """Diameter of the machine: of a ball about all joints and O at home."""
        points = robot_points(self.geometry, self.home)
        return float(2.0 * np.linalg.norm(points - points.mean(axis=0), axis=1).max())

    @cached_property
    def family(self) -> str:
        """The family of the study, else the smallest one that has this design; "" if none has."""
        if self.study is not None:
            return self.study.family
        names = ("hexagonal", "symmetric", "symmetric_nonplanar", "general")
        return next((name for name in names if variables_of(name, self.geometry, self.home) is not None), "")

    @cached_property
    def variables(self) -> dict[str, float]:
        """The variables of the family, and a free characteristic length or offsets of O; empty without a family."""
        if self.result is not None and self.result.variables is not None:
            return dict(self.result.variables)
        return (variables_of(self.family, self.geometry, self.home) or {}) if self.family else {}

    @cached_property
    def sliders(self) -> list[Variable]:
        """Every variable of the family with the ends of its slider.

        Bounds of the study, as far as they are within three sizes of the machine; without them half to twice a length,
        plus or minus half the size about a coordinate, a full turn of an angle.
        """
        found = []
        for name, kind in variable_kinds(self.family).items() if self.family else ():
            value, reach = self.variables[name], 0.5 * self.size
            low, high = self._bounds(name)
            if kind == "angle":
                least, most = -math.pi, math.pi
            elif kind == "length":
                least, most = (0.5 * value, 2.0 * value) if value > 0.0 else (0.0, reach)
            else:
                least, most = value - reach, value + reach
            if low < high:  # free in the study
                far = math.pi if kind == "angle" else 3.0 * self.size
                least, most = max(low, value - far), min(high, value + far)
            found.append(Variable(name, value, min(least, value), max(most, value), kind == "angle"))
        return found

    def leg_limits(self, zp: float) -> tuple[Floats, Floats]:
        """Return the least and greatest length of each leg, shapes (9,): of the study and of the ranges of a region."""
        if self.study is None or self.result is None:
            return np.zeros(9), np.full(9, math.inf)
        low, high = leg_limits_of(self.study, zp)
        ranges = () if self.result.region is None else self.result.region.leg_ranges
        if ranges:
            least, most = np.transpose(ranges)
            low, high = np.maximum(low, least), np.minimum(high, most)
        return low, high

    def length_at(self, g: Geometry, home: Configuration, variables: dict[str, float]) -> float:
        """Return the characteristic length of a design: a kind is taken at its neutral pose."""
        if "characteristic_length" in variables:
            return variables["characteristic_length"]
        length = self.characteristic_length if self.study is None else self.study.characteristic_length
        if isinstance(length, tuple):
            length = self.characteristic_length
        return float(characteristic_length(g, home, length)) if isinstance(length, str) else float(length)

    def _bounds(self, name: str) -> tuple[float, float]:
        bound: Any = 0.0 if self.study is None else self.study.variables.get(name, 0.0)
        return bound if isinstance(bound, tuple) else (bound, bound)


def subject_of(design: Any = None) -> Subject:
    """Return the subject that an argument `design` names: the published design without one.

    Raises
    ------
    ValueError
        If it is no design: neither a Design, nor a Result with one, nor a path that `ninedof.load` reads as one.

    """
    if design is None:
        return _of(hexagonal_design(published_variables()))
    name = ""
    if isinstance(design, str | os.PathLike):
        name = f"{os.fspath(design)}: "
        design = load(design)
    if isinstance(design, Design):
        return _of(design)
    if isinstance(design, Front):
        raise ValueError(f"{name}got a front, expected one of its points: RUN#1 to RUN#{len(design)}")
    if not isinstance(design, Result):
        what = "a run without a design" if name else shown(design)
        raise ValueError(f"{name or 'design: '}got {what}, expected a design file, a Design or a run with a design")
    best = design.best
    if best is None:
        raise ValueError(f"{name or 'design: '}the result holds no design: {design.reason}")
    return Subject(best.geometry, best.configuration, best.characteristic_length, design.study.unit, design)


def _of(design: Design) -> Subject:
    single(design.geometry, design.configuration)
    return Subject(design.geometry, design.configuration, design.characteristic_length, design.unit)


def robot_points(g: Geometry, c: Configuration) -> Floats:
    """Return the joints in the base frame, in the order of `TRIPLES`, and O; shape (13, 3)."""
    base_external, base_internal, external, internal = (getattr(g, name) for name in TRIPLES)
    carried = np.vstack([external, internal]) @ c.rotation.T + c.position
    return np.vstack([base_external, base_internal, carried, c.internal_point])
