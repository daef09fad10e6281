"""Changes of a study: variables as people give them (numbers, degrees by their names, per cent), limits scaled."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from ninedof.design.limits import Limit
from ninedof.design.objective import CONDITION_LIMITS
from ninedof.design.study import LENGTH, Study, variable_kinds
from ninedof.support.angles import DEG, in_radians
from ninedof.support.arguments import finite, shown


def angles_in_radians(study: Study, given: Mapping[str, Any], check: Callable[[str, Any], Any]) -> dict[str, Any]:
    """Return checked values of variables, numbers or pairs, with angles in radians under their own names.

    An angle without "_deg" of more than a turn was meant in degrees: it is refused.
    """
    values = {name: check(name, value) for name, value in given.items()}
    for name in study.angles:
        ends = values.get(name, 0.0)
        most = max(map(abs, ends if isinstance(ends, tuple) else (ends,)))
        if most > 2.0 * math.pi:
            raise ValueError(f"{name}: got {most:g} rad, expected at most a turn, or {name}{DEG}")
    return in_radians(values, dict.fromkeys(study.angles, lambda _, value: value))


def given_values(study: Study, own: Mapping[str, float], given: Mapping[str, Any], what: str) -> dict[str, float]:
    """Return values of variables that are given as numbers, or as texts such as "+10%" of those in `own`.

    `what` is the argument in the message of an unknown name.
    """
    names = [*study.variables, *([LENGTH] if LENGTH in own else [])]
    for name in given:
        if name not in [*names, *(f"{angle}{DEG}" for angle in study.angles)]:
            raise ValueError(f"{what}: got {shown(name)}, expected one of {', '.join(names)}")
    return angles_in_radians(study, given, lambda name, value: _value(name, value, own))


def changed_variables(study: Study, own: Mapping[str, float], changes: Mapping[str, Any]) -> dict[str, float]:
    """Return variables with those of `changes` in their place, as `given_values` reads them."""
    if not changes:
        raise ValueError("changes: got none, expected a variable and its value, as a2=900.0 or a2='+10%'")
    values = dict(own) | given_values(study, own, changes, "changes")
    for name, kind in variable_kinds(study.family).items():
        finite(name, values[name], 0.0 if kind == "length" else -math.inf)
    if not 0.0 < values["zs"] < values["zp"]:  # of fixed variables a Study lets it pass: its answer is "infeasible"
        raise ValueError(f"{', '.join(changes)}: got zs = {values['zs']:g}, expected 0 < zs < zp = {values['zp']:g}")
    if values.get(LENGTH, 1.0) <= 0.0:
        raise ValueError(f"{LENGTH}: got {values[LENGTH]:g}, expected a length, more than 0")
    return values


def _value(name: str, value: Any, own: Mapping[str, float]) -> float:
    if not isinstance(value, str):
        return finite(name, value)
    try:
        if not value.endswith("%"):
            raise ValueError
        share = finite(name, float(value[:-1]))
    except ValueError:
        raise ValueError(f"{name}: got {shown(value)}, expected a number, or a change as '+10%'") from None
    if name not in own:
        unit = " of degrees" if name.endswith(DEG) else ": it has no value to change"
        raise ValueError(f"{name}: got {value!r}, expected a number{unit}")
    return own[name] * (1.0 + share / 100.0)


def with_scaled_limits(study: Study, factor: Callable[[str, str], float]) -> Study:
    """Return a study with each end of its limits times factor(label, side); an angle is at most pi.

    The limits of the condition number have the names of the objective's fields as labels.
    """
    constraints = dict[str, list[Limit]]()
    for limit in study.limits:
        most = math.pi if limit.row.is_angle else math.inf
        high = min(limit.high * factor(limit.label, "max"), max(most, limit.high))
        scaled = replace(limit, low=limit.low * factor(limit.label, "min"), high=high)
        constraints.setdefault(limit.name, []).append(scaled)
    bounds = {name: getattr(study.objective, name) for name in CONDITION_LIMITS}
    kept = {name: bound * factor(name, "max") for name, bound in bounds.items() if bound is not None}
    return replace(study, constraints=constraints, objective=replace(study.objective, **kept))
