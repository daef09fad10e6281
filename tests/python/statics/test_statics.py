"""Leg forces, self-stress and stiffness.

Oracles: finite differences of leg lengths (virtual work); a spring energy minimised over the place of O by scipy on leg
lengths alone; numpy's least squares on a matrix built elsewhere."""

import numpy as np
import numpy_model as model
import pytest
import robots
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.linalg import null_space, subspace_angles
from scipy.optimize import least_squares

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)
KINDS = pytest.mark.parametrize("kind", robots.SINGULAR)


def forces(m, load):
    return nd.leg_forces(m.geometry(), m.configuration(), load[:3], load[3:6], load[6:])


def stiffness(m, k, **options):
    return nd.stiffness(m.geometry(), m.configuration(), k, **options)


# --- Leg forces -------------------------------------------------------------------------------------------------------


def lost(m):
    return 1e-14 * np.linalg.cond(robots.rates(m))


@given(SEEDS)
def test_virtual_work(seed):
    """In every small motion the work of the legs and of the load sum to zero; central differences of leg lengths."""
    m, rng = robots.regular(seed)
    load, motion = rng.normal(size=(2, 9))
    c, h = m.configuration(), 1e-3
    d1, d2 = (nd.leg_lengths(m.geometry(), c.moved(k * h * motion)) for k in (1, 2))
    e1, e2 = (nd.leg_lengths(m.geometry(), c.moved(-k * h * motion)) for k in (1, 2))
    rates = (8.0 * (d1 - e1) - (d2 - e2)) / (12.0 * h)
    result = forces(m, load).forces
    shortest = model.lengths(m).min()
    assert result @ rates + load @ motion == pytest.approx(
        0.0, abs=1e-9 * np.abs(result).sum() / min(shortest, 1.0) ** 4
    )


def test_a_weight_on_the_platform_is_pushed_up(published, neutral):
    """By hand: without a moment about O the external legs carry nothing, and the six others share the weight evenly."""
    result, _ = nd.leg_forces(published, neutral, [0, 0, 0], [0, 0, -12.0])
    lengths = nd.leg_lengths(published, neutral)
    assert_allclose(result[:3], 0.0, atol=1e-14)
    assert_allclose(result[3:6], 4.0 * lengths[3:6] / (3.9828 - 2.3745), rtol=1e-14)
    assert_allclose(result[6:], 4.0 * lengths[6:] / 2.3745, rtol=1e-14)
    assert (result[3:] > 0.0).all()
    only_at_o, _ = nd.leg_forces(published, neutral, [0, 0, 0], [0, 0, 0], [0, 0, -12.0])
    assert_allclose(only_at_o[:6], 0.0, atol=1e-14)
    assert_allclose(only_at_o[6:], result[6:], rtol=1e-14)


def test_forces_broadcast_and_rows_are_independent(published, stack):
    rng = np.random.default_rng(1)
    moment, force, at_o = rng.normal(size=(4, 1, 3)), rng.normal(size=(5, 3)), rng.normal(size=3)
    result, unbalanced = nd.leg_forces(published, stack, moment, force, at_o)
    assert result.shape == unbalanced.shape == (4, 5, 9)
    for i in range(4):
        for k in range(5):
            assert_array_equal(result[i, k], nd.leg_forces(published, stack[k], moment[i, 0], force[k], at_o).forces)
    assert nd.leg_forces(published, stack[:0], [0, 0, 0], [0, 0, 1]).forces.shape == (0, 9)


def test_a_missing_row_stays_alone(published):
    c = nd.Configuration([[0, 0, 4], [np.nan, 0, 4], [0, 0, 4], [0, 0, 4]], np.eye(3), [0, 0, 2.0])
    force = np.array([[0, 0, -1], [0, 0, -1], [0, np.nan, -1], [0, 0, -1.0]])
    result, unbalanced = nd.leg_forces(published, c, [0, 0, 0], force)
    for rows in (result, unbalanced):
        assert np.isnan(rows[1:3]).all()
        assert np.isfinite(rows[[0, 3]]).all()
    K = nd.stiffness(published, c, np.array([[1.0], [1.0], [np.nan], [1.0]]) * np.ones(9))
    assert np.isnan(K[1:3]).all()
    assert np.isfinite(K[[0, 3]]).all()
    assert np.isnan(nd.self_stress(published, c[1])).all()


# --- Singular configurations ------------------------------------------------------------------------------------------


@KINDS
def test_singular_load_that_legs_can_carry_leaves_nothing(kind):
    rng = np.random.default_rng(6)
    for m in robots.singular_robots(kind):
        pushed = rng.normal(size=9)
        load = -robots.rates(m).T @ pushed
        result, unbalanced = forces(m, load)
        assert_array_equal(unbalanced, np.zeros(9))
        stress = nd.self_stress(m.geometry(), m.configuration())
        assert_allclose(result, pushed - stress @ (stress.T @ pushed), atol=1e-9 * np.abs(result).max())


def test_several_free_motions():
    """Similar hexagons after a half turn: the external legs meet in O, about which the platform rotates freely."""
    g = nd.Geometry.hexagonal(a1=1.0, a2=4.0, b1=0.5, b2=2.0)
    for c, count in ((nd.Configuration.neutral(3.0, 2.0, np.pi), 3), (nd.Configuration.neutral(0.0, 0.0, 0.1), 4)):
        expected = null_space(robots.rates(model.robot(g, c)).T, rcond=1e-13)
        result = nd.self_stress(g, c)
        assert result.shape == expected.shape == (9, count)
        assert_allclose(subspace_angles(result, expected), 0.0, atol=1e-12)
        assert_allclose(result.T @ result, np.eye(count), atol=1e-14)
        _, unbalanced = nd.leg_forces(g, c, [0.0, 0.0, 1.0], [0.3, 0.2, 0.1])
        assert np.abs(unbalanced).max() > 0.1


def test_forces_grow_towards_a_singularity(published):
    """O one tenth as high above the base, ten times the force in the legs that carry the weight."""
    heights = 10.0 ** -np.arange(1.0, 10.0)
    result, unbalanced = nd.leg_forces(published, nd.Configuration.neutral(4.0, heights), [0, 0, 0], [0, 0, -1.0])
    assert_allclose(result[:, 6] * heights, np.hypot(heights, 5.8124 / np.sqrt(3.0)) / 3.0, rtol=1e-7)
    assert_array_equal(unbalanced, 0.0)


# --- Stiffness --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(12))
def test_stiffness_is_the_least_spring_energy(seed):
    """Springs between joints, O free: the energy, minimised over s on lengths alone, rises as t K t / 2."""
    m, rng = robots.regular(seed)
    g, c, k = m.geometry(), m.configuration(), rng.uniform(0.5, 2.0, size=9)
    rest = nd.leg_lengths(g, c)
    h = 1e-4 * min(1.0, rest.min())
    t = rng.normal(size=6)

    def least(motion):
        def strain(s):
            return np.sqrt(k) * (nd.leg_lengths(g, c.moved(h * np.concatenate([motion, s]))) - rest) / h

        return least_squares(strain, np.zeros(3), method="lm").cost

    # Odd orders cancel between t and -t.
    assert 0.5 * (least(t) + least(-t)) == pytest.approx(0.5 * t @ stiffness(m, k) @ t, rel=1e-5)


@given(SEEDS)
def test_deflection_under_load_gives_the_leg_forces(seed):
    """For any springs: legs pressed by x = K9^-1 load push with -k H x, which is what balances the load."""
    m, rng = robots.regular(seed)
    k, load = rng.uniform(0.1, 10.0, size=9), rng.normal(size=9)
    K9 = stiffness(m, k, internal=True)
    pushed = -k * (robots.rates(m) @ np.linalg.solve(K9, load))
    assert_allclose(pushed, forces(m, load).forces, atol=1e-14 * np.linalg.cond(K9) * np.abs(pushed).max())


def test_pseudo_inverse_is_no_substitute():
    """J^+T diag(k) J^+ agrees for equal springs and is too stiff otherwise, as the documentation says."""
    m, rng = robots.regular(3)
    inverse = np.linalg.pinv(model.jacobian(m))
    assert_allclose(stiffness(m, 2.5), 2.5 * inverse.T @ inverse, atol=1e-11)
    k = rng.uniform(0.1, 10.0, size=9)
    excess = np.linalg.eigvalsh(inverse.T @ (k[:, None] * inverse) - stiffness(m, k))
    assert excess.min() > -1e-11
    assert excess.max() > 0.1


def test_all_internal_legs_in_a_plane():
    """O itself is loose there; the platform is held within the plane and not against leaving it."""
    g = nd.Geometry.hexagonal(a1=0.5, a2=4.0, b1=2.5, b2=0.25)
    m = model.robot(g, nd.Configuration([0.25, 0.125, 0.0], np.eye(3), [0.5, -0.25, 0.0]))
    k = np.arange(1.0, 10.0)
    K9 = robots.rates(m).T @ (k[:, None] * robots.rates(m))
    schur = K9[:6, :6] - K9[:6, 6:] @ np.linalg.pinv(K9[6:, 6:], rcond=1e-13) @ K9[6:, :6]
    assert_allclose(stiffness(m, k), schur, atol=1e-13 * np.abs(K9).max())
    assert np.linalg.matrix_rank(schur, tol=1e-12) == 3


def test_stiffness_of_a_stack(published, stack):
    k = np.random.default_rng(2).uniform(1.0, 2.0, size=(3, 1, 9))
    K = nd.stiffness(published, stack, k)
    assert K.shape == (3, 5, 6, 6)
    assert nd.stiffness(published, stack, 1.0, internal=True).shape == (5, 9, 9)
    for i in range(3):
        for n in range(5):
            assert_array_equal(K[i, n], nd.stiffness(published, stack[n], k[i, 0]))
