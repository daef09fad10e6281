"""The search for a workspace: one call to the core."""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter
from typing import Unpack

from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.indices import What, indices_of
from ninedof.redundancy.redundancy_map import MapAudit
from ninedof.robot.designs import HasRobot
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, shown, whole
from ninedof.support.arrays import as_number, thread_argument
from ninedof.support.running import Progress, progress_argument
from ninedof.support.structs import from_core, options_of
from ninedof.support.units import unit_argument
from ninedof.workspace.cells import WorkspaceCells, statistics_of
from ninedof.workspace.map import WorkspaceMap, WorkspaceStatus
from ninedof.workspace.question import WorkspaceArguments, question_of
from ninedof.workspace.study_question import robot_and_arguments

METHODS = ("octree", "grid", "sample")
POINTS = 16384
POINTS_SEARCHED = 1024  # if the best O is sought at each
COORDINATES = {
    "": ("x", "y", "z"),
    "rotation_vector": ("w_x", "w_y", "w_z"),
    "tilt_torsion": ("tilt_x", "tilt_y", "torsion"),
}


def workspace(
    geometry: Geometry | HasRobot,
    box: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    position: ArrayLike | None = None,
    method: str = "octree",
    tolerance: float = 1e-3,
    resolution: int | None = None,
    points: int | None = None,
    shifts: int = 16,
    seed: int = 0,
    most_evaluations: int = 2_000_000,
    threads: int | None = None,
    progress: Progress | None = None,
    index: What | None = None,
    **question: Unpack[WorkspaceArguments],
) -> WorkspaceMap:
    """Find the workspace of the platform: its volume, its boundary, and what limits it.

    Cells of an octree are divided at the boundary, so that the work grows with its area. Legs, cones and regions are
    decided by bounds over whole cells: where nothing else limits, each cell inside or outside is proved. Other criteria
    are judged by corners and centre. Poses of a low-discrepancy sequence audit this: a cell that one of them
    contradicts is divided too. In the smallest cells the boundary is taken as linear, and the volume is extrapolated
    from two levels.

    Parameters
    ----------
    geometry : Geometry, Result or Design
        A design stands for its geometry, its home pose, its characteristic length and its unit. One of a study, as a
        Result, stands for the limits of that too, as `ninedof workspace RUN` has them: the actuators are as long as the
        study permits, O follows its rule, and the box is about its region. What is given beside it counts instead.
    box : (low, high), each array_like, shape (3,)
        Positions p of the platform to search, length units, base frame. Not for "orientation".
    archetype : str
        "constant_orientation": positions at a fixed `rotation`. "orientation": rotations of a `region` at a fixed
        `position`. "reachable": positions where some rotation of `orientations` is allowed. "inclusive": positions
        where all of them are. "dexterous": inclusive for evenly spread rotations of all of SO(3); rotations between
        them are not tested.
    criteria : mapping
        The criteria of an allowed pose, in any combination; without any, all poses are allowed.

        - "leg_limits": (low, high), each a number or shape (9,) in the order of `leg_lengths`; may be infinite.
        - "base_cone", "platform_cone": greatest angle, radians, between each leg at its joint there and its direction
          at `home`, seen from that body; {"max": angle, "axis": (x, y, z)} for one axis of that body.
        - "leg_clearance": least distance of the axes of legs that share no joint; {"min": distance, "exempt": ("l1-l2",
          ...)} where only these pairs may share one, so that joints of others that coincide collide.
        - "condition_number": its greatest value, at least 1.
        - "singularity_free": True for poses that are connected with `home` and where det N, det B and det C have the
          signs they have there. By cells: pieces closer than one of the smallest cells count as one.
    internal_point : float, array_like, mapping or "best"
        The rule for O. A number: that fraction of the way from the centroid of the lower to that of the upper internal
        joints, half by default, of a Result as its study has it. Shape (3,): fixed in the base. {"platform": (3,)}:
        fixed in the platform. "best": the
        point of least condition number within the leg limits, by `best_internal_map` at the corners of the first cells
        and by continuation from two points around it elsewhere.
    rotation : array_like, shape (3, 3), or scipy.spatial.transform.Rotation, optional
        Q of "constant_orientation", or the centre of the region of "orientation". The identity by default.
    position : array_like, shape (3,), optional
        p of "orientation".
    region : mapping, optional
        {"angle": a}: rotation vectors of length at most a, in base axes. {"tilt": t, "torsion": (low, high) or number}:
        the platform's axis tilted by at most t in any direction, after a torsion about it. For "reachable" and
        "inclusive" the first kind, over which `orientations` are spread.
    orientations : int, array_like, shape (n, 3, 3), or Rotation, optional
        The set of "reachable" and "inclusive", or the number to spread over the region (`spread_rotations`); 60 over
        all of SO(3) by default.
    home : Configuration, optional
        The home pose, with its O. The middle of the box or region by default, with O by the rule.
    characteristic_length : float
        Of the condition number, length units; 1 by default, of a design its own.
    method : {"octree", "grid", "sample"}
        "grid" judges resolution^3 cells by their centres. "sample" counts points of a low-discrepancy sequence with
        random shifts.
    tolerance : float
        Largest error of an octree, relative to the volume, including what may be unseen.
    resolution : int, optional
        Cells along each side before any is divided, by default 16 (64 for a grid). Unless leg limits and cones
        are the only criteria, the audit alone may find features thinner than such a cell; `WorkspaceMap.unseen` bounds
        the rest.
    points : int, optional
        First audit poses of an octree, to which it adds as many as the tolerance needs, or points of each shift of a
        sample; 16384 by default, 1024 if the best O is sought.
    shifts : int
        Number of shifts of a sample.
    seed : int
        Seed of audit and sample.
    most_evaluations : int
        Greatest number of poses of an octree. Each takes about 350 bytes, and 24 more for each O that is sought.
    threads : int, optional
        One for each processor by default. The result does not depend on it.
    progress : callable, optional
        Called as progress(poses evaluated, poses in all as far as known, volume); volume is None before the first level
        and for a sample.
    index : str, callable, or sequence of them, optional
        Indices to take over the workspace (docs/sweeps.md), in `WorkspaceMap.indices`. Callables as in `sweep`. Not for
        sets of orientations, nor with the best O. Ctrl-C during this returns the map without them, as "stopped".
    unit : str, optional
        Name of the length unit, for screens and figures: "mm", "cm", "m", "in" or "ft". None by default.

    Returns
    -------
    WorkspaceMap
        Ctrl-C ends the search within a fraction of a second and returns the last complete level, with status "stopped".
        The summary takes another second for each million cells.

    Raises
    ------
    ValueError
        If an argument is not valid; the message names it.

    References
    ----------
    Merlet, Parallel Robots, 2nd ed., Springer 2006, ch. 7 (kinds of workspace). Gosselin and Angeles, A global
    performance index for the kinematic optimization of robotic manipulators, J. Mech. Design 113 (1991). Bonev and
    Ryu, A new approach to orientation workspace analysis of 6-DOF parallel manipulators, Mech. Mach. Theory 36 (2001).

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> found = nd.workspace(
    ...     g, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (2.5, 6.5), "condition_number": 8.0}
    ... )
    >>> found.status, round(found.volume, 1), found.error < 1e-3 * found.volume
    (<WorkspaceStatus.CONVERGED: 'converged'>, 8.7, True)

    """
    options = options_of(workspace, WorkspaceArguments, question, archetype="constant_orientation")
    geometry, arguments = robot_and_arguments(geometry, {"box": box, "position": position, **options})
    unit, archetype = unit_argument(arguments["unit"]), arguments["archetype"]
    problem = question_of(geometry, arguments["box"], arguments)
    progress_argument(progress)
    choice("method", method, METHODS)
    indices = () if index is None else indices_of(index)
    searched = problem.rule.kind == "best"
    if indices and archetype not in ("constant_orientation", "orientation"):
        raise ValueError(f"index: got {shown(index)}, expected none for the {archetype} workspace: its poses are sets")
    if indices and searched:
        raise ValueError(f"index: got {shown(index)}, expected none with the best internal point")
    cells, most = (64, 512) if method == "grid" else (16, 128)
    settings = _core.WorkspaceSettings(
        method=method,
        tolerance=as_number("tolerance", tolerance),
        resolution=whole("resolution", cells if resolution is None else resolution, 2, most),
        most_evaluations=whole("most_evaluations", most_evaluations, 1, 10**9),
        points=whole("points", (POINTS_SEARCHED if searched else POINTS) if points is None else points, 1, 10**8),
        shifts=whole("shifts", shifts, 2, 1000),
        seed=whole("seed", seed, 0),
        threads=thread_argument(threads),
    )
    begin = perf_counter()
    search = _core.workspace(problem, settings, progress)
    result = from_core(
        WorkspaceMap,
        search,
        status=WorkspaceStatus(search.status),
        cells=from_core(WorkspaceCells, search.cells, size=search.sides),
        coordinates=COORDINATES[problem.domain.region.chart if archetype == "orientation" else ""],
        archetype=archetype,
        method=method,
        seconds=perf_counter() - begin,
        internal_point_audit=from_core(MapAudit, search.internal_point_audit),
        indices={},
        unit=unit,
        certified=None,
    )
    if not indices or result.interrupted:
        return result
    try:
        over = statistics_of(problem, result, indices, threads)
    except KeyboardInterrupt:
        return replace(result, status=WorkspaceStatus.STOPPED)
    return replace(result, indices=over, seconds=perf_counter() - begin)
