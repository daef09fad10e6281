"""The weight of the platform."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof.support.arguments import Vector, finite, shown, vector
from ninedof.support.arrays import Floats, as_floats

STANDARD = (0.0, 0.0, -9.81)


class Weight(NamedTuple):
    """The weight of the platform with what it carries."""

    mass: float
    centre: Vector
    """Centre of mass in the platform frame."""
    gravity: Vector
    """Force per mass, base axes: with 9.81 and kilograms forces are in newtons, in any unit of length."""

    @classmethod
    def checked(cls, mass: float | None, centre: ArrayLike | None, gravity: ArrayLike | None) -> Weight | None:
        """Return the weight of valid arguments, None without a mass; at the platform's origin by default."""
        if mass is None:
            for name, value in (("centre", centre), ("gravity", gravity)):
                if value is not None:
                    raise ValueError(f"{name}: got {shown(value)} without a mass, expected a mass too")
            return None
        at = vector("centre", (0.0, 0.0, 0.0) if centre is None else as_floats("centre", centre, (3,)).tolist())
        return cls(
            finite("mass", mass, 0.0),
            at,
            vector("gravity", STANDARD if gravity is None else as_floats("gravity", gravity, (3,)).tolist()),
        )

    def wrench(self, rotation: Floats) -> Floats:
        """Return (moment about p, force) at each rotation of the platform, (n, 3, 3), in base axes, shape (n, 6)."""
        arm = rotation @ np.asarray(self.centre)
        force = np.broadcast_to(self.mass * np.asarray(self.gravity), arm.shape)
        return np.concatenate([np.cross(arm, force), force], axis=-1)
