"""Margins, mechanisms and uncontrolled motions.

Oracles: numpy determinants of rows rebuilt from the joints, reference values with 50 digits, the neutral closed forms
of the theory (section 5), geometry that is singular by construction, and leg lengths along the motions that are said to
leave them alone. Of the package only lengths and rates of legs are used besides what is under test, and both are tested
elsewhere.
"""

import numpy as np
import numpy_model as model
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from reference_cases import reference_cases
from singular_robots import from_o, lost, size

import ninedof as nd

EPS = np.finfo(float).eps
SEEDS = st.integers(0, 2**32 - 1)
SIDES = st.floats(0.05, 5.0)
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


def curvature(m, motion):
    """Largest change of a leg length along a motion, over the square of the step, for steps of two sizes."""
    g, c = m.geometry(), m.configuration()
    return [
        np.abs(nd.leg_lengths(g, c.moved(h * motion)) - nd.leg_lengths(g, c)).max() / h**2
        for h in (1e-3, -1e-3, 1e-4, -1e-4)
    ]


def assert_unnoticed(m, motion):
    g, c = m.geometry(), m.configuration()
    x, tips = motion.reshape(3, 3), size(motion.reshape(3, 3)).max()
    assert np.abs(nd.inverse_velocity(g, c, *x)).max() <= 1e-13 * max(tips, size(from_o(m)[1]).max())
    far, back, near, near_back = curvature(m, motion)
    # Second order: the change over the square of the step stays. In first order it would grow tenfold.
    assert max(near, near_back) <= 2.0 * max(far, back) + 1e-6
    h = 1e-4
    difference = nd.leg_lengths(g, c.moved(h * motion)) - nd.leg_lengths(g, c.moved(-h * motion))
    assert np.abs(difference).max() / (2 * h) <= 1e-6 * max(far, back, 1.0)


@pytest.mark.parametrize("case", reference_cases(), ids=lambda case: case["id"])
def test_margins_against_50_digits(case):
    joints = case["joints"]
    g = nd.Geometry(joints["r"], joints["rh"], joints["u"], joints["ut"])
    c = nd.Configuration(case["p"], case["Q"], case["s"])
    result = nd.singularity_margins(g, c)
    assert_array_equal(np.sign(result), np.sign([case["detM"], case["detB"], case["detC"]]))
    assert_allclose([result.det_b, result.det_c], [case["detB"], case["detC"]], rtol=0.0, atol=100 * EPS)
    assert_allclose(result.det_n, case["detM"] / spread(model.robot(g, c)), rtol=0.0, atol=100 * EPS)


@given(a1=SIDES, a2=SIDES, b1=SIDES, ratio=st.floats(0.3, 3.0), zs=st.floats(0.1, 0.9))
def test_between_the_plates_a_neutral_pose_is_singular_where_the_hexagons_are_similar_and_only_there(
    a1, a2, b1, ratio, zs
):
    c = nd.Configuration.neutral(2.0, 2.0 * zs)
    similar = nd.Geometry.hexagonal(a1, a2, b1, b1 * a2 / a1)
    result = nd.singularity(similar, c)
    assert abs(result.margins.det_n) <= 16 * EPS
    assert result.mechanism == "n"
    assert nd.condition_number(similar, c) > 1e14  # infinite above 2.8e14, which rounding of the joints may miss
    margin = nd.singularity_margins(nd.Geometry.hexagonal(a1, a2, b1, ratio * b1 * a2 / a1), c).det_n
    if abs(ratio - 1.0) > 1e-9:
        assert np.sign(margin) == np.sign(ratio - 1.0)  # -(a2 b1 - a1 b2)
        assert abs(margin) > 1e-6 * abs(ratio - 1.0)


@MECHANISMS
@pytest.mark.parametrize("seed", range(12))
def test_each_mechanism_on_purpose(mechanism, seed):
    m = lost(np.random.default_rng(seed), mechanism)
    g, c = m.geometry(), m.configuration()
    result = nd.singularity(g, c)
    k = "nbc".index(mechanism)
    assert result.mechanism is nd.Mechanism(mechanism)
    assert abs(result.margins[k]) <= 100 * EPS
    assert result.smallest[k] <= 100 * EPS
    assert np.delete(np.abs(result.margins), k).min() > 1e-9
    motion = np.concatenate([result.omega, result.pdot, result.sdot])
    assert_unnoticed(m, motion)
    (other,) = nd.uncontrolled_motions(g, c)
    assert_allclose(np.sign(other @ motion) * other, motion, rtol=0.0, atol=1e-8 * np.abs(motion).max())

    at_o = result.pdot + np.cross(result.omega, m.s - m.p)
    assert_allclose(size(result.omega) ** 2 + (size(at_o) ** 2 + size(result.sdot) ** 2) / reach(m) ** 2, 1.0)
    if mechanism == "b":  # normal to the lower plane, the upper legs carrying the platform's point at O along
        normal = np.cross(m.rh[1] - m.rh[0], m.rh[2] - m.rh[0])
        assert_allclose(np.cross(result.sdot, normal / size(normal)), 0.0, atol=1e-12)
        assert_allclose(at_o, result.sdot, atol=1e-13)
    if mechanism == "c":  # O still, the platform's point at O moves normal to the upper plane
        normal = m.Q @ np.cross(m.ut[1] - m.ut[0], m.ut[2] - m.ut[0])
        assert_array_equal(result.sdot, 0.0)
        assert_allclose(np.cross(at_o, normal / size(normal)), 0.0, atol=1e-12)
    if mechanism == "n":  # a turn about the line that the three leg planes share
        assert_array_equal(result.sdot, 0.0)
        assert_allclose(at_o, 0.0, atol=1e-14)
        assert_allclose(np.sum(np.cross(*from_o(m)) * result.omega, axis=-1), 0.0, atol=1e-12)


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


@given(SEEDS)
def test_neither_place_nor_unit_matters_mirrors_and_numbering_change_signs(seed):
    rng = np.random.default_rng(seed)
    m = model.random_robots(rng, 1).at(0)
    margins = np.array(nd.singularity_margins(m.geometry(), m.configuration()))
    smallest = nd.singularity(m.geometry(), m.configuration()).smallest
    turn, shift = model.random_rotations(rng, 1)[0], rng.normal(size=3)
    moved = model.Robot(
        m.r @ turn.T + shift, m.rh @ turn.T + shift, m.u, m.ut, turn @ m.p + shift, turn @ m.Q, turn @ m.s + shift
    )
    mirror = np.diag([1.0, 1.0, -1.0])
    mirrored = model.Robot(*(part @ mirror for part in m[:5]), mirror @ m.Q @ mirror, mirror @ m.s)
    swapped = model.Robot(*(part[[1, 0, 2]] for part in m[:4]), *m[4:])
    for factor in (1e-6, 1e6):
        large = model.Robot(*(factor * part for part in m[:5]), m.Q, factor * m.s)
        assert_allclose(nd.singularity_margins(large.geometry(), large.configuration()), margins, atol=1e-14)
    # Rows of M are cross products, which a mirror turns about as well: (-1)^3 times the -1 of the mirror.
    for other, signs in ((moved, [1, 1, 1]), (mirrored, [1, -1, -1]), (swapped, [-1, -1, -1])):
        result = nd.singularity(other.geometry(), other.configuration())
        assert_allclose(result.margins, signs * margins, atol=1e-13)
        assert_allclose(result.smallest, smallest, atol=1e-13)


def test_stack_equals_one_by_one_and_missing_rows_stay_alone(published, stack):
    c = nd.Configuration(
        np.concatenate([stack.position, [[np.nan, 0, 4]]]),
        np.concatenate([stack.rotation, [np.eye(3)]]),
        np.concatenate([stack.internal_point, [[0, 0, 0]]]),
    )
    result = nd.singularity(published, c)
    assert result.mechanism.tolist()[-1] == nd.Mechanism.NONE == ""
    for k, one in enumerate(stack):
        alone = nd.singularity(published, one)
        assert result.mechanism[k] == alone.mechanism
        assert_array_equal(result.smallest[k], alone.smallest)
        assert_array_equal(np.array(result.margins)[:, k], alone.margins)
        for part in ("omega", "pdot", "sdot"):
            assert_array_equal(getattr(result, part)[k], getattr(alone, part))
    for part in (*result.margins, result.smallest, result.omega, result.pdot, result.sdot):
        assert np.isfinite(part[:-1]).all()
        assert np.isnan(part[-1]).all()
    many = nd.Configuration.neutral(4.0, np.linspace(0.0, 4.0, 5000).reshape(2, 2500))
    one, two = (nd.singularity(published, many, threads=k) for k in (1, 2))
    assert one.omega.shape == (2, 2500, 3)
    assert one.mechanism.shape == one.margins.det_n.shape == (2, 2500)
    assert_array_equal(np.concatenate([one.smallest, one.pdot], -1), np.concatenate([two.smallest, two.pdot], -1))
    assert_array_equal(one.mechanism[[0, -1], [0, -1]], ["b", "c"])
    assert nd.singularity(published, stack[:0]).sdot.shape == (0, 3)
    assert nd.singularity_margins(published, stack[:0]).det_b.shape == (0,)


def test_similar_hexagons_det_n_is_odd_in_the_twist_and_the_internal_legs_do_not_see_it():
    rng = np.random.default_rng(6)
    g = nd.Geometry.hexagonal(1.0, 2.0, 0.5, 1.0)
    for zp, zs in rng.uniform([1.0, 0.1], [3.0, 0.9], size=(5, 2)):
        margins = nd.singularity_margins(g, nd.Configuration.neutral(zp, zs * zp, np.linspace(-3.0, 3.0, 601)))
        assert_allclose(margins.det_n, -margins.det_n[::-1], atol=1e-14)
        assert np.abs(margins.det_n).max() > 0.1
        assert_allclose(margins.det_b, margins.det_b[0], atol=1e-14)
        assert_allclose(margins.det_c, margins.det_c[0], atol=1e-14)
