"""Margins, mechanisms and uncontrolled motions.

Oracles: numpy determinants of rows rebuilt from the joints, reference values with 50 digits, the neutral closed forms
of the theory (section 5), geometry that is singular by construction, and leg lengths along the motions that are said to
leave them alone. Of the package only lengths and rates of legs are used besides what is under test, and both are tested
elsewhere.
"""

import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from reference_cases import reference_cases
from singular_robots import from_o, lost, size

import ninedof as nd

EPS = np.finfo(float).eps
MECHANISMS = pytest.mark.parametrize("mechanism", "nbc")


def spread(m):
    """Quotient of det N' with rows w_i x e_i by det N."""
    d, w = from_o(m)
    return (size(d) * size(w) / size(model.legs(m)[0])).prod(axis=-1)


def reach(m):
    """Root mean square distance of the platform joints from O."""
    return np.sqrt((size(from_o(m)[1]) ** 2 + size(model.legs(m)[1]) ** 2).sum(axis=-1) / 6.0)


def rates_matrix(m):
    """9x9: (omega, v_O, sdot) with omega in units of 1 / reach -> leg rates."""
    x, y, z, *_ = model.legs(m)
    e, et, eh = (v / size(v)[..., None] for v in (x, y, z))
    zero = np.zeros((3, 3))
    w = from_o(m)[1]
    return np.block([[np.cross(w, e) / reach(m), e, zero], [zero, -et, et], [zero, zero, eh]])


@pytest.mark.parametrize("case", reference_cases(), ids=lambda case: case["id"])
def test_margins_against_50_digits(case):
    joints = case["joints"]
    g = nd.Geometry(joints["r"], joints["rh"], joints["u"], joints["ut"])
    c = nd.Configuration(case["p"], case["Q"], case["s"])
    result = nd.singularity_margins(g, c)
    assert_array_equal(np.sign(result), np.sign([case["detM"], case["detB"], case["detC"]]))
    assert_allclose([result.det_b, result.det_c], [case["detB"], case["detC"]], rtol=0.0, atol=100 * EPS)
    assert_allclose(result.det_n, case["detM"] / spread(model.robot(g, c)), rtol=0.0, atol=100 * EPS)


@MECHANISMS
@pytest.mark.parametrize("seed", range(3))
def test_each_mechanism_on_purpose(mechanism, seed):
    """What the motion of each is, along normals of planes and lines, is in the C++ suite."""
    m = lost(np.random.default_rng(seed), mechanism)
    g, c = m.geometry(), m.configuration()
    result = nd.singularity(g, c)
    k = "nbc".index(mechanism)
    assert result.mechanism is nd.Mechanism(mechanism)
    assert max(abs(result.margins[k]), result.smallest[k]) <= 100 * EPS
    assert np.delete(np.abs(result.margins), k).min() > 1e-9
    motion = np.concatenate([result.omega, result.pdot, result.sdot])
    assert np.abs(nd.inverse_velocity(g, c, *motion.reshape(3, 3))).max() <= 1e-12 * np.abs(motion).max()
    (other,) = nd.uncontrolled_motions(g, c)
    assert_allclose(np.sign(other @ motion) * other, motion, rtol=0.0, atol=1e-8 * np.abs(motion).max())


def test_tolerance_counts_singular_values():
    m = model.random_robots(np.random.default_rng(3), 1).at(0)
    sigma = np.linalg.svd(rates_matrix(m), compute_uv=False)[::-1]
    g, c = m.geometry(), m.configuration()
    for k in range(9):
        motions = nd.uncontrolled_motions(g, c, tolerance=1.0001 * sigma[k])
        assert len(motions) == k + 1
        rates = nd.inverse_velocity(g, c, *motions[k].reshape(3, 3))
        assert_allclose(size(rates) / reach(m), sigma[k], rtol=1e-10)
    assert nd.uncontrolled_motions(g, c, tolerance=0.9999 * sigma[0]).shape == (0, 9)
