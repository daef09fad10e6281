"""`failure`: what is left of a machine when a leg is locked at its length, or carries nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import length_argument, resolve_length
from ninedof.conditioning.conditioning import condition_number as condition_numbers
from ninedof.design.region_poses import Placing, configurations_at, places_o
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import jacobian
from ninedof.kinematics.velocity import forward_velocity
from ninedof.robot.configuration import Configuration, operands
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.sheet.duty import masses_of
from ninedof.sheet.failure.result import Failure, FreeLeg, LegLoad, LockedLegs
from ninedof.sheet.region_look import PLACED, SAMPLES, RegionSearch, joined, look_over
from ninedof.sheet.request import load_rows, robot_of
from ninedof.sheet.sheet import Extreme
from ninedof.statics.accuracy import MOST_SAMPLES
from ninedof.statics.dynamics import inverse_dynamics
from ninedof.support.arguments import finite, flag, whole
from ninedof.support.arrays import Floats

LOST = 1e6
"""A condition number from which control counts as lost: a search comes this near to a singular pose, never onto it."""
BORNE = 1e-9  # of the largest force in a leg: a free leg that would have to carry no more does not matter
EXTERNAL = LEGS[:3]
SETS = (*((k, -1) for k in range(9)), *combinations(range(9), 2))


def failure(
    design: Any,
    poses: Configuration | None = None,
    *,
    condition_number: float | None = None,
    loads: ArrayLike | None = None,
    pairs: bool = True,
    characteristic_length: float | str | None = None,
    samples: int = SAMPLES,
) -> Failure:
    """Return what is left of a machine when a leg is locked at its length, or carries nothing.

    A locked leg has the rate 0: the platform moves with J' without its column. Locked, an internal leg leaves the
    platform all six freedoms, with another condition number: O gives way. An external leg joins base and platform
    alone: locked, it takes the motion of its platform joint along the leg, in every design, and five freedoms are left.
    Locked legs carry load as before: forces do not change. A leg that carries nothing leaves one motion to itself, and
    the other eight bear only loads for which the force in it is 0.

    The poses are those of the study; of the result of a region study also the worst of its region, sought as those of
    `sheet` are: a dense sample, and descents from the worst of it for each leg and pair. Where O is placed anew at
    every pose, the sample has 4000 poses, without descents.

    Parameters
    ----------
    design : Result, Candidate, DesignPoint, a design of a file, or Geometry
        As of `sheet`.
    poses : Configuration, shape (n,), optional
        As of `sheet`: in place of the study's, no region is looked over then.
    condition_number : float, optional
        At least 1: the bound of shares of a region. Twice the worst of the machine with nine legs by default.
    loads : array_like, shape (6,) or (k, 6), optional
        (moment about p, force) on the platform, base axes; those of the study by default. Masses and gravity of the
        study act besides: its forces are those at rest.
    pairs : bool
        Whether pairs of legs are locked too.
    characteristic_length : float or str, optional
        That of the design by default, 1 for a Geometry; a kind is taken at the neutral pose.
    samples : int
        Half of the poses of the sample of a region, and even poses for shares; 10000 by default.

    Returns
    -------
    Failure

    Raises
    ------
    ValueError
        If there is no design, or an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(zp=[3.9828], zs=2.3745)
    >>> one = nd.failure(g, c)
    >>> one.locked[3].legs, round(one.locked[3].condition_number, 4), round(one.healthy.value, 4)
    (('q1',), 4.0118, 3.911)
    >>> one.locked[0].legs, one.locked[0].freedoms, one.locked[0].controlled
    (('l1',), 5, False)

    """
    g, c, own_length = robot_of(design, poses)
    length = length_argument(own_length if characteristic_length is None else characteristic_length)
    length = float(resolve_length(g, c[0], length)[0])
    study = getattr(design, "solved", None) or Study()
    masses, own = masses_of(study), study.loads.wrenches
    if loads is None and (own or masses is not None):
        loads = own or np.zeros(6)
    rows, count = load_rows(loads), whole("samples", samples, 1, MOST_SAMPLES)
    sets = SETS if flag("pairs", pairs) else SETS[:9]
    bound = None if condition_number is None else finite("condition_number", condition_number, 1.0)
    over = _Poses.of(design, c, length, sets, count) if poses is None else _Poses(c)
    c = over.worst
    gravity = study.loads.gravity
    forces = [inverse_dynamics(g, c, masses=masses, gravity=gravity, load=row).forces for row in rows]
    healthy = np.asarray(condition_numbers(g, c, length))
    at = int(np.argmax(healthy))
    bound = 2.0 * float(healthy[at]) if bound is None else bound
    locked = _locked(g, over, length, sets, (float(healthy[at]), bound))
    return Failure(
        geometry=g,
        configurations=c,
        characteristic_length=length,
        healthy=Extreme(float(healthy[at]), at),
        bound=bound,
        locked=locked[:9],
        pairs=locked[9:],
        free=tuple(_free(g, c, length, [np.abs(each) for each in forces])),
        relative_manipulability=_core.relative_manipulability(*operands(g, c), 0),
        loads=rows,
        masses=masses,
        region=over.region,
        leg_ranges=over.ranges,
        unit=getattr(getattr(design, "solved", None) or design, "unit", ""),
    )


@dataclass(frozen=True)
class _Poses:
    """The poses that are looked at."""

    worst: Configuration
    """The neutral one first."""
    even: Configuration | None = None
    """Of a region."""
    region: RegionSearch | None = None
    ranges: tuple[tuple[float, float], ...] | None = None

    @staticmethod
    def of(design: Any, c: Configuration, length: float, sets: Sequence[tuple[int, int]], count: int) -> _Poses:
        """Return the poses of a design, of the result of a region study the worst of the region too."""
        study: Any = getattr(design, "study", None)
        report = getattr(design, "region", None)
        region = None if study is None else study.objective.region
        ranges = None if region is None or places_o(region) or report is None else report.leg_ranges
        if region is None or not (places_o(region) or ranges is not None):
            return _Poses(c)
        place = None
        if ranges is not None:
            place = Placing(study, c[0], design.variables or {}, design.objective, ranges)
        question = _core.SheetQuestion(design.geometry, c[0], characteristic_length=length, locked=list(sets))
        look, worst, _ = look_over(study, c[0], question, count, place)
        at = _core.even_poses(region.for_core(), count if place is None else min(count, PLACED))
        even = configurations_at(region, c[0], at)[1] if place is None else place(at)[0]
        return _Poses(joined(c, worst), even, look, ranges)


def _locked(
    g: Geometry, over: _Poses, length: float, sets: Sequence[tuple[int, int]], healthy_and_bound: tuple[float, float]
) -> tuple[LockedLegs, ...]:
    def numbers(c: Configuration, of: Sequence[tuple[int, int]] = sets) -> Floats:
        return _core.locked_condition_numbers(*operands(g, c), np.array([length]), list(of), 0)

    healthy, bound = healthy_and_bound
    worst, even, home = numbers(over.worst), over.even, over.worst[:1]
    shares = None if even is None else (numbers(even) <= bound).mean(axis=0)
    out = []
    for k, (one, other) in enumerate(sets):
        legs = (LEGS[one],) if other < 0 else (LEGS[one], LEGS[other])
        pose = int(np.argmax(worst[:, k]))
        remaining, freedoms = float(worst[pose, k]), 6 - sum(leg in EXTERNAL for leg in legs)
        remaining = remaining if remaining < LOST else np.inf
        all_left = freedoms == 6
        from_home = None
        if even is not None and all_left and other < 0:
            stuck = _at_length(g, even, one, float(_leg(g, home, one)[1][0]))
            from_home = float((numbers(stuck, [(one, -1)]) <= bound).mean())
        out.append(
            LockedLegs(
                legs=legs,
                freedoms=freedoms,
                controlled=all_left and bool(np.isfinite(remaining)),
                condition_number=remaining if all_left else np.inf,
                remaining=remaining,
                pose=pose,
                ratio=remaining / healthy,
                share=None if shares is None else float(shares[k]) if all_left else 0.0,
                share_from_home=from_home,
            )
        )
    return tuple(out)


def _leg(g: Geometry, c: Configuration, leg: int) -> tuple[Floats, Floats, Floats]:
    """Return the joint of an internal leg, base frame, its length and its vector to O, at each pose."""
    if leg < 6:
        joint = c.position + c.rotation @ g.platform_internal[leg - 3]
    else:
        joint = np.broadcast_to(g.base_internal[leg - 6], c.position.shape)
    arm = c.internal_point - joint
    return joint, np.linalg.norm(arm, axis=-1), arm


def _at_length(g: Geometry, c: Configuration, leg: int, length: float) -> Configuration:
    """Return configurations with O moved along an internal leg until it has a length."""
    joint, now, arm = _leg(g, c, leg)
    return Configuration(c.position, c.rotation, joint + arm * (length / np.maximum(now, 1e-300))[:, None])


def _free(g: Geometry, c: Configuration, length: float, forces: Sequence[Floats]) -> list[FreeLeg]:
    columns = jacobian(g, c, length)
    sizes = np.where(np.isnan(columns).any(axis=1), np.inf, np.linalg.norm(columns, axis=1))
    omega, pdot, sdot = forward_velocity(g, c[0], np.eye(9))
    out = []
    for k, leg in enumerate(LEGS):
        least, most = int(np.argmin(sizes[:, k])), int(np.argmax(sizes[:, k]))
        out.append(
            FreeLeg(
                leg=leg,
                twist=tuple(np.concatenate([omega[k], pdot[k]]).tolist()),
                internal_point=tuple(sdot[k].tolist()),
                size=float(sizes[0, k]),
                share=float(sizes[0, k] / sizes[0].max()) if np.isfinite(sizes[0]).all() else np.nan,
                least=Extreme(float(sizes[least, k]), least),
                largest=Extreme(float(sizes[most, k]), most),
                loads=tuple(_leg_load(each, k) for each in forces),
            )
        )
    return out


def _leg_load(forces: Floats, k: int) -> LegLoad:
    """Return what leg k carries of one load, from moduli of the forces at each pose, shape (n, 9)."""
    borne = forces[:, k] <= BORNE * forces.max(axis=1)
    largest = float(forces[borne].max()) if borne.any() else np.nan
    return LegLoad(float(forces[:, k].max()), bool(borne.all()), largest)
