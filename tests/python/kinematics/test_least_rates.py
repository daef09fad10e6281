"""Redundancy: null motions, and the least leg rates for a platform velocity.

Oracle: numpy's pseudo-inverse and least squares on the matrices of numpy_model, and the definition itself: no other
velocity of O has smaller leg rates.
"""

import numpy as np
import numpy_model as model
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from robots import regular

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)


def least(m, omega, pdot, weights=1.0):
    """Sdot by least squares, SVD inside: all nine leg rates as an affine function of sdot."""
    A, B, C, D = model.matrices(m)
    t = np.concatenate([omega, pdot])
    fixed = np.concatenate([A @ t, -np.hstack([D, C]) @ t, np.zeros(3)])
    free = np.vstack([np.zeros((3, 3)), C, B])
    root = np.sqrt(weights) * np.ones(9)
    return np.linalg.lstsq(root[:, None] * free, -root * fixed, rcond=1e-14)[0]


@given(SEEDS, st.floats(1.0, 1e3))
def test_weighted_least_squares(seed, spread):
    m, rng = regular(seed)
    g, c, (omega, pdot) = m.geometry(), m.configuration(), rng.normal(size=(2, 3))
    weights = spread ** rng.uniform(-1.0, 1.0, size=9)
    sdot = nd.internal_velocity(g, c, omega, pdot, weights)
    lost = 1e-13 * spread * np.linalg.cond(nd.null_motion(g, c)) ** 2
    assert_allclose(sdot, least(m, omega, pdot, weights), rtol=0.0, atol=lost)
    rates = nd.inverse_velocity(g, c, omega, pdot, weights=weights)
    cost = weights @ rates**2
    for other in sdot + 1e-3 * rng.normal(size=(20, 3)):
        assert weights @ nd.inverse_velocity(g, c, omega, pdot, other) ** 2 > cost


def test_leg_rates_of_a_platform_velocity_differ_by_null_motions(published, neutral):
    rng = np.random.default_rng(6)
    omega, pdot, sdot = rng.normal(size=(3, 3))
    shift = sdot - nd.internal_velocity(published, neutral, omega, pdot)
    assert_allclose(
        nd.inverse_velocity(published, neutral, omega, pdot, sdot),
        nd.inverse_velocity(published, neutral, omega, pdot) + nd.null_motion(published, neutral) @ shift,
        atol=1e-14,
    )
