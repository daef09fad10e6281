"""The largest payload of a machine over its poses or its region, for given leg forces."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.limit_numbers import FORCES
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import LEGS
from ninedof.sheet.region_look import SAMPLES, RegionSearch, look_over, robot_of
from ninedof.sheet.request import duty_of, leg_limits_argument, leg_limits_of, load_rows, masses_of
from ninedof.statics.accuracy import MOST_SAMPLES
from ninedof.statics.dynamics import inverse_dynamics, masses_for_core
from ninedof.support.arguments import Vector, vector, whole
from ninedof.support.arrays import Floats
from ninedof.support.text import short_repr
from ninedof.support.units import amount
from ninedof.tables.html import notebook


@short_repr
class Payload(NamedTuple):
    """The largest mass that the legs hold at every pose, and what limits it."""

    mass: float
    """0 where the machine violates a limit without any payload, infinite where no leg reaches one."""
    fits: bool
    """Whether the machine without the payload keeps the limits."""
    leg: str
    """The leg that reaches its limit first, "l1" to "r3"; "" where none does."""
    side: str
    """"push" or "pull"; "" where no leg reaches a limit."""
    configuration: Configuration
    """The worst pose: the leg reaches its limit there."""
    forces: Floats
    """Of the legs there under the payload, for the load that limits it; without it where it does not fit. (9,)."""
    load: int
    """The number of that load in `loads`, from 0."""
    region: RegionSearch | None
    """The search of the region; None for listed poses. It is a search and no proof."""
    limits: tuple[Floats, Floats]
    """Greatest forces of each leg, pushing and pulling, shapes (9,): those given, or of the study."""
    not_looked_at: tuple[str, ...]
    """Limits of the study that a payload may violate: of powers, of forces at the neutral pose, and of forces at all
    poses where others are given."""
    force_unit: str = ""
    """"N" where the study states masses and lengths have a unit: the payload is in kilograms then."""
    without_loads: float = np.inf
    """The largest mass if no load acts: those are always there, so that one upward carries a part of the payload."""

    @property
    def words(self) -> str:
        """The payload as a sentence."""
        if not self.fits:
            return f"no payload: {self.leg} exceeds its limit ({self.side}) without one"
        if np.isinf(self.mass):
            return "no limit: no leg reaches its force under any payload"
        limit = self.limits[self.side == "pull"][LEGS.index(self.leg)]
        first = f"{self.leg} reaches its limit of {amount(f'{limit:g}', self.force_unit)} ({self.side}) first"
        return f"largest payload {mass_words(self.mass, self.force_unit)}: {first}"

    def _repr_html_(self) -> str:
        return notebook(self.words)

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain values."""
        look, pose = self.region, arrays_of(self.configuration)
        search = None if look is None else {"region": look.region, "looked_at": look.looked_at}
        return {**self._asdict(), "configuration": pose, "region": search, "proved": False}


def largest_payload(
    design: Any,
    force: ArrayLike | None = None,
    pull: ArrayLike | None = None,
    centre: Vector = (0.0, 0.0, 0.0),
    loads: ArrayLike | None = None,
    samples: int = SAMPLES,
) -> Payload:
    """Return the greatest mass on the platform such that no leg force violates a limit at any pose, at rest.

    Leg forces are affine in the mass, so that the largest one at a pose has a closed form; over the region of a study
    it is searched as the numbers of `sheet` are: a sample, and descents from the worst of it. That is no proof.

    Parameters
    ----------
    design : Result, Candidate, DesignPoint or a design of a file
        As for `sheet`. Loads, masses and gravity of its study act besides the payload; a design of a file has no study,
        so that nothing else acts.
    force : float or array_like of shape (9,), optional
        Greatest force with which a leg may push, for all legs or in the order of `leg_lengths`; in newtons for
        kilograms and a gravity of 9.81. By default the limits `force`, `external_force`, `upper_force` and
        `lower_force` of the study over its poses; a leg without any is not limited. `Payload.not_looked_at` names the
        other limits of the study that a payload may violate: `sheet` with the payload's mass has forces and powers.
    pull : float or array_like of shape (9,), optional
        Greatest force with which it may pull; `force` by default.
    centre : (3,) floats
        Centre of the payload in the frame of the plate; its origin by default.
    loads : array_like, shape (6,) or (k, 6), optional
        (moment about p, force) on the platform, base axes, each on its own beside the payload; those of the study by
        default.
    samples : int
        Half of the poses of the sample of a region; 10000 by default.

    Raises
    ------
    ValueError
        If there is no design, or an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> machine = nd.Design(g, nd.Configuration.neutral(3.9828, 2.4432))
    >>> payload = nd.largest_payload(machine, force=100.0)
    >>> round(payload.mass, 3), payload.leg[0], payload.side
    (18.0, 'r', 'push')

    """
    duty = duty_of(design)
    g, c, _ = robot_of(design, length=1.0)
    rows = load_rows(duty.loads.wrenches or None if loads is None else loads)
    rows = rows if len(rows) else np.zeros((1, 6))
    others = [one for one in duty.limits if one.row.needs and one.kind != "rate"]  # whatever the mass
    if force is None:
        force = leg_limits_of(duty, FORCES)
        if np.isinf(force).all():
            own_study = getattr(design, "study", None)
            raise ValueError(
                "force: got none, expected a number (--force at the terminal): "
                f"{'there is no study' if own_study is None else 'the study has no limit of force at its poses'}"
            )
        others = [one for one in others if one.kind != FORCES or one.at != "poses"]
    push = leg_limits_argument("force", force)
    most_pull = leg_limits_argument("pull", force if pull is None else pull)
    count = whole("samples", samples, 1, MOST_SAMPLES)
    gravity, masses = duty.loads.gravity, masses_of(duty)
    wrenches = [*rows, np.zeros(6)] if rows.any() else list(rows)
    question = _core.SheetQuestion(g, c[0], loads=wrenches, gravity=gravity)
    if masses is not None:
        question.masses = masses_for_core(masses)
    at = duty.tool.seen(vector("centre", centre))
    question.payload = _core.PayloadLimits(push=push, pull=most_pull, centre=at, gravity=gravity)
    looked = look_over(design, c, question, count)
    c, look = looked.configurations, looked.search
    if look is not None:
        look = look._replace(mean=np.nan, mean_error=np.nan)  # of the condition number, which is not asked for
    numbers = _core.sheet_numbers(question, c)
    shares = numbers["payload"].reshape(len(c), len(wrenches), 2, 9)
    shares, alone = shares[:, : len(rows)], float(shares[:, -1].max())
    most = float(shares.max())
    if most == np.inf:  # a limit is violated without a payload: where it is violated most
        own = numbers["force"].reshape(len(c), len(wrenches), 9)[:, : len(rows)]
        shares = np.stack([own - push, -own - most_pull], axis=2)
    pose, load, side, leg = map(int, np.unravel_index(int(np.argmax(shares)), shares.shape))
    mass = _mass(most)
    down = np.asarray(gravity) * (mass if np.isfinite(mass) else 0.0)
    wrench = rows[load] + np.concatenate([np.cross(c[pose].rotation @ np.asarray(at), down), down])
    forces = inverse_dynamics(g, c[pose], masses=masses, gravity=gravity, load=wrench).forces
    not_looked_at = tuple(one.label for one in others)
    names = (LEGS[leg], ("push", "pull")[side]) if most > 0.0 else ("", "")
    fits, limits = most < np.inf, (push, most_pull)
    return Payload(
        mass, fits, *names, c[pose], forces, load, look, limits, not_looked_at, duty.force_unit, _mass(alone)
    )


def mass_words(mass: float, force_unit: str) -> str:
    """Return a mass with what it is in: kilograms where forces are newtons."""
    return f"{mass:.6g} kg" if force_unit else f"{mass:.6g}, in kg where forces are in N"


def _mass(share: float) -> float:
    """Return the mass of which a unit takes a share of what the legs have left."""
    return 1.0 / share if share > 0.0 else np.inf
