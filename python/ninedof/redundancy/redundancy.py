"""The best internal point: nine legs control the six coordinates of the platform and the three of O."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, instance, items
from ninedof.support.arrays import Floats, all_finite, as_floats, as_number, one_or_each, thread_argument
from ninedof.support.structs import options_of
from ninedof.support.text import short_repr

CRITERIA = ("condition_number", "singularity", "leg_centring")


class PointOptions(TypedDict, total=False):
    """Options that the searches for an internal point share; `best_internal_point` says what they mean."""

    characteristic_length: float
    start: ArrayLike | None
    clearance: float | None


class InternalPointStatus(StrEnum):
    """The end of a search for an internal point."""

    FOUND = "found"
    """Within the limits and stationary by independent checks, and no worse than any point of a scan of the chamber.
    That no other is better is not proved."""
    LOCAL = "local"
    """The same, but the scan saw more cells that may be lower than it divided: a point in one of them may be better."""
    STOPPED = "stopped"
    """Within the limits, but the checks failed: the best point evaluated."""
    INFEASIBLE = "infeasible"
    """An external leg is outside its limits, or no point satisfies those of the internal legs; `active` names them."""
    UNBOUNDED = "unbounded"
    """The criterion improves as O moves away or into a joint, and no point attains its limit; `active` names the legs
    whose limits would bound O, or det N next to a joint of an external leg."""
    SINGULAR = "singular"
    """The start lies on a singularity, and so in no chamber. A start within the clearance is not singular."""
    MISSING = "missing"
    """The pose has NaN."""


STATUSES = np.array([InternalPointStatus(word) for word in _core.internal_point_statuses], dtype=object)


@short_repr
@dataclass(frozen=True)
class InternalPoint:
    """Internal points, one for each pose."""

    configuration: Configuration
    """The poses with their O, shape (...); NaN where there is none."""
    value: Any
    """Condition number, least |det| or sum of squares, by criterion: float or shape (...). NaN where there is none."""
    status: Any
    """An InternalPointStatus, or an array of them, shape (...)."""
    active: Any
    """Names of the bounds active at O, or of those that exclude every point: a tuple, or an array of them, shape (...).

    "q1 low" and "r3 high" are limits of legs, "det B" the clearance from a singularity."""


@takes_designs
def best_internal_point(
    geometry: Geometry,
    position: ArrayLike,
    rotation: Any = None,
    criterion: str = "condition_number",
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    threads: int | None = None,
    **options: Unpack[PointOptions],
) -> InternalPoint:
    """Return the best internal point for a pose of the platform.

    The pose fixes the external legs. O is free in three directions (`null_motion`): the six internal legs move it while
    the platform stays at rest. The search stays in the chamber of `start`, the region in which det B, det C and det N
    keep their signs: the robot can reach the result without passing a singularity. Newton's method finds local optima
    from many starts, among them `start` and the best points of a grid over the chamber, refined where the criterion may
    be lower; the best is returned, never worse than a `start` within the limits. It is a local optimum: a valley
    narrower than the finest grid, or behind a narrow passage of the chamber, may be missed.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    position : array_like, shape (..., 3)
        Origin p of the platform, length units, base frame.
    rotation : array_like, shape (..., 3, 3), or scipy.spatial.transform.Rotation
        Q, platform frame to base frame. The identity by default. Broadcasts against the position.
    criterion : {"condition_number", "singularity", "leg_centring"}
        "condition_number" minimizes that of J' (eq. 2). "singularity" maximizes the least of |det B|, |det C| and
        |det N| of `singularity_margins`; O then keeps 0.05 times the size of the robot (greatest distance of a joint
        from the mean of the twelve) from the joints of external legs, where det N has no limit, and "det N" in `active`
        may mean that distance. "leg_centring" minimizes the sum of ((length - middle) / half range)^2 over
        the internal legs, and needs finite limits.
    limits : (low, high), optional
        Least and greatest leg lengths, each a number or shape (9,) in the order of `leg_lengths`. None by default.
    characteristic_length : float
        Length l_c of the condition number; 1 by default, of a design its own.
    start : array_like, shape (..., 3), optional
        A point of the chamber to search. By default midway between the centroids of the internal joints of base and
        platform.
    clearance : float, optional
        Lower bound of each of the three |det| of "singularity", for every criterion; "det B" in `active` means that it
        is active. A start may lie within it. By default 0.01 for "leg_centring", which would allow singular points, and
        1e-10 for the others.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    InternalPoint
        `configuration`, `value`, `status` and `active`, for one pose or a stack.

    Raises
    ------
    ValueError
        If an argument has a wrong shape, a limit, the length or the criterion is not valid, or leg_centring lacks
        limits.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> best = nd.best_internal_point(g, [0.8, 0.0, 3.9828])
    >>> middle = nd.Configuration([0.8, 0.0, 3.9828], internal_point=[0.4, 0.0, 1.9914])
    >>> best.status, bool(best.value < nd.condition_number(g, middle))
    (<InternalPointStatus.FOUND: 'found'>, True)

    """
    values = options_of(best_internal_point, PointOptions, options, characteristic_length=1.0)
    shape, p, q = poses_of(geometry, position, rotation)
    problem, starts = problem_of(criterion, limits, values), starts_of(values["start"], shape)
    points = _core.best_internal_point(geometry, p, q, starts, problem, thread_argument(threads))
    return InternalPoint(**point_fields(shape, p, q, points))


@takes_designs
def best_internal_path(
    geometry: Geometry,
    position: ArrayLike,
    rotation: Any = None,
    criterion: str = "condition_number",
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    smoothness: float = 0.1,
    **options: Unpack[PointOptions],
) -> InternalPoint:
    """Return internal points along a path of the platform: good at every pose, and smooth.

    Minimizes the mean of f along the path plus `smoothness` times the mean square of the speed of O along it,

        mean f(s_k) + smoothness (n - 1) sum |s_(k+1) - s_k|^2 / size^2,

    where f is the logarithm of the condition number, minus the logarithm of the least |det|, or the sum of squares, and
    size that of the robot. Dynamic programming selects one local optimum at each pose for the whole path; Newton's
    method then moves all points together. O stays in one chamber, except where a gap divides the path.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    position : array_like, shape (n, 3)
        The path of the platform origin, in order.
    rotation : array_like, shape (n, 3, 3), or scipy.spatial.transform.Rotation
        The identity by default.
    criterion : {"condition_number", "singularity", "leg_centring"}
    limits : (low, high), optional
    characteristic_length : float
        As in `best_internal_point`.
    start : array_like, shape (3,), optional
        A point of the chamber to search, at the first pose.
    clearance : float, optional
        As in `best_internal_point`.
    smoothness : float
        Greater than zero. With a large value O moves less and f is worse; with a small one O follows the best points.

    Returns
    -------
    InternalPoint
        Shape (n,). If the last pose is the first (to 1e-12), the path is closed and so is that of O: both ends have the
        same O and value, and the sum includes the move from the last pose but one to the first. Poses that allow no
        point divide the path: on their two sides O is placed independently. After such a gap O stays in its chamber if
        the next pose has a point there, else in that of the default start.

    Raises
    ------
    ValueError
        As `best_internal_point`, and unless the path is an (n, 3) array and the smoothness finite and positive.

    Examples
    --------
    >>> import numpy as np
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> t = np.linspace(0.0, 1.0, 21)
    >>> path = nd.best_internal_path(g, np.stack([t, 0 * t, 3.98 + 0 * t], axis=-1))
    >>> steps = np.linalg.norm(np.diff(path.configuration.internal_point, axis=0), axis=1)
    >>> set(path.status.tolist()), bool(steps.max() < 0.1)
    ({<InternalPointStatus.FOUND: 'found'>}, True)

    """
    shape, p, q = poses_of(geometry, position, rotation)
    if len(shape) != 1:
        raise ValueError(f"position: got shape {(*shape, 3)}, expected a path of shape (n, 3)")
    values = options_of(best_internal_path, PointOptions, options, characteristic_length=1.0)
    problem, weight = problem_of(criterion, limits, values), as_number("smoothness", smoothness)
    start = None if values["start"] is None else starts_of(values["start"], ())[0]
    points = _core.best_internal_path(geometry, p, q, start, problem, weight)
    return InternalPoint(**point_fields(shape, p, q, points))


def point_fields(shape: tuple[int, ...], p: Floats, q: Floats, points: _core.InternalPoints) -> dict[str, Any]:
    """Return the fields of an InternalPoint from those of flat poses."""
    keys, inverse = np.unique(points.active, return_inverse=True)
    words, names = points.active_names, np.empty(len(keys), dtype=object)
    names[:] = [words[int(key)] for key in keys]
    return {
        "configuration": Configuration._shaped(shape, p, q, points.internal_point),
        "value": points.value.reshape(shape)[()],
        "status": STATUSES[points.status].reshape(shape)[()],
        "active": names[inverse.reshape(-1)].reshape(shape)[()],
    }


def poses_of(geometry: Geometry, position: ArrayLike, rotation: Any) -> tuple[tuple[int, ...], Floats, Floats]:
    """Check a stack of poses as a configuration would; return its shape and flat arrays."""
    instance("geometry", geometry, Geometry)
    c = Configuration(position, rotation, np.zeros(3))
    return c.shape, c.position.reshape(-1, 3), c.rotation.reshape(-1, 3, 3)


def starts_of(start: ArrayLike | None, shape: tuple[int, ...]) -> Floats:
    """Return one start for each pose, or no rows for the default."""
    if start is None:
        return np.empty((0, 3))
    points = as_floats("start", start, (3,))
    all_finite("start", points, missing=points.ndim > 1)
    try:
        return np.ascontiguousarray(np.broadcast_to(points, (*shape, 3))).reshape(-1, 3)
    except ValueError:
        raise ValueError(f"start: got shape {points.shape}, expected one that broadcasts to {(*shape, 3)}") from None


def problem_of(criterion: str, limits: Any, options: Mapping[str, Any]) -> _core.InternalPointProblem:
    """Return the problem of an internal point; the default clearance depends on the criterion."""
    clearance = options["clearance"]
    if clearance is None:
        clearance = 1e-2 if criterion == "leg_centring" else 1e-10
    low, high = leg_limits(limits)
    return _core.InternalPointProblem(
        criterion=choice("criterion", criterion, CRITERIA),
        limits=_core.LegLimits(low=low, high=high),
        characteristic_length=as_number("characteristic_length", options["characteristic_length"]),
        clearance=as_number("clearance", clearance),
    )


def leg_limits(limits: Any, name: str = "limits") -> tuple[Floats, Floats]:
    """Return least and greatest lengths of the nine legs from (low, high), each a number or nine."""
    if limits is None:
        return np.zeros(9), np.full(9, np.inf)
    least, greatest = items(name, limits, "(low, high), each a number or nine", 2)
    low, high = one_or_each(f"{name} (low)", least, 9), one_or_each(f"{name} (high)", greatest, 9)
    if low.ndim + high.ndim > 2:
        raise ValueError(f"{name}: got shapes {low.shape} and {high.shape}, expected numbers or shape (9,)")
    return low, high
