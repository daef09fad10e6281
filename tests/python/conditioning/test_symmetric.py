"""The closed form on the symmetry axis against methods that do not use it.

Three independent ways to the same six numbers: the package's triangular blocks (axis_singular_values), the package's
general path (singular_values, which never sees the symmetry), numpy's SVD of an assembled J'; and, typed here, the
trace and determinant form of the theory note, which shares with the package's version only the group theory.
"""

import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_allclose
from sizes import size

import ninedof as nd

EPS = np.finfo(float).eps
COUNT = size(4_000, 10_000)


@pytest.fixture(scope="module")
def robots():
    return model.random_symmetric_robots(np.random.default_rng(2024), COUNT)


@pytest.fixture(scope="module")
def closed_form(robots):
    singles = [robots.at(k) for k in range(COUNT)]
    return np.array([nd.axis_singular_values(m.geometry(), m.configuration()) for m in singles])


def theory_note(m, lc=1.0):
    """docs/theory/closed-form.md: singular values of J' from T0, D0, T1, D1, largest first."""
    x, y, z, u, ut = (v[..., 0, :] for v in model.legs(m))
    e, et, eh = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (x, y, z))
    mm, n = np.cross(u, e) / lc, np.cross(ut, et) / lc

    def c(w):
        return w[..., 0] + 1j * w[..., 1]

    def square(w):
        return np.abs(w) ** 2

    c0 = square(et[..., 2] / eh[..., 2])
    c1 = square(c(et)) / square(c(eh))
    t0 = 3.0 * (square(mm[..., 2]) + square(e[..., 2]) + (square(n[..., 2]) + square(et[..., 2])) / (1.0 + c0))
    d0 = 3.0 * np.abs(mm[..., 2] * et[..., 2] - e[..., 2] * n[..., 2]) / np.sqrt(1.0 + c0)
    t1 = 1.5 * (square(c(mm)) + square(c(e)) + (square(c(n)) + square(c(et))) / (1.0 + c1))
    d1 = 1.5 * np.abs(c(mm) * c(et) - c(e) * c(n)) / np.sqrt(1.0 + c1)
    values = []
    for t, d, times in ((t0, d0, 1), (t1, d1, 2)):
        large = 0.5 * (t + np.sqrt(np.maximum(t * t - 4.0 * d * d, 0.0)))
        values += [np.sqrt(large), d / np.sqrt(large)] * times
    return -np.sort(-1.0 / np.stack(values, axis=-1))


def test_the_sample_covers_good_and_bad_conditioning(robots, closed_form):
    kappa = closed_form[:, 0] / closed_form[:, 5]
    assert np.median(kappa) < 100.0
    assert kappa.max() > 1e5
    planar = np.abs(robots.u[..., 2]).max(axis=-1) == 0.0
    assert 0.2 * COUNT < planar.sum() < 0.4 * COUNT


def test_against_numpy(robots, closed_form):
    expected = model.singular_values(robots)
    kappa = expected[:, :1] / expected[:, 5:]
    assert (np.abs(closed_form / expected - 1.0) <= 100 * EPS * kappa).all()


def test_against_the_formula_of_the_theory(robots, closed_form):
    expected = theory_note(robots)
    kappa = expected[:, 0] / expected[:, 5]
    # T^2 - 4 D^2 cancels where the two roots of a block meet: square root of rounding there, rounding elsewhere.
    assert_allclose(closed_form, expected, rtol=1e-7)
    error = np.abs(closed_form[:, 0] / closed_form[:, 5] / kappa - 1.0)
    assert np.quantile(error, 0.95) < 1e-11


def test_internal_point_over_its_base_joints():
    """|e^_c| -> 0 makes c1 of the derivation infinite; the closed form must remain finite."""
    for radius in (1e-3, 1e-6, 1e-9):
        g = nd.Geometry.symmetric((2.0, 0.0, 0.0), (radius, 1.0, 0.0), (1.0, 0.7, 0.0), (1.0, 2.0, 0.0))
        c = nd.Configuration.neutral(3.0, 1.4)
        m = model.robot(g, c)
        expected = model.singular_values(m)
        assert_allclose(nd.axis_singular_values(g, c), expected, rtol=1e3 * EPS / radius)
