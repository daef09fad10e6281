"""The characteristic length computed from the robot.

Oracles: the definition of each kind, evaluated on numpy's J'; for the optimal one a scan that knows nothing of slopes.
"""

import numpy as np
import numpy_model as model
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

import ninedof as nd

KINDS = ("mean_leg", "platform_radius", "natural", "optimal")
SEEDS = st.integers(0, 2**32 - 1)


def random_robot(seed):
    return model.random_robots(np.random.default_rng(seed), 1).at(0)


def length(m, kind):
    return nd.characteristic_length(m.geometry(), m.configuration(), kind)


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
