"""Velocities and accelerations of samples over time: the polynomial through the five nearest samples.

Exact for polynomials of degree four. Even spacing is not needed. The samples are not smoothed: an error e of a sample
becomes one of about e / step^2 in the acceleration.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof.motion.rotations import to_quaternions, vectors_between
from ninedof.support.arrays import Floats

MOST_SAMPLES = 5  # of a stencil


class Stencils(NamedTuple):
    """For each sample its neighbours and their weights, shape (n, k)."""

    neighbours: NDArray[np.intp]
    first: Floats
    """Of the first derivative."""
    second: Floats
    """Of the second derivative."""


def stencils(time: Floats) -> Stencils:
    """Return the stencils of increasing times, at least three; one-sided at both ends."""
    size = min(MOST_SAMPLES, len(time))
    begin = np.clip(np.arange(len(time)) - size // 2, 0, len(time) - size)
    neighbours = begin[:, None] + np.arange(size)
    distance = time[neighbours] - time[:, None]
    unit = np.abs(distance).max(axis=1, keepdims=True)
    # Row j of V: powers of the distance of neighbour j. Its inverse maps samples to the coefficients of the polynomial.
    inverse = np.linalg.inv((distance / unit)[:, :, None] ** np.arange(size))
    return Stencils(neighbours, inverse[:, 1] / unit, 2.0 * inverse[:, 2] / unit**2)


def derivatives(at: Stencils, values: Floats) -> tuple[Floats, Floats]:
    """Return the first and second derivative of vectors, shape (n, 3)."""
    around = values[at.neighbours] - values[:, None]  # differences first: no digits are lost to a large offset
    return np.einsum("nk,nkd->nd", at.first, around), np.einsum("nk,nkd->nd", at.second, around)


def angular_derivatives(at: Stencils, rotations: Floats) -> tuple[Floats, Floats]:
    """Return the angular velocity and acceleration of rotations (n, 3, 3), base frame.

    About sample k, Q(t) = exp(w(t)) Q_k. At w = 0 the velocity is w' and the acceleration w''.
    """
    q = to_quaternions(rotations)
    w = vectors_between(q[:, None], q[at.neighbours])
    return np.einsum("nk,nkd->nd", at.first, w), np.einsum("nk,nkd->nd", at.second, w)
