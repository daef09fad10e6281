"""Arguments of the searches for an internal point: poses, starts, and the problem as the core takes it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, require_geometry
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, shown
from ninedof.support.arrays import Floats, as_floats, as_number

CRITERIA = ("condition_number", "singularity", "leg_centring")


class PointOptions(TypedDict, total=False):
    """Options that the searches for an internal point share; `best_internal_point` says what they mean."""

    characteristic_length: float
    start: ArrayLike | None
    clearance: float | None


def poses_of(geometry: Geometry, position: ArrayLike, rotation: Any) -> tuple[tuple[int, ...], Floats, Floats]:
    """Check a stack of poses as a configuration would; return its shape and flat arrays."""
    require_geometry(geometry)
    c = Configuration(position, rotation, np.zeros(3))
    return c.shape, c.position.reshape(-1, 3), c.rotation.reshape(-1, 3, 3)


def starts_of(start: ArrayLike | None, shape: tuple[int, ...]) -> Floats:
    """Return one start for each pose, or no rows for the default."""
    if start is None:
        return np.empty((0, 3))
    given = as_floats("start", start, (3,))
    try:
        return np.ascontiguousarray(np.broadcast_to(given, (*shape, 3))).reshape(-1, 3)
    except ValueError:
        raise ValueError(f"start: got shape {given.shape}, expected one that broadcasts to {(*shape, 3)}") from None


def problem_of(criterion: str, limits: Any, options: Mapping[str, Any]) -> _core.InternalPointProblem:
    """Return the problem of an internal point; the default clearance depends on the criterion."""
    clearance = options["clearance"]
    if clearance is None:
        clearance = 1e-2 if criterion == "leg_centring" else 1e-10
    low, high = leg_limits(limits)
    return _core.InternalPointProblem(
        criterion=choice("criterion", criterion, CRITERIA),
        limits=_core.LegLimits(low=low, high=high),
        characteristic_length=as_number("characteristic_length", options["characteristic_length"]),
        clearance=as_number("clearance", clearance),
    )


def leg_limits(limits: Any, name: str = "limits") -> tuple[Floats, Floats]:
    """Return least and greatest lengths of the nine legs from (low, high), each a number or nine."""
    if limits is None:
        return np.zeros(9), np.full(9, np.inf)
    if not isinstance(limits, tuple | list) or len(limits) != 2:
        raise ValueError(f"{name}: got {shown(limits)}, expected (low, high), each a number or nine")
    ends = []
    for side, end in zip(("low", "high"), limits, strict=True):
        values = as_floats(f"{name} ({side})", end, ())
        if values.shape not in ((), (9,)):
            raise ValueError(f"{name} ({side}): got shape {values.shape}, expected a number or shape (9,)")
        ends.append(np.ascontiguousarray(np.broadcast_to(values, 9)))
    return ends[0], ends[1]
