"""Effect of leg and joint errors: first-order bounds, covariance, samples.

Oracles: numpy's inverse of a matrix built elsewhere; all 512 corners one by one; scipy's root finder on leg lengths of
robots whose joints have really been moved; the leg lengths that samples have, which no first order enters."""

import numpy as np
import numpy_model as model
import pytest
import robots
import sizes
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.optimize import fsolve

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)
TRIPLES = ("r", "rh", "u", "ut")
LEG_OF_JOINT = [0, 1, 2, 6, 7, 8, 0, 1, 2, 3, 4, 5]
"""In the order of `joint_errors`: base external and internal, platform external and internal."""


def bounds(m, legs=0.0, joints=0.0):
    return nd.error_bounds(m.geometry(), m.configuration(), legs, joints)


def samples(m, legs=0.0, joints=0.0, **options):
    return nd.error_samples(m.geometry(), m.configuration(), legs, joints, **options)


def inverse(m):
    return np.linalg.inv(robots.rates(m))


def solved(m, lengths):
    """Tangent to where `m` has these lengths, by scipy; joints may have been moved since."""
    g, c = m.geometry(), m.configuration()
    result, _, status, message = fsolve(
        lambda t: nd.leg_lengths(g, c.moved(t)) - lengths, np.zeros(9), xtol=1e-14, full_output=True
    )
    residual = np.abs(nd.leg_lengths(g, c.moved(result)) - lengths).max()
    assert residual < 1e-12, (status, message)
    return result


def moved_joint(m, joint, d):
    name, row = TRIPLES[joint // 3], joint % 3
    triple = getattr(m, name).copy()
    triple[row] += d
    return m._replace(**{name: triple})


# --- The map ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("joint", range(12))
def test_a_joint_error_acts_like_a_leg_error(joint):
    """Signs as documented: longer where the leg begins, shorter where it ends."""
    m, rng = robots.regular(11)
    d = 1e-5 * rng.normal(size=3)
    leg = LEG_OF_JOINT[joint]
    along = np.concatenate([v / np.linalg.norm(v, axis=1, keepdims=True) for v in model.legs(m)[:3]])[leg]
    in_base = d if joint < 6 else m.Q @ d
    expected = nd.error_map(m.geometry(), m.configuration())[:, leg] * (along @ in_base) * (-1 if 6 <= joint < 9 else 1)
    result = solved(moved_joint(m, joint, d), model.lengths(m))
    assert_allclose(result, expected, atol=3e-4 * np.abs(expected).max())


# --- Bounds -----------------------------------------------------------------------------------------------------------


@given(SEEDS)
def test_covariance_of_independent_errors(seed):
    m, rng = robots.regular(seed)
    legs, joints = rng.uniform(0.0, 1e-3, size=9), rng.uniform(0.0, 1e-3, size=12)
    variance = legs**2 / 3.0
    np.add.at(variance, LEG_OF_JOINT, joints**2 / 5.0)
    expected = (inverse(m) * variance) @ inverse(m).T
    result = bounds(m, legs, joints).covariance
    assert_allclose(result, expected, atol=1e-13 * np.linalg.cond(robots.rates(m)) * np.abs(expected).max())


def test_leg_of_zero_length_has_no_bound(published):
    for s, regular in ((published.base_internal[1], False), ([0.0, 1.6778953523188904, 4.0], True)):
        result = nd.error_bounds(published, nd.Configuration([0, 0, 4.0], np.eye(3), s), 1e-3)
        assert np.isinf(result.rotation)
        assert np.isfinite(result.internal_point) == regular


# --- Samples ----------------------------------------------------------------------------------------------------------


def test_samples_have_the_covariance_and_keep_the_bounds():
    m, rng = robots.regular(14)
    legs, joints = rng.uniform(1e-5, 1e-4, size=9), rng.uniform(1e-5, 1e-4, size=12)
    result, limit = samples(m, legs, joints, samples=40_000), bounds(m, legs, joints)
    assert np.isfinite(result).all()
    second_order = 0.01
    assert (np.abs(result) <= limit.components * (1.0 + second_order)).all()
    for k, name in enumerate(("rotation", "position", "internal_point")):
        assert np.linalg.norm(result[:, 3 * k : 3 * k + 3], axis=1).max() <= getattr(limit, name) * (1.0 + second_order)
    deviation = np.sqrt(limit.covariance.diagonal())
    assert_allclose(result.mean(axis=0) / deviation, 0.0, atol=0.03)
    assert_allclose(
        np.cov(result.T) / np.outer(deviation, deviation), limit.covariance / np.outer(deviation, deviation), atol=0.03
    )


def test_normal_errors_have_their_own_covariance():
    """A tolerance of three standard deviations, of a leg and of a joint along each axis, by the map in numpy."""
    m, rng = robots.regular(14)
    legs, joints = rng.uniform(1e-5, 1e-4, size=9), rng.uniform(1e-5, 1e-4, size=12)
    g, c = m.geometry(), m.configuration()
    normal = nd.error_bounds(g, c, legs, joints, distribution="normal")
    variances = legs**2 / 9.0
    np.add.at(variances, LEG_OF_JOINT, joints**2 / 9.0)
    assert_allclose(normal.covariance, inverse(m) @ np.diag(variances) @ inverse(m).T, rtol=1e-8, atol=1e-22)
    uniform = nd.error_bounds(g, c, legs, joints)
    assert_array_equal(normal.components, uniform.components)
    assert normal.position == uniform.position
    assert (normal.covariance.diagonal() < uniform.covariance.diagonal()).all()


def test_no_error_no_motion(published, neutral):
    assert np.abs(nd.error_samples(published, neutral, samples=5)).max() < 1e-14
    assert nd.error_samples(published, neutral, 1e-3, samples=0).shape == (0, 9)


COUNT = sizes.size(9_000, 25_000)


def test_same_bits_for_any_threads_and_run_length(published, neutral):
    one = nd.error_samples(published, neutral, 1e-3, 1e-3, samples=COUNT, seed=7, threads=1)
    for threads in (2, 3, 8, None):
        result = nd.error_samples(published, neutral, 1e-3, 1e-3, samples=COUNT, seed=7, threads=threads)
        assert_array_equal(result, one)
    assert_array_equal(nd.error_samples(published, neutral, 1e-3, 1e-3, samples=10, seed=7), one[:10])
    assert len(np.unique(one[:, 0])) == COUNT
    other = nd.error_samples(published, neutral, 1e-3, 1e-3, samples=COUNT, seed=8)
    assert not np.intersect1d(one[:, 0], other[:, 0]).size


def test_samples_do_not_depend_on_the_distance_from_the_origin():
    m, _ = robots.regular(19)
    shift = np.array([1e5, -2e5, 3e5])
    far = m._replace(r=m.r + shift, rh=m.rh + shift, p=m.p + shift, s=m.s + shift)
    assert_allclose(samples(far, 1e-2, 1e-2, samples=200), samples(m, 1e-2, 1e-2, samples=200), atol=1e-7)


def test_large_errors_give_nan(published, neutral):
    """Some robots cannot be assembled; the others have their lengths, with O on the side of the start."""
    rest = nd.leg_lengths(published, neutral)
    result = nd.error_samples(published, neutral, 0.25 * rest, samples=2000)
    stands = np.isfinite(result).all(axis=1)
    assert_array_equal(np.isnan(result).all(axis=1), ~stands)
    assert 0.2 < stands.mean() < 0.8
    c = neutral.moved(result[stands])
    off = nd.leg_lengths(published, c) - rest
    assert (np.abs(off) <= 0.25 * rest * (1.0 + 1e-12)).all()
    assert (c.internal_point[:, 2] > 0.0).all()
    assert (np.einsum("ni,ni->n", c.position - c.internal_point, c.rotation[:, :, 2]) > 0.0).all()


def test_collinear_joints_give_nan():
    """Errors that may make the geometry invalid raise no exception; robots that exist have their lengths."""
    g = nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0)
    result = nd.error_samples(g, nd.Configuration.neutral(4.0, 2.2), joint_errors=5.0, samples=500)
    assert np.isnan(result).any()
