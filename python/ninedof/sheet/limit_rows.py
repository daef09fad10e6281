"""The limits of a study beside the values of a design."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from ninedof.design.limits import kind_unit
from ninedof.design.objective import CONDITION_LIMITS
from ninedof.design.study import Study
from ninedof.support.units import amount


class LimitRow(NamedTuple):
    """One side of a limit beside the worst value of the design at the study's own poses."""

    name: str
    """As margins call it: "base_cone", "base_cone at neutral"."""
    side: str
    """"min" or "max"."""
    limit: float
    """Angles in radians."""
    value: float
    """In the unit of the limit."""
    margin: float
    """As `margin_of`, negative if violated: `DesignPoint.margins`."""
    part: str
    """The leg, the pair of legs ("l1-q2") or the determinant that reaches it; "" for a limit without parts."""
    unit: str
    """"ratio", "length", "angle", "sign", "number", "rate" or "power" as in the table of constraints; "ratio" for a
    length over zp or a radius."""


def limit_amount(row: LimitRow, value: float, number: Callable[[float], str], unit: str, degree: str = "°") -> str:
    """Return a value of a limit with its unit, as `number` writes it; an angle in degrees."""
    if row.unit == "angle":
        return f"{math.degrees(value):.2f}{degree}"
    return amount(number(value), kind_unit(row.unit, unit))


def limit_rows(study: Study, variables: Mapping[str, float]) -> tuple[LimitRow, ...]:
    """Return a row for each side of each limit, in the order of the study."""
    problem, x, rows = study.problem(), study.vector(variables), []
    for limit in study.limits:
        for side, bound in limit.sides.items():
            low, high = (bound, math.inf) if side == "min" else (0.0, bound)
            alone = problem.with_limits([study.limit_for_core(replace(limit, low=low, high=high))], math.inf, math.inf)
            rows.append(_row(side, bound, limit.kind, alone.evaluate(x)))
    for name in CONDITION_LIMITS:
        if (bound := getattr(study.objective, name)) is not None:
            alone = problem.with_limits([], *(bound if name == other else math.inf for other in CONDITION_LIMITS))
            rows.append(_row("max", bound, "ratio", alone.evaluate(x)))
    return tuple(rows)


def _row(side: str, bound: float, kind: str, point: Mapping[str, Any]) -> LimitRow:
    ((label, margin, _),) = point["margins"]
    return LimitRow(label, side, bound, point["limited"][label], margin, point["parts"][label], kind)
