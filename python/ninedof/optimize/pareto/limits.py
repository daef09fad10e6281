"""A study with another value of one limit."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from ninedof.design.domains.region_poses import o_is_placed
from ninedof.design.duty import tolerances_like
from ninedof.design.indices import objectives
from ninedof.design.limit_numbers import SPREADS
from ninedof.design.limits import AT, ROWS, Limit, label, names_with_max, split_label
from ninedof.design.objective import CONDITION_LIMIT
from ninedof.design.study import Study
from ninedof.optimize.result import Result
from ninedof.sheet.rows import limit_rows
from ninedof.sheet.sheet import sheet
from ninedof.support.arguments import did_you_mean, shown
from ninedof.support.units import DEG

TOLERANCE = "tolerance"
"""The larger one of the study's two; both are scaled. It is tighter for the search where it is larger."""
IN_DEGREES = {label(name + DEG, at): label(name, at) for name, row in ROWS.items() if row.is_angle for at in AT}
"""The names of limits on angles whose values are in degrees, "base_cone_deg at neutral", and those in radians."""


def without_degrees(against: Any) -> tuple[Any, bool]:
    """Return the limit behind "base_cone_deg", and whether its values are in degrees."""
    degrees = isinstance(against, str) and against in IN_DEGREES
    return IN_DEGREES[against] if degrees else against, degrees


def with_degrees(against: str) -> str:
    """Return the name for values in degrees of a limit on an angle: "base_cone_deg"; any other name unchanged."""
    return next((name for name, plain in IN_DEGREES.items() if plain == against), against)


def unit_of(study: Study, against: str) -> str:
    """Return the unit of the values of a limit: "deg", "rad", that of lengths or forces, or "" for a ratio."""
    plain, degrees = without_degrees(against)
    if plain in (CONDITION_LIMIT, TOLERANCE):
        return study.unit if plain == TOLERANCE else ""
    unit = _limit(study, plain).unit(study.unit, study.force_unit)
    return "rad" if unit == "deg" and not degrees else unit


def tightest_first(against: str, values: Iterable[float]) -> list[float]:
    """Return values of a limit in the order of a front: a larger tolerance is harder to keep."""
    return sorted(values, reverse=against == TOLERANCE)


def resolve(study: Study, against: str) -> tuple[Study, str]:
    """Return the study to solve and the limit to vary, for the argument `against` of `pareto`.

    A constraint with a max is varied as it is; one at the neutral pose alone is "leg_ratio at neutral". Of two indices,
    one is minimized under limits on the condition number: "speed" for a study of the condition number becomes a study
    of speed with a varying condition limit. The front is the same, with its axes exchanged.
    """
    names = names_with_max()
    labels = [label(one, at) for at in AT for one in names]
    name = against if isinstance(against, str) else ""
    if name in labels:
        return study, name
    if name == TOLERANCE:
        if o_is_placed(study):
            raise ValueError(
                'against: got "tolerance" for a study that places O anew at every pose, where the search leaves no '
                "reserve for it, expected O shifted or held"
            )
        return study, TOLERANCE
    index = study.objective.index
    indices = objectives()
    if name in (CONDITION_LIMIT, *indices):
        if name in (CONDITION_LIMIT, "condition_number") and index != "condition_number":
            return study, CONDITION_LIMIT
        if name in indices and index == "condition_number" and name != index:
            return replace(study, objective=replace(study.objective, index=name)), CONDITION_LIMIT
        raise ValueError(
            f"against: got {shown(against)} for a study of the index {index!r}, expected one of the two to be the "
            "condition number and the other another index"
        )
    plain = split_label(name)[0]
    if plain in ROWS and plain not in names:
        raise ValueError(
            f"against: got {shown(against)}, which has no max, expected a limit that has one: only that varies"
        )
    hint = did_you_mean(name, [*labels, CONDITION_LIMIT, TOLERANCE, *indices])
    raise ValueError(
        f"against: got {shown(against)}, expected a constraint with a max ({', '.join(names)}; also "
        f'"{label(names[0], AT[1])}", "base_cone_deg"), '
        f"{CONDITION_LIMIT}, {TOLERANCE} or another index{hint}"
    )


def with_limit(study: Study, against: str, value: float | None) -> Study:
    """Return the study with another `max` of a limit, None for no max; its other options are kept."""
    if against == TOLERANCE:
        return replace(study, tolerances=tolerances_like(study.tolerances, value or 0.0))
    if against == CONDITION_LIMIT:
        return replace(study, objective=replace(study.objective, condition_limit=value))
    limit = replace(_limit(study, against), high=math.inf if value is None else value)
    others = {name: limits for name, limits in study.constraints.items() if name != limit.name}
    same = [one for one in study.limits if one.name == limit.name and one.at != limit.at]
    same += [limit] * bool(limit.sides)
    return replace(study, constraints=others | ({limit.name: same} if same else {}))


def own_value(study: Study, against: str) -> float | None:
    """Return the value of a constraint in the study; None without one."""
    return _limit(study, against).sides.get("max")


def value_of(study: Study, against: str, result: Result) -> float:
    """Return the least limit that allows the best design of a result: its value over the region, with its options."""
    least = _limit(study, against).low
    study = with_limit(study, against, own_value(study, against) or max(least, 1.0))
    in_region = study.objective.region is not None
    rows = sheet(replace(result, study=study)).limits if in_region else limit_rows(study, result.variables or {})
    return next(row.value for row in rows if row.name == against and row.side == "max")


def floor_of(study: Study, against: str) -> float:
    """Return the lower bound of a constraint for any design: 1 for a ratio of maximum to minimum, or its own min."""
    name = split_label(against)[0]
    least = 1.0 if name in SPREADS and ROWS[name].kind == "ratio" else 0.0
    return max(least, _limit(study, against).low)


def _limit(study: Study, against: str) -> Limit:
    """Return a limit of the study; one without sides where it has none."""
    name, at = split_label(against)
    return next((limit for limit in study.limits if limit.label == against), Limit(name, at=at))
