"""The condition number of many hexagonal designs, by the closed form on the symmetry axis."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.support.arrays import Floats, all_finite, as_floats, leading_shape, thread_argument

HEXAGONAL = ("a1", "a2", "b1", "b2", "zp", "zs")
GATHERED = 2**16  # designs passed to the core at once, so that they stay in the caches


def hexagonal_condition_number(
    a1: ArrayLike,
    a2: ArrayLike,
    b1: ArrayLike,
    b2: ArrayLike,
    zp: ArrayLike,
    zs: ArrayLike,
    threads: int | None = None,
) -> Any:
    """Return the condition number of many hexagonal designs, each at its neutral configuration (eqs. 6, 37, 38).

    Uses the closed form on the symmetry axis: about 6 ns per design on one processor, and as much to gather the six
    arrays. Made for maps and atlases of millions of designs. All lengths are in units of the characteristic length, and
    theta_z = 0. The designs need not satisfy any constraint, not even zs < zp (eq. 9b).

    Joints are rounded, here and in `Geometry.hexagonal`, and differently so. Where the external legs are shorter than
    the sides by a factor f, that alone changes the condition number by up to about 1e-15 f, relative: nine digits are
    left at f = 1e6, three at f = 1e12.

    Parameters
    ----------
    a1, a2, b1, b2, zp, zs : array_like
        Sides of base and platform, heights of platform and O, divided by the characteristic length. They broadcast.
    threads : int, optional
        Number of threads; one per processor by default. The result does not depend on it.

    Returns
    -------
    float or numpy.ndarray
        Infinite where singular, NaN where an argument has NaN.

    Raises
    ------
    ValueError
        If shapes do not broadcast or a number is infinite.

    Examples
    --------
    >>> import ninedof as nd
    >>> nd.hexagonal_condition_number(0.0, 5.8124, 2.9062, 0.0, 3.9828, [2.3745, 2.4435, 2.5110]).round(4)
    array([3.911 , 3.9071, 3.911 ])

    """
    arguments = dict(zip(HEXAGONAL, (a1, a2, b1, b2, zp, zs), strict=True))
    columns = {name: all_finite(name, _column(name, value), missing=True) for name, value in arguments.items()}
    shape, count = leading_shape({name: (values, 0) for name, values in columns.items()}), thread_argument(threads)
    results = np.empty(shape)
    access: Any = [["readonly"]] * 6 + [["writeonly"]]
    pieces: Any = np.nditer(
        [*columns.values(), results],
        flags=["external_loop", "buffered", "zerosize_ok"],
        op_flags=access,
        buffersize=GATHERED,
        order="C",
    )
    with pieces:
        for *designs, piece in pieces:
            _core.hexagonal_condition_numbers(np.stack(designs, axis=1), count, piece)
    return results[()]


def _column(name: str, value: ArrayLike) -> Floats:
    """Return an array for reading: the argument itself if it has the right type."""
    own = type(value) is np.ndarray and value.dtype == np.float64
    return value if own else as_floats(name, value, ())  # type: ignore[return-value]  # the condition says so
