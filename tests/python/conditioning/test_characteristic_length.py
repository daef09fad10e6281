"""The characteristic length computed from the robot.

Oracles: the definition of each kind, evaluated on numpy's J'; for the optimal one a scan that knows nothing of slopes.
"""

import numpy as np
import numpy_model as model
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

import ninedof as nd

KINDS = ("mean_leg", "platform_radius", "natural", "optimal")
SEEDS = st.integers(0, 2**32 - 1)


def random_robot(seed):
    return model.random_robots(np.random.default_rng(seed), 1).at(0)


def length(m, kind):
    return nd.characteristic_length(m.geometry(), m.configuration(), kind)


@given(SEEDS)
def test_mean_leg_and_platform_radius(seed):
    m = random_robot(seed)
    assert_allclose(length(m, "mean_leg"), model.lengths(m).mean(), rtol=1e-14)
    assert_allclose(length(m, "platform_radius"), np.linalg.norm([*m.u, *m.ut], axis=1).max(), rtol=1e-14)


@given(SEEDS)
def test_natural_makes_rotation_and_translation_weigh_the_same(seed):
    """M^T M = (J' J'^T)^-1: at the natural length its two diagonal blocks have the same trace."""
    m = random_robot(seed)
    J = model.jacobian(m, length(m, "natural"))
    weight = np.diag(np.linalg.inv(J @ J.T))
    assert_allclose(weight[:3].sum(), weight[3:].sum(), rtol=1e-13 * model.condition_number(m) ** 2)


@given(SEEDS)
def test_optimal_is_not_beaten_by_any_length_of_a_scan(seed):
    m = random_robot(seed)
    best = length(m, "optimal")
    kappa = model.condition_number(m, best)
    copies = model.Robot(*(np.broadcast_to(a, (401, *a.shape)) for a in m))
    for spread in (5.0, 1e-1, 1e-3, 1e-5):
        scan = best * np.exp(np.linspace(-spread, spread, 401))
        others = model.condition_number(copies, scan[:, None, None])
        assert kappa <= others.min() * (1.0 + 1e-9)
    assert kappa <= min(model.condition_number(m, length(m, kind)) for kind in KINDS) * (1.0 + 1e-9)


@given(SEEDS, st.sampled_from(KINDS), st.floats(1e-6, 1e6))
def test_lengths_scale_with_the_robot(seed, kind, unit):
    m = random_robot(seed)
    other = model.Robot(*(x if name == "Q" else x * unit for name, x in m._asdict().items()))
    # The optimum is flat or kinked: where it is flat its position is accurate to the square root of rounding.
    assert_allclose(length(other, kind), unit * length(m, kind), rtol=1e-5 if kind == "optimal" else 1e-10)
    assert_allclose(
        nd.condition_number(other.geometry(), other.configuration(), kind),
        nd.condition_number(m.geometry(), m.configuration(), kind),
        rtol=1e-9,
    )


def test_octahedral_design_by_hand():
    """docs/theory/conditioning.md: lc = b1 / 3 is both optimal and natural."""
    side = np.sqrt(2.0)
    g = nd.Geometry.hexagonal(a1=0.0, a2=side, b1=side, b2=0.0)
    c = nd.Configuration.neutral(zp=2.0 / np.sqrt(3.0), zs=1.0 / np.sqrt(3.0))
    assert nd.condition_number(g, c, "optimal") <= 3.0 * np.sqrt(2.0) * (1.0 + 1e-14)


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_in_place_of_a_number(published, stack, kind):
    lengths = nd.characteristic_length(published, stack, kind)
    assert lengths.shape == (5,)
    for function in (nd.condition_number, nd.singular_values, nd.jacobian, nd.axis_singular_values, nd.manipulability):
        assert_array_equal(function(published, stack, kind), function(published, stack, lengths))
    assert nd.characteristic_length(published, stack[:0], kind).shape == (0,)
    assert isinstance(nd.characteristic_length(published, stack[0], kind), float)


def test_optimal_is_the_default(published, neutral):
    assert nd.characteristic_length(published, neutral) == nd.characteristic_length(published, neutral, "optimal")


def test_no_length_helps_a_singular_pose(published):
    c = nd.Configuration.neutral(4.0, [0.0, 2.0])
    for kind in ("natural", "optimal"):
        assert_array_equal(np.isnan(nd.characteristic_length(published, c, kind)), [True, False])
    for kind in ("mean_leg", "platform_radius"):
        assert np.isfinite(nd.characteristic_length(published, c, kind)).all()


@pytest.mark.parametrize("kind", KINDS)
def test_singular_and_missing_poses_do_not_spoil_a_stack(published, kind):
    """A kind in one call for a stack: the singular pose is infinite, the missing one NaN, the others are unchanged."""
    good = nd.Configuration.neutral(4.0, [0.0, 2.0, 2.5])
    p = np.array(good.position)
    p[2, 0] = np.nan
    result = nd.condition_number(published, nd.Configuration(p, good.rotation, good.internal_point), kind)
    assert result[0] == np.inf
    assert result[1] == nd.condition_number(published, good[1], kind)
    assert np.isnan(result[2])
