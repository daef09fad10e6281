"""The machine that a viewer opened: a design, the study that it belongs to, and the variables of its family."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ninedof.conditioning.characteristic_length import length_at
from ninedof.design.domains.region import Region
from ninedof.design.limit_numbers import compared
from ninedof.design.study import FAMILIES, LENGTH, Study, variable_kinds
from ninedof.design.variables import variables_of
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.result import Result
from ninedof.paper.published import published_variables
from ninedof.records.design_file import Design, hexagonal_design
from ninedof.records.load import design_and_result, load
from ninedof.robot.configuration import Configuration, single
from ninedof.robot.geometry import Geometry
from ninedof.robot.plates import points_of
from ninedof.support.arrays import Floats
from ninedof.workspace.study_question import leg_ranges_over


class Variable(NamedTuple):
    """A variable of the family, with the ends of its slider."""

    name: str
    low: float
    """In the unit of the study; angles in radians."""
    high: float
    is_angle: bool


@dataclass(frozen=True, eq=False)
class Variant:
    """A design of a machine, and what belongs to it and not to a pose. Immutable."""

    geometry: Geometry
    home: Configuration
    """The neutral configuration, a single one."""
    length: float
    """Characteristic length."""
    leg_low: Floats
    """Least length of each leg, shape (9,): of the study, and of the ranges of its region."""
    leg_high: Floats
    study: Study | None = None
    study_lengths: Floats | None = None
    """Leg lengths that the study has, shape (m, 9): at its poses, and the ends over its region. Spreads are taken over
    them and the pose shown."""
    margins: Mapping[str, float] | None = None
    """Least margin of every constraint at the study's own poses, by name."""


@dataclass(frozen=True, eq=False)
class Machine:
    """A design and what is known about it. Immutable."""

    design: Design
    result: Result | None = None
    """The run that it comes from; None for a design file."""

    @property
    def unit(self) -> str:
        """The name of the length unit; "" without one."""
        return self.design.unit

    @property
    def force_unit(self) -> str:
        """The unit of forces of its study; "" without one."""
        return "" if self.study is None else self.study.force_unit

    @cached_property
    def study(self) -> Study | None:
        """The study that found it, with the poses that it was solved for; None without one."""
        return None if self.result is None else self.result.solved

    @property
    def region(self) -> Region | None:
        """The region of the study; None without one."""
        return None if self.result is None else self.result.study.objective.region

    @cached_property
    def size(self) -> float:
        """Diameter of the machine: of a ball about all joints and O at home."""
        points = points_of(self.design.geometry, self.design.configuration)
        return float(2.0 * np.linalg.norm(points - points.mean(axis=0), axis=1).max())

    @cached_property
    def family(self) -> str:
        """The family of the study, else the smallest one that has this design; "" if none has."""
        if self.study is not None:
            return self.study.family
        if self.design.tool:
            return ""  # its variables are of the plates
        return next((name for name in FAMILIES if variables_of(name, *self.design[:2]) is not None), "")

    @cached_property
    def variables(self) -> dict[str, float]:
        """The variables of the family, and a free characteristic length or offsets of O; empty without a family."""
        if self.result is not None and self.result.variables is not None:
            return dict(self.result.variables)
        return (variables_of(self.family, *self.design[:2]) or {}) if self.family else {}

    @cached_property
    def problem(self) -> Any:
        """The problem of the study, which makes designs of variables; None without a family."""
        if not self.family:
            return None
        return (self.study or Study(self.family, variables=self.variables)).problem()

    @cached_property
    def sliders(self) -> list[Variable]:
        """Every variable of the family with the ends of its slider.

        Bounds of the study, as far as they are within three sizes of the machine; without them half to twice a length,
        plus or minus half the size about a coordinate, a full turn of an angle.
        """
        sliders = []
        for name, kind in variable_kinds(self.family).items() if self.family else ():
            value, reach = self.variables[name], 0.5 * self.size
            bounds = 0.0 if self.study is None else self.study.variables.get(name, 0.0)
            if isinstance(bounds, tuple):
                far = math.pi if kind == "angle" else 3.0 * self.size
                low, high = max(bounds[0], value - far), min(bounds[1], value + far)
            elif kind == "angle":
                low, high = -math.pi, math.pi
            elif kind == "length":
                low, high = (0.5 * value, 2.0 * value) if value > 0.0 else (0.0, reach)
            else:
                low, high = value - reach, value + reach
            sliders.append(Variable(name, min(low, value), max(high, value), kind == "angle"))
        return sliders

    def variant(self, variables: Mapping[str, float], length: float | None = None) -> Variant:
        """Return the design of variables; a length of a kind is taken at its neutral pose unless one is given."""
        g, home, study = self.design.geometry, self.design.configuration, self.study
        lengths, margins = None, None
        if self.problem is not None:
            x = [variables[name] for name in self.problem.names]
            poses = Configuration(*self.problem.configurations(x))
            if variables != self.variables:
                g, home = self.problem.geometry(x), poses[0]
            if study is not None:
                at_poses = poses[1:] if len(poses) > 1 else poses  # home only where none is listed
                lengths = self._over_region(g, home, np.asarray(leg_lengths(g, at_poses)))
                evaluated = self.problem.evaluate(x).margins if study.constraints else ()
                margins = {one.name: one.value for one in evaluated}
        if length is None:
            length = self._length(g, home, variables)
        return Variant(g, home, length, *self._leg_limits(home), study, lengths, margins)

    def _over_region(self, g: Geometry, home: Configuration, lengths: Floats) -> Floats:
        """Return lengths at poses with the ends over the region; of the legs at O where the region says where O is."""
        region, study = self.region, self.study
        if region is None or study is None or not compared(study):
            return lengths
        ends = np.array(leg_ranges_over(region, g, home))
        if region.internal_point == "best":
            ends[:, 3:] = lengths[0, 3:]  # nothing beyond the poses
        return np.concatenate([lengths, ends])

    def _length(self, g: Geometry, home: Configuration, variables: Mapping[str, float]) -> float:
        if LENGTH in variables:
            return variables[LENGTH]
        length = self.design.characteristic_length if self.study is None else self.study.characteristic_length
        if isinstance(length, tuple):
            length = self.design.characteristic_length
        return length_at(g, home, length)

    def _leg_limits(self, home: Configuration) -> tuple[Floats, Floats]:
        if self.result is None:
            return np.zeros(9), np.full(9, math.inf)
        region = self.result.region
        return self.result.study.leg_limits(home, (region and region.leg_ranges) or None)


def machine_of(design: Any = None) -> Machine:
    """Return the machine that an argument `design` names: the published design without one."""
    name = "design"
    if design is None:
        design = hexagonal_design(published_variables())
    elif isinstance(design, str | os.PathLike):
        name, design = os.fspath(design), load(design)
    point, result = design_and_result(design, name)
    single(point.geometry, point.configuration)
    return Machine(point, result)
