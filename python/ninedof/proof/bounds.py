"""Certified numbers: rigorous lower and upper bounds of what the other functions compute in doubles."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import operands_and_length
from ninedof.robot.configuration import Configuration, operands
from ninedof.robot.designs import takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, all_finite, as_floats, broadcast_leading, thread_argument
from ninedof.support.text import short, short_repr


class Bounds(NamedTuple):
    """Numbers between which the exact one lies, with certainty."""

    lower: Any
    """A float, or an array of the shape that the function states."""
    upper: Any
    """The same, never below `lower`; infinite where no upper bound is found."""

    def __repr__(self) -> str:
        """Show two numbers in full, and arrays by shape and range."""
        lower, upper = (short(one) if np.ndim(one) else repr(float(one)) for one in self)
        return f"Bounds(lower={lower}, upper={upper})"


@short_repr
class DeterminantBounds(NamedTuple):
    """Bounds of the three determinants of `singularity_margins`, each in [-1, 1]."""

    det_n: Bounds
    """Of the external legs, shape (...). Where 0 is not between the bounds there is no singularity of this kind."""
    det_b: Bounds
    """Of the lower internal legs, shape (...)."""
    det_c: Bounds
    """Of the upper internal legs, shape (...)."""


@takes_designs
def condition_number_bounds(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
) -> Bounds:
    """Return numbers between which the condition number of J' lies with certainty, at any pose.

    The numbers of geometry, configuration and characteristic length are taken as exact, and so is the rotation matrix
    as it stands: the platform joints are at p + Q u_i, whether or not Q is orthogonal to the last bit. For a Q that is
    a rotation to rounding this is a true robot whose platform differs from the given one by that rounding.

    Parameters
    ----------
    geometry : Geometry, Result or Design
    configuration : Configuration
        Shape (...).
    characteristic_length : float, array_like of shape (...), or str
        Length l_c > 0, or a kind as in `characteristic_length`; then the length computed is taken as exact.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    Bounds
        Each a float or of shape (...), at least 1. Their distance is about 1.5e-14 times the square of the condition
        number. The upper bound is infinite where a singular configuration cannot be excluded: always at one, and for
        condition numbers above some 1e14. NaN for a pose without data.

    Raises
    ------
    RuntimeError
        If the floating-point arithmetic of the process is unfit: another rounding mode, or subnormal numbers taken for
        zero, as code built with -ffast-math leaves it.

    Notes
    -----
    Assumed are IEEE 754 doubles rounded to nearest, square roots too. The approximate singular vectors need not be
    trusted: they are verified. `axis_condition_number_bounds` and `hexagonal_condition_number_bounds` are the same by
    the closed form, faster and narrower. Theory of proof, certified numbers.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> lower, upper = nd.condition_number_bounds(g, nd.Configuration.neutral(3.9828, 2.3745))
    >>> print(f"{lower:.12f} {upper:.12f}")
    3.911004436477 3.911004436478

    """
    return _at_poses("condition_number_bounds", (), geometry, configuration, characteristic_length, threads)


@takes_designs
def axis_condition_number_bounds(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
) -> Bounds:
    """Return numbers between which the condition number of J' lies, by the closed form for C3 designs on their axis.

    The first joint of each triple is taken as exact and the other two as its exact images; so are the heights of p and
    s, which lie on the axis exactly. The platform joints are Q u_i with Q as it stands.
    Parameters as in `condition_number_bounds`, with every joint triple a C3 orbit about z, to 1e-9 of its size,
    position and internal point on z, and a rotation about z.

    Returns
    -------
    Bounds
        Each a float or of shape (...), at least 1. Their distance is about 3e-14 of the condition number however large
        it is, unless coordinates cancel.

    Raises
    ------
    ValueError
        Naming what violates the symmetry.
    RuntimeError
        As in `condition_number_bounds`.

    """
    return _at_poses("axis_condition_number_bounds", (), geometry, configuration, characteristic_length, threads)


def hexagonal_condition_number_bounds(
    a1: ArrayLike,
    a2: ArrayLike,
    b1: ArrayLike,
    b2: ArrayLike,
    zp: ArrayLike,
    zs: ArrayLike,
    threads: int | None = None,
) -> Bounds:
    """Return numbers between which the condition numbers of many hexagonal designs lie, by the closed form.

    The six numbers of a design are taken as exact, and the joints are those of eqs. (37)-(38) without rounding.
    Parameters as in `hexagonal_condition_number`.

    Returns
    -------
    Bounds
        Each a float or of the shape the arguments broadcast to, at least 1; NaN where an argument has NaN. Their
        distance is about 1e-14 of the condition number, also near singular designs.

    Raises
    ------
    ValueError
        If shapes do not broadcast or a number is infinite.
    RuntimeError
        As in `condition_number_bounds`.

    Examples
    --------
    >>> import ninedof as nd
    >>> lower, upper = nd.hexagonal_condition_number_bounds(0.0, 5.8124, 2.9062, 0.0, 3.9828, [2.3745, 2.4435])
    >>> lower.round(4), bool(((upper - lower) / lower).max() < 1.5e-14)
    (array([3.911 , 3.9071]), True)

    """
    numbers = {"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs}
    columns = {name: (all_finite(name, as_floats(name, x, ()), missing=True), 0) for name, x in numbers.items()}
    shape, arrays = broadcast_leading(columns)
    designs = np.stack([array.reshape(-1) for array in arrays], axis=-1)
    rows = _core.hexagonal_condition_number_bounds(designs, thread_argument(threads))
    return _split(rows, shape, ())


@takes_designs
def singular_value_bounds(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
) -> Bounds:
    """Return numbers between which the six singular values of J' lie with certainty, descending.

    Parameters as in `condition_number_bounds`. Arrays of shape (..., 6); the upper bound is infinite where a singular
    configuration cannot be excluded.
    """
    return _at_poses("singular_value_bounds", (6,), geometry, configuration, characteristic_length, threads)


@takes_designs
def jacobian_bounds(
    geometry: Geometry,
    configuration: Configuration,
    characteristic_length: ArrayLike | str = 1.0,
    threads: int | None = None,
) -> Bounds:
    """Return numbers between which the elements of J' (eq. 36) lie with certainty.

    Parameters as in `condition_number_bounds`. Arrays of shape (..., 6, 9), as `jacobian`; minus and plus infinity
    where a singular configuration cannot be excluded. Finite bounds prove that J' exists.
    """
    return _at_poses("jacobian_bounds", (6, 9), geometry, configuration, characteristic_length, threads)


@takes_designs
def leg_length_bounds(geometry: Geometry, configuration: Configuration, threads: int | None = None) -> Bounds:
    """Return numbers between which the nine leg lengths lie with certainty.

    Parameters as in `condition_number_bounds`. Arrays of shape (..., 9) in the order of `leg_lengths`, a few units in
    the last place apart.
    """
    rows = _core.leg_length_bounds(*operands(geometry, configuration), thread_argument(threads))
    return _split(rows, configuration.shape, (9,))


@takes_designs
def determinant_bounds(
    geometry: Geometry, configuration: Configuration, threads: int | None = None
) -> DeterminantBounds:
    """Return bounds of the three determinants whose zeros are the singularities, as `singularity_margins` defines them.

    Parameters as in `condition_number_bounds`. Two poses of one robot with proved opposite signs have a singularity
    between them, on every path.
    """
    rows = _core.determinant_bounds(*operands(geometry, configuration), thread_argument(threads))
    lower, upper = _split(rows, configuration.shape, (3,))
    return DeterminantBounds(*(Bounds(lower[..., k], upper[..., k]) for k in range(3)))


def _at_poses(
    name: str,
    tail: tuple[int, ...],
    geometry: Geometry,
    configuration: Configuration,
    length: ArrayLike | str,
    threads: int | None,
) -> Bounds:
    rows = getattr(_core, name)(*operands_and_length(geometry, configuration, length), thread_argument(threads))
    return _split(rows, configuration.shape, tail)


def _split(rows: Floats, shape: tuple[int, ...], tail: tuple[int, ...]) -> Bounds:
    """Return rows (n, 2 columns) of lower, then upper bounds apart, each of shape (*shape, *tail)."""
    both = rows.reshape(len(rows), 2, math.prod(tail))
    lower, upper = (np.ascontiguousarray(both[:, k]).reshape((*shape, *tail))[()] for k in range(2))
    return Bounds(lower, upper)
