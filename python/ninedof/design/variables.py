"""The variables of a study as people give them, numbers, degrees by their names, per cent; those that make a robot."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ninedof.design.study import LENGTH, Study, variable_kinds
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import TRIPLES, Geometry, triples
from ninedof.support.arguments import finite, shown
from ninedof.support.units import DEG, in_radians


def angles_in_radians(study: Study, changes: Mapping[str, Any], check: Callable[[str, Any], Any]) -> dict[str, Any]:
    """Return checked values of variables, numbers or pairs, with angles in radians under their own names.

    An angle without "_deg" of more than a turn was meant in degrees: it is refused.
    """
    values = {name: check(name, value) for name, value in changes.items()}
    for name in study.angles:
        ends = values.get(name, 0.0)
        most = max(map(abs, ends if isinstance(ends, tuple) else (ends,)))
        if most > 2.0 * math.pi:
            raise ValueError(f"{name}: got {most:g} rad, expected at most a turn, or {name}{DEG}")
    return in_radians(values, dict.fromkeys(study.angles, lambda _, value: value))


def given_values(study: Study, own: Mapping[str, float], changes: Mapping[str, Any], what: str) -> dict[str, float]:
    """Return values of variables that are given as numbers, or as texts such as "+10%" of those in `own`.

    `what` is the argument in the message of an unknown name.
    """
    names = [*study.variables, *([LENGTH] if LENGTH in own else [])]
    for name in changes:
        if name not in [*names, *(f"{angle}{DEG}" for angle in study.angles)]:
            raise ValueError(f"{what}: got {shown(name)}, expected one of {', '.join(names)}")
    return angles_in_radians(study, changes, lambda name, value: _value(name, value, own))


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


SAME = 1e-12  # of the largest coordinate


def variables_of(family: str, geometry: Geometry, neutral: Configuration) -> dict[str, float] | None:
    """Return the variables of a family whose design is a given robot at its neutral pose; None if there are none.

    Of a family's designs p and O are on the z axis at the neutral pose, and the platform turns about it alone.
    """
    candidates = _heights(neutral) | _hexagon(geometry) | _polar(geometry) | _coordinates(geometry)
    values = {name: candidates[name] for name in variable_kinds(family)}
    try:
        point = Study(family, variables=values).evaluate(values)
    except ValueError:  # a side below 0, zs above zp
        return None
    rebuilt = triples(point.geometry) | arrays_of(point.configuration)
    arrays = triples(geometry) | arrays_of(neutral)
    unit = max(float(np.abs(array).max()) for array in arrays.values())
    same = all(np.abs(rebuilt[name] - array).max() <= SAME * unit for name, array in arrays.items())
    return values if same else None


def _heights(neutral: Configuration) -> dict[str, float]:
    q = neutral.rotation
    heights = {"zp": float(neutral.position[2]), "zs": float(neutral.internal_point[2])}
    return heights | {"theta_z": math.atan2(float(q[1, 0]), float(q[0, 0]))}


def _hexagon(geometry: Geometry) -> dict[str, float]:
    """Return the sides: the joints of eqs. (37)-(38) are linear in them."""
    units = [triples(Geometry.hexagonal(x, y, x, y)) for x, y in ((1.0, 0.0), (0.0, 1.0))]
    variables: dict[str, float] = {}
    for body, sides in (("base", ("a1", "a2")), ("platform", ("b1", "b2"))):
        names = [name for name in TRIPLES if name.startswith(body)]
        columns = [np.concatenate([unit[name].ravel() for name in names]) for unit in units]
        joints = np.concatenate([getattr(geometry, name).ravel() for name in names])
        solution = np.linalg.lstsq(np.stack(columns, axis=1), joints, rcond=None)[0]
        rounding = SAME * float(np.abs(solution).max())
        variables |= {side: 0.0 if abs(x) <= rounding else float(x) for side, x in zip(sides, solution, strict=True)}
    return variables


def _polar(geometry: Geometry) -> dict[str, float]:
    """Return radius, angle and height of the first joint of each triple."""
    variables: dict[str, float] = {}
    for name, points in triples(geometry).items():
        x, y, z = points[0].tolist()
        variables |= {f"{name}_radius": math.hypot(x, y), f"{name}_angle": math.atan2(y, x), f"{name}_height": z}
    return variables


def _coordinates(geometry: Geometry) -> dict[str, float]:
    return {
        f"{name}_{i + 1}_{axis}": float(value)
        for name, points in triples(geometry).items()
        for i, point in enumerate(points)
        for axis, value in zip("xyz", point, strict=True)
    }
