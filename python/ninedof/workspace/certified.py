"""The volume of a workspace between proved bounds: one call to the core."""

from __future__ import annotations

from time import perf_counter
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.designs import HasRobot
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import finite, shown, whole
from ninedof.support.arrays import thread_argument
from ninedof.support.running import Progress, progress_argument
from ninedof.support.structs import from_core, options_of
from ninedof.support.units import unit_argument
from ninedof.workspace.certified_record import CertifiedWorkspace
from ninedof.workspace.question import WorkspaceArguments, connected, question_of, rule_of
from ninedof.workspace.study_question import robot_and_arguments

FOREVER = 1e9  # seconds
GAPS = (1e-9, 0.999)


def require_certifiable(archetype: str, internal_point: Any) -> None:
    """Raise for kinds of workspaces of which nothing can be certified."""
    if isinstance(archetype, str) and archetype == "orientation":  # an array has no truth value
        raise ValueError("archetype: got 'orientation', expected positions: of orientations nothing is certified")
    if rule_of(internal_point).kind == "best":
        expected = "expected carried, shifted, held or a fraction: no proof where O is searched for"
        raise ValueError(f"internal_point: got {shown(internal_point)}, {expected}")


def certified_workspace(
    geometry: Geometry | HasRobot,
    box: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    gap: float = 0.05,
    time_limit: float | None = 60.0,
    most_boxes: int = 4_000_000,
    threads: int | None = None,
    progress: Progress | None = None,
    **question: Unpack[WorkspaceArguments],
) -> CertifiedWorkspace:
    """Prove bounds of the volume of a workspace, and where every pose is allowed or none is.

    The box is halved again and again. A part is inner where every criterion is proved to hold at all of its poses,
    outer where one is proved to be violated at all of them. In parts on the boundary planes bound what is allowed and
    what is not, so that the bounds approach each other with the square of the size of the boxes.

    Parameters as in `workspace`: `archetype` (but not "orientation"; sets of rotations consist of their members only),
    `internal_point` (but not "best"), `criteria`, `rotation`, `region`, `orientations`, `home`, `characteristic_length`
    and `unit`. Besides:

    Parameters
    ----------
    geometry : Geometry, Result or Design
        A design stands for the same as in `workspace`, with the limits of its study.
    box : (low, high), each array_like, shape (3,)
        Positions to examine.
    gap : float
        The search ends when the bounds are this far apart, relative to the upper one.
    time_limit : float, optional
        Seconds; None for no limit.
    most_boxes : int
        To be looked at. Each takes about 300 bytes.
    threads : int, optional
        One for each processor by default. The result does not depend on it, unless the time ends the search.
    progress : callable, optional
        Called as progress(boxes looked at, 0, lower bound of the volume).

    Returns
    -------
    CertifiedWorkspace
        Ctrl-C returns what is proved until then, with `end` "stopped".

    Raises
    ------
    ValueError
        If an argument is not valid, or nothing can be certified: orientations, and O where it is searched for.

    See Also
    --------
    workspace : an estimate, in less time, with what limits the workspace and the conditioning in it.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> proved = nd.certified_workspace(g, ([-9, -9, -9], [9, 9, 9]), criteria={"leg_limits": (2.5, 6.5)})
    >>> proved.end, proved.gap < 0.05, proved.beyond
    ('gap', True, 'nothing')
    >>> estimate = nd.workspace(g, ([-9, -9, -9], [9, 9, 9]), criteria={"leg_limits": (2.5, 6.5)}).volume
    >>> proved.volume[0] < estimate < proved.volume[1]
    True

    """
    options = options_of(certified_workspace, WorkspaceArguments, question, archetype="constant_orientation")
    progress_argument(progress)
    geometry, arguments = robot_and_arguments(geometry, {"box": box, **options})
    unit = unit_argument(arguments["unit"])
    require_certifiable(arguments["archetype"], arguments["internal_point"])
    problem = question_of(geometry, arguments["box"], arguments)
    settings = _core.CertifySettings(
        gap=finite("gap", gap, *GAPS),
        seconds=FOREVER if time_limit is None else finite("time_limit", time_limit, 0.0, FOREVER),
        boxes=whole("most_boxes", most_boxes, 1, 10**9),
        threads=thread_argument(threads),
    )
    begin = perf_counter()
    answer = _core.certified_workspace(problem, settings, progress)
    seconds = perf_counter() - begin
    return from_core(
        CertifiedWorkspace,
        answer,
        connected=connected(problem),
        archetype=arguments["archetype"],
        seconds=seconds,
        estimate=None,
        unit=unit,
        certificate=np.frombuffer(_core.workspace_certificate(problem, answer), np.uint8),
    )
