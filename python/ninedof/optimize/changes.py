"""Variables of a design with some of them changed: to a value, or by per cent."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ninedof.design.study import LENGTH, Study, variable_kinds
from ninedof.support.angles import in_radians
from ninedof.support.arguments import finite, shown


def changed_variables(study: Study, own: Mapping[str, float], changes: Mapping[str, Any]) -> dict[str, float]:
    """Return variables with those of `changes` in their place: numbers, or texts as "+10%".

    Raises
    ------
    ValueError
        If a name or a value does not fit, or the family has no such design.

    """
    if not changes:
        raise ValueError("changes: got none, expected a variable and its value, as a2=900.0 or a2='+10%'")
    kinds = variable_kinds(study.family)
    names = [*kinds, *([LENGTH] if LENGTH in own else [])]
    angles = [name for name, kind in kinds.items() if kind == "angle"]
    for name in changes:
        if name not in names and name not in [f"{angle}_deg" for angle in angles]:
            raise ValueError(f"changes: got {shown(name)}, expected one of {', '.join(names)}")
    degrees = {name: _value(name, value, own) for name, value in changes.items()}
    for name in angles:
        if abs(degrees.get(name, 0.0)) > 2.0 * math.pi:
            raise ValueError(f"{name}: got {degrees[name]:g} rad, expected at most a turn, or {name}_deg")
    values = dict(own) | in_radians(degrees, dict.fromkeys(angles, finite))
    for name, kind in kinds.items():
        finite(name, values[name], 0.0 if kind == "length" else -math.inf)
    try:
        Study(study.family, variables={name: values[name] for name in kinds})  # raises where zs is above zp
    except ValueError as error:
        raise ValueError(f"{', '.join(changes)}: {error}") from None
    if not 0.0 < values["zs"] < values["zp"]:
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
        raise ValueError(f"{name}: got {value!r}, expected a number of degrees")
    return own[name] * (1.0 + share / 100.0)
