"""Masses and gravity for the core, and the leg forces of a machine in motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, operands_with
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import items, shown
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.text import short_repr
from ninedof.support.units import metres, unit_argument

GRAVITY = (0.0, 0.0, -9.81)
"""Force per mass, base axes."""
OF_LEGS = ("cylinder", "rod", "cylinder_centre", "rod_centre", "cylinder_inertia", "rod_inertia")


def inertia_matrix(six: Sequence[float]) -> Floats:
    """Return the matrix of ixx, iyy, izz, ixy, ixz and iyz."""
    xx, yy, zz, xy, xz, yz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def masses_for_core(masses: Any, unit: str = "") -> _core.Masses:
    """Return `ninedof.Masses` such that the forces of the core are newtons for kilograms and lengths of a unit.

    Those of legs may also be nine numbers.
    """
    if not hasattr(masses, "platform") or not hasattr(masses, "rod_inertia"):
        raise ValueError(f"masses: got {shown(masses)}, expected Masses")
    scale = metres(unit)
    legs = {name: np.broadcast_to(np.asarray(getattr(masses, name), dtype=float), (9,)) for name in OF_LEGS}
    return _core.Masses(
        platform=scale * masses.platform,
        centre=masses.centre,
        inertia=scale * inertia_matrix(masses.inertia),
        internal_point=scale * masses.internal_point,
        **{name: (1.0 if name.endswith("_centre") else scale) * values for name, values in legs.items()},
    )


def gravity_for_core(gravity: ArrayLike, unit: str = "") -> Floats:
    """Return gravity as the core takes it beside `masses_for_core`: weights stay mass times gravity."""
    value = as_floats("gravity", gravity, (3,))
    if value.shape != (3,) or not np.isfinite(value).all():
        raise ValueError(f"gravity: got {shown(gravity)}, expected three finite numbers")
    return value / metres(unit)


@short_repr
class InverseDynamics(NamedTuple):
    """Leg forces for a motion; leading dimensions are those of configuration, motion and load."""

    forces: Floats
    """In the order of `leg_lengths`, positive if the leg pushes, shape (..., 9)."""
    rates: Floats
    """Of the legs, length/time, shape (..., 9)."""
    power: Floats
    """Force times rate, in watts with a length unit, positive where the actuator does work, shape (..., 9)."""
    unbalanced: Floats
    """The part that no leg forces balance, as `leg_forces` has it, shape (..., 9). Exactly 0 unless singular."""


def inverse_dynamics(
    geometry: Geometry,
    configuration: Configuration,
    motion: tuple[ArrayLike, ArrayLike] = ((0.0,) * 9, (0.0,) * 9),
    masses: Any = None,
    gravity: ArrayLike = GRAVITY,
    load: ArrayLike = (0.0,) * 6,
    unit: str = "",
) -> InverseDynamics:
    """Return the forces that the actuators exert in a motion, and their powers.

    Virtual power: by d'Alembert every body acts on the machine with weight - mass times acceleration. What all of them
    do in a motion (omega, pdot, sdot) is one load on platform and O, and H^T f + load = 0 as in `leg_forces`.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    motion : (velocity, acceleration), each array_like of shape (..., 9)
        Angular velocity of the platform (rad/time), velocities of its origin p and of O (length/time), base frame, and
        their time derivatives, as `Followed.velocity` and `Followed.acceleration` have them. 0 by default: the forces
        that hold the machine at rest.
    masses : Masses, optional
        None by default: the load alone.
    gravity : array_like, shape (3,)
        Force per mass, base axes; (0, 0, -9.81) by default.
    load : array_like, shape (..., 6)
        External load on the platform: moment about p and force, base axes; 0 by default.
    unit : str
        Name of the length unit. With one, masses are kilograms, times seconds, forces newtons and powers watts, and
        moments newtons times the unit, so that gravity stays 9.81. "" by default: units that go together, where
        gravity is an acceleration in the unit of length.

    Raises
    ------
    ValueError
        If an argument does not fit.

    Examples
    --------
    A platform of 5 kg that is lifted at 2 m/s²:

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=0.58124, b1=0.29062, b2=0.0)
    >>> c = nd.Configuration.neutral(0.39828, 0.24432)
    >>> rest, up = [0] * 9, [0, 0, 0, 0, 0, 2, 0, 0, 2]
    >>> lift = nd.inverse_dynamics(g, c, (rest, up), nd.Masses(platform=5.0))
    >>> lift.forces.round(1)[[3, 6]]
    array([29.1, 33.4])

    """
    name = unit_argument(unit)
    velocity, acceleration = items("motion", motion, "velocity and acceleration", 2)
    bodies = _core.Masses() if masses is None else masses_for_core(masses, name)
    shape, flat, rows = operands_with(
        geometry, configuration, velocity=(velocity, 9), acceleration=(acceleration, 9), load=(load, 6)
    )
    rows = np.hstack([rows, np.zeros((len(rows), 3))])
    out = _core.inverse_dynamics(*flat, rows, bodies, gravity_for_core(gravity, name), 0)
    forces, rates, unbalanced = (out.reshape(*shape, 3, 9)[..., k, :].copy() for k in range(3))
    with np.errstate(over="ignore", invalid="ignore"):  # infinite where it is no number of double precision
        power = metres(name) * forces * rates
    return InverseDynamics(forces, rates, power, unbalanced)
