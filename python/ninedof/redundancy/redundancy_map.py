"""The best internal points of a grid of poses, each continued from its neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Unpack

from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.redundancy.redundancy import InternalPoint, PointOptions, point_fields, poses_of, problem_of, starts_of
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import whole
from ninedof.support.arrays import thread_argument
from ninedof.support.running import Progress, progress_argument
from ninedof.support.structs import from_core, options_of
from ninedof.support.text import short_repr


@short_repr
@dataclass(frozen=True)
class MapAudit:
    """Share of the poses where continuation missed a better point, from searches of poses drawn at random."""

    poses: int
    """Number of poses searched, without the seeds."""
    missed: int
    """Number of these where the search found a point better by more than 1e-6 of the value."""
    largest: float
    """Greatest such difference, relative to the better value; infinite where the map had no point and the search had
    one. For "leg_centring" the difference of the sums of squares."""


@short_repr
@dataclass(frozen=True)
class InternalPointMap(InternalPoint):
    """Internal points of a grid of poses, with the audit of the map."""

    audit: MapAudit
    """Of the map before improvements found by the audit were entered; the map returned is as good or better."""
    searched: int
    """Number of poses searched as by `best_internal_point`, including those of the audit."""
    followed: int
    """Number of local optima continued from those of neighbours."""


class MapOptions(PointOptions, total=False):
    """Options of `best_internal_map`, which says what they mean."""

    seed_every: int
    audit_every: int
    audit_seed: int


MAP_DEFAULTS = {"characteristic_length": 1.0, "seed_every": 256, "audit_every": 512, "audit_seed": 0}


@takes_designs
def best_internal_map(
    geometry: Geometry,
    position: ArrayLike,
    rotation: Any = None,
    criterion: str = "condition_number",
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
    **options: Unpack[MapOptions],
) -> InternalPointMap:
    """Return the best internal point of every pose of a grid, up to eight times faster than one by one.

    The poses of a coarse lattice are searched as by `best_internal_point`. The others are reached by wavefront
    propagation: Newton's method continues the points of neighbours to each pose, extrapolated where two lie on one
    line. A better point replaces that of a pose and is passed on. Then every pose is scanned on a coarse grid of O for
    better valleys. The result is the lower envelope of all branches of
    local optima found and does not depend on the order. A branch that neither a seed nor a scan has found is missed;
    `audit` estimates how often that happens.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    position : array_like, shape (n0, ..., nk, 3)
        The grid: poses next to each other along an axis are near each other, in position and rotation. A list (n, 3) is
        a grid of one axis, in the order given. Use more seeds if neighbours are far apart.
    rotation : array_like, shape (..., 3, 3), or scipy.spatial.transform.Rotation
        The identity by default. Broadcasts against the position: a grid may also have axes of orientation.
    criterion : {"condition_number", "singularity", "leg_centring"}
    limits : (low, high), optional
    characteristic_length : float
    start : array_like, shape (..., 3), optional
    clearance : float, optional
    threads : int, optional
        As in `best_internal_point`.
    seed_every : int
        Number of poses per seed, approximately: seeds lie on a lattice with equal steps along all axes. 1 searches
        every pose.
    audit_every : int
        Number of other poses per audited pose; at least 32 poses are searched at the end. Improvements are passed on.
    audit_seed : int
        Seed of the selection of audited poses.
    progress : callable, optional
        Called as progress(poses placed, poses in all, None). If it raises an exception, the map ends with it.

    Returns
    -------
    InternalPointMap
        Statuses as of `best_internal_point`; "infeasible" for an internal leg means that no point near those of the
        neighbours satisfies the limits. A pose with NaN is "missing" and does not affect others.

    Raises
    ------
    ValueError
        As `best_internal_point`, and for numbers of poses or a seed that are not valid.

    Notes
    -----
    The result does not depend on the number of threads. Ctrl-C ends the map within a fraction of a second.

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
    values = options_of(best_internal_map, MapOptions, options, **MAP_DEFAULTS)
    shape, p, q = poses_of(geometry, position, rotation)
    settings = _core.MapSettings(
        seed_every=whole("seed_every", values["seed_every"], 1),
        audit_every=whole("audit_every", values["audit_every"], 1),
        audit_seed=whole("audit_seed", values["audit_seed"], 0),
        threads=thread_argument(threads),
    )
    problem, starts = problem_of(criterion, limits, values), starts_of(values["start"], shape)
    best = _core.best_internal_map(geometry, p, q, shape, starts, problem, settings, progress_argument(progress))
    fields = point_fields(shape, p, q, best.points) | {"audit": from_core(MapAudit, best.audit)}
    return InternalPointMap(**fields, searched=best.searched, followed=best.followed)
