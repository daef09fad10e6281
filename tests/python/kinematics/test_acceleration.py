"""Accelerations and the derivative of J' by their definition: leg lengths along a curved motion.

The oracle moves the robot in time with scipy rotations and measures it with numpy_model: distances between joints, and
J' by a general inverse. It knows no acceleration of a joint and no derivative of a direction.
"""

import numpy as np
import numpy_model as model
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from robots import regular
from scipy.spatial.transform import Rotation

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)
FLAT = nd.Geometry.hexagonal(0.4, 3.0, 2.0, 0.3)


def at_time(m, motion, t):
    """The model at p + t pdot + t^2 pddot / 2 and so on; exp(t omega + t^2 alpha / 2) Q has these derivatives."""
    omega, pdot, sdot, alpha, pddot, sddot = motion
    turn = Rotation.from_rotvec(t * omega + 0.5 * t**2 * alpha).as_matrix()
    return m._replace(p=m.p + t * pdot + 0.5 * t**2 * pddot, Q=turn @ m.Q, s=m.s + t * sdot + 0.5 * t**2 * sddot)


def second_derivative(function, h):
    """Central differences of the sixth order."""
    pair = [function(k * h) + function(-k * h) for k in (1, 2, 3)]
    return (270 * pair[0] - 27 * pair[1] + 2 * pair[2] - 490 * function(0.0)) / (180 * h**2)


@given(SEEDS)
def test_inverse_acceleration_is_the_second_derivative_of_leg_lengths(seed):
    m, rng = regular(seed)
    motion = 0.5 * rng.normal(size=(6, 3))
    outcome = nd.inverse_acceleration(m.geometry(), m.configuration(), *motion)
    scale = 1.0 / model.lengths(m).min() ** 7  # the error of the differences: by the eighth derivative of a short leg
    expected = second_derivative(lambda t: model.lengths(at_time(m, motion, t)), 1e-2)
    assert_allclose(outcome, expected, rtol=0.0, atol=1e-8 * max(1.0, scale))


def test_a_circle_at_constant_speed():
    """The platform rotates about its axis, O at rest on it: only the external legs accelerate (by hand)."""
    g, c, w = nd.Geometry.hexagonal(0.0, 3.0, 2.0, 0.0), nd.Configuration.neutral(2.0, 1.0, 0.3), 1.7
    zero = np.zeros(3)
    outcome = nd.inverse_acceleration(g, c, [0, 0, w], zero, zero, zero, zero, zero)
    # l^2 = R^2 + U^2 - 2 R U cos(phi + w t) + h^2
    r, u = g.base_external[0], g.platform_external[0]
    R, U = np.hypot(*r[:2]), np.hypot(*u[:2])
    phi = np.arctan2(u[1], u[0]) + 0.3 - np.arctan2(r[1], r[0])
    length = np.sqrt(R**2 + U**2 - 2 * R * U * np.cos(phi) + 4.0)
    rate = R * U * np.sin(phi) * w / length
    assert_allclose(outcome[:3], (R * U * np.cos(phi) * w**2 - rate**2) / length, rtol=1e-14)
    assert_allclose(outcome[3:], 0.0, atol=1e-15)


def test_stack_equals_one_by_one(published, stack):
    rng = np.random.default_rng(3)
    rates, accelerations = rng.normal(size=(2, 5, 9))
    motion, lc = rng.normal(size=(6, 5, 3)), rng.uniform(0.5, 2.0, size=5)
    singles = list(stack)
    forward = [nd.forward_acceleration(published, *row) for row in zip(singles, rates, accelerations, strict=True)]
    assert_array_equal(np.stack(nd.forward_acceleration(published, stack, rates, accelerations), axis=1), forward)
    inverse = [nd.inverse_acceleration(published, c, *motion[:, k]) for k, c in enumerate(singles)]
    assert_array_equal(nd.inverse_acceleration(published, stack, *motion), inverse)
    rate = [nd.jacobian_rate(published, c, *motion[:3, k], lc[k]) for k, c in enumerate(singles)]
    assert_array_equal(nd.jacobian_rate(published, stack, *motion[:3], lc), rate)


def test_a_large_stack_holds_the_bits_of_its_rows():
    """More than one block of work, on any number of threads."""
    rng = np.random.default_rng(9)
    c = model.random_robots(rng, 3000).configuration()
    motion = rng.normal(size=(6, 3000, 3))
    accelerations = nd.inverse_acceleration(FLAT, c, *motion)
    rate = nd.jacobian_rate(FLAT, c, *motion[:3])
    for k in range(0, 3000, 250):
        assert_array_equal(accelerations[k], nd.inverse_acceleration(FLAT, c[k], *motion[:, k]))
        assert_array_equal(rate[k], nd.jacobian_rate(FLAT, c[k], *motion[:3, k]))


def test_broadcasting(published, stack, neutral):
    alpha, pddot, sddot = nd.forward_acceleration(published, stack, np.ones((4, 1, 9)), np.ones(9))
    assert alpha.shape == pddot.shape == sddot.shape == (4, 5, 3)
    v = [np.ones((2, 1, 3)), [0, 0, 1], np.zeros((6, 3))]
    assert nd.inverse_acceleration(published, neutral, *v, *v).shape == (2, 6, 9)
    lc = np.array([0.5, 1.0, 2.0, 3.0, 0.1])
    rate = nd.jacobian_rate(published, stack, np.ones((2, 1, 3)), [0, 0, 1], [1, 0, 0], lc)
    assert rate.shape == (2, 5, 6, 9)
    assert_array_equal(rate[1], nd.jacobian_rate(published, stack, np.ones(3), [0, 0, 1], [1, 0, 0], lc))
    assert nd.jacobian_rate(published, stack[:0], *np.eye(3)).shape == (0, 6, 9)
    assert nd.forward_acceleration(published, stack[:0], np.ones(9), np.ones(9))[0].shape == (0, 3)


def test_a_length_by_its_kind_is_constant(published, neutral):
    """The derivative of J' is taken with the length of this configuration, which is constant along the motion."""
    motion, lc = np.eye(3), nd.characteristic_length(published, neutral, "natural")
    outcome = nd.jacobian_rate(published, neutral, *motion, "natural")
    assert_array_equal(outcome, nd.jacobian_rate(published, neutral, *motion, lc))


def test_missing_pose_stays_alone(published):
    c = nd.Configuration([[0, 0, 4], [np.nan, 0, 4], [0, 0, 4]], np.eye(3), [0, 0, 2.0])
    e = np.eye(3)
    for result in (
        nd.inverse_acceleration(published, c, *e, *e)[..., :6],
        nd.jacobian_rate(published, c, *e),
        nd.forward_acceleration(published, c, np.ones(9), np.ones(9))[0],
    ):
        assert np.isfinite(result[[0, 2]]).all()
        assert np.isnan(result[1]).all()
