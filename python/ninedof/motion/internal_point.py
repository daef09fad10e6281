"""Where O is along a trajectory: carried, shifted, held, a fraction between the plates, or best."""

from __future__ import annotations

from typing import Any

import numpy as np

from ninedof.motion.trajectory import Trajectory
from ninedof.redundancy.redundancy import best_internal_path
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, finite
from ninedof.support.arrays import Floats

MOST_SEARCHED = 201  # poses at which the best O is searched


def rule_argument(rule: Any) -> str | float:
    """Return a rule: one of RULES or a fraction."""
    return choice("internal_point", rule, RULES) if isinstance(rule, str) else finite("internal_point", rule)


def internal_points(
    geometry: Geometry,
    trajectory: Trajectory,
    home: Configuration,
    rule: str | float,
    length: float,
    limits: tuple[Floats, Floats],
) -> Floats:
    """Return O at each pose, shape (n, 3)."""
    p, q = trajectory.position, trajectory.rotation
    if rule == "best":
        return _best(geometry, trajectory, home, length, limits)
    if rule == "held":
        return np.tile(home.internal_point, (len(p), 1))
    if rule == "shifted":
        return np.asarray(p + (home.internal_point - home.position))
    if rule == "carried":
        own = home.rotation.T @ (home.internal_point - home.position)  # in the platform frame
        found: Floats = p + q @ own
        return found
    below, above = geometry.base_internal.mean(axis=0), p + q @ geometry.platform_internal.mean(axis=0)
    return np.asarray(below + float(rule) * (above - below))


def _best(
    geometry: Geometry,
    trajectory: Trajectory,
    home: Configuration,
    length: float,
    limits: tuple[Floats, Floats],
) -> Floats:
    """Return the best O at evenly chosen poses, and a cubic spline between them."""
    n = len(trajectory)
    picks = np.unique(np.round(np.linspace(0, n - 1, min(n, MOST_SEARCHED))).astype(int))
    t, p, q = trajectory.time[picks], trajectory.position[picks], trajectory.rotation[picks]
    start = internal_points(geometry, trajectory, home, "carried", length, limits)[0]
    found = best_internal_path(geometry, p, q, limits=limits, characteristic_length=length, start=start)
    missing = np.isnan(found.configuration.internal_point).any(axis=1)
    if missing.any():
        k = int(np.flatnonzero(missing)[0])
        why = ", ".join(found.active[k]) or str(found.status[k])
        raise ValueError(
            f"internal_point: got 'best', but no position of O is allowed at t = {t[k]:g} ({why}); expected wider "
            "limits of the legs, or 'carried', 'shifted', 'held' or a fraction"
        )
    s = found.configuration.internal_point
    if len(picks) == n:
        return s
    found_s = cubic_spline(t, s, trajectory.time, trajectory.closed)
    found_s[[0, -1]] = s[[0, -1]]  # without rounding: a closed path closes to the last bit
    return found_s


def cubic_spline(x: Floats, y: Floats, at: Floats, periodic: bool) -> Floats:
    """Return the cubic spline through (x, y), y of shape (n, k), at other points.

    Periodic, or with a continuous third derivative at the first and last inner knot ("not a knot").
    """
    n, h, rise = len(x), np.diff(x), np.diff(y, axis=0)
    slope = rise / h[:, None]
    matrix, right = np.zeros((n, n)), np.zeros((n, y.shape[1]))  # for the second derivatives at the knots
    inner = np.arange(1, n - 1)
    matrix[inner, inner - 1], matrix[inner, inner], matrix[inner, inner + 1] = h[:-1], 2.0 * (h[:-1] + h[1:]), h[1:]
    right[1:-1] = 6.0 * np.diff(slope, axis=0)
    if periodic:
        matrix[0, [0, -1]] = 1.0, -1.0
        matrix[-1, [0, 1, -2, -1]] = 2.0 * h[0], h[0], h[-1], 2.0 * h[-1]
        right[-1] = 6.0 * (slope[0] - slope[-1])
    else:
        matrix[0, :3] = h[1], -(h[0] + h[1]), h[0]
        matrix[-1, -3:] = h[-1], -(h[-2] + h[-1]), h[-2]
    bend = np.linalg.solve(matrix, right)
    k = np.clip(np.searchsorted(x, at, side="right") - 1, 0, n - 2)
    a, b, step = (x[k + 1] - at)[:, None], (at - x[k])[:, None], h[k][:, None]
    cubic = (bend[k] * a**3 + bend[k + 1] * b**3) / (6.0 * step)
    linear = (y[k] / step - bend[k] * step / 6.0) * a + (y[k + 1] / step - bend[k + 1] * step / 6.0) * b
    found: Floats = cubic + linear
    return found
