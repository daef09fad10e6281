"""Velocity and force ellipsoids: the effect of unit leg rates and unit leg forces (Fig. 4)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import operands_and_length
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice
from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr

_VELOCITY = {
    "translation": _core.velocity_ellipsoid_translation,
    "rotation": _core.velocity_ellipsoid_rotation,
    "twist": _core.velocity_ellipsoid_twist,
}
_FORCE = {
    "translation": _core.force_ellipsoid_translation,
    "rotation": _core.force_ellipsoid_rotation,
    "twist": _core.force_ellipsoid_twist,
}


@short_repr
class Ellipsoid(NamedTuple):
    """Ellipsoids around 0 in n = 3 or 6 dimensions; leading dimensions are those of the configuration."""

    directions: Floats
    """Orthonormal columns, one per axis, base axes, the entry of largest modulus positive, shape (..., n, n)."""
    semi_axes: Floats
    """Descending, shape (..., n)."""


def velocity_ellipsoid(
    geometry: Geometry,
    configuration: Configuration,
    part: str = "translation",
    characteristic_length: ArrayLike | str = 1.0,
) -> Ellipsoid:
    """Return the velocities of the platform for leg rates of norm at most 1: Fig. 4.

    The image of the unit ball of all nine leg rates under J', or under three of its rows. It is computed from the
    least leg rates for a velocity, so it exists also at a singular configuration.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    part : {"translation", "rotation", "twist"}
        pdot alone (n = 3), l_c omega alone (n = 3), or both, (l_c omega, pdot) (n = 6).
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`; no effect on "translation". With the default 1 the
        semi-axes of "rotation" are in rad per unit of length.

    Returns
    -------
    Ellipsoid
        Semi-axes are singular values of J' or of its rows: speed per unit of leg rate. At a singular
        configuration the axis along a free motion is infinite, unless the free motion does not contain this part.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> directions, semi_axes = nd.velocity_ellipsoid(g, nd.Configuration.neutral(3.9828, 2.4432))
    >>> semi_axes.round(3)
    array([1.465, 1.465, 1.301])
    >>> abs(directions[:, 2]).round(3)  # slowest along z
    array([0., 0., 1.])

    """
    return _ellipsoid(_VELOCITY, geometry, configuration, part, characteristic_length)


def force_ellipsoid(
    geometry: Geometry,
    configuration: Configuration,
    part: str = "translation",
    characteristic_length: ArrayLike | str = 1.0,
) -> Ellipsoid:
    """Return the loads on the platform that leg forces of norm at most 1 balance, without a force on O.

    {w : |J'^T w| <= 1} for w = (moment about p / l_c, force): the polar of the velocity ellipsoid, with the same
    directions and reciprocal semi-axes, so that the direction of the largest speed is that of the smallest force.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    part : {"translation", "rotation", "twist"}
        Forces through p without moment (n = 3), pure moments over l_c (n = 3), or wrenches (moment / l_c, force) (n =
        6).
    characteristic_length : float, array_like of shape (...), or str
        As in `velocity_ellipsoid`.

    Returns
    -------
    Ellipsoid
        Semi-axes: load per unit of leg force. At a singular configuration 0 along the loads that no leg forces balance.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> nd.force_ellipsoid(g, nd.Configuration.neutral(3.9828, 2.4432)).semi_axes.round(3)
    array([0.769, 0.683, 0.683])

    """
    return _ellipsoid(_FORCE, geometry, configuration, part, characteristic_length)


def _ellipsoid(
    parts: Mapping[str, Callable[..., Floats]], g: Geometry, c: Configuration, part: str, length: ArrayLike | str
) -> Ellipsoid:
    out = parts[choice("part", part, parts)](*operands_and_length(g, c, length), 0)
    n = 6 if part == "twist" else 3
    directions, semi_axes = np.split(out, [n * n], axis=1)
    return Ellipsoid(directions.reshape(*c.shape, n, n).copy(), semi_axes.reshape(*c.shape, n).copy())
