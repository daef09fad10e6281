"""Positions and velocities: the Jacobian by its definition.

Convention, written once: a twist (omega, pdot, sdot) in the base frame perturbs a configuration as
p + h pdot, exp(h omega) Q, s + h sdot. The oracle of this file is that definition, carried out with scipy rotations on
leg lengths only: it knows no leg direction, no cross product and no matrix of eqs. (30)-(36).
"""

import numpy as np
import numpy_model as model
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from robots import regular
from scipy.spatial.transform import Rotation

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)


def moved(c, omega, pdot, sdot, h):
    turn = Rotation.from_rotvec(h * np.asarray(omega)).as_matrix()
    return nd.Configuration(
        c.position + h * np.asarray(pdot), turn @ c.rotation, c.internal_point + h * np.asarray(sdot)
    )


def rates_by_differences(g, c, omega, pdot, sdot, h=2e-3):
    """Central differences of leg lengths with three steps, Richardson-extrapolated to order h^6."""
    d1, d2, d3 = (
        (nd.leg_lengths(g, moved(c, omega, pdot, sdot, k * h)) - nd.leg_lengths(g, moved(c, omega, pdot, sdot, -k * h)))
        / (2 * k * h)
        for k in (1, 2, 3)
    )
    return 1.5 * d1 - 0.6 * d2 + 0.1 * d3


def regime(name, rng):
    """Configuration by regime: neutral; 1e-9 away from it, where series and closed forms change over; random."""
    c = nd.Configuration.neutral(3.9828, 2.3745)
    if name == "neutral":
        return c
    if name == "tiny":
        return moved(c, *rng.normal(size=(3, 3)), 1e-9)
    return model.random_robots(rng, 1).at(0).configuration()


REGIMES = pytest.mark.parametrize("name", ["neutral", "tiny", "random"])


@REGIMES
@pytest.mark.parametrize("seed", range(5))
def test_inverse_velocity_is_the_derivative_of_leg_lengths(published, name, seed):
    rng = np.random.default_rng(seed)
    c = regime(name, rng)
    motion = rng.normal(size=(3, 3))
    assert_allclose(nd.inverse_velocity(published, c, *motion), rates_by_differences(published, c, *motion), atol=2e-11)


@REGIMES
@pytest.mark.parametrize("lc", [1.0, 0.3])
def test_jacobian_takes_differences_of_leg_lengths_to_the_twist(published, name, lc):
    rng = np.random.default_rng(7)
    c = regime(name, rng)
    J = nd.jacobian(published, c, lc)
    for _ in range(5):
        omega, pdot, sdot = rng.normal(size=(3, 3))
        udot = rates_by_differences(published, c, omega, pdot, sdot)
        assert_allclose(J @ udot, [*(lc * omega), *pdot], atol=2e-11 * np.abs(J).sum(axis=1).max())


@given(SEEDS)
def test_moving_the_internal_point_alone_moves_no_platform(seed):
    """The three-parameter redundancy: ldot = 0, qdot = C sdot, rdot = B sdot is a null motion of J'."""
    m, rng = regular(seed)
    _, B, C, _ = model.matrices(m)
    sdot = rng.normal(size=3)
    rates = np.concatenate([np.zeros(3), C @ sdot, B @ sdot])
    omega, pdot, outcome = nd.forward_velocity(m.geometry(), m.configuration(), rates)
    lost = 1e-13 * model.condition_number(m) * np.linalg.cond(B)
    assert_allclose([omega, pdot, outcome], [np.zeros(3), np.zeros(3), sdot], atol=lost)
    assert_allclose(
        nd.inverse_velocity(m.geometry(), m.configuration(), np.zeros(3), np.zeros(3), sdot), rates, atol=1e-14
    )


def test_leg_lengths_of_a_robot_that_can_be_checked_by_hand():
    """3-4-5 and 8-15-17 triangles; legs of different length, so that a wrong order is detected."""
    g = nd.Geometry(
        base_external=[[3, 0, 0], [0, 8, 0], [-5, 0, 0]],
        base_internal=[[4, 0, 0], [0, 15, 0], [0, -6, 0]],
        platform_external=[[0, 0, 4], [0, 0, 15], [0, 1, 12]],
        platform_internal=[[0, 3, 8], [8, 0, 15], [0, 5, 20]],
    )
    c = nd.Configuration([0.0, 0.0, 0.0], np.eye(3), [0.0, 0.0, 8.0])
    expected = [5, 17, np.sqrt(170), 3, np.hypot(8, 7), 13, np.hypot(4, 8), 17, 10]
    assert_allclose(nd.leg_lengths(g, c), expected, rtol=1e-15)


def test_stack_equals_one_by_one(published, stack):
    rng = np.random.default_rng(3)
    rates, motion = rng.normal(size=(5, 9)), rng.normal(size=(3, 5, 3))
    singles = list(stack)
    for function in (nd.leg_lengths, nd.jacobian):
        assert_array_equal(function(published, stack), [function(published, c) for c in singles])
    for name, part in nd.velocity_matrices(published, stack)._asdict().items():
        assert_array_equal(part, [getattr(nd.velocity_matrices(published, c), name) for c in singles])
    forward = [nd.forward_velocity(published, c, r) for c, r in zip(singles, rates, strict=True)]
    assert_array_equal(np.stack(nd.forward_velocity(published, stack, rates), axis=1), forward)
    inverse = [nd.inverse_velocity(published, c, *motion[:, k]) for k, c in enumerate(singles)]
    assert_array_equal(nd.inverse_velocity(published, stack, *motion), inverse)


def test_velocities_broadcast_against_the_configuration(published, stack, neutral):
    omega, pdot, sdot = nd.forward_velocity(published, stack, np.ones((4, 1, 9)))
    assert omega.shape == pdot.shape == sdot.shape == (4, 5, 3)
    assert nd.inverse_velocity(published, neutral, np.ones((2, 1, 3)), [0, 0, 1], np.zeros((6, 3))).shape == (2, 6, 9)
    empty = stack[:0]
    assert nd.leg_lengths(published, empty).shape == (0, 9)
    assert nd.jacobian(published, empty).shape == (0, 6, 9)
    assert nd.velocity_matrices(published, empty).G.shape == (0, 6, 9)
    assert nd.forward_velocity(published, empty, np.zeros(9))[0].shape == (0, 3)


def test_missing_pose_stays_alone(published):
    c = nd.Configuration([[0, 0, 4], [np.nan, 0, 4], [0, 0, 4]], np.eye(3), [0, 0, 2.0])
    results = [
        nd.leg_lengths(published, c),
        nd.jacobian(published, c),
        nd.forward_velocity(published, c, np.ones(9))[0],
    ]
    for result in results:
        assert np.isfinite(result[[0, 2]]).all()
        assert np.isnan(result[1]).any()
