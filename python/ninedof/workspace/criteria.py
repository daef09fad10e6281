"""What makes a pose allowed, as the core takes it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ninedof.redundancy.search_arguments import leg_limits
from ninedof.support.arguments import known_keys, shown, vector
from ninedof.support.arrays import Floats, as_floats, as_number

__all__ = ["CRITERIA", "criteria_of"]

CRITERIA = ("leg_limits", "base_cone", "platform_cone", "leg_clearance", "condition_number", "singularity_free")


def criteria_of(criteria: Mapping[str, Any] | None, characteristic_length: float) -> dict[str, Any]:
    """Check the criteria by name."""
    given = {} if criteria is None else criteria
    known_keys("criteria", given, CRITERIA)
    found: dict[str, Any] = dict.fromkeys(CRITERIA)
    for name, value in given.items():
        if value is None:
            continue
        if name == "leg_limits":
            found[name] = _leg_limits(value)
        elif name == "singularity_free":
            if not isinstance(value, bool | np.bool_):
                raise ValueError(f"singularity_free: got {shown(value)}, expected True or False")
            found[name] = bool(value)
        elif name in ("base_cone", "platform_cone"):
            found[name] = _cone(name, value)
        else:
            found[name] = _number(name, value)
    found["singularity_free"] = bool(found["singularity_free"])
    found["characteristic_length"] = as_number("characteristic_length", characteristic_length)
    return found


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool | np.bool_):
        raise ValueError(f"{name}: got {value}, expected a number")
    return as_number(name, value)


def _leg_limits(value: Any) -> tuple[Floats, Floats]:
    low, high = leg_limits(value, "leg_limits")
    for k in np.flatnonzero(~((low >= 0.0) & (low < high) & np.isfinite(low))).tolist():
        leg = f"{'lqr'[k // 3]}{k % 3 + 1}"
        raise ValueError(f"leg_limits ({leg}): got {low[k]:g} to {high[k]:g}, expected 0 <= low < high, low finite")
    return low, high


def _cone(name: str, value: Any) -> tuple[float, Floats]:
    """Return the greatest angle and the axis; zero stands for each leg's own direction at home."""
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
