"""Rates and accelerations, eqs. (24)-(28) and (36), and the null motions of the redundancy."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import resolve_length
from ninedof.robot.configuration import Configuration, operands, operands_with
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats


@takes_designs
def forward_velocity(
    geometry: Geometry, configuration: Configuration, leg_rates: ArrayLike
) -> tuple[Floats, Floats, Floats]:
    """Return the velocity that given leg rates produce.

    Parameters
    ----------
    geometry : Geometry, Result or Design
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
        At a singular configuration the components that the leg rates do not determine are NaN.

    """
    shape, flat, rates = operands_with(geometry, configuration, leg_rates=(leg_rates, 9))
    return _three_vectors(_core.forward_velocity(*flat, rates, 0), shape)


@takes_designs
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
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    omega, pdot : array_like, shape (..., 3)
        Angular velocity of the platform (rad/time) and velocity of its origin (length/time), base frame. They broadcast
        against the configuration, as do all arguments below.
    sdot : array_like, shape (..., 3), optional
        Velocity of O, length/time, base frame. By default that of `internal_velocity`, which minimizes the weighted
        sum of squared leg rates: with all weights one the leg rates are J'^+ (l_c omega, pdot).
    weights : array_like, shape (..., 9), optional
        Weights of the squared leg rates; all ones by default. Not allowed together with `sdot`.

    Returns
    -------
    numpy.ndarray, shape (..., 9)
        ldot, qdot, rdot in the order of `leg_lengths`, length/time. Always defined; 0 for a leg of zero length.

    Raises
    ------
    ValueError
        If a shape does not fit, a weight is not finite and positive, or weights come with `sdot`.

    Examples
    --------
    The platform rises. If O is at rest, the lower internal legs do not move. The rates are smaller if O follows part of
    the motion.

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
            "weights: got weights and sdot, expected one of them: with sdot given the weights have no effect"
        )
    if sdot is None:
        sdot = internal_velocity(geometry, configuration, omega, pdot, weights)
    shape, flat, velocity = operands_with(geometry, configuration, omega=(omega, 3), pdot=(pdot, 3), sdot=(sdot, 3))
    return _core.inverse_velocity(*flat, velocity, 0).reshape(*shape, 9)


@takes_designs
def internal_velocity(
    geometry: Geometry,
    configuration: Configuration,
    omega: ArrayLike,
    pdot: ArrayLike,
    weights: ArrayLike | None = None,
) -> Floats:
    """Return the velocity of O that minimizes the leg rates for a given platform velocity.

    Any velocity of O is compatible with a given velocity of the platform (see `null_motion`). This one minimizes the
    weighted sum of squared leg rates: sdot = (B^T Wr B + C^T Wq C)^-1 C^T Wq E t, computed without normal equations.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    omega, pdot : array_like, shape (..., 3)
        Angular velocity of the platform (rad/time) and velocity of its origin (length/time), base frame. They broadcast
        against the configuration.
    weights : array_like, shape (..., 9), optional
        Finite and positive, in the order of `leg_lengths`; all ones by default, which gives the leg rates
        J'^+ (l_c omega, pdot). The first three have no effect, because the external legs do not depend on O. A weight
        below 1e-30 of the largest has no effect either.

    Returns
    -------
    numpy.ndarray, shape (..., 3)
        sdot, length/time, base frame. Finite if only B or only C is singular. If both have a common null direction, the
        leg rates do not depend on sdot along it, and the shortest sdot is returned.

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
    weights = np.ones(9) if weights is None else weights
    shape, flat, rows = operands_with(geometry, configuration, omega=(omega, 3), pdot=(pdot, 3), weights=(weights, 9))
    return _core.internal_velocity(*flat, rows[:, :6], rows[:, 6:], 0).reshape(*shape, 3)


@takes_designs
def null_motion(geometry: Geometry, configuration: Configuration) -> Floats:
    """Return the leg rates of the three null motions, in which the platform is at rest.

    Column k is the motion of O with unit velocity along axis k of the base: ldot = 0, qdot = C, rdot = B. Added to any
    leg rates, null_motion @ v moves O with velocity v and does not move the platform: J' maps every column to zero. The
    rank of the matrix is the redundancy: 3, nine legs for six coordinates. It is smaller only if O lies in the plane of
    the lower joints and in that of the upper ones, and these planes coincide: there O can move with all legs locked.
    Parameters as in `leg_lengths`.

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
    >>> rates = nd.null_motion(g, c)
    >>> int(np.linalg.matrix_rank(rates)), bool(np.allclose(nd.jacobian(g, c) @ rates, 0.0))
    (3, True)

    """
    flat = _core.null_motion(*operands(geometry, configuration), 0)
    return flat.reshape(*configuration.shape, 9, 3)


@takes_designs
def forward_acceleration(
    geometry: Geometry, configuration: Configuration, leg_rates: ArrayLike, leg_accelerations: ArrayLike
) -> tuple[Floats, Floats, Floats]:
    """Return the acceleration that given leg rates and leg accelerations produce.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    leg_rates : array_like, shape (..., 9)
        ldot, qdot, rdot in the order of `leg_lengths`, length/time. A leg that rotates has a centripetal
        acceleration even if its rate is constant.
    leg_accelerations : array_like, shape (..., 9)
        lddot, qddot, rddot, length/time^2. Both broadcast against the configuration.

    Returns
    -------
    alpha : numpy.ndarray, shape (..., 3)
        Angular acceleration of the platform, rad/time^2, base frame.
    pddot : numpy.ndarray, shape (..., 3)
        Acceleration of the platform origin, length/time^2.
    sddot : numpy.ndarray, shape (..., 3)
        Acceleration of the internal point, length/time^2.
        At a singular configuration the components that the legs do not determine are NaN.

    Examples
    --------
    The platform rises while O is at rest. With constant leg rates it slows down and begins to rotate, because the legs
    become steeper.

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> rates = nd.inverse_velocity(g, c, omega=[0, 0, 0], pdot=[0, 0, 1], sdot=[0, 0, 0])
    >>> alpha, pddot, sddot = nd.forward_acceleration(g, c, rates, [0] * 9)
    >>> alpha.round(4) + 0.0, pddot.round(4) + 0.0
    (array([0.    , 0.    , 0.2168]), array([ 0.    ,  0.    , -0.3526]))

    """
    shape, flat, rows = operands_with(
        geometry, configuration, leg_rates=(leg_rates, 9), leg_accelerations=(leg_accelerations, 9)
    )
    return _three_vectors(_core.forward_acceleration(*flat, rows[:, :9], rows[:, 9:], 0), shape)


@takes_designs
def inverse_acceleration(
    geometry: Geometry,
    configuration: Configuration,
    omega: ArrayLike,
    pdot: ArrayLike,
    sdot: ArrayLike,
    alpha: ArrayLike,
    pddot: ArrayLike,
    sddot: ArrayLike,
) -> Floats:
    """Return the leg accelerations of a given motion: the time derivative of `inverse_velocity`.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    omega, pdot, sdot : array_like, shape (..., 3)
        Angular velocity of the platform (rad/time), velocities of its origin and of O (length/time), base frame.
    alpha, pddot, sddot : array_like, shape (..., 3)
        Their time derivatives. All six broadcast against the configuration.

    Returns
    -------
    numpy.ndarray, shape (..., 9)
        lddot, qddot, rddot in the order of `leg_lengths`, length/time^2. Always defined, except for a leg of zero
        length: NaN for that leg only, because its length has a kink there.

    Examples
    --------
    The platform rotates about its axis at a constant rate: only the external legs accelerate.

    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> still, turning = [0, 0, 0], [0, 0, 1]
    >>> nd.inverse_acceleration(g, c, turning, still, still, still, still, still).round(4)[[0, 3, 6]] + 0.0
    array([0.3726, 0.    , 0.    ])

    """
    motion = {"omega": omega, "pdot": pdot, "sdot": sdot, "alpha": alpha, "pddot": pddot, "sddot": sddot}
    shape, flat, rows = operands_with(geometry, configuration, **{name: (v, 3) for name, v in motion.items()})
    return _core.inverse_acceleration(*flat, rows[:, :9], rows[:, 9:], 0).reshape(*shape, 9)


@takes_designs
def jacobian_rate(
    geometry: Geometry,
    configuration: Configuration,
    omega: ArrayLike,
    pdot: ArrayLike,
    sdot: ArrayLike,
    characteristic_length: ArrayLike | str = 1.0,
) -> Floats:
    """Return the time derivative of J' along a motion, in closed form.

    With it the twist t = (l_c omega, pdot) of leg rates u changes as dt/dt = J' du/dt + (dJ'/dt) u.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    omega, pdot, sdot : array_like, shape (..., 3)
        The motion: angular velocity of the platform (rad/time), velocities of its origin and of O (length/time), base
        frame. They broadcast against the configuration. J' depends on O, so sdot matters.
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`. It is constant: a length chosen by its kind at this
        configuration does not change along the motion.

    Returns
    -------
    numpy.ndarray, shape (..., 6, 9)
        Rows and columns as in `jacobian`, per time. All NaN where J' does not exist.

    Raises
    ------
    ValueError
        If the characteristic length is not finite and positive.

    Examples
    --------
    >>> import numpy as np
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> c = nd.Configuration.neutral(3.9828, 2.4432)
    >>> v = np.array([0.1, -0.2, 0.3]), np.array([1.0, 0.0, 0.5]), np.array([0.2, 0.3, 0.4])
    >>> h = 1e-5 * np.concatenate(v)
    >>> differences = (nd.jacobian(g, c.moved(h)) - nd.jacobian(g, c.moved(-h))) / 2e-5
    >>> bool(np.allclose(nd.jacobian_rate(g, c, *v), differences, atol=1e-8))
    True

    """
    shape, flat, velocity = operands_with(geometry, configuration, omega=(omega, 3), pdot=(pdot, 3), sdot=(sdot, 3))
    lc = resolve_length(geometry, configuration, characteristic_length)
    if lc.size != 1:  # one per configuration, broadcast to the velocities
        lc = np.ascontiguousarray(np.broadcast_to(lc.reshape(configuration.shape), shape)).reshape(-1)
    return _core.jacobian_rate(*flat, velocity, lc, 0).reshape(*shape, 6, 9)


def _three_vectors(flat: Floats, shape: tuple[int, ...]) -> tuple[Floats, Floats, Floats]:
    """Return three arrays (..., 3) from rows of nine numbers: rates of the rotation, of p and of O."""
    rotation, p, s = np.moveaxis(flat.reshape(*shape, 3, 3), -2, 0)
    return rotation.copy(), p.copy(), s.copy()
