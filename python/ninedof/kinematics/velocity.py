"""Leg rates and velocities, eqs. (24)-(28) and (36), and the three motions that nine legs have to spare."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.robot.configuration import Configuration, operands, operands_with
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, as_floats

__all__ = ["forward_velocity", "internal_velocity", "inverse_velocity", "null_motion"]


def forward_velocity(
    geometry: Geometry, configuration: Configuration, leg_rates: ArrayLike
) -> tuple[Floats, Floats, Floats]:
    """Return the velocity that given leg rates produce.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    leg_rates : array_like, shape (..., 9)
        ldot, qdot, rdot in the order of `leg_lengths`, length/time. Broadcasts against the configuration.

    Returns
    -------
    omega : numpy.ndarray, shape (..., 3)
        Angular velocity of the platform, rad/time, base frame.
    pdot : numpy.ndarray, shape (..., 3)
        Velocity of the platform origin, length/time.
    sdot : numpy.ndarray, shape (..., 3)
        Velocity of the internal point, length/time.
        NaN in whatever the leg rates do not determine at a singular configuration.

    """
    rates = as_floats("leg_rates", leg_rates, (9,))
    shape, flat, (rates,) = operands_with(geometry, configuration, {"leg_rates": rates})
    out = _core.forward_velocity(*flat, rates, 0).reshape(*shape, 3, 3)
    return out[..., 0, :].copy(), out[..., 1, :].copy(), out[..., 2, :].copy()


def inverse_velocity(
    geometry: Geometry,
    configuration: Configuration,
    omega: ArrayLike,
    pdot: ArrayLike,
    sdot: ArrayLike | None = None,
    weights: ArrayLike | None = None,
) -> Floats:
    """Return the leg rates of a given velocity, eqs. (24)-(26).

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    omega, pdot : array_like, shape (..., 3)
        Angular velocity of the platform (rad/time) and velocity of its origin (length/time), base frame. They broadcast
        against the configuration, as all that follows does.
    sdot : array_like, shape (..., 3), optional
        Velocity of O, length/time, base frame. By default O moves so that the weighted sum of squared leg rates is
        least, as `internal_velocity` says: the leg rates are then J'^+ (l_c omega, pdot) when all weights are one.
    weights : array_like, shape (..., 9), optional
        Weights of the squared leg rates; all ones by default. Without a meaning where `sdot` is given.

    Returns
    -------
    numpy.ndarray, shape (..., 9)
        ldot, qdot, rdot in the order of `leg_lengths`, length/time. Defined everywhere; 0 for a leg of zero length.

    Raises
    ------
    ValueError
        If a shape does not fit, a weight is not finite and positive, or weights come with `sdot`.

    Examples
    --------
    The platform rises. Where O is left behind, the upper internal legs do all the work inside; O is better taken along
    part of the way.

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> nd.inverse_velocity(g, c, [0, 0, 0], [0, 0, 1], sdot=[0, 0, 0]).round(4)[[0, 3, 6]] + 0.0
    array([0.8078, 0.6761, 0.    ])
    >>> nd.inverse_velocity(g, c, [0, 0, 0], [0, 0, 1]).round(4)[[0, 3, 6]]
    array([0.8078, 0.2915, 0.3348])

    """
    if sdot is not None and weights is not None:
        raise ValueError(
            "weights: got weights and sdot, expected one of them: with sdot given nothing is left to choose"
        )
    if sdot is None:
        sdot = internal_velocity(geometry, configuration, omega, pdot, weights)
    shape, flat, velocity = operands_with(geometry, configuration, _vectors(omega=omega, pdot=pdot, sdot=sdot))
    return _core.inverse_velocity(*flat, np.concatenate(velocity, axis=1), 0).reshape(*shape, 9)


def internal_velocity(
    geometry: Geometry,
    configuration: Configuration,
    omega: ArrayLike,
    pdot: ArrayLike,
    weights: ArrayLike | None = None,
) -> Floats:
    """Return the velocity of O that makes the leg rates of a given platform velocity least.

    Any velocity of O serves a given velocity of the platform (see `null_motion`). This one makes the weighted sum of
    squared leg rates least: sdot = (B' Wr B + C' Wq C)^-1 C' Wq E t, found without forming a square.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    omega, pdot : array_like, shape (..., 3)
        Angular velocity of the platform (rad/time) and velocity of its origin (length/time), base frame. They broadcast
        against the configuration.
    weights : array_like, shape (..., 9), optional
        Finite and positive, in the order of `leg_lengths`; all ones by default, which gives the leg rates
        J'^+ (l_c omega, pdot). The first three have no effect, since the external legs do not feel O. A weight below
        1e-30 of the largest decides nothing.

    Returns
    -------
    numpy.ndarray, shape (..., 3)
        sdot, length/time, base frame. Finite where only B or only C is singular, as O then follows the other three
        legs. Where both fail in one direction the leg rates do not depend on sdot in it, and the shortest sdot is
        returned.

    Raises
    ------
    ValueError
        If a shape does not fit or a weight is not finite and positive.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> nd.internal_velocity(g, c, omega=[0, 0, 0], pdot=[0, 0, 1]).round(4) + 0.0
    array([0.    , 0.    , 0.5689])

    """
    vectors = _vectors(omega=omega, pdot=pdot)
    vectors["weights"] = np.ones(9) if weights is None else as_floats("weights", weights, (9,))
    shape, flat, (*twist, weight) = operands_with(geometry, configuration, vectors)
    return _core.internal_velocity(*flat, np.concatenate(twist, axis=1), weight, 0).reshape(*shape, 3)


def null_motion(geometry: Geometry, configuration: Configuration) -> Floats:
    """Return the leg rates of the three motions that leave the platform where it is.

    Column k is the motion of O with unit velocity along axis k of the base: ldot = 0, qdot = C, rdot = B. Added to any
    leg rates, N v moves O with velocity v and the platform not at all, so that J' N = 0. The rank of N,
    `numpy.linalg.matrix_rank(N)`, is the redundancy: 3, nine legs for six coordinates. It is less only where O is in
    the plane of the lower joints and in that of the upper ones, and these planes coincide: there O can leave its place
    though no leg moves.

    Parameters
    ----------
    geometry : Geometry
    configuration : Configuration
        Shape (...).

    Returns
    -------
    numpy.ndarray, shape (..., 9, 3)
        Dimensionless: leg rates per velocity of O. Rows in the order of `leg_lengths`; 0 for a leg of zero length.

    Examples
    --------
    >>> import numpy as np
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> N = nd.null_motion(g, c)
    >>> int(np.linalg.matrix_rank(N)), bool(np.allclose(nd.jacobian(g, c) @ N, 0.0))
    (3, True)

    """
    flat = _core.null_motion(*operands(geometry, configuration), 0)
    return flat.reshape(*configuration.shape, 9, 3)


def _vectors(**named: ArrayLike) -> dict[str, Floats]:
    return {name: as_floats(name, value, (3,)) for name, value in named.items()}
