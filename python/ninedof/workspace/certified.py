"""The volume of a workspace between proved bounds: one call to the core."""

from __future__ import annotations

from collections.abc import Mapping
from time import perf_counter
from typing import Any

from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, require_geometry
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import finite, shown, whole
from ninedof.support.arrays import thread_argument
from ninedof.support.progress import Progress, progress_argument
from ninedof.support.units import unit_argument
from ninedof.workspace.certified_record import CertifiedWorkspace
from ninedof.workspace.criteria import criteria_of
from ninedof.workspace.domain import domain_of, home_of, rule_of

FOREVER = 1e9  # seconds
GAPS = (1e-9, 0.999)


def require_certifiable(archetype: str, internal_point: Any) -> None:
    """Raise for kinds of workspaces of which nothing can be certified."""
    if isinstance(archetype, str) and archetype == "orientation":
        raise ValueError("archetype: got 'orientation', expected positions: of orientations nothing is certified")
    if rule_of(internal_point)[0] == "best":
        expected = "expected carried, shifted, held or a fraction: no proof where O is searched for"
        raise ValueError(f"internal_point: got {shown(internal_point)}, {expected}")


def certified_workspace(
    geometry: Geometry,
    box: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    archetype: str = "constant_orientation",
    criteria: Mapping[str, Any] | None = None,
    internal_point: ArrayLike | Mapping[str, ArrayLike] = 0.5,
    rotation: Any = None,
    region: Mapping[str, Any] | None = None,
    orientations: Any = None,
    home: Configuration | None = None,
    characteristic_length: float = 1.0,
    gap: float = 0.05,
    time_limit: float | None = 60.0,
    most_boxes: int = 4_000_000,
    threads: int | None = None,
    progress: Progress | None = None,
    unit: str | None = None,
) -> CertifiedWorkspace:
    """Prove bounds of the volume of a workspace, and where every pose is allowed or none is.

    The box is halved again and again. A part is inner where every criterion is proved to hold at all of its poses,
    outer where one is proved to be violated at all of them. In parts on the boundary planes bound what is allowed and
    what is not, so that the bounds approach each other with the square of the size of the boxes.

    Parameters
    ----------
    geometry : Geometry
    box : (low, high), each array_like, shape (3,)
        Positions to examine.
    archetype : {"constant_orientation", "reachable", "inclusive", "dexterous"}
        As in `workspace`. Sets of rotations consist of their members only.
    criteria, rotation, region, orientations, home, characteristic_length : optional
        As in `workspace`.
    internal_point : float or array_like, shape (3,), or mapping
        As in `workspace`, but not "best".
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
    unit : str, optional
        Name of the length unit.

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
    require_geometry(geometry)
    progress_argument(progress)
    named = unit_argument(unit)
    require_certifiable(archetype, internal_point)
    rule = rule_of(internal_point)
    domain = domain_of(archetype, box, None, rotation, region, orientations)
    limits = criteria_of(criteria, characteristic_length)
    settings = {
        "gap": finite("gap", gap, *GAPS),
        "seconds": FOREVER if time_limit is None else finite("time_limit", time_limit, 0.0, FOREVER),
        "boxes": whole("most_boxes", most_boxes, 1, 10**9),
        "threads": thread_argument(threads),
    }
    begin = perf_counter()
    found = _core.certified_workspace(geometry, domain, *rule, limits, settings, home_of(home), progress)
    inside, outside = found.pop("home_inside"), found.pop("home_outside")
    return CertifiedWorkspace(
        **found,
        home="allowed" if inside else "forbidden" if outside else "unknown",
        connected=limits["singularity_free"],
        archetype=archetype,
        seconds=perf_counter() - begin,
        unit=named,
    )
