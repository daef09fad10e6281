"""Leg lengths, and the matrices of eqs. (30)-(36)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import operands_and_length
from ninedof.robot.configuration import Configuration, operands
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, filled, thread_argument
from ninedof.support.text import short_repr


@short_repr
class VelocityMatrices(NamedTuple):
    """The matrices of eqs. (30)-(35); leading dimensions are those of the configuration."""

    A: Floats
    """External legs, rows [u_i x e_i / l_c, e_i], shape (..., 3, 6). Eq. (30)."""
    B: Floats
    """Lower internal unit vectors, base joint to O, shape (..., 3, 3). Eq. (31)."""
    C: Floats
    """Upper internal unit vectors, platform joint to O, shape (..., 3, 3). Eq. (32)."""
    D: Floats
    """Rows u~_i x e~_i / l_c, shape (..., 3, 3). Eq. (33)."""
    E: Floats
    """[D C], shape (..., 3, 6). Eq. (35b)."""
    F: Floats
    """[A; E], shape (..., 6, 6). Eq. (35a)."""
    G: Floats
    """[1 0 0; 0 -1 C B^-1], shape (..., 6, 9); NaN in the last block where det B = 0. Eq. (35a)."""


@takes_designs
def leg_lengths(
    geometry: Geometry, configuration: Configuration, threads: int | None = None, out: Floats | None = None
) -> Floats:
    """Return the nine leg lengths: inverse position analysis.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        One configuration or a stack of shape (...).
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.
    out : numpy.ndarray, optional
        Array for the result: float64, C-contiguous, aligned, of the result's shape.

    Returns
    -------
    numpy.ndarray, shape (..., 9)
        l1 l2 l3 q1 q2 q3 r1 r2 r3, the order of eq. (35b), in the length unit of the input.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> nd.leg_lengths(g, nd.Configuration.neutral(3.9828, 2.4432)).round(4)[[0, 3, 6]]
    array([4.9304, 2.2772, 4.151 ])

    """
    poses, count = operands(geometry, configuration), thread_argument(threads)
    lengths = filled(out, (*configuration.shape, 9), lambda array: _core.leg_lengths(*poses, count, array))
    return lengths  # type: ignore[no-any-return]  # an array: the shape is never ()


@takes_designs
def velocity_matrices(
    geometry: Geometry, configuration: Configuration, characteristic_length: ArrayLike | str = 1.0
) -> VelocityMatrices:
    """Return A, B, C, D, E, F and G of eqs. (30)-(35) by name.

    They act on the twist (l_c omega, pdot). (Eqs. (27) and (29) as printed omit l_c.) Parameters as in `jacobian`.

    Raises
    ------
    ValueError
        If the characteristic length is not finite and positive.

    """
    flat = _core.velocity_matrices(*operands_and_length(geometry, configuration, characteristic_length), 0)
    sizes = [(3, 6), (3, 3), (3, 3), (3, 3), (3, 6), (6, 6), (6, 9)]
    parts = np.split(flat, np.cumsum([rows * columns for rows, columns in sizes])[:-1], axis=1)
    matrices = (part.reshape(*configuration.shape, *size).copy() for part, size in zip(parts, sizes, strict=True))
    return VelocityMatrices(*matrices)


@takes_designs
def jacobian(geometry: Geometry, configuration: Configuration, characteristic_length: ArrayLike | str = 1.0) -> Floats:
    """Return J' = F^-1 G of eq. (36), in closed form.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`.

    Returns
    -------
    numpy.ndarray, shape (..., 6, 9)
        Rows: twist (l_c omega, pdot). Columns: leg rates in the order of `leg_lengths`. All NaN at a configuration
        where F or B is exactly singular, since J' does not exist there; `condition_number` is infinite.

    """
    flat = _core.jacobian(*operands_and_length(geometry, configuration, characteristic_length), 0)
    return flat.reshape(*configuration.shape, 6, 9)
