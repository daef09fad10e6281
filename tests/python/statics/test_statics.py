"""Leg forces, self-stress and stiffness.

Oracles: a spring energy minimised over the place of O by scipy on leg
lengths alone; numpy's least squares on a matrix built elsewhere."""

import numpy as np
import numpy_model as model
import pytest
import robots
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.linalg import null_space, subspace_angles
from scipy.optimize import least_squares

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)


def forces(m, load):
    return nd.leg_forces(m.geometry(), m.configuration(), load[:3], load[3:6], load[6:])


def stiffness(m, k, **options):
    return nd.stiffness(m.geometry(), m.configuration(), k, **options)


# --- Singular configurations ------------------------------------------------------------------------------------------


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
