"""Certified numbers against balls of 400 bits (exact_robot): what they enclose and how tightly.

The cases: general robots, in millimetres, in units of 1e-97 and 1e97, near singularities of each kind and on them,
and those of tests/reference.
"""

import ctypes
import platform
import sys

import numpy as np
import pytest
import robots
from exact_robot import ExactRobot
from numpy.testing import assert_array_equal
from reference_cases import of_case, reference_cases, rotation
from sizes import size

import ninedof as nd
from ninedof import _core

COUNT = size(120, 3000)
UNITS = (1.0, 1e3, 1e-97, 1e97)


def encloses(bounds, exact):
    """Whether no exact number lies outside; balls have a radius of some 1e-100 of it."""
    pairs = zip(np.ravel(bounds.lower).tolist(), np.ravel(bounds.upper).tolist(), exact, strict=True)
    return all(low <= high and not value < low and not (high != np.inf and value > high) for low, high, value in pairs)


def width(bounds):
    return (bounds.upper - bounds.lower) / np.maximum(np.abs(bounds.lower), np.abs(bounds.upper))


def in_units(g, c, unit):
    triples = (g.base_external, g.base_internal, g.platform_external, g.platform_internal)
    return nd.Geometry(*(unit * t for t in triples)), nd.Configuration(
        unit * c.position, c.rotation, unit * c.internal_point
    )


def near(kind, seed):
    """A general robot with O between 1e-1 and 1e-15 from a singularity."""
    m, rng = robots.singular(kind, seed)
    return m.geometry(), nd.Configuration(m.p, m.Q, m.s + 10.0 ** rng.uniform(-15, -1) * rng.normal(size=3))


def cases():
    rng = np.random.default_rng(1602)
    for k in range(COUNT):
        g, c = robots.any_pose(rng, k % 2)
        unit = UNITS[k % len(UNITS)]
        yield *in_units(g, c, unit), unit * 10.0 ** rng.uniform(-2, 2)
    for k in range(COUNT // 2):
        yield *near(robots.SINGULAR[k % 3], k), 1.0
    for k in range(COUNT // 8):  # the length unit of the twist far from that of the robot
        yield *in_units(*robots.any_pose(rng, k % 2), 1e-4), 10.0 ** rng.uniform(-9, 9)


@pytest.mark.parametrize("part", range(4))
def test_every_number_is_enclosed(part):
    """Where all rounding is of the order of 1e-16 the bounds are as near as that times the condition number."""
    finite = 0
    for g, c, lc in list(cases())[part::4]:
        exact = ExactRobot(g, c)
        kappa = nd.condition_number_bounds(g, c, lc)
        sigma = nd.singular_value_bounds(g, c, lc)
        value = float(exact.condition_number(lc))
        assert encloses(kappa, [exact.condition_number(lc)])
        assert encloses(sigma, exact.singular_values(lc))
        assert encloses(nd.jacobian_bounds(g, c, lc), exact.jacobian(lc).entries())
        lengths, determinants = nd.leg_length_bounds(g, c), nd.determinant_bounds(g, c)
        assert encloses(lengths, exact.lengths())
        assert all(encloses(b, [x]) for b, x in zip(determinants, exact.determinants(), strict=True))
        assert width(lengths).max() < 2e-15
        assert all(b.upper - b.lower < 4e-14 for b in determinants)
        assert kappa.upper < np.inf or value > 1e12
        if kappa.upper < np.inf and value < 1e10:
            finite += 1
            assert width(kappa) < 1e-13 * value
    assert finite > COUNT // 8


def test_the_cases_of_fifty_digits():
    """Their rotations are exact, ours rounded: apart by rounding times the condition number."""
    compared = 0
    for case in reference_cases():
        g, _ = of_case(case)
        c = nd.Configuration(case["p"], rotation(case["quat"]), case["s"])
        lower, upper = nd.condition_number_bounds(g, c, case["lc"])
        kappa = case["cond2"]
        if not kappa < 1e10:
            assert lower > 1e8
            continue
        compared += 1
        room = 1e-14 * kappa * kappa
        assert lower - room <= kappa <= upper + room
        exact = ExactRobot(g, c)
        assert encloses(nd.condition_number_bounds(g, c, case["lc"]), [exact.condition_number(case["lc"])])
        assert abs(float(exact.condition_number(case["lc"])) - kappa) <= room
    assert compared > 20


@pytest.mark.parametrize("kind", robots.SINGULAR)
def test_a_singular_configuration_has_no_upper_bound_and_a_large_lower_one(kind):
    m = robots.flat(kind)
    g, c = m.geometry(), m.configuration()
    kappa, sigma = nd.condition_number_bounds(g, c), nd.singular_value_bounds(g, c)
    assert kappa.upper == np.inf
    assert kappa.lower > 1e12
    assert sigma.upper[0] == np.inf
    assert sigma.lower[0] > 1e12
    assert np.all(nd.jacobian_bounds(g, c).upper == np.inf)
    lost = {"lower plane": 1, "upper plane": 2, "leg through O": 0}[kind]
    signs = [bool(b.lower <= 0.0 <= b.upper) for b in nd.determinant_bounds(g, c)]
    assert signs == [k == lost for k in range(3)]


def test_shapes_missing_poses_and_threads(published):
    grid = nd.Configuration.neutral([[3.0], [4.0]], [1.0, 1.5, 2.0])
    functions = {
        nd.condition_number_bounds: (),
        nd.axis_condition_number_bounds: (),
        nd.singular_value_bounds: (6,),
        nd.jacobian_bounds: (6, 9),
        nd.leg_length_bounds: (9,),
    }
    for function, tail in functions.items():
        lower, upper = function(published, grid)
        assert lower.shape == upper.shape == (2, 3, *tail)
        assert_array_equal(lower[1, 2], function(published, grid[1, 2]).lower)
        assert_array_equal(upper, function(published, grid, threads=3).upper)
        assert function(published, grid[0, :0]).lower.shape == (0, *tail)
        missing = nd.Configuration.neutral([3.0, np.nan], 1.0)
        assert_array_equal(np.isnan(function(published, missing).upper).reshape(2, -1).all(axis=1), [False, True])
    assert nd.determinant_bounds(published, grid).det_b.upper.shape == (2, 3)
    assert isinstance(nd.condition_number_bounds(published, grid[0, 0]).lower, float)


def test_numbers_are_shown_in_full(published, neutral):
    lower, upper = nd.condition_number_bounds(published, neutral)
    assert repr(nd.Bounds(lower, upper)) == f"Bounds(lower={float(lower)!r}, upper={float(upper)!r})"
    assert "array 6x9" in repr(nd.jacobian_bounds(published, neutral))


@pytest.mark.skipif(sys.platform != "linux" or platform.machine() != "x86_64", reason="the number of a rounding mode")
def test_arithmetic_with_another_rounding_mode_is_refused(published, neutral):
    given, upward, nearest = (published, neutral), 0x800, 0
    library = ctypes.CDLL("libm.so.6")
    library.fesetround(upward)
    try:
        nd.leg_length_bounds(*given)
        message = "nothing raised"
    except RuntimeError as error:
        message = str(error)
    finally:
        checked = _core.check_certificate(b"", None)
        library.fesetround(nearest)
    assert checked.words == "numbers are not rounded as they must be here: to nearest, with gradual underflow"
    assert message == "the arithmetic of this process is unfit for proofs: numbers are not rounded to nearest"


def test_a_length_at_the_end_of_the_range_has_finite_bounds():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    far = nd.Configuration(np.array([1e100, 1e100, 4.0]), np.eye(3), np.array([0.0, 0.0, 2.0]))
    lower, upper = nd.leg_length_bounds(g, far)
    assert np.isfinite(upper).all()
    assert (lower[:3] <= 1.4142135623730951e100).all()
    assert (upper[:3] >= 1.414213562373095e100).all()
    assert (upper - lower <= 1e-14 * upper).all()


def test_a_leg_of_zero_length():
    g = nd.Geometry.hexagonal(a1=1.0, a2=4.0, b1=2.5, b2=0.5)
    c = nd.Configuration([0.0, 0.0, 3.0], np.eye(3), g.base_internal[0])
    assert nd.condition_number_bounds(g, c).upper == np.inf
    lengths = nd.leg_length_bounds(g, c)
    assert lengths.lower[6] == 0.0
    assert lengths.upper[6] < 1e-300
    assert nd.determinant_bounds(g, c).det_b.lower <= 0.0 <= nd.determinant_bounds(g, c).det_b.upper
