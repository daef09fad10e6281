"""Least condition number of threefold symmetric designs by the height of O: found numerically, from rho = 0.505 on."""

import math

import numpy as np


def least_by_height(rho):
    """kappa*(rho): the least condition number of any C3 design with |s - p| = rho (docs/theory/limits.md)."""
    q = rho * rho
    k = np.roots(
        [2, -(87 * q + 47), 264 + 33 * q - 27 * q * q, 144 + 132 * q + 27 * q * q - q**3, q * q * (q + 3)],
    )
    return math.sqrt(min(x.real for x in k if abs(x.imag) < 1e-7 * abs(x) and x.real >= 1.0))
