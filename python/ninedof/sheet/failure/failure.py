"""`failure`: what is left of a machine when a leg is locked at its length, or carries nothing."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.conditioning import condition_number as condition_numbers
from ninedof.kinematics.kinematics import jacobian, leg_lengths
from ninedof.kinematics.velocity import forward_velocity
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.sheet.failure.result import Failure, FreeLeg, LegLoad, LockedLegs
from ninedof.sheet.region_look import SAMPLES, Looked, even_poses, look_over, robot_of
from ninedof.sheet.request import duty_of, load_rows, masses_of
from ninedof.sheet.sheet import Extreme, extreme
from ninedof.statics.accuracy import MOST_SAMPLES
from ninedof.statics.dynamics import inverse_dynamics, masses_for_core
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
    g, c, length = robot_of(design, poses, characteristic_length)
    length = 1.0 if np.isnan(length) else length  # of a singular robot, whose numbers are infinite with any
    study = duty_of(design)
    masses, own = masses_of(study), study.loads.wrenches
    if loads is None and (own or masses is not None):
        loads = own or np.zeros(6)
    rows, count = load_rows(loads), whole("samples", samples, 1, MOST_SAMPLES)
    sets = SETS if flag("pairs", pairs) else SETS[:9]
    bound = None if condition_number is None else finite("condition_number", condition_number, 1.0)
    question = _core.SheetQuestion(g, c[0], characteristic_length=length, locked=list(sets))
    question.loads, gravity = list(rows), study.loads.gravity
    if masses is not None:
        question.masses, question.gravity = masses_for_core(masses), gravity
    looked = look_over(design, c, question, count) if poses is None else Looked(c)
    even = None if looked.search is None else even_poses(design, looked, count)
    c = looked.configurations
    forces = [inverse_dynamics(g, c, masses=masses, gravity=gravity, load=row).forces for row in rows]
    healthy = extreme(np.asarray(condition_numbers(g, c, length)), np.argmax)
    bound = 2.0 * healthy.value if bound is None else bound

    def numbers(at: Configuration, of: Sequence[tuple[int, int]] = sets) -> Floats:
        return _core.locked_condition_numbers(g, at, np.array([length]), list(of), 0)

    shares = [None] * len(sets) if even is None else (numbers(even) <= bound).mean(axis=0).tolist()
    home = leg_lengths(g, c[0])
    worst = [extreme(column, np.argmax) for column in numbers(c).T]
    locked = []
    for legs, one, share in zip(sets, worst, shares, strict=True):
        from_home = None
        if even is not None and legs[0] >= 3 and legs[1] < 0:
            stuck = _at_length(g, even, legs[0], float(home[legs[0]]))
            from_home = float((numbers(stuck, [legs]) <= bound).mean())
        locked.append(_locked(legs, one, healthy.value, share, from_home))
    return Failure(
        geometry=g,
        configurations=c,
        characteristic_length=length,
        healthy=healthy,
        bound=bound,
        locked=tuple(locked[:9]),
        pairs=tuple(locked[9:]),
        free=_free(g, c, length, [np.abs(each) for each in forces]),
        relative_manipulability=_core.relative_manipulability(g, c, 0),
        loads=rows,
        masses=masses,
        region=looked.search,
        leg_ranges=looked.leg_ranges,
        unit=study.unit,
    )


def _locked(
    numbers: tuple[int, int], worst: Extreme, healthy: float, share: float | None, from_home: float | None
) -> LockedLegs:
    legs = tuple(LEGS[k] for k in numbers if k >= 0)
    freedoms = 6 - sum(leg in EXTERNAL for leg in legs)
    remaining = worst.value if worst.value < LOST else np.inf
    return LockedLegs(
        legs=legs,
        freedoms=freedoms,
        controlled=freedoms == 6 and bool(np.isfinite(remaining)),
        condition_number=remaining if freedoms == 6 else np.inf,
        remaining=remaining,
        pose=worst.pose,
        ratio=remaining / healthy,
        share=share if share is None or freedoms == 6 else 0.0,
        share_from_home=from_home,
    )


def _at_length(g: Geometry, c: Configuration, leg: int, length: float) -> Configuration:
    """Return configurations with O moved along an internal leg until it has a length."""
    joint = c.position + c.rotation @ g.platform_internal[leg - 3] if leg < 6 else g.base_internal[leg - 6]
    arm = c.internal_point - joint
    now = np.linalg.norm(arm, axis=-1, keepdims=True)
    return Configuration(c.position, c.rotation, joint + arm * (length / np.maximum(now, 1e-300)))


def _free(g: Geometry, c: Configuration, length: float, forces: Sequence[Floats]) -> tuple[FreeLeg, ...]:
    columns = jacobian(g, c, length)
    sizes = np.where(np.isnan(columns).any(axis=1), np.inf, np.linalg.norm(columns, axis=1))
    omega, pdot, sdot = forward_velocity(g, c[0], np.eye(9))
    shares = sizes[0] / sizes[0].max() if np.isfinite(sizes[0]).all() else np.full(9, np.nan)
    return tuple(
        FreeLeg(
            leg=leg,
            twist=(*omega[k].tolist(), *pdot[k].tolist()),
            internal_point=tuple(sdot[k].tolist()),
            size=float(sizes[0, k]),
            share=float(shares[k]),
            least=extreme(sizes[:, k], np.argmin),
            largest=extreme(sizes[:, k], np.argmax),
            loads=tuple(_leg_load(each, k) for each in forces),
        )
        for k, leg in enumerate(LEGS)
    )


def _leg_load(forces: Floats, k: int) -> LegLoad:
    """Return what leg k carries of one load, from moduli of the forces at each pose, shape (n, 9)."""
    borne = forces[:, k] <= BORNE * forces.max(axis=1)
    largest = float(forces[borne].max()) if borne.any() else np.nan
    return LegLoad(float(forces[:, k].max()), bool(borne.all()), largest)
