"""The set of poses of a workspace, its home and the rule for O, as the core takes them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.robot.configuration import Configuration
from ninedof.support.arguments import choice, known_keys, pair, shown, whole
from ninedof.support.arrays import Floats, as_floats, as_number

ARCHETYPES = ("constant_orientation", "orientation", "reachable", "inclusive", "dexterous")
SPREAD = 60  # rotations of a set that is not given
MOST_ROTATIONS = 100_000


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


def domain_of(archetype: str, box: Any, position: Any, rotation: Any, region: Any, orientations: Any) -> dict[str, Any]:
    """Return the set of poses of an archetype; raise for arguments that do not apply to it."""
    choice("archetype", archetype, ARCHETYPES)
    is_set = archetype in ("reachable", "inclusive", "dexterous")
    takes = {
        "box": (box, archetype != "orientation"),
        "position": (position, archetype == "orientation"),
        "rotation": (rotation, not is_set),
        "region": (region, archetype in ("orientation", "reachable", "inclusive")),
        "orientations": (orientations, is_set),
    }
    for name, (given, wanted) in takes.items():
        if given is not None and not wanted:
            raise ValueError(f"{name}: got {shown(given)}, expected nothing for the {archetype} workspace")
    for name in ("box",) if archetype != "orientation" else ("position", "region"):
        if takes[name][0] is None:
            raise ValueError(f"{name}: got nothing, expected it for the {archetype} workspace")
    low, high = _box(box) if box is not None else (np.zeros(3), np.zeros(3))
    chart, angle, torsion = _region(region)
    if is_set and chart != "rotation_vector":
        raise ValueError(f"region: got {shown(region)}, expected {{'angle': ...}} for a set of orientations")
    return {
        "archetype": "inclusive" if archetype == "dexterous" else archetype,
        "low": low,
        "high": high,
        "position": _vector("position", position) if position is not None else np.zeros(3),
        "rotations": _set(orientations, angle if region is not None else math.pi) if is_set else _rotations(rotation),
        "chart": chart,
        "angle": angle,
        "torsion": torsion,
    }


def _box(box: Any) -> tuple[Floats, Floats]:
    low, high = pair("box", box, "(low, high), each of shape (3,)")
    return _vector("box (low)", low), _vector("box (high)", high)


def _vector(name: str, value: Any) -> Floats:
    found = as_floats(name, value, (3,))
    if found.ndim != 1:
        raise ValueError(f"{name}: got shape {found.shape}, expected shape (3,)")
    return found


def _rotations(rotation: Any) -> Floats:
    """Return one rotation as a stack, checked as in a configuration."""
    c = Configuration(np.zeros(3), rotation, np.zeros(3))
    if len(c.shape) > 0:
        raise ValueError(f"rotation: got a stack of shape {c.shape}, expected one")
    return c.rotation.reshape(-1, 3, 3)


def _set(orientations: Any, angle: float) -> Floats:
    if orientations is None or isinstance(orientations, int | np.integer):
        return spread_rotations(
            SPREAD if orientations is None else whole("orientations", orientations, 1, MOST_ROTATIONS), angle
        )
    if not hasattr(orientations, "as_matrix") and np.size(orientations) == 0:
        raise ValueError("orientations: got none, expected at least one")
    try:
        return Configuration(np.zeros(3), orientations, np.zeros(3)).rotation.reshape(-1, 3, 3)
    except ValueError as error:
        raise ValueError(f"orientations: {str(error).removeprefix('rotation: ')}") from None


def _region(region: Any) -> tuple[str, float, tuple[float, float]]:
    """Return chart, angle and torsion of {"angle": ...} or {"tilt": ..., "torsion": ...}."""
    if region is None:
        return "rotation_vector", 0.5, (-0.5, 0.5)
    known_keys("region", region, ("angle", "tilt", "torsion"))
    keys = set(region)
    if keys == {"angle"}:
        return "rotation_vector", as_number("region (angle)", region["angle"]), (-0.5, 0.5)
    if keys != {"tilt", "torsion"}:
        raise ValueError(f"region: got {shown(region)}, expected 'angle', or 'tilt' and 'torsion'")
    return "tilt_torsion", as_number("region (tilt)", region["tilt"]), _torsion(region["torsion"])


def _torsion(given: Any) -> tuple[float, float]:
    if isinstance(given, tuple | list):
        low, high = pair("region (torsion)", given, "a number or (low, high)")
        return as_number("region (torsion)", low), as_number("region (torsion)", high)
    most = as_number("region (torsion)", given)
    return -most, most


def home_of(home: Configuration | None) -> tuple[Floats, Floats, Floats] | None:
    """Return the home pose as the core takes it."""
    if home is None:
        return None
    if not isinstance(home, Configuration) or home.shape != ():
        raise ValueError(f"home: got {shown(home)}, expected one Configuration")
    return home.position, home.rotation, home.internal_point


def rule_of(rule: Any) -> tuple[str, float, Floats]:
    """Return the rule for O: "best", a fraction, a point of the base, or {"platform": point}."""
    if isinstance(rule, str):
        choice("internal_point", rule, ("best",))
        return "best", 0.5, np.zeros(3)
    if isinstance(rule, Mapping):
        known_keys("internal_point", rule, ("platform",))
        if not rule:
            raise ValueError("internal_point: got {}, expected {'platform': a point}")
        return "platform", 0.5, _vector("internal_point", rule["platform"])
    found = as_floats("internal_point", rule, ())
    if found.ndim == 0:
        return "between", float(found), np.zeros(3)
    return "fixed", 0.5, _vector("internal_point", rule)
