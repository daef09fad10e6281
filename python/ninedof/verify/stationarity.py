"""Stationarity of a design, also at a kink: the least convex combination of the active gradients.

At a minimum, a convex combination of gradients of the objective and a nonnegative combination of gradients of active
limits and bounds add up to zero: no direction improves to first order. A tie has infinitely many gradients. They are
added one by one, each time the one that most reduces the current combination.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ninedof.support.arrays import Floats
from ninedof.verify.nonsmooth import differences
from ninedof.verify.objective import Gradients, ObjectiveRule
from ninedof.verify.robot import DesignSpace, Indices
from ninedof.verify.rules import Limit, margins

ACTIVE = 1e-6  # relative distance at which a limit or bound is active
ROUNDS = 300


@dataclass(frozen=True)
class Stationarity:
    """The stationarity of a design."""

    residual: float
    """Norm of the least combination: relative change of the objective for a relative change of the variables."""
    gradients: int
    """Gradients of the objective in the last combination."""
    limits: int
    """Active margins and bounds."""


def stationarity(space: DesignSpace, objective: ObjectiveRule, limits: list[Limit]) -> Stationarity:
    """Return the stationarity of a design over the free variables of its study; the worst where several pieces meet."""
    return max((_of_piece(piece, objective, limits) for piece in space.pieces()), key=lambda s: s.residual)


def _of_piece(space: DesignSpace, objective: ObjectiveRule, limits: list[Limit]) -> Stationarity:
    x, size, low, high = space.x, space.size, space.low, space.high
    free = space.free
    if not len(free):
        return Stationarity(0.0, 0, 0)
    slopes = differences(lambda y: objective.matrices(space.robot(y)), x, size, low, high)
    all_slopes = Gradients(objective, space.robot(x), objective.matrices(space.robot(x)), slopes)
    held = -active_limits(space, limits, ACTIVE)
    room = 1.0 / np.maximum(size[free], 1e-300)
    at_low = np.flatnonzero(space.bounded[free] & ((x[free] - low[free]) * room <= ACTIVE))
    at_high = np.flatnonzero(space.bounded[free] & ((high[free] - x[free]) * room <= ACTIVE))
    unit = np.eye(len(free))
    nearer = -differences(space.nearer, x, size, low, high).T
    tied = (space.nearer(x) <= ACTIVE) & (np.abs(nearer).max(axis=1) > ACTIVE)  # without those equal in every design
    cone = np.vstack([held, -unit[at_low], unit[at_high], nearer[tied]])
    residual, used = least_combination(all_slopes, cone)
    return Stationarity(residual, used, len(cone))


def active_limits(space: DesignSpace, limits: list[Limit], near: float) -> Floats:
    """Return the gradients of all margins under `near`, in units of the sizes of the variables, shape (k, free)."""
    here = space.robot(space.x)
    rows = [np.empty((0, len(space.free)))]
    for limit in limits:
        close = np.flatnonzero(margins(limit, here) <= near)
        if len(close):

            def chosen(y: Floats, limit: Limit = limit, close: Indices = close) -> Floats:
                return np.asarray(margins(limit, space.robot(y))[close])

            rows.append(differences(chosen, space.x, space.size, space.low, space.high).T)
    return np.vstack(rows)


def least_combination(slopes: Gradients, cone: Floats) -> tuple[float, int]:
    """Return the least norm of a convex combination of gradients plus a nonnegative combination of the rows of a cone.

    Parameters
    ----------
    slopes : object with steepest(direction) and held(direction)
        The sets of gradients; `held` returns further rows of the cone.
    cone : numpy.ndarray, shape (k, n)

    Returns
    -------
    residual : float
    used : int
        Number of gradients with a positive coefficient.

    """
    n = cone.shape[1]
    points = [slopes.steepest(np.zeros(n))]
    rows = list(cone)
    best, used = np.inf, 0
    for _ in range(ROUNDS):
        a = np.array([*points, *rows]).T
        ones = np.concatenate([np.ones(len(points)), np.zeros(len(rows))])
        scale = max(float(np.abs(a).max()), 1e-300)
        # With a further equation, that the shares sum to one, the solution is a multiple of the least combination.
        shares = nonnegative_least_squares(np.vstack([a / scale, ones]), np.append(np.zeros(n), 1.0))
        shares = shares / max(float(shares[: len(points)].sum()), 1e-300)
        rest = a @ shares
        norm = float(np.linalg.norm(rest))
        if norm < best:
            best, used = norm, int(np.count_nonzero(shares[: len(points)] > 1e-9))
        point, held = slopes.steepest(rest), slopes.held(rest)
        worse = [row for row in held if float(row @ rest) < -1e-3 * norm * float(np.linalg.norm(row))]
        is_new = float(point @ rest) < norm * norm * (1.0 - 1e-3)
        if norm <= 1e-9 or not (is_new or worse):
            break
        if is_new:
            points.append(point)
        rows.extend(worse)
    return best, used


def nonnegative_least_squares(a: Floats, b: Floats) -> Floats:
    """Return x >= 0 that makes |a x - b| least, by the active set method of Lawson and Hanson.

    Parameters
    ----------
    a : numpy.ndarray, shape (m, n)
    b : numpy.ndarray, shape (m,)

    """
    n = a.shape[1]
    x, taken = np.zeros(n), np.zeros(n, dtype=bool)
    tolerance = 1e-14 * (1.0 + float(np.abs(a).max())) * (1.0 + float(np.abs(b).max()))
    for _ in range(10 * n):
        gain = np.where(taken, -np.inf, a.T @ (b - a @ x))
        if float(gain.max()) <= tolerance:
            break
        taken[int(gain.argmax())] = True
        while True:
            trial = np.zeros(n)
            trial[taken] = np.linalg.lstsq(a[:, taken], b, rcond=None)[0]
            if not np.any(trial[taken] <= 0.0):
                break
            out = np.flatnonzero(taken & (trial <= 0.0))
            steps = x[out] / np.maximum(x[out] - trial[out], 1e-300)
            x = x + float(steps.min()) * (trial - x)
            # The entry that set the step is zero except for rounding. Without this line the loop may not end.
            x[out[int(steps.argmin())]] = 0.0
            taken &= x > 1e-15
            if not taken.any():
                trial = np.zeros(n)
                break
        x = trial
    return x
