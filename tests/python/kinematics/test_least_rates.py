"""Redundancy: null motions, and the least leg rates for a platform velocity.

Oracle: numpy's pseudo-inverse and least squares on the matrices of numpy_model, and the definition itself: no other
velocity of O has smaller leg rates.
"""

import numpy as np
import numpy_model as model
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
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


def test_stack_equals_one_by_one(published, stack):
    rng = np.random.default_rng(3)
    omega, pdot, weights = rng.normal(size=(5, 3)), rng.normal(size=(5, 3)), rng.uniform(0.1, 10.0, size=(5, 9))
    singles = list(stack)
    assert_array_equal(nd.null_motion(published, stack), [nd.null_motion(published, c) for c in singles])
    rows = list(zip(singles, omega, pdot, weights, strict=True))
    assert_array_equal(
        nd.internal_velocity(published, stack, omega, pdot, weights),
        [nd.internal_velocity(published, *row) for row in rows],
    )
    assert_array_equal(
        nd.inverse_velocity(published, stack, omega, pdot, weights=weights),
        [nd.inverse_velocity(published, c, o, p, weights=w) for c, o, p, w in rows],
    )


def test_shapes(published, stack, neutral):
    assert nd.internal_velocity(published, neutral, np.ones((2, 1, 3)), np.zeros((6, 3))).shape == (2, 6, 3)
    assert nd.inverse_velocity(published, neutral, [0, 0, 1], [0, 0, 0], weights=np.ones((4, 9))).shape == (4, 9)
    assert nd.inverse_velocity(published, stack[:0], [0, 0, 1], [0, 0, 0]).shape == (0, 9)
    grid = nd.Configuration.neutral([[3.0], [4.0]], [1.0, 1.5, 2.0])
    assert nd.null_motion(published, grid).shape == (2, 3, 9, 3)


def test_missing_pose_stays_alone(published):
    c = nd.Configuration([[0, 0, 4], [np.nan, 0, 4], [0, 0, 4]], np.eye(3), [0, 0, 2.0])
    for result in (
        nd.internal_velocity(published, c, [1, 0, 0], [0, 1, 0]),
        nd.inverse_velocity(published, c, [1, 0, 0], [0, 1, 0])[..., 3:],
    ):
        assert np.isfinite(result[[0, 2]]).all()
        assert np.isnan(result[1]).all()
    one = nd.internal_velocity(published, c[0], [[1, 0, 0], [np.nan, 0, 0]], [0, 1, 0])
    assert np.isfinite(one[0]).all()
    assert np.isnan(one[1]).all()
