"""The variables of a design family that make a given robot."""

from __future__ import annotations

import math

import numpy as np

from ninedof.design.study import Study, variable_kinds
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import TRIPLES, Geometry, triples

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
