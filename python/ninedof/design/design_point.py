"""One design of a study, looked at: its numbers and their exact gradients."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from ninedof import _core

__all__ = ["DesignPoint", "design_point"]

LARGEST = 1e200  # of an objective; beyond, a singular value has vanished and its stand-in shows


@dataclass(frozen=True, eq=False)
class DesignPoint:
    """One design of a study, with exact gradients."""

    variables: dict[str, float]
    """Every variable: those of the family, then "characteristic_length" and the places of O, where they are free."""
    objective: float
    """What the study makes least; infinite where J' is singular."""
    condition_number: float
    """Of J' at the neutral configuration; infinite where it is singular."""
    conditions: tuple[float, ...]
    """Condition number at each pose of the objective."""
    characteristic_length: float
    gradient: dict[str, float]
    """d(objective)/d(variable); NaN where singular. Where singular values or poses tie, that of one of them."""
    margins: dict[str, float]
    """Smallest margin of each constraint, relative to its limit: 0.01 is one per cent to spare, negative is violated.
    Of singularity_free: determinant less its limit."""
    margin_gradients: dict[str, dict[str, float]]
    """d(margin)/d(variable) of that margin."""
    geometry: Geometry
    configuration: Configuration
    """The neutral one."""
    configurations: Configuration
    """The neutral one, then the poses of the objective: a stack."""


def design_point(problem: _core.Problem, x: Sequence[float]) -> DesignPoint:
    """Return what the core says about one full vector of variables."""
    names = list(problem.names)
    core = problem.evaluate(x)
    objective = _infinite_if_singular(core["objective"])
    slope = objective * core["gradient"] if math.isfinite(objective) else np.full(len(names), np.nan)
    margins: dict[str, tuple[float, Floats]] = {}
    for name, value, margin_slope in core["margins"]:
        if name not in margins or value < margins[name][0]:
            margins[name] = (float(value), margin_slope)
    configurations = Configuration(*problem.configurations(x))
    return DesignPoint(
        variables=dict(zip(names, x, strict=True)),
        objective=objective,
        condition_number=_infinite_if_singular(core["condition_number"]),
        conditions=tuple(_infinite_if_singular(k) for k in core["conditions"]),
        characteristic_length=float(problem.characteristic_length(x)),
        gradient=dict(zip(names, slope.tolist(), strict=True)),
        margins={name: value for name, (value, _) in margins.items()},
        margin_gradients={n: dict(zip(names, s.tolist(), strict=True)) for n, (_, s) in margins.items()},
        geometry=problem.geometry(x),
        configuration=configurations[0],
        configurations=configurations,
    )


def _infinite_if_singular(value: float) -> float:
    return float(value) if value < LARGEST else math.inf
