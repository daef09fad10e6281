"""Configurations of infinite condition number: the three mechanisms of loss, on and off the symmetry axis.

Oracle: geometry alone. Each singular pose is built from what makes it so (theory of position and velocity, section 5),
not from a determinant.
"""

import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import ninedof as nd


def assert_singular(g, c):
    assert nd.condition_number(g, c) == np.inf
    assert nd.condition_number(g, c, norm="frobenius") == np.inf
    assert nd.manipulability(g, c) == np.inf
    assert nd.isotropy_residual(g, c) == np.inf
    sigma = nd.singular_values(g, c)
    assert sigma[0] == np.inf
    assert np.isfinite(sigma[5])


def test_internal_point_in_the_base_plane(published):
    assert_singular(published, nd.Configuration.neutral(3.0, 0.0))
    assert_singular(
        published, nd.Configuration([0.3, -0.2, 3.0], Rotation.from_rotvec([0.2, 0.1, 0.3]), [0.4, 0.7, 0.0])
    )


def test_internal_point_in_the_platform_plane(published):
    assert_singular(published, nd.Configuration.neutral(3.0, 3.0))
    turn = Rotation.from_rotvec([0.2, 0.1, 0.3])
    p = np.array([0.3, -0.2, 3.0])
    assert_singular(published, nd.Configuration(p, turn, p + turn.apply([0.4, -0.3, 0.0])))


@pytest.mark.parametrize(("a1", "a2"), [(1.0, 2.0), (0.3, 0.7), (1.0, 1.0), (2.2, 5.1), (0.0, 3.0), (4.0, 0.0)])
@pytest.mark.parametrize("ratio", [0.1, 1.0 / 3.0, 0.5, 1.0, 1.7])
def test_similar_hexagons_in_the_neutral_pose(a1, a2, ratio):
    g = nd.Geometry.hexagonal(a1, a2, ratio * a1, ratio * a2)
    for zp, zs in ((3.0, 1.0), (0.3, 0.1), (2.2, 1.7)):
        assert_singular(g, nd.Configuration.neutral(zp, zs))


def test_three_leg_planes_with_a_common_line():
    """det N = 0 away from symmetry: the planes (O, A_i, B_i) meet in one line through O."""
    rng = np.random.default_rng(5)
    for _ in range(20):
        m = model.random_robots(rng, 1).at(0)
        line = rng.normal(size=3)
        mix = rng.normal(size=(3, 2))
        platform = m.p + m.u @ m.Q.T
        base = m.s + mix[:, :1] * (platform - m.s) + mix[:, 1:] * line
        kappa = nd.condition_number(nd.Geometry(base, m.rh, m.u, m.ut), m.configuration())
        assert kappa > 1e13  # singular to rounding of the joints, not exactly


def test_approach_to_a_singularity_grows_like_one_over_the_distance(published):
    h = np.array([1e-3, 1e-5, 1e-7, 1e-9, 1e-11])
    product = nd.condition_number(published, nd.Configuration.neutral(3.0, h)) * h
    assert_allclose(product, product[0], rtol=1e-2)
