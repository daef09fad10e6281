"""Criteria of a workspace: checked and converted for the core."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.limits import Row
from ninedof.redundancy.search_arguments import leg_limits
from ninedof.support.arguments import known_keys, shown, vector
from ninedof.support.arrays import Floats, as_floats, as_number

ROWS = {row.name: row for row in (Row(*values) for values in _core.criterion_table)}
CRITERIA = tuple(ROWS)


def criteria_of(criteria: Mapping[str, Any] | None, characteristic_length: float) -> dict[str, Any]:
    """Check the criteria by name; those that are not given are None."""
    given = {} if criteria is None else criteria
    known_keys("criteria", given, CRITERIA)
    found: dict[str, Any] = dict.fromkeys(CRITERIA)
    found |= {name: _checked(ROWS[name], value) for name, value in given.items() if value is not None}
    found["singularity_free"] = bool(found["singularity_free"])
    found["characteristic_length"] = as_number("characteristic_length", characteristic_length)
    return found


def _checked(row: Row, value: Any) -> Any:
    """Return a criterion as the core takes it: by the sides, the kind and the options of its row."""
    if len(row.sides) == 2:
        return _leg_limits(row.name, value)
    if row.kind == "sign":
        if not isinstance(value, bool | np.bool_):
            raise ValueError(f"{row.name}: got {shown(value)}, expected True or False")
        return bool(value)
    return _cone(row.name, value) if "axis" in row.options else _number(row.name, value)


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool | np.bool_):
        raise ValueError(f"{name}: got {value}, expected a number")
    return as_number(name, value)


def _leg_limits(name: str, value: Any) -> tuple[Floats, Floats]:
    low, high = leg_limits(value, name)
    for k in np.flatnonzero(~((low >= 0.0) & (low < high) & np.isfinite(low))).tolist():
        leg = f"{'lqr'[k // 3]}{k % 3 + 1}"
        raise ValueError(f"{name} ({leg}): got {low[k]:g} to {high[k]:g}, expected 0 <= low < high, low finite")
    return low, high


def _cone(name: str, value: Any) -> tuple[float, Floats]:
    """Return the greatest angle and the axis; a zero axis means each leg's own direction at the home configuration."""
    if not isinstance(value, Mapping):
        return _number(name, value), np.zeros(3)
    known_keys(name, value, ("max", "axis"))
    if "max" not in value:
        raise ValueError(f"{name}: got {shown(value)}, expected an angle as 'max'")
    axis = (
        as_floats(f"{name} (axis)", vector(f"{name} (axis)", value["axis"]), (3,)) if "axis" in value else np.zeros(3)
    )
    if "axis" in value and not np.any(axis):
        raise ValueError(f"{name} (axis): got {shown(value['axis'])}, expected a direction")
    return _number(name, value["max"]), axis
