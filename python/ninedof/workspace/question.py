"""A workspace that is asked for, as the core takes it: poses, where O is, limits."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.duty import LegDuty, duty
from ninedof.design.limit_numbers import PARTS
from ninedof.redundancy.redundancy import leg_limits
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.support.arguments import (
    choice,
    flag,
    instance,
    items,
    known_keys,
    number,
    shown,
    vector,
    whole,
)
from ninedof.support.arrays import Floats, as_floats, as_number

SETS = ("reachable", "inclusive", "dexterous")
ARCHETYPES = ("constant_orientation", "orientation", *SETS)
SPREAD = 60  # rotations of a set that is not given
MOST_ROTATIONS = 100_000
ROWS = {row.name: row for row in _core.criterion_table}
CRITERIA = tuple(ROWS)
LEG_LIMITS = next(name for name, row in ROWS.items() if row.kind == "length" and name not in PARTS)
"""The criterion that gives every leg a range of lengths of its own."""
ENDS = {"min": "low", "max": "high"}


class WorkspaceArguments(TypedDict, total=False):
    """Arguments besides the box that `workspace` and `certified_workspace` share; `workspace` says what they mean."""

    archetype: str
    criteria: Mapping[str, Any] | None
    internal_point: ArrayLike | str | Mapping[str, ArrayLike] | None
    rotation: Any
    region: Mapping[str, Any] | None
    orientations: Any
    home: Configuration | None
    characteristic_length: float | None
    unit: str | None


DEFAULTS = {"internal_point": 0.5, "characteristic_length": 1.0}
"""Of a robot alone; a design has its own."""


def spread_rotations(count: int, angle: float = math.pi) -> Floats:
    """Return rotations that cover a ball of SO(3) evenly: all of it, or those within an angle of the identity.

    The identity, then a low-discrepancy sequence by Haar's measure. Unless the ball is all of SO(3), every second
    rotation lies on its boundary, where most limits are reached first.

    Parameters
    ----------
    count : int
        Number of rotations.
    angle : float
        Radius of the ball, radians in (0, pi]; all of SO(3) by default.

    Returns
    -------
    numpy.ndarray, shape (count, 3, 3)

    Raises
    ------
    ValueError
        If the count is not positive or the angle outside its range.

    Examples
    --------
    >>> import numpy as np
    >>> import ninedof as nd
    >>> q = nd.spread_rotations(500)
    >>> bool(np.abs(q.mean(axis=0)).max() < 0.02)  # no direction is preferred
    True

    """
    return _core.spread_rotations(whole("count", count, 1, MOST_ROTATIONS), as_number("angle", angle))


def question_of(geometry: Geometry, box: Any, arguments: Mapping[str, Any]) -> _core.WorkspaceQuestion:
    """Return what is asked of the core; raise ValueError for an argument that is not valid."""
    instance("geometry", geometry, Geometry)
    home = arguments["home"]
    if home is not None and (not isinstance(home, Configuration) or home.shape != ()):
        raise ValueError(f"home: got {shown(home)}, expected one Configuration")
    return _core.WorkspaceQuestion(
        geometry,
        domain=_domain(box, arguments),
        rule=rule_of(arguments["internal_point"]),
        criteria=criteria_of(arguments["criteria"], arguments["characteristic_length"]),
        home=home,
    )


def connected(question: _core.WorkspaceQuestion) -> bool:
    """Return whether only what is connected with home counts."""
    return any(ROWS[limit.name].kind == "sign" for limit in question.criteria.limits)


def _domain(box: Any, arguments: Mapping[str, Any]) -> _core.WorkspaceDomain:
    archetype = choice("archetype", arguments["archetype"], ARCHETYPES)
    turns, is_set = archetype == "orientation", archetype in SETS
    position, region = arguments.get("position"), arguments["region"]
    bounds = {
        "box": (box, not turns, not turns),
        "position": (position, turns, turns),
        "rotation": (arguments["rotation"], not is_set, False),
        "region": (region, archetype not in ("constant_orientation", "dexterous"), turns),
        "orientations": (arguments["orientations"], is_set, False),
    }
    for name, (value, takes, needs) in bounds.items():
        if value is not None and not takes:
            raise ValueError(f"{name}: got {shown(value)}, expected nothing for the {archetype} workspace")
        if value is None and needs:
            raise ValueError(f"{name}: got nothing, expected it for the {archetype} workspace")
    chart = _region(region)
    if is_set and chart.chart != "rotation_vector":
        raise ValueError(f"region: got {shown(region)}, expected {{'angle': ...}} for a set of orientations")
    if is_set:
        rotations = _set(arguments["orientations"], math.pi if region is None else chart.angle)
    else:
        rotations = _rotations("rotation", arguments["rotation"])[None]
        if rotations.ndim != 3:
            raise ValueError(f"rotation: got a stack of shape {rotations.shape[1:-2]}, expected one")
    out = _core.WorkspaceDomain(
        archetype="inclusive" if archetype == "dexterous" else archetype, rotations=rotations, region=chart
    )
    if box is not None:
        low, high = items("box", box, "(low, high), each of shape (3,)", 2)
        out.low, out.high = _vector("box (low)", low), _vector("box (high)", high)
    if position is not None:
        out.position = _vector("position", position)
    return out


def _vector(name: str, value: Any) -> Floats:
    array = as_floats(name, value, (3,))
    if array.ndim != 1:
        raise ValueError(f"{name}: got shape {array.shape}, expected shape (3,)")
    return array


def _rotations(name: str, value: Any) -> Floats:
    """Return a rotation, or a stack of them, checked as in a configuration."""
    try:
        return Configuration(np.zeros(3), value, np.zeros(3)).rotation
    except ValueError as error:
        raise ValueError(f"{name}: {str(error).removeprefix('rotation: ')}") from None


def _set(orientations: Any, angle: float) -> Floats:
    if orientations is None or isinstance(orientations, int | np.integer):
        count = SPREAD if orientations is None else whole("orientations", orientations, 1, MOST_ROTATIONS)
        return spread_rotations(count, angle)
    if not hasattr(orientations, "as_matrix") and np.size(orientations) == 0:
        raise ValueError("orientations: got none, expected at least one")
    return _rotations("orientations", orientations).reshape(-1, 3, 3)


def _region(region: Any) -> _core.OrientationRegion:
    """Return the region of {"angle": ...} or {"tilt": ..., "torsion": ...}."""
    if region is None:
        return _core.OrientationRegion()
    known_keys("region", region, ("angle", "tilt", "torsion"))
    if set(region) == {"angle"}:
        return _core.OrientationRegion(angle=as_number("region (angle)", region["angle"]))
    if set(region) != {"tilt", "torsion"}:
        raise ValueError(f"region: got {shown(region)}, expected 'angle', or 'tilt' and 'torsion'")
    tilt, torsion = as_number("region (tilt)", region["tilt"]), region["torsion"]
    if isinstance(torsion, tuple | list):
        low, high = (as_number("region (torsion)", x) for x in items("region (torsion)", torsion, "(low, high)", 2))
    else:
        high = as_number("region (torsion)", torsion)
        low = -high
    return _core.OrientationRegion(chart="tilt_torsion", angle=tilt, torsion_low=low, torsion_high=high)


def rule_of(rule: Any) -> _core.InternalPointRule:
    """Return the rule for O: "best", a fraction, a point of the base, or {"platform": point}."""
    if isinstance(rule, str):
        return _core.InternalPointRule(kind=choice("internal_point", rule, ("best",)))
    if isinstance(rule, Mapping):
        known_keys("internal_point", rule, ("platform",))
        if not rule:
            raise ValueError("internal_point: got {}, expected {'platform': a point}")
        return _core.InternalPointRule(kind="platform", point=_vector("internal_point", rule["platform"]))
    point = as_floats("internal_point", rule, ())
    if point.ndim == 0:
        return _core.InternalPointRule(kind="between", fraction=float(point))
    return _core.InternalPointRule(kind="fixed", point=_vector("internal_point", rule))


def criteria_of(criteria: Mapping[str, Any] | None, characteristic_length: float) -> _core.WorkspaceCriteria:
    """Return criteria by name as the core takes them, in the order of its table; None stands for no limit."""
    entries = {} if criteria is None else criteria
    known_keys("criteria", entries, CRITERIA)
    out = _core.WorkspaceCriteria(characteristic_length=as_number("characteristic_length", characteristic_length))
    limits = []
    for name, row in ROWS.items():
        if (value := entries.get(name)) is None:
            continue
        if name in PARTS:
            limits += _limit(row, value)
            if isinstance(value, Mapping) and "exempt" in value:
                pairs = [choice(f"{name} (exempt)", one, PARTS[name]) for one in value["exempt"]]
                out.exempt = [one in pairs for one in PARTS[name]]
        elif row.kind == "length":
            out.legs = _leg_limits(name, value)
        else:
            out.condition_number = number(name, value)
    out.limits = limits
    return out


def _limit(row: _core.ConstraintInfo, value: Any) -> list[_core.Limit]:
    """Return the limit of a row: a flag, a number for its only side, (low, high), or a mapping with options."""
    if row.kind == "sign":
        return [_core.Limit(name=row.name)] if flag(row.name, value) else []
    entries = value
    if not isinstance(value, Mapping):
        both = items(row.name, value, "(low, high)", 2) if len(row.sides) == 2 else (value,)
        entries = dict(zip(row.sides, both, strict=True))
    option = "axis" if row.is_angle else "duty" if row.needs else "exempt"
    known_keys(row.name, entries, (*row.sides, option))
    ends = {ENDS[side]: number(row.name, entries[side]) for side in row.sides if entries.get(side) is not None}
    if not ends:
        raise ValueError(f"{row.name}: got {shown(value)}, expected a number as {' or '.join(map(repr, row.sides))}")
    if row.needs and "duty" not in entries:
        needs = " and ".join(row.needs)
        raise ValueError(f"{row.name}: got no {needs}, expected the limit of a study, with {needs} of its own")
    options: dict[str, Any] = {}
    if row.needs:
        options["duty"] = duty(LegDuty)(f"{row.name} (duty)", entries["duty"]).for_core()
    if "axis" in entries:
        options["axis"] = np.array(vector(f"{row.name} (axis)", entries["axis"]))
        if not options["axis"].any():
            raise ValueError(f"{row.name} (axis): got {shown(entries['axis'])}, expected a direction")
    return [_core.Limit(name=row.name, **ends, **options)]


def _leg_limits(name: str, value: Any) -> _core.LegLimits:
    low, high = leg_limits(value, name)
    for k in np.flatnonzero(~((low >= 0.0) & (low < high) & np.isfinite(low))).tolist():
        expected = "expected 0 <= low < high, low finite"
        raise ValueError(f"{name} ({LEGS[k]}): got {low[k]:g} to {high[k]:g}, {expected}")
    return _core.LegLimits(low=low, high=high)
