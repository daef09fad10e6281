"""The distance from a configuration to the nearest singularity along a direction."""

from __future__ import annotations

from typing import Any, NamedTuple

from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, operands_with
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import mechanisms_of
from ninedof.support.arrays import Floats, as_number, thread_argument
from ninedof.support.short import short_repr


@short_repr
class SingularityDistance(NamedTuple):
    """The first singular configuration on a path; leading dimensions broadcast."""

    distance: Any
    """In multiples of the direction, shape (...); infinite where the whole path is free."""
    mechanism: Any
    """The `Mechanism` lost there, `NONE` where the path is free; for a stack an array of their values."""
    each: Floats
    """The distance for each mechanism alone, in the order n, b, c, shape (..., 3)."""
    resolved: Any
    """False where the path is free up to `distance` and undecided beyond; shape (...)."""


def distance_to_singularity(
    geometry: Geometry,
    configuration: Configuration,
    direction: ArrayLike,
    most: float = 1.0,
    threads: int | None = None,
) -> SingularityDistance:
    """Return the distance along a direction to the first singularity.

    The path is t -> configuration.moved(t * direction): p and s on straight lines, the platform turning about a fixed
    axis at a fixed rate. No zero is missed: within each step, bounds of the derivatives prove that the
    determinants keep their signs. A zero without change of sign is found where the determinant is below its rounding
    error; its place is then known to about the square root of that error.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    direction : array_like, shape (..., 9)
        (omega, dp, ds): rotation vector in radians and displacements in length units, base frame, as for
        `Configuration.moved`. Broadcasts against the configuration.
    most : float
        End of the path, in multiples of the direction. 1 by default: the displacement itself, so that an infinite
        distance means that the whole displacement is free. A pure rotation repeats after 2 pi / |omega|.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    SingularityDistance
        0 where the configuration itself is singular, infinite where the whole path is free, NaN where the
        configuration or the direction has NaN.

    Raises
    ------
    ValueError
        If the direction has another shape or is infinite, or `most` is not finite and positive.

    Examples
    --------
    O sinks to the plane of the lower joints:

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> found = nd.distance_to_singularity(g, c, [0, 0, 0, 0, 0, 0, 0, 0, -1.0], most=5.0)
    >>> round(float(found.distance), 10), found.mechanism
    (2.4432, <Mechanism.B: 'b'>)

    """
    shape, flat, (t,) = operands_with(geometry, configuration, direction=(direction, 9))
    out = _core.distance_to_singularity(*flat, t, as_number("most", most), thread_argument(threads))
    return SingularityDistance(
        out[:, 0].reshape(shape)[()],
        mechanisms_of(out[:, 1], shape),
        out[:, 3:].reshape(*shape, 3),
        (out[:, 2] == 1.0).reshape(shape)[()],
    )
