"""Kinetostatic indices of the homogenized Jacobian J' (eqs. 2-5)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import resolve_length
from ninedof.robot.configuration import Configuration, operands
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice
from ninedof.support.arrays import Floats, as_floats, checked_out, leading_shape, thread_argument, without_infinity

GATHERED = 2**16  # designs passed to the core at once, so that they stay in the caches


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
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`.
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
    lc = resolve_length(geometry, configuration, characteristic_length)
    shape = (*configuration.shape, 6)
    flat = _core.singular_values(
        *operands(geometry, configuration), lc, thread_argument(threads), checked_out(out, shape)
    )
    return out if out is not None else flat.reshape(shape)


def axis_singular_values(
    geometry: Geometry, configuration: Configuration, characteristic_length: ArrayLike | str = 1.0
) -> Floats:
    """Return the six singular values of J' by the closed form for C3 designs on their axis.

    A second, independent computation of `singular_values`, accurate for any condition number.

    Parameters
    ----------
    geometry : Geometry
        Every joint triple a C3 orbit about z.
    configuration : Configuration
        Shape (...); position and internal point on z, rotation about z.
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`.

    Returns
    -------
    numpy.ndarray, shape (..., 6)
        Descending.

    Raises
    ------
    ValueError
        Naming what violates the symmetry.

    """
    lc = resolve_length(geometry, configuration, characteristic_length)
    return _core.axis_singular_values(*operands(geometry, configuration), lc, 0).reshape(*configuration.shape, 6)


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
    geometry : Geometry
    configuration : Configuration
        Shape (...).
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`.
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


def hexagonal_condition_number(
    a1: ArrayLike,
    a2: ArrayLike,
    b1: ArrayLike,
    b2: ArrayLike,
    zp: ArrayLike,
    zs: ArrayLike,
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return the condition number of many hexagonal designs, each at its neutral configuration (eqs. 6, 37, 38).

    By the closed form on the symmetry axis, about 6 ns per design on one processor and as much again to gather six
    arrays: for maps and atlases of millions of designs. All lengths in units of the characteristic length; theta_z = 0.
    The designs need not satisfy any constraint, not even zs < zp (eq. 9b).

    Parameters
    ----------
    a1, a2, b1, b2, zp, zs : array_like
        Sides of base and platform, heights of platform and O, divided by the characteristic length. They broadcast.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.
    out : numpy.ndarray, optional
        Array for the result: float64, C-contiguous, aligned, of the shape the arguments broadcast to.

    Returns
    -------
    float or numpy.ndarray
        Infinite where singular, NaN where an argument has NaN.

    Raises
    ------
    ValueError
        If shapes do not broadcast, a number is infinite, or `out` does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.hexagonal_condition_number(0.0, 5.8124, 2.9062, 0.0, 3.9828, [2.3745, 2.4435, 2.5110]).round(4)
    array([3.911 , 3.9071, 3.911 ])

    """
    given = {"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs}
    columns = {name: without_infinity(name, _column(name, value)) for name, value in given.items()}
    shape = leading_shape({name: (values, 0) for name, values in columns.items()})
    checked_out(out, shape)
    found = np.empty(shape) if out is None else out
    each = [v.reshape(-1) if v.size == 1 else np.broadcast_to(v, shape).reshape(-1) for v in columns.values()]
    flat, count = found.reshape(-1), thread_argument(threads)
    designs = np.empty((min(GATHERED, flat.size), len(each)))
    for first in range(0, flat.size, GATHERED):
        part = flat[first : first + GATHERED]
        rows = designs[: part.size]
        for k, values in enumerate(each):
            rows[:, k] = values if values.size == 1 else values[first : first + GATHERED]
        _core.hexagonal_condition_numbers(rows, count, part)
    return found if out is not None else found[()]


def _column(name: str, value: ArrayLike) -> Floats:
    """Return an array for reading: the argument itself if it has the right type."""
    own = type(value) is np.ndarray and value.dtype == np.float64
    return value if own else as_floats(name, value, ())  # type: ignore[return-value]  # the condition says so


def reciprocal_condition_number(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return sigma_min / sigma_max of J': 1 at isotropy, 0 at a singular configuration.

    Parameters as in `condition_number`.
    """
    return _index(_core.reciprocal_condition_number, geometry, configuration, characteristic_length, threads, out)


def manipulability(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return sqrt(det(J' J'^T)), the product of the singular values of J'.

    Parameters as in `condition_number`. Infinite at a singular configuration, where locked legs allow
    some twist.
    """
    return _index(_core.manipulability, geometry, configuration, characteristic_length, threads, out)


def isotropy_residual(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
    out: Floats | None = None,
) -> Any:
    """Return the distance of J' from isotropy: |J' J'^T - sigma 1|_F / |sigma 1|_F, sigma = trace(J' J'^T) / 6.

    Eq. (5) with the 6x6 product (J'^T J' is 9x9 and of rank 6, so never a multiple of 1). 0 exactly at isotropy,
    which no design of this kind reaches; infinite at a singular configuration. Parameters as in `condition_number`.
    """
    return _index(_core.isotropy_residual, geometry, configuration, characteristic_length, threads, out)


def _index(
    core: Callable[..., Floats],
    geometry: Geometry,
    configuration: Configuration,
    length: ArrayLike | str,
    threads: int | None,
    out: Floats | None,
) -> Any:
    lc = resolve_length(geometry, configuration, length)
    checked_out(out, configuration.shape)
    flat = core(*operands(geometry, configuration), lc, thread_argument(threads), out)
    return out if out is not None else flat.reshape(configuration.shape)[()]
