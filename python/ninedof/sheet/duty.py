"""The duty of a study, as options of a sheet that are left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof.design.duty import Masses, Tool
from ninedof.design.study import Study
from ninedof.sheet.request import Weight
from ninedof.support.arguments import Vector, finite, shown, vector
from ninedof.support.arrays import as_floats

WEIGHTS = ("platform", "inertia", "cylinder", "rod", "cylinder_inertia", "rod_inertia", "internal_point")
"""Entries of masses of which one is not 0 where a machine has any."""


def duty_of(design: Any) -> Study:
    """Return the study of a design with the poses that it was solved for; without one, with its unit and its tool."""
    study: Study | None = getattr(design, "solved", None)
    return study or Study(unit=getattr(design, "unit", ""), tool=getattr(design, "tool", Tool()))


def with_duty(options: Mapping[str, Any], study: Study) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the options of a sheet, those left out as the study states them, and the tables that gave some."""
    speeds, tolerances = study.speeds, study.tolerances
    moves = speeds.linear > 0.0 or speeds.angular > 0.0
    stated = (
        ("speeds", "linear_speed", speeds.linear if moves else None),
        ("speeds", "angular_speed", speeds.angular if moves else None),
        ("loads", "loads", study.loads.wrenches or None),
        ("tolerances", "leg_errors", tolerances.legs or None),
        ("tolerances", "joint_errors", tolerances.joints or None),
    )
    out, tables = dict(options), []
    for table, name, value in stated:
        if out[name] is None and value is not None:
            out[name] = value
            tables.append(table)
    if (out["mass"] is None and study.masses.platform > 0.0) or masses_besides_platform(study) is not None:
        tables.append("masses")
    return out, tuple(dict.fromkeys(tables))


def weight_of(study: Study, mass: float | None, centre: ArrayLike | None, gravity: ArrayLike | None) -> Weight | None:
    """Return the weight of the platform, of options or, where they are left out, of the study; None without a mass.

    `centre` is in the platform's own frame, that of the weight in the frame of geometries, the tool's.
    """
    masses = study.masses
    mass = (masses.platform or None) if mass is None else mass
    if mass is None:
        for name, value in (("centre", centre), ("gravity", gravity)):
            if value is not None:
                raise ValueError(f"{name}: got {shown(value)} without a mass, expected a mass too")
        return None
    at = _vector("centre", masses.centre if centre is None else centre)
    return Weight(
        finite("mass", mass, 0.0),
        study.tool.seen(at),
        _vector("gravity", study.loads.gravity if gravity is None else gravity),
    )


def _vector(name: str, value: ArrayLike) -> Vector:
    return vector(name, as_floats(name, value, (3,)).tolist())


def masses_of(study: Study, mass: float | None = None, centre: Vector | None = None) -> Masses | None:
    """Return the masses of a study in the frame of geometries; None where all are 0.

    `mass` and `centre`, in the frame of the plate, take the place of the platform's.
    """
    masses = study.masses
    if mass is not None:
        masses = replace(masses, platform=mass)
    if centre is not None:
        masses = replace(masses, centre=centre)
    if not any(np.any(getattr(masses, name)) for name in WEIGHTS):
        return None
    return masses.seen_from(study.tool)


def masses_besides_platform(study: Study) -> Masses | None:
    """Return the masses of the legs and of O; None where they are 0. Sheets have the platform as a `Weight`."""
    masses = masses_of(study)
    if masses is None or not any((masses.cylinder, masses.rod, masses.internal_point)):
        return None
    return replace(masses, platform=0.0)
