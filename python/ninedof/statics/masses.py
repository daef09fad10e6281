"""Masses of a machine as the core takes them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.support.arguments import shown
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.units import metres

GRAVITY = (0.0, 0.0, -9.81)
"""Force per mass, base axes."""
OF_LEGS = ("cylinder", "rod", "cylinder_centre", "rod_centre", "cylinder_inertia", "rod_inertia")


def masses_for_core(masses: Any, unit: str = "") -> _core.Masses:
    """Return `ninedof.Masses` such that the forces of the core are newtons for kilograms and lengths of a unit.

    Those of legs may also be nine numbers.
    """
    if not hasattr(masses, "platform") or not hasattr(masses, "rod_inertia"):
        raise ValueError(f"masses: got {shown(masses)}, expected Masses")
    scale = metres(unit)
    xx, yy, zz, xy, xz, yz = masses.inertia
    legs = {name: np.broadcast_to(np.asarray(getattr(masses, name), dtype=float), (9,)) for name in OF_LEGS}
    return _core.Masses(
        platform=scale * masses.platform,
        centre=masses.centre,
        inertia=scale * np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]),
        internal_point=scale * masses.internal_point,
        **{name: (1.0 if name.endswith("_centre") else scale) * values for name, values in legs.items()},
    )


def gravity_for_core(gravity: ArrayLike, unit: str = "") -> Floats:
    """Return gravity as the core takes it beside `masses_for_core`: weights stay mass times gravity."""
    value = as_floats("gravity", gravity, (3,))
    if value.shape != (3,) or not np.isfinite(value).all():
        raise ValueError(f"gravity: got {shown(gravity)}, expected three finite numbers")
    return value / metres(unit)
