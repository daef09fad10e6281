"""Indices of the homogenized Jacobian, eqs. (2)-(5): values, invariances, singularities, the array boundary.

Oracle for values: numpy's SVD of a J' assembled and inverted by LAPACK (numpy_model), where the package never forms J'.
Oracles for invariances: none, only the symmetry itself.
"""

import numpy as np
import numpy_model as model
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import ninedof as nd

SEEDS = st.integers(0, 2**32 - 1)
EPS = np.finfo(float).eps


def random_robot(seed):
    rng = np.random.default_rng(seed)
    return model.random_robots(rng, 1).at(0), rng


def singular_values(m, lc=1.0):
    return nd.singular_values(m.geometry(), m.configuration(), lc)


def lost(m, lc=1.0):
    """Relative error that rounding the input by one unit may cause, with some room."""
    return 100 * EPS * max(model.condition_number(m, lc), model.condition_number(m))


# --- Values -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lc", [1e-7, 1e-5, 3e-4, 1e-3, 3e-3, 1e-2, 20.0, 40.0, 1e3, 1e5, 1e7])
def test_a_characteristic_length_far_from_the_robot_costs_few_digits(lc):
    """The closed form on the axis as oracle: its two blocks hold at any scales of rotation and translation."""
    rng, rtol = np.random.default_rng(12), max(3e-13, 1e-15 / lc) if lc > 5e-4 else 3e-13
    for _ in range(50):
        g = nd.Geometry.hexagonal(*rng.uniform([0.0, 0.8, 0.8, 0.0], [0.3, 3.0, 2.0, 0.3]))
        c = nd.Configuration.neutral(*rng.uniform([1.5, 0.5], [3.0, 1.2]), theta_z=rng.uniform(0.3, 0.6))
        expected = nd.axis_singular_values(g, c, lc)
        assert_allclose(nd.singular_values(g, c, lc), expected, rtol=rtol)
        assert_allclose(nd.condition_number(g, c, lc), expected[0] / expected[5], rtol=rtol)
        frobenius = np.linalg.norm(expected) * np.linalg.norm(1.0 / expected)
        assert_allclose(nd.condition_number(g, c, lc, norm="frobenius"), frobenius, rtol=rtol)


@given(SEEDS, st.floats(0.05, 20.0))
def test_indices_by_their_definitions(seed, lc):
    """Eqs. (2), (4), (5) written out with numpy on J' itself."""
    m, _ = random_robot(seed)
    g, c, J = m.geometry(), m.configuration(), model.jacobian(m, lc)
    tolerance = {"rtol": 20 * lost(m, lc)}
    assert_allclose(nd.condition_number(g, c, lc), np.linalg.cond(J), **tolerance)
    frobenius = np.linalg.norm(J) * np.linalg.norm(np.linalg.pinv(J, rcond=1e-16))
    assert_allclose(nd.condition_number(g, c, lc, norm="frobenius"), frobenius, **tolerance)
    assert_allclose(nd.manipulability(g, c, lc), np.prod(np.linalg.svd(J, compute_uv=False)), **tolerance)
    product = J @ J.T
    sigma = np.trace(product) / 6.0
    residual = np.linalg.norm(product - sigma * np.eye(6)) / np.linalg.norm(sigma * np.eye(6))
    assert_allclose(nd.isotropy_residual(g, c, lc), residual, **tolerance)


def test_nearly_isotropic_design():
    """docs/theory/limits.md: rho = 5 gives kappa = sqrt(1.12) exactly."""
    side, p, s = np.sqrt(1.0 / 13.0), np.array([0.0, 0.0, 6.0]), np.array([0.0, 0.0, 1.0])
    turn = Rotation.from_euler("z", [[0.0], [-120.0], [-240.0]], degrees=True).as_matrix()
    external_base, external_platform = turn @ [0.7, -3.0, 6.2], turn @ [0.7, 1.0, 6.2] - p
    g = nd.Geometry(external_base, turn @ [side, 0.0, 0.0], external_platform, turn @ [0.0, 5.0 * side, 0.0])
    c = nd.Configuration(p, np.eye(3), s)
    assert_allclose(nd.condition_number(g, c), np.sqrt(1.12), rtol=1e-14)
    assert nd.condition_number(g, c) == pytest.approx(1.0583005244, abs=5e-11)
    assert 6.0 <= nd.condition_number(g, c, norm="frobenius") < 6.01
    assert 0.0 < nd.isotropy_residual(g, c) < 0.08


# --- Invariances ------------------------------------------------------------------------------------------------------


def test_many_hexagonal_designs_are_gathered_block_by_block():
    """More than one block, every way of broadcasting, and no second copy of all arguments in memory."""
    import tracemalloc

    rng = np.random.default_rng(5)
    a1, a2 = rng.uniform(0.5, 5.0, (2, 3, 70_001))
    b1, zp = rng.uniform(0.5, 5.0, (70_001, 6)).T[:2]  # strided
    b1[7] = np.nan
    tracemalloc.start()
    result = nd.hexagonal_condition_number(a1, a2, b1, 1, zp, np.float32(0.25))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert result.shape == (3, 70_001)
    assert peak < 5.5 * result.nbytes
    assert np.isnan(result[:, 7]).all()
    for i, j in ((0, 0), (0, 65_535), (0, 65_536), (1, 131_072 - 70_001), (2, 70_000)):
        g = nd.Geometry.hexagonal(a1[i, j], a2[i, j], b1[j], 1.0)
        expected = nd.condition_number(g, nd.Configuration.neutral(zp[j], 0.25))
        assert_allclose(result[i, j], expected, rtol=1e-10)
    alone = nd.hexagonal_condition_number(a1, a2, b1, 1, zp, 0.25, threads=1)
    assert alone.tobytes() == result.tobytes()


def test_characteristic_lengths_in_out(published, stack):
    lengths = np.linspace(0.5, 1.5, len(stack))
    for index in (nd.condition_number, nd.manipulability, nd.isotropy_residual, nd.reciprocal_condition_number):
        out = lengths.copy()
        index(published, stack, out, out=out)
        assert out.tobytes() == index(published, stack, lengths).tobytes()
    assert nd.hexagonal_condition_number([], 1, 1, 1, 1, 0.5).shape == (0,)
    with pytest.raises(ValueError, match="leading dimensions do not broadcast"):
        nd.hexagonal_condition_number([1, 2], [1, 2, 3], 1, 1, 1, 0.5)


@pytest.mark.parametrize(
    ("out", "words"),
    [
        ([0.0] * 5, "got 'list'"),
        (np.zeros(4), r"got one of float64 and shape \(4,\)"),
        (np.zeros((1, 5)), r"got one of float64 and shape \(1, 5\)"),
        (np.zeros(5, np.float32), r"got one of float32 and shape \(5,\)"),
        (np.zeros(5, ">f8"), r"got one of >f8 and shape \(5,\)"),
        (np.zeros(10)[::2], "got one .*, not C-contiguous"),
        (np.broadcast_to(np.zeros(5), 5), "got one .*, not writeable"),
        (np.frombuffer(bytearray(41), np.uint8)[1:].view(np.float64), "got one .*, not aligned"),
    ],
)
def test_an_out_that_does_not_fit_is_described(published, stack, out, words):
    with pytest.raises(ValueError, match=rf"^out: {words}.*, expected a writeable aligned C-contiguous float64"):
        nd.condition_number(published, stack, out=out)
