"""The largest payload along a motion, for given forces and powers of the legs."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.duty import Masses
from ninedof.design.limit_numbers import FORCES, PARTS
from ninedof.design.study import Study
from ninedof.motion.follow import Followed
from ninedof.robot.geometry import LEGS, TRIPLES
from ninedof.sheet.region_look import robot_of
from ninedof.sheet.request import duty_of
from ninedof.statics.dynamics import inverse_dynamics
from ninedof.support.arguments import Vector, instance, shown, vector
from ninedof.support.arrays import Floats, one_or_each
from ninedof.support.text import short_repr
from ninedof.support.units import amount


@short_repr
class PathPayload(NamedTuple):
    """The largest mass that the legs move along a motion, and what limits it."""

    mass: float
    """0 where the machine violates a limit without any payload, infinite where no leg reaches one."""
    fits: bool
    """Whether the machine without the payload keeps the limits."""
    leg: str
    """The leg that reaches its limit first, "l1" to "r3"; "" where none does."""
    kind: str
    """The limit that it reaches: "force" or "power"; "" where none is reached, "singular" at a singular pose."""
    time: float
    """When; NaN where no limit is reached."""
    load: int
    """The number of the load of the motion that limits it, from 0."""
    unit: str = ""
    """"kg" where lengths have a unit and forces are newtons."""

    @property
    def words(self) -> str:
        """The payload as a sentence."""
        if np.isinf(self.mass):
            return "no limit of the payload along the path: no leg reaches its force or power"
        at = f"at t = {amount(f'{self.time:.6g}', 's' * bool(self.unit))}"
        if self.kind == "singular":
            return f"no payload along the path: singular {at}"
        if not self.fits:
            return f"no payload along the path: {self.leg} exceeds its {self.kind} {at} without one"
        mass = amount(f"{self.mass:.6g}", self.unit)
        return f"largest payload along the path {mass}: {self.leg} reaches its {self.kind} {at} first"


def payload_along(
    design: Any,
    motion: Followed,
    force: ArrayLike | None = None,
    power: ArrayLike | None = None,
    centre: Vector = (0.0, 0.0, 0.0),
) -> PathPayload:
    """Return the greatest mass on the platform with which every leg keeps its force and its power along a motion.

    With its weight and its inertia: at each instant leg forces are affine in the mass, f0 + m f1, and a power is a
    force times a rate that no payload changes, so that the largest mass has a closed form. It holds at the poses of the
    motion; between them nothing is looked at.

    Parameters
    ----------
    design : Result, Candidate, DesignPoint or a design of a file
        Whose limits `force` and `power` at its poses are held where none is given, with gravity and tool of its study.
    motion : Followed
        Of that design, as `follow` returns it: its loads and masses act besides the payload.
    force : float or array_like of shape (9,), optional
        Greatest force of each leg, pushing or pulling; that of the study by default.
    power : float or array_like of shape (9,), optional
        Greatest power of each leg, force times length/time as a limit of a study; that of the study by default.
    centre : (3,) floats
        Centre of the payload, a point mass, in the frame of the plate; its origin by default.

    Returns
    -------
    PathPayload

    Raises
    ------
    ValueError
        If nothing limits a leg, or an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> machine = nd.Design(g, nd.Configuration.neutral(3.9828, 2.4432))
    >>> lift = nd.follow(machine, nd.Trajectory.line(machine.configuration, (0.0, 0.0, 0.5)))
    >>> payload = nd.payload_along(machine, lift, power=50.0)
    >>> round(payload.mass, 2), payload.kind
    (15.35, 'power')

    """
    instance("motion", motion, Followed)
    g = robot_of(design, length=1.0)[0]
    if not all(np.array_equal(getattr(g, name), getattr(motion.geometry, name)) for name in TRIPLES):
        raise ValueError("motion: got that of another robot, expected what `follow` returns of the design")
    duty, unit, n = duty_of(design), motion.unit, len(motion.time)
    most = {"force": force, "power": power}
    if force is None and power is None:
        limits = {name: _stated(duty, kind) for name, kind in zip(most, (FORCES, "power"), strict=True)}
    else:
        limits = {name: np.full(9, np.inf) if x is None else _limit(name, x) for name, x in most.items()}
    if np.isinf([*limits.values()]).all():
        raise ValueError("force, power: got none, expected one, or a design of a study that limits one at its poses")
    own = np.zeros((1, n, 9)) if motion.leg_forces is None else motion.leg_forces.reshape(-1, n, 9)
    unit_mass = Masses(platform=1.0, centre=duty.tool.seen(vector("centre", centre)))
    state = (motion.velocity, motion.acceleration)
    moved = inverse_dynamics(motion.geometry, motion.configurations, state, unit_mass, duty.loads.gravity, unit=unit)
    with np.errstate(divide="ignore"):  # a leg that rests has no power
        at_power = limits["power"] / np.abs(motion.leg_rates)
    ends = np.minimum(limits["force"], at_power)
    instants = np.stack(np.broadcast_arrays(own, moved.forces, ends, ends), axis=-2).reshape(-1, 36)
    shares = _core.payload_shares(instants, 0).reshape(-1, n, 2, 9)
    if (singular := np.abs(moved.unbalanced).max(axis=1) > 0.0).any():
        return PathPayload(0.0, False, "", "singular", float(motion.time[singular.argmax()]), 0, "kg" * bool(unit))
    share = float(shares.max())
    if share <= 0.0:
        return PathPayload(np.inf, True, "", "", np.nan, 0, "kg" * bool(unit))
    if share == np.inf:  # where a limit is violated most without a payload
        shares = np.stack([own / ends, -own / ends], axis=2)
    load, k, _, leg = map(int, np.unravel_index(int(np.argmax(shares)), shares.shape))
    kind = "force" if limits["force"][leg] <= at_power[k, leg] else "power"
    return PathPayload(1.0 / share, share < np.inf, LEGS[leg], kind, float(motion.time[k]), load, "kg" * bool(unit))


def _stated(study: Study, kind: str) -> Floats:
    """Return the greatest force or power that a study allows each leg at its poses; infinite where none."""
    most = np.full(9, np.inf)
    for one in study.limits:
        if one.at == "poses" and one.kind == kind:
            legs = [LEGS.index(leg) for leg in PARTS[one.name]]
            most[legs] = np.minimum(most[legs], one.high)
    return most


def _limit(name: str, value: ArrayLike) -> Floats:
    limit = one_or_each(name, value, 9)
    if limit.shape != (9,) or not (limit > 0.0).all():
        raise ValueError(f"{name}: got {shown(value)}, expected numbers > 0, one or nine")
    return limit
