"""The largest payload along a motion, for given forces and powers of the legs."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.duty import Masses
from ninedof.design.limit_numbers import FORCES
from ninedof.motion.follow import Followed
from ninedof.robot.geometry import LEGS, TRIPLES
from ninedof.sheet.payload import mass_words
from ninedof.sheet.region_look import robot_of
from ninedof.sheet.request import duty_of, leg_limits_argument, leg_limits_of
from ninedof.statics.dynamics import inverse_dynamics
from ninedof.support.arguments import Vector, instance, vector
from ninedof.support.text import short_repr
from ninedof.support.units import amount, kind_unit


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
    """Name of the length unit; "" without one."""
    force_unit: str = ""
    """"N": the payload is in kilograms. "": what goes with the unit of forces."""
    limit: float = np.nan
    """The force or power that the leg reaches; NaN where no limit is reached."""

    @property
    def words(self) -> str:
        """The payload as a sentence."""
        if np.isinf(self.mass):
            return "no limit of the payload along the path: no leg reaches its force or power"
        at = f"at t = {amount(f'{self.time:.6g}', 's' * bool(self.unit))}"
        if self.kind == "singular":
            return f"no payload along the path: singular {at}"
        kind = FORCES if self.kind == "force" else self.kind
        reached = f"{self.kind} of {amount(f'{self.limit:g}', kind_unit(kind, self.unit, self.force_unit))}"
        if not self.fits:
            return f"no payload along the path: {self.leg} exceeds its {reached} {at} without one"
        mass = mass_words(self.mass, self.force_unit)
        return f"largest payload along the path {mass}: {self.leg} reaches its {reached} {at} first"


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
        Of the tool of its study `centre` is seen, and its limits hold where none is given.
    motion : Followed
        Of that design, as `follow` returns it: its loads, masses and gravity act on the payload too.
    force : float or array_like of shape (9,), optional
        Greatest force of each leg, pushing or pulling; by default the limit `force` of the study at its poses, if any.
    power : float or array_like of shape (9,), optional
        Greatest power of each leg, force times length/time; by default the limit `power` of the study, if any.
    centre : (3,) floats
        Centre of the payload, a point mass, in the frame of the plate; its origin by default.

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
    duty, n = duty_of(design), len(motion.time)
    limits = [
        leg_limits_of(duty, kind) if value is None else leg_limits_argument(name, value)
        for name, value, kind in (("force", force, FORCES), ("power", power, "power"))
    ]
    if np.isinf(limits).all():
        raise ValueError("force, power: got none, expected one, or a design of a study that limits one at its poses")
    own = np.zeros((1, n, 9)) if motion.leg_forces is None else motion.leg_forces.reshape(-1, n, 9)
    unit_mass = Masses(platform=1.0, centre=duty.tool.seen(vector("centre", centre)))
    state = (motion.velocity, motion.acceleration)
    moved = inverse_dynamics(motion.geometry, motion.configurations, state, unit_mass, motion.gravity, unit=motion.unit)
    with np.errstate(divide="ignore", invalid="ignore"):  # a leg that rests has no power
        at_power = np.where(motion.leg_rates == 0.0, np.inf, limits[1] / np.abs(motion.leg_rates))
    ends = np.minimum(limits[0], at_power)
    instants = np.stack(np.broadcast_arrays(own, moved.forces, ends, ends), axis=-2).reshape(-1, 36)
    shares = _core.payload_shares(instants, 0).reshape(-1, n, 2, 9)
    units = motion.unit, motion.force_unit or duty.force_unit
    if (singular := np.abs(moved.unbalanced).max(axis=1) > 0.0).any():
        return PathPayload(0.0, False, "", "singular", float(motion.time[singular.argmax()]), 0, *units)
    share = float(shares.max())
    if share <= 0.0:
        return PathPayload(np.inf, True, "", "", np.nan, 0, *units)
    if share == np.inf:  # where a limit is violated most without a payload
        with np.errstate(divide="ignore", invalid="ignore"):
            shares = np.nan_to_num(np.stack([own / ends, -own / ends], axis=2), nan=0.0)
    load, k, _, leg = map(int, np.unravel_index(int(np.argmax(shares)), shares.shape))
    kind = "force" if limits[0][leg] <= at_power[k, leg] else "power"
    limit = float(limits[kind == "power"][leg])
    return PathPayload(1.0 / share, share < np.inf, LEGS[leg], kind, float(motion.time[k]), load, *units, limit)
