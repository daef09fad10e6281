"""Kinetostatic indices of the homogenized Jacobian J' (eqs. 2-5)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import operands_and_length
from ninedof.robot.configuration import Configuration
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice
from ninedof.support.arrays import Floats, filled, thread_argument


@takes_designs
def singular_values(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
    out: Floats | None = None,
) -> Floats:
    """Return the six singular values of J', descending.

    They come from a 6x6 matrix whose singular values are the reciprocals, without inverting or squaring a matrix, so
    a singular configuration gives infinity and not an error.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`; 1 by default, of a design its own.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.
    out : numpy.ndarray, optional
        Array for the result: float64, C-contiguous, aligned, of the result's shape.

    Returns
    -------
    numpy.ndarray, shape (..., 6)
        Speed per unit of leg rate: l_c rad/time and length/time alike. The number of infinite ones is the number of
        free motions with all legs locked.

    """
    poses = geometry, configuration, characteristic_length
    return _index(_core.singular_values, *poses, threads, out, (6,))  # type: ignore[no-any-return]


@takes_designs
def axis_singular_values(
    geometry: Geometry, configuration: Configuration, characteristic_length: ArrayLike | str = 1.0
) -> Floats:
    """Return the six singular values of J' by the closed form for C3 designs on their axis.

    A second, independent computation of `singular_values`, accurate for any condition number. It takes the first joint
    of each triple for exact: where the legs are shorter than the coordinates of their ends by a factor f, the rounding
    of the others makes the two differ by up to about 1e-15 f, relative. Parameters as in `singular_values`, with every
    joint triple a C3 orbit about z, position and internal point on z, and a rotation about z.

    Returns
    -------
    numpy.ndarray, shape (..., 6)
        Descending.

    Raises
    ------
    ValueError
        Naming what violates the symmetry.

    """
    poses = operands_and_length(geometry, configuration, characteristic_length)
    return _core.axis_singular_values(*poses, 0).reshape(*configuration.shape, 6)


@takes_designs
def condition_number(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    norm: str = "2",
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return the condition number of J'.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...); of a design its neutral pose by default. The worst over its study is `Result.condition_number`.
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`; 1 by default, of a design its own.
    norm : {"2", "frobenius"}
        "2": sigma_max / sigma_min, eq. (2), 1 at best. "frobenius": |J'|_F |J'^+|_F, eq. (4) with the Frobenius norm
        and the pseudo-inverse, 6 at best.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.
    out : numpy.ndarray, optional
        Array for the result: float64, C-contiguous, aligned, shape (...).

    Returns
    -------
    float or numpy.ndarray, shape (...)
        Infinite at a singular configuration (and above 2.8e14, which double precision cannot distinguish from it).

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> float(nd.condition_number(g, nd.Configuration.neutral(3.9828, 2.3745)).round(4))
    3.911

    """
    functions = {"2": _core.condition_number_two, "frobenius": _core.condition_number_frobenius}
    return _index(
        functions[choice("norm", norm, functions)], geometry, configuration, characteristic_length, threads, out
    )


@takes_designs
def reciprocal_condition_number(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return sigma_min / sigma_max of J': 1 at isotropy, 0 at a singular configuration.

    Parameters as in `singular_values`.
    """
    return _index(_core.reciprocal_condition_number, geometry, configuration, characteristic_length, threads, out)


@takes_designs
def manipulability(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return sqrt(det(J' J'^T)), the product of the singular values of J'.

    Parameters as in `singular_values`. Infinite at a singular configuration, where locked legs allow
    some twist.
    """
    return _index(_core.manipulability, geometry, configuration, characteristic_length, threads, out)


@takes_designs
def isotropy_residual(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return the distance of J' from isotropy: |J' J'^T - sigma 1|_F / |sigma 1|_F, sigma = trace(J' J'^T) / 6.

    Eq. (5) with the 6x6 product (J'^T J' is 9x9 and of rank 6, so never a multiple of 1). 0 exactly at isotropy,
    which no design of this kind reaches; infinite at a singular configuration. Parameters as in `singular_values`.
    """
    return _index(_core.isotropy_residual, geometry, configuration, characteristic_length, threads, out)


def _index(
    core: Callable[..., Floats],
    geometry: Geometry,
    configuration: Configuration,
    length: ArrayLike | str,
    threads: int | None,
    out: Floats | None,
    tail: tuple[int, ...] = (),
) -> Any:
    poses, count = operands_and_length(geometry, configuration, length), thread_argument(threads)
    return filled(out, (*configuration.shape, *tail), lambda array: core(*poses, count, array))
