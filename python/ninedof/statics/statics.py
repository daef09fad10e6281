"""Leg forces for a load, self-stresses, stiffness; ellipsoids of unit leg rates and leg forces (Fig. 4)."""

from __future__ import annotations

from typing import NamedTuple

from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import operands_and_length
from ninedof.robot.configuration import Configuration, operands_with, single
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, flag
from ninedof.support.arrays import Floats, all_finite, one_or_each
from ninedof.support.text import short_repr

PARTS = ("translation", "rotation", "twist")
"""Of an ellipsoid."""


@short_repr
class LegForces(NamedTuple):
    """Leg forces for a load; leading dimensions are those of the configuration and the load."""

    forces: Floats
    """In the order of `leg_lengths`, positive if the leg pushes, shape (..., 9)."""
    unbalanced: Floats
    """The part that no leg forces balance: moment, force and force at O, shape (..., 9). Exactly 0 unless singular."""


@takes_designs
def leg_forces(
    geometry: Geometry,
    configuration: Configuration,
    moment: ArrayLike,
    force: ArrayLike,
    force_at_o: ArrayLike = (0.0, 0.0, 0.0),
) -> LegForces:
    """Return the leg forces that balance a load.

    Virtual work: with H of eqs. (24)-(26), udot = H (omega, pdot, sdot), the leg forces f have the power f.udot, so
    H^T f + load = 0. At a regular configuration f is unique: the redundancy lies in the choice of O and not in the
    forces. At a singular configuration f is the solution of least norm, to which any `self_stress` may be added.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    moment, force : array_like, shape (..., 3)
        External load on the platform: moment about its origin p (force times length) and force, base axes. They
        broadcast against the configuration. Nothing acts beside it: `inverse_dynamics` has the masses of a study too.
    force_at_o : array_like, shape (..., 3)
        Load on the internal point; zero by default.

    Returns
    -------
    LegForces
        `forces` are positive where a leg pushes; 0 for a leg of zero length. At a singular configuration `unbalanced`
        is the part of the load that works on the free motions with locked legs, and `forces` balance the rest (moments
        are divided by the platform radius). A load with an unbalanced part moves the robot for any leg forces.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> forces, _ = nd.leg_forces(g, c, moment=[0, 0, 0], force=[0, 0, -9.81])  # a weight on the platform
    >>> (forces + 0.0).round(3)[[0, 3, 6]]  # no force in external legs: no moment about O
    array([0.   , 4.837, 5.556])

    """
    shape, flat, load = operands_with(
        geometry, configuration, moment=(moment, 3), force=(force, 3), force_at_o=(force_at_o, 3)
    )
    out = _core.leg_forces(*flat, load, 0).reshape(*shape, 2, 9)
    return LegForces(out[..., 0, :].copy(), out[..., 1, :].copy())


@takes_designs
def self_stress(geometry: Geometry, configuration: Configuration) -> Floats:
    """Return the leg forces that are in equilibrium without a load: the null space of H^T.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        A single one.

    Returns
    -------
    numpy.ndarray, shape (9, k)
        Orthonormal columns, the entry of largest modulus positive. k = 0 at a regular configuration; k is also the
        number of independent free motions with locked legs. A leg of zero length has no direction and contributes a
        column. One column of NaN if the configuration has NaN.

    Raises
    ------
    ValueError
        If the configuration is a stack: k may differ between configurations.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> nd.self_stress(g, nd.Configuration.neutral(3.9828, 2.4432)).shape
    (9, 0)
    >>> nd.self_stress(g, nd.Configuration.neutral(3.9828, 0.0)).round(3)[[0, 3, 6], 0]  # O in the base plane
    array([0.   , 0.   , 0.577])

    """
    return _core.self_stress(*single(geometry, configuration))


@takes_designs
def stiffness(
    geometry: Geometry, configuration: Configuration, leg_stiffness: ArrayLike, internal: bool = False
) -> Floats:
    """Return the stiffness matrix of the platform with locked actuators and O free.

    Springs of stiffness k in the nine legs make the 9x9 matrix K9 = H^T diag(k) H over (rotation, p, s). Only the
    legs hold O, so it moves to the minimum of the spring energy, and the stiffness of the platform is the Schur
    complement of K9: K = (J diag(1/k) J^T)^-1 with the 6x9 Jacobian J for l_c = 1. The textbook J^-T diag(k) J^-1 does
    not apply, because J is not square. With the pseudo-inverse in place of J^-1 it is too stiff unless all k are equal:
    O would minimize the changes of length and not the energy. K is computed by an orthogonal factorization of
    sqrt(k) H without an inverse: at a singular configuration it is finite and singular.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    leg_stiffness : float or array_like of shape (..., 9)
        k >= 0, force/length, the same for all legs or in the order of `leg_lengths`; 0 for a missing leg.
        Broadcasts against the configuration.
    internal : bool
        Whether to return K9, for displacements of platform and O; by default K.

    Returns
    -------
    numpy.ndarray, shape (..., 6, 6), or (..., 9, 9)
        Symmetric and positive semidefinite. (Moment about the platform origin p, force) for a small displacement
        (rotation, translation of p), base axes; followed by force and displacement of O with `internal`. It is the
        stiffness without load: the geometric stiffness of preloaded legs is not included.

    Raises
    ------
    ValueError
        If a stiffness is negative, infinite or, but in a stack where it marks missing data, NaN.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> K = nd.stiffness(g, c, 1e6)
    >>> (K.diagonal() / 1e6).round(3)
    array([3.81 , 3.81 , 2.935, 0.966, 0.966, 2.549])

    """
    k = one_or_each("leg_stiffness", leg_stiffness, 9)
    all_finite("leg_stiffness", k, missing=k.ndim > 1)
    shape, flat, k = operands_with(geometry, configuration, leg_stiffness=(k, 9))
    core, size = (_core.stiffness_with_o, 9) if flag("internal", internal) else (_core.stiffness, 6)
    return core(*flat, k, 0).reshape(*shape, size, size)


@short_repr
class Ellipsoid(NamedTuple):
    """Ellipsoids around 0 in n = 3 or 6 dimensions; leading dimensions are those of the configuration."""

    directions: Floats
    """Orthonormal columns, one per axis, base axes, the entry of largest modulus positive, shape (..., n, n)."""
    semi_axes: Floats
    """Descending, shape (..., n)."""


@takes_designs
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
    geometry : Geometry, Result or Design
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
    return _ellipsoid("velocity", part, geometry, configuration, characteristic_length)


@takes_designs
def force_ellipsoid(
    geometry: Geometry,
    configuration: Configuration,
    part: str = "translation",
    characteristic_length: ArrayLike | str = 1.0,
) -> Ellipsoid:
    """Return the loads on the platform that leg forces of norm at most 1 balance, without a force on O.

    {w : |J'^T w| <= 1} for w = (moment about p / l_c, force): the polar of the velocity ellipsoid, with the same
    directions and reciprocal semi-axes, so that the direction of the largest speed is that of the smallest force.
    Parameters as in `velocity_ellipsoid`; a part is of forces through p without moment, of pure moments over l_c, or of
    wrenches (moment / l_c, force).

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
    return _ellipsoid("force", part, geometry, configuration, characteristic_length)


def _ellipsoid(kind: str, part: str, g: Geometry, c: Configuration, length: ArrayLike | str) -> Ellipsoid:
    core = getattr(_core, f"{kind}_ellipsoid_{choice('part', part, PARTS)}")
    out, n = core(*operands_and_length(g, c, length), 0), 6 if part == "twist" else 3
    return Ellipsoid(out[:, :-n].reshape(*c.shape, n, n).copy(), out[:, -n:].reshape(*c.shape, n).copy())
