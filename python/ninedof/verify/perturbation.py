"""Random steps from a design: from an optimum, no step to an allowed design improves the objective."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ninedof.support.arrays import Floats
from ninedof.verify.objective import ObjectiveRule
from ninedof.verify.robot import DesignSpace, Indices
from ninedof.verify.rules import Limit, margins
from ninedof.verify.stationarity import active_limits

SCALES = tuple(10.0**-k for k in range(1, 7))


@dataclass(frozen=True)
class Perturbations:
    """The results of the steps."""

    tried: int
    better: int
    """Number of designs with a smaller objective, allowed or not."""
    best: float
    """Largest relative improvement by an allowed design; 0 without one."""


def perturb(
    space: DesignSpace, objective: ObjectiveRule, limits: list[Limit], count: int, seed: int, violation: float
) -> Perturbations:
    """Try random steps of six sizes from a design.

    Half of the steps change every free variable, half change about two of them. Steps are clipped to the bounds. A
    design that is better but violates limits is corrected once to first order and evaluated again, because near a
    corner of the allowed region few random steps stay in it.

    Parameters
    ----------
    space : DesignSpace
    objective : ObjectiveRule
    limits : list of Limit
    count, seed : int
    violation : float
        Allowed violation of a limit: that of the design itself.

    """
    n = len(space.free)
    if not n or not count:
        return Perturbations(0, 0, 0.0)
    rng = np.random.default_rng(seed)
    own = objective.total(objective.values(space.robot(space.x)))
    back = np.asarray(np.linalg.pinv(active_limits(space, limits, 0.02)), dtype=np.float64)
    near = [np.flatnonzero(margins(limit, space.robot(space.x)) <= 0.02) for limit in limits]
    better, best = 0, 0.0
    for k in range(count):
        direction = rng.normal(size=n)
        if k % 2 and n > 2:
            direction *= rng.uniform(size=n) < 2.0 / n
        x = _step(space, space.x, SCALES[k % len(SCALES)] * direction)
        gain, worst, broken = _judge(space, objective, limits, near, x, own)
        if gain <= 0.0:
            continue
        better += 1
        if worst < -violation and back.size:
            x = _step(space, x, back @ -np.minimum(broken, 0.0))
            gain, worst, _ = _judge(space, objective, limits, near, x, own)
        if worst >= -violation:
            best = max(best, gain)
    return Perturbations(count, better, best)


def _step(space: DesignSpace, x: Floats, relative: Floats) -> Floats:
    out = x.copy()
    out[space.free] += relative * space.size[space.free]
    return space.inside(out)


def _judge(
    space: DesignSpace, objective: ObjectiveRule, limits: list[Limit], near: list[Indices], x: Floats, own: float
) -> tuple[float, float, Floats]:
    """Return the relative improvement of a design, its worst margin, and the margins that were small at the start."""
    try:
        robot = space.robot(x)
    except ValueError:  # no robot exists, for example if zs exceeds zp
        return 0.0, 0.0, np.empty(0)
    gain = 1.0 - objective.total(objective.values(robot)) / own
    if not gain > 0.0:
        return 0.0, 0.0, np.empty(0)
    every = [margins(limit, robot) for limit in limits]
    worst = min((float(m.min()) for m in every if m.size), default=np.inf)
    zp, zs = float(robot.neutral.position[2]), float(robot.neutral.internal_point[2])
    worst = min(worst, zs / zp, 1.0 - zs / zp)
    worst = min([worst, *(float(m.min()) for m in objective.condition_margins(robot).values())])
    return gain, worst, np.concatenate([m[i] for m, i in zip(every, near, strict=True)] or [np.empty(0)])
