"""One design of a study: objective, condition numbers and margins, with exact gradients."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.support.structs import Fixed
from ninedof.support.text import short_repr

LARGEST = 1e200  # of an objective; beyond, the core has replaced a vanishing singular value by 1e-300
DERIVED = {"derived": True}  # fields that follow from others


@short_repr
@dataclass(frozen=True, eq=False)
class DesignPoint:
    """One design of a study, with exact gradients."""

    variables: dict[str, float]
    """Those of the family, then "characteristic_length" and offsets of O, where they are free; angles in radians."""
    objective: float
    """The value of the study's objective; infinite where J' is singular."""
    neutral_condition_number: float
    """Of J' at the neutral configuration; infinite where it is singular."""
    conditions: tuple[float, ...]
    """Condition number at each pose of the objective."""
    characteristic_length: float
    gradient: dict[str, float]
    """d(objective)/d(variable); NaN where singular. Where singular values or poses tie, that of one of them."""
    margins: dict[str, float]
    """Smallest margin of each constraint: 1 - value / max or value / min - 1, so that 0.01 is one per cent to spare and
    negative is violated; of singularity_free, which has no scale, value - min.

    A limit at the neutral pose alone is named "leg_ratio at neutral".
    """
    margin_gradients: dict[str, dict[str, float]]
    """d(margin)/d(variable) of that margin."""
    values: dict[str, float]
    """The quantity of each constraint where its margin is smallest, in the unit of the limit; angles in radians."""
    geometry: Geometry
    configuration: Configuration
    """The neutral one."""
    configurations: Configuration
    """The neutral one, then the poses of the objective: a stack."""
    study: Any = field(default=None, repr=False, compare=False, metadata=DERIVED)
    """The Study that it is a design of."""

    def __post_init__(self) -> None:
        """Make what is there by name unchangeable, as all else is."""
        for name in ("variables", "gradient", "margins", "values"):
            object.__setattr__(self, name, Fixed(getattr(self, name)))
        slopes = {name: Fixed(slope) for name, slope in self.margin_gradients.items()}
        object.__setattr__(self, "margin_gradients", Fixed(slopes))

    @property
    def permitted_lengths(self) -> tuple[Floats, Floats] | None:
        """Least and greatest length of each leg by the limits of its study, shapes (9,); None without a study."""
        return None if self.study is None else self.study.leg_limits(self.configuration)

    @property
    def condition_number(self) -> float:
        """The worst condition number over the poses of the objective; without any, that at the neutral one."""
        return max(self.conditions)


def design_point(problem: _core.Problem, x: Sequence[float]) -> DesignPoint:
    """Evaluate one full vector of variables."""
    names = list(problem.names)
    core = problem.evaluate(x)
    objective = infinite_if_singular(core.objective)
    with np.errstate(over="ignore"):  # nearly singular: the slope may be infinite where the value is not
        slope = objective * core.gradient if math.isfinite(objective) else np.full(len(names), np.nan)
    return DesignPoint(
        variables=dict(zip(names, x, strict=True)),
        objective=objective,
        neutral_condition_number=infinite_if_singular(core.condition_number),
        conditions=tuple(infinite_if_singular(k) for k in core.conditions),
        characteristic_length=core.characteristic_length,
        gradient=dict(zip(names, slope.tolist(), strict=True)),
        margins={one.name: one.value for one in core.margins},
        margin_gradients={one.name: dict(zip(names, one.gradient.tolist(), strict=True)) for one in core.margins},
        values={one.name: one.limited for one in core.margins},
        **robot_at(problem, x),
    )


def robot_at(problem: _core.Problem, x: Sequence[float]) -> dict[str, Any]:
    """Return geometry, neutral configuration and all configurations of one full vector of variables, by field."""
    configurations = Configuration(*problem.configurations(x))
    return {"geometry": problem.geometry(x), "configuration": configurations[0], "configurations": configurations}


def infinite_if_singular(value: float) -> float:
    """Return a value of the core, infinite where the core has replaced a vanishing singular value."""
    return float(value) if value < LARGEST else math.inf
