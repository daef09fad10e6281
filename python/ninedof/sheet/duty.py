"""The duty of a study, as options of a sheet that are left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof.design.duty import Masses
from ninedof.design.study import Study
from ninedof.sheet.request import Weight
from ninedof.support.arguments import Vector

WEIGHTS = ("platform", "inertia", "cylinder", "rod", "cylinder_inertia", "rod_inertia", "internal_point")
"""Entries of masses of which one is not 0 where a machine has any."""
SLOW = (1.0, 0.0)
"""Linear and angular speed where nothing states them."""


def with_duty(options: Mapping[str, Any], study: Study) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the options of a sheet, those left out as the study states them, and the tables that gave some."""
    speeds, tolerances, wrenches = study.speeds, study.tolerances, study.loads.wrenches
    moves = speeds.linear > 0.0 or speeds.angular > 0.0
    linear, angular = (speeds.linear, speeds.angular) if moves else SLOW
    stated: dict[str, tuple[str, Any]] = {
        "linear_speed": ("speeds" * moves, linear),
        "angular_speed": ("speeds" * moves, angular),
        "loads": ("loads", np.array(wrenches) if wrenches else None),
        "leg_errors": ("tolerances", tolerances.legs or None),
        "joint_errors": ("tolerances", tolerances.joints or None),
    }
    out, tables = dict(options), []
    for name, (table, value) in stated.items():
        if out[name] is None and value is not None:
            out[name] = value
            tables.append(table)
    if (out["mass"] is None and study.masses.platform > 0.0) or masses_besides_platform(study) is not None:
        tables.append("masses")
    return out, tuple(dict.fromkeys(table for table in tables if table))


def weight_of(study: Study, mass: float | None, centre: ArrayLike | None, gravity: ArrayLike | None) -> Weight | None:
    """Return the weight of the platform, of options or, where they are left out, of the study; None without a mass.

    `centre` is in the platform's own frame, that of the weight in the frame of geometries, the tool's.
    """
    masses = study.masses
    mass = (masses.platform or None) if mass is None else mass
    if mass is not None:
        centre = masses.centre if centre is None else centre
        gravity = study.loads.gravity if gravity is None else gravity
    weight = Weight.of(mass, centre, gravity)
    return weight if weight is None or not study.tool else weight._replace(centre=study.tool.seen(weight.centre))


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
    return masses.seen_from(study.tool) if study.tool else masses


def masses_besides_platform(study: Study) -> Masses | None:
    """Return the masses of the legs and of O; None where they are 0. Sheets have the platform as a `Weight`."""
    masses = masses_of(study)
    if masses is None or not any((masses.cylinder, masses.rod, masses.internal_point)):
        return None
    return replace(masses, platform=0.0)
