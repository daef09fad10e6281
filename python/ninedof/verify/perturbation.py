"""Thousands of small steps from a design: none that is allowed may be better."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.support.arrays import Floats
from ninedof.verify.aim import Aim
from ninedof.verify.robot import Indices, Places
from ninedof.verify.rules import Limit, margins
from ninedof.verify.stationarity import active_limits

SCALES = tuple(10.0**-k for k in range(1, 7))


@dataclass(frozen=True)
class Perturbations:
    """What became of the steps."""

    tried: int
    better: int
    """Designs with a smaller objective, allowed or not."""
    best: float
    """Largest share by which an allowed one is better; 0 if none is."""


def perturb(places: Places, aim: Aim, limits: list[Limit], count: int, seed: int, violation: float) -> Perturbations:
    """Try random steps from a design, each size a tenth of the one before.

    Half of the steps move every free variable, half about two of them. They are drawn back into the bounds. One that
    is better but breaks limits is pushed back onto them, once, and looked at again: at a corner of the allowed designs
    few random steps stay inside.

    Parameters
    ----------
    places : Places
    aim : Aim
    limits : list of Limit
    count, seed : int
    violation : float
        By how much a limit may be broken: as much as the design itself breaks it.

    """
    n = len(places.free)
    if not n or not count:
        return Perturbations(0, 0, 0.0)
    rng = np.random.default_rng(seed)
    own = aim.total(aim.values(places.robot(places.x)))
    back = np.asarray(np.linalg.pinv(active_limits(places, limits, 0.02)), dtype=np.float64)
    near = [np.flatnonzero(margins(limit, places.robot(places.x)) <= 0.02) for limit in limits]
    better, best = 0, 0.0
    for k in range(count):
        direction = rng.normal(size=n)
        if k % 2 and n > 2:
            direction *= rng.uniform(size=n) < 2.0 / n
        x = _step(places, places.x, SCALES[k % len(SCALES)] * direction)
        gain, worst, broken = _judge(places, aim, limits, near, x, own)
        if gain <= 0.0:
            continue
        better += 1
        if worst < -violation and back.size:
            x = _step(places, x, back @ -np.minimum(broken, 0.0))
            gain, worst, _ = _judge(places, aim, limits, near, x, own)
        if worst >= -violation:
            best = max(best, gain)
    return Perturbations(count, better, best)


def _step(places: Places, x: Floats, relative: Floats) -> Floats:
    out = x.copy()
    out[places.free] += relative * places.size[places.free]
    return places.inside(out)


def _judge(
    places: Places, aim: Aim, limits: list[Limit], near: list[Indices], x: Floats, own: float
) -> tuple[float, float, Floats]:
    """Return by which share a design is better, its worst margin, and the margins that were small at the start."""
    try:
        robot = places.robot(x)
    except ValueError:  # no robot there, as where zs passes zp
        return 0.0, 0.0, np.empty(0)
    gain = 1.0 - aim.total(aim.values(robot)) / own
    if not gain > 0.0:
        return 0.0, 0.0, np.empty(0)
    every = [margins(limit, robot) for limit in limits]
    worst = min((float(m.min()) for m in every if m.size), default=np.inf)
    zp, zs = float(robot.neutral.position[2]), float(robot.neutral.internal_point[2])
    worst = min(worst, zs / zp, 1.0 - zs / zp)
    if np.isfinite(aim.condition_limit):
        conditions = np.asarray(condition_number(robot.geometry, robot.poses, robot.length))
        worst = min(worst, float(np.log(aim.condition_limit / conditions.max())))
    return gain, worst, np.concatenate([m[i] for m, i in zip(every, near, strict=True)] or [np.empty(0)])
