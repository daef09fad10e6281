"""Velocity and force ellipsoids (Fig. 4).

Oracles: numpy's SVD of a J' assembled and inverted by LAPACK; sampled leg rates; at singular
configurations, where there is no J', numpy's null space and the limit from configurations nearby."""

import numpy as np
import numpy_model as model
import pytest
import robots
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)
KINDS = pytest.mark.parametrize("kind", robots.SINGULAR)
PARTS = {"rotation": slice(0, 3), "translation": slice(3, 6), "twist": slice(0, 6)}
EACH_PART = pytest.mark.parametrize("part", PARTS)


def velocity(m, part, lc=1.0):
    return nd.velocity_ellipsoid(m.geometry(), m.configuration(), part, lc)


@EACH_PART
def test_forces_are_fast_where_velocities_are_slow(part, published, stack):
    fast, strong = nd.velocity_ellipsoid(published, stack, part), nd.force_ellipsoid(published, stack, part)
    assert_allclose(strong.semi_axes, 1.0 / fast.semi_axes[:, ::-1], rtol=1e-15)
    assert_array_equal(strong.directions, fast.directions[:, :, ::-1])


# --- Values -----------------------------------------------------------------------------------------------------------


@given(SEEDS)
def test_axes_are_orthonormal_with_a_sign_of_their_own(seed):
    m, _ = robots.regular(seed)
    for part, n in (("rotation", 3), ("translation", 3), ("twist", 6)):
        V = velocity(m, part).directions
        assert_allclose(V.T @ V, np.eye(n), atol=1e-14)
        assert (np.take_along_axis(V, np.abs(V).argmax(axis=0)[None], axis=0) > 0.0).all()


# --- Singular configurations ------------------------------------------------------------------------------------------


@KINDS
@EACH_PART
def test_the_other_axes_are_those_of_configurations_nearby(kind, part):
    rng = np.random.default_rng(9)
    for m in robots.singular_robots(kind)[:10]:
        result = velocity(m, part).semi_axes[1:]
        near = m._replace(s=m.s + 1e-6 * rng.normal(size=3))
        assert_allclose(np.linalg.svd(model.jacobian(near)[PARTS[part]], compute_uv=False)[1:], result, rtol=1e-2)


def test_a_free_rotation_about_the_origin_of_the_platform():
    """O at p on the line of an external leg: a rotation is free that does not move p, so no translation is."""
    m = robots.flat("leg through O")
    # The same robot in platform axes whose origin is at O.
    shift = m.Q.T @ (m.s - m.p)
    m = m._replace(u=m.u - shift, ut=m.ut - shift, p=m.s)
    assert np.isinf(velocity(m, "rotation").semi_axes[0])
    result = velocity(m, "translation")
    # B and C tell what the internal legs need. Leg 1 feels p whatever the platform turns; turning keeps 2 and 3 still.
    _, B, C, _ = model.matrices(m)
    of_o = np.hstack([np.linalg.inv(C), np.linalg.inv(B)])
    e = model.legs(m)[0][0] / model.lengths(m)[0]
    stretch = np.linalg.eigvalsh(np.linalg.inv(of_o @ of_o.T) + np.outer(e, e))
    assert_allclose(result.semi_axes, 1.0 / np.sqrt(stretch), rtol=1e-12)
    # Nearby all three can be kept still: the ellipsoid is not continuous here, and this is the smaller one.
    near = model.jacobian(m._replace(s=m.s + np.array([1e-6, 2e-6, -1e-6])))[3:]
    assert (result.semi_axes < 0.96 * np.linalg.svd(near, compute_uv=False)).any()


def test_all_internal_legs_in_a_plane():
    """Three motions out of the plane are free; the rest agrees with numpy's projection of the leg rates."""
    g = nd.Geometry.hexagonal(a1=0.5, a2=4.0, b1=2.5, b2=0.25)
    m = model.robot(g, nd.Configuration([0.25, 0.125, 0.0], np.eye(3), [0.5, -0.25, 0.0]))
    h = robots.rates(m)
    of_o = h[:, 6:]
    least = (np.eye(9) - of_o @ np.linalg.pinv(of_o, rcond=1e-13)) @ h[:, :6]
    expected = np.linalg.svd(least, compute_uv=False)
    result = velocity(m, "twist").semi_axes
    assert np.isinf(result[:3]).all()
    assert_allclose(1.0 / result[3:], expected[2::-1], rtol=1e-13)


def test_leg_of_zero_length_and_similar_hexagons(published):
    c = nd.Configuration([0, 0, 4.0], np.eye(3), published.base_internal[1])
    assert np.isinf(nd.velocity_ellipsoid(published, c).semi_axes[0])
    turning = nd.velocity_ellipsoid(
        nd.Geometry.hexagonal(1.0, 4.0, 0.5, 2.0), nd.Configuration.neutral(3.0, 1.5), "rotation"
    )
    assert np.isinf(turning.semi_axes[0])
    assert_allclose(turning.directions[:, 0], [0.0, 0.0, 1.0], atol=1e-12)
