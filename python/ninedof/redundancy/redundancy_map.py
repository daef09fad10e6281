"""Where to put the internal point at very many poses: a grid of them, each continued from its neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.redundancy.redundancy import InternalPoint, point_fields
from ninedof.redundancy.search_arguments import poses_of, problem_of, starts_of
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import whole
from ninedof.support.arrays import thread_argument
from ninedof.support.progress import Progress, progress_argument

__all__ = ["InternalPointMap", "MapAudit", "best_internal_map"]


@dataclass(frozen=True)
class MapAudit:
    """How often following neighbours missed a better point: poses drawn at random and searched one by one."""

    poses: int
    """Number of poses searched, none of them a seed."""
    missed: int
    """Those of them where the search found a point better by more than 1e-6 of the value."""
    largest: float
    """By how much at most, as a part of the better value; infinite where the map had no point and the search had one.

    For "leg_centring" the difference of the sums of squares."""


@dataclass(frozen=True)
class InternalPointMap(InternalPoint):
    """Internal points of a grid of poses, and what they rest on."""

    audit: MapAudit
    """Of the map before what the audit found better went into it: the rest of the map is as good or better."""
    searched: int
    """Poses given to the search of `best_internal_point`, those of the audit included."""
    followed: int
    """Local optima sought from a neighbour's."""


def best_internal_map(
    geometry: Geometry,
    position: ArrayLike,
    rotation: Any = None,
    criterion: str = "condition_number",
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    characteristic_length: float = 1.0,
    start: ArrayLike | None = None,
    clearance: float | None = None,
    threads: int | None = None,
    seed_every: int = 256,
    audit_every: int = 512,
    audit_seed: int = 0,
    progress: Progress | None = None,
) -> InternalPointMap:
    """Return the best internal point of every pose of a grid, five to twenty times faster than one by one.

    A coarse lattice of poses is searched as `best_internal_point` does it. From there the others are reached in waves:
    each pose continues the points of its neighbours, ahead along the line of two where there are two, by Newton's
    method. Wherever the point of a neighbour, continued, is better than what a pose has, it takes its place and is
    passed on. What remains is the lower envelope of all branches of local optima that were found, not an accident of
    the order; a branch that no seed met is missed, and `audit` says how often that is seen to happen.

    Parameters
    ----------
    geometry : Geometry
    position : array_like, shape (n0, ..., nk, 3)
        The grid: poses next to each other along an axis are near each other, in position and rotation. A list (n, 3) is
        a grid of one axis, in the order given. More seeds are wanted where neighbours are far apart.
    rotation : array_like, shape (..., 3, 3), or scipy.spatial.transform.Rotation
        The identity by default. Broadcasts against the position: a grid may have axes of orientation too.
    criterion : {"condition_number", "singularity", "leg_centring"}
    limits : (low, high), optional
    characteristic_length : float
    start : array_like, shape (..., 3), optional
    clearance : float, optional
    threads : int, optional
        As in `best_internal_point`.
    seed_every : int
        About one pose in so many is a seed, on a lattice of equal steps along all axes. 1 searches every pose.
    audit_every : int
        One pose in so many of the others, but no fewer than 32, is searched at the end. What that finds is passed on as
        well.
    audit_seed : int
        Which ones.
    progress : callable, optional
        Called as progress(poses placed, poses in all, None). An exception it raises ends the map and goes on to the
        caller.

    Returns
    -------
    InternalPointMap
        Statuses as of `best_internal_point`; "infeasible" for an internal leg says here that no point near those of the
        neighbours keeps the limits. A pose with NaN is "missing" and concerns no other.

    Raises
    ------
    ValueError
        As `best_internal_point`, and for a share or a seed that is no such number.

    Notes
    -----
    The result does not depend on the number of threads: each wave reads the one before only. Ctrl-C ends the map within
    a fraction of a second.

    Examples
    --------
    >>> import numpy as np
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> x = np.linspace(-0.5, 0.5, 21)
    >>> grid = np.stack([*np.meshgrid(x, x, indexing="ij"), np.full((21, 21), 3.9828)], axis=-1)
    >>> best = nd.best_internal_map(g, grid)
    >>> best.value.shape, best.audit.missed
    ((21, 21), 0)

    """
    shape, p, q = poses_of(geometry, position, rotation)
    settings = {
        "seed_every": whole("seed_every", seed_every, 1),
        "audit_every": whole("audit_every", audit_every, 1),
        "audit_seed": whole("audit_seed", audit_seed, 0),
        "threads": thread_argument(threads),
    }
    problem = problem_of(criterion, limits, characteristic_length, clearance)
    found = _core.best_internal_map(
        geometry, p, q, shape, starts_of(start, shape), problem, settings, progress_argument(progress)
    )
    return InternalPointMap(
        **point_fields(shape, p, q, found),
        audit=MapAudit(**found["audit"]),
        searched=found["searched"],
        followed=found["followed"],
    )
