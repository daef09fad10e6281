"""Gradients of logarithms of condition numbers, also where singular values coincide.

Where singular values coincide, the largest has a set of gradients: one for each unit vector v in the space of the
cluster, the derivative of log sigma along v. The tie is not broken by a perturbation. J' itself is smooth in the
variables. Its differences give the derivatives of the cluster as small matrices, one for each variable.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ninedof.support.arrays import Floats

TIE = 1e-6  # of a logarithm: values nearer than that count as equal
STEP = 1e-4  # of the size of a variable; the error of the differences is about its fourth power


@dataclass(frozen=True, eq=False)
class Ends:
    """The two ends of a spectrum: for each variable, the derivative of log sigma over the cluster at each end."""

    top: Floats
    """Of the largest singular values, shape (variables, m, m)."""
    bottom: Floats
    """Of the smallest, shape (variables, k, k)."""

    def steepest(self, direction: Floats) -> Floats:
        """Return the gradient of log(largest / smallest) with the least slope along a direction."""
        return _extreme(self.top, direction, 0) - _extreme(self.bottom, direction, -1)

    def steepest_speed(self, direction: Floats) -> Floats:
        """Return the same for log(1 / smallest)."""
        return -_extreme(self.bottom, direction, -1)


def _extreme(cluster: Floats, direction: Floats, which: int) -> Floats:
    """Return the gradient for the vector of the cluster with the least (0) or the greatest (-1) slope."""
    vectors = np.linalg.eigh(np.einsum("j,jab->ab", direction, cluster))[1]
    v = vectors[:, which]
    return np.asarray(np.einsum("a,jab,b->j", v, cluster, v))


def ends_of(matrix: Floats, slopes: Floats) -> Ends:
    """Return the ends of the spectrum of a matrix with given derivatives.

    Parameters
    ----------
    matrix : numpy.ndarray, shape (6, k)
    slopes : numpy.ndarray, shape (variables, 6, k)

    """
    left, sigma, right = np.linalg.svd(matrix, full_matrices=False)
    near_top = sigma >= sigma[0] * (1.0 - TIE)
    near_bottom = sigma <= sigma[-1] * (1.0 + TIE)
    return Ends(*(_cluster(left[:, c], right[c], float(sigma[c].mean()), slopes) for c in (near_top, near_bottom)))


def _cluster(left: Floats, right: Floats, sigma: float, slopes: Floats) -> Floats:
    """Return the symmetric part of U^T dM V / sigma: its eigenvalues are the derivatives of the logarithms."""
    moved: Floats = np.einsum("ia,jik,bk->jab", left, slopes, right) / sigma
    return 0.5 * (moved + np.swapaxes(moved, -1, -2))


def differences(f: Callable[[Floats], Floats], x: Floats, size: Floats, low: Floats, high: Floats) -> Floats:
    """Return the derivatives of an array over some variables, each in units of its size.

    Central differences of fourth order; at a bound all points lie on the inner side.

    Parameters
    ----------
    f : callable
        From x to an array of any shape.
    x, size, low, high : numpy.ndarray, shape (n,)
        Variables, their sizes and bounds. Fixed variables, with low = high, have no row in the result.

    Returns
    -------
    numpy.ndarray, shape (free variables, ...)

    """
    out = []
    for j in np.flatnonzero(low < high):
        h = min(STEP * float(size[j]), 0.2 * float(high[j] - low[j]))
        if x[j] - low[j] < 2.0 * h:
            points = _INNER
        elif high[j] - x[j] < 2.0 * h:
            points = {-k: -weight for k, weight in _INNER.items()}
        else:
            points = _CENTRAL
        total = sum(weight * f(_moved(x, int(j), k * h)) for k, weight in points.items())
        out.append(np.asarray(total) * (float(size[j]) / h))
    return np.array(out)


_CENTRAL = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}
_INNER = {0: -25 / 12, 1: 4.0, 2: -3.0, 3: 4 / 3, 4: -1 / 4}


def _moved(x: Floats, j: int, by: float) -> Floats:
    out = x.copy()
    out[j] += by
    return out
