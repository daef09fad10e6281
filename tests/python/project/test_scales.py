"""Every function has the same answer in any unit of length within the stated range, and refuses what lies outside."""

from fractions import Fraction

import main_results
import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd

JOINTS = main_results.JOINTS
EXPONENTS = (-331, -250, -120, 120, 250, 328)
"""Powers of two, which scale without rounding: from 2e-100 to 5e98, with coordinates of up to 5 units."""

DIRECTION = np.array([0.3, -0.2, 0.5])


def measured(g, c, unit):
    """Name: the value, and the power of the unit of length that it has."""
    margins = nd.singularity_margins(g, c)
    modes = nd.forward_position(g, nd.leg_lengths(g, c[0]))
    lengths = nd.leg_lengths(g, c)
    errors = nd.error_bounds(g, c, 1e-3 * unit, 2e-3 * unit)
    sample = nd.error_samples(g, c[0], 1e-3 * unit, 2e-3 * unit, samples=20)
    architecture = nd.architecture_singularity(g)
    proof = nd.forward_position(g, lengths[0], certify=True).certificate
    return {
        "leg_lengths": (lengths, 1),
        "condition_number": (nd.condition_number(g, c, unit), 0),
        "frobenius": (nd.condition_number(g, c, unit, norm="frobenius"), 0),
        "singular_values": (nd.singular_values(g, c, unit), 0),
        "manipulability": (nd.manipulability(g, c, unit), 0),
        "isotropy": (nd.isotropy_residual(g, c, unit), 0),
        "optimal": (nd.condition_number(g, c, "optimal"), 0),
        **{kind: (nd.characteristic_length(g, c, kind), 1) for kind in ("mean_leg", "platform_radius", "natural")},
        "margins": (np.stack([margins.det_n, margins.det_b, margins.det_c]), 0),
        "modes": (np.concatenate([modes.position, modes.internal_point]), 1),
        "count": ([modes.count, modes.certain], 0),
        "tracked": (nd.track(g, lengths[1], c[0]).internal_point, 1),
        "nearest": (nd.nearest_singularity(g, c[0]).distance, 1),
        "inverse_velocity": (nd.inverse_velocity(g, c, DIRECTION, DIRECTION * unit, DIRECTION * unit), 1),
        "errors": (errors.position, 1),
        "errors of turns": (errors.rotation, 0),
        "samples": (sample[..., 3:], 1),
        "samples of turns": (sample[..., :3], 0),
        "architecture": (architecture.distance, 1),
        "relative": (architecture.relative, 0),
        "certified": ([proof.complete, proof.proved], 0),
        "best": (nd.best_internal_point(g, c.position, c.rotation, characteristic_length=unit).value, 0),
        "bounds": (np.stack(nd.condition_number_bounds(g, c, unit)), 0),
        "length_bounds": (np.stack(nd.leg_length_bounds(g, c)), 1),
        "determinants": (np.stack(nd.determinant_bounds(g, c).det_b), 0),
    }


def scaled(g, c, exponent):
    geometry = nd.Geometry(*(np.ldexp(getattr(g, name), exponent) for name in JOINTS))
    position, point = (np.ldexp(a, exponent) for a in (c.position, c.internal_point))
    return geometry, nd.Configuration(position, c.rotation, point)


@pytest.fixture(scope="module")
def robot():
    rng = np.random.default_rng(31)
    return main_results.robot(rng), main_results.poses(rng, 8)


@pytest.fixture(scope="module")
def in_one(robot):
    return measured(*robot, 1.0)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_a_power_of_two_changes_rounding_at_most(robot, in_one, exponent):
    found = measured(*scaled(*robot, exponent), 2.0**exponent)
    for name, (value, power) in found.items():
        known = np.asarray(in_one[name][0], dtype=float)
        value = np.ldexp(np.asarray(value, dtype=float), -power * exponent)
        assert_allclose(value, known, rtol=1e-9, atol=1e-11 * np.abs(known).max(), err_msg=name)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_kernels_keep_every_bit(robot, in_one, exponent):
    found = measured(*scaled(*robot, exponent), 2.0**exponent)
    for name in ("leg_lengths", "condition_number", "singular_values", "margins"):
        value, power = found[name]
        assert np.ldexp(value, -power * exponent).tobytes() == in_one[name][0].tobytes()


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_the_closed_form_at_any_scale(exponent):
    unit = 2.0**exponent
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8 * unit, b1=2.9 * unit, b2=0.0)
    one = nd.Geometry.hexagonal(a1=0.0, a2=5.8, b1=2.9, b2=0.0)
    found = nd.axis_singular_values(g, nd.Configuration.neutral(4.0 * unit, 2.4 * unit), unit)
    assert_allclose(found, nd.axis_singular_values(one, nd.Configuration.neutral(4.0, 2.4)), rtol=1e-14)


def test_designs_of_any_size_have_a_condition_number():
    """No NaN; where the function for any configuration can tell the design from a singular one, both agree."""
    rng = np.random.default_rng(32)
    x = 10.0 ** rng.uniform(-99.0, 99.0, (6, 400))
    x[:, :300] = 10.0 ** (rng.uniform(-90.0, 90.0, 300) + rng.uniform(-4.0, 4.0, (6, 300)))
    kappa = nd.hexagonal_condition_number(*x)
    assert not np.isnan(kappa).any()
    for k in range(400):
        direct = nd.condition_number(nd.Geometry.hexagonal(*x[:4, k]), nd.Configuration.neutral(*x[4:, k]))
        if direct < 1e7:
            assert_allclose(kappa[k], direct, rtol=1e-6)
        else:
            assert kappa[k] > 1e6 or np.isinf(direct)


def test_a_design_that_only_the_closed_form_tells_from_a_singular_one():
    """The lengths of the legs span 83 orders of magnitude. The number is by 450 digits."""
    x = [5e-5, 3e-34, 2e-13, 2e43, 2e-44, 3e70]
    assert_allclose(nd.hexagonal_condition_number(*x), 34641.0161514, rtol=1e-9)


def test_plates_of_very_different_size():
    """1e80 beside 1e-80: singular to rounding where they are compared, and no mode is missed with certainty."""
    for base, platform in ((1e80, 1e-80), (1e-80, 1e80)):
        g = nd.Geometry.hexagonal(a1=0.0, a2=5.8 * base, b1=2.9 * platform, b2=0.0)
        c = nd.Configuration.neutral(4e80, 2.4e80)
        for length in (1e80, 1.0):
            assert nd.condition_number(g, c, length) > 1e14
        modes = nd.forward_position(g, nd.leg_lengths(g, c))
        assert modes.count > 0 or not modes.certain


def exact_condition_number(g, c):
    """From leg vectors in rational numbers: only their directions are rounded."""

    def rational(a):
        return np.vectorize(Fraction, otypes=[object])(np.asarray(a, dtype=float))

    p, q, s = (rational(a) for a in (c.position, c.rotation, c.internal_point))
    rates = np.zeros((9, 9))  # from the twist (omega, pdot, sdot) to the rates of the legs

    def unit(v):
        a = np.array([float(x) for x in v / max(abs(v))])
        return a / np.linalg.norm(a)

    for i in range(3):
        u, v = (q.dot(rational(joints[i])) for joints in (g.platform_external, g.platform_internal))
        e, upper = unit(p + u - rational(g.base_external[i])), unit(s - p - v)
        rates[i, :6] = *np.cross(u.astype(float), e), *e
        rates[3 + i] = *-np.cross(v.astype(float), upper), *-upper, *upper
        rates[6 + i, 6:] = unit(s - rational(g.base_internal[i]))
    return np.linalg.cond(np.linalg.inv(rates)[:6])


@pytest.mark.parametrize("distance", [4e-16, 1e-14, 1e-10, 1e-7, 1e-6, 1e-3])
def test_o_close_to_a_joint_of_the_platform(distance):
    """Rounding would decide about the direction of the leg: condition numbers were wrong by factors of up to five."""
    rng = np.random.default_rng(33)
    for k in range(12):
        g, c = main_results.robot(rng), main_results.poses(rng, 1)[0]
        joint = c.position + c.rotation @ g.platform_internal[k % 3]
        c = nd.Configuration(c.position, c.rotation, joint + distance * rng.normal(size=3))
        exact = exact_condition_number(g, c)
        stack = nd.Configuration(c.position, c.rotation, np.tile(c.internal_point, (9, 1)))
        j = nd.jacobian(g, c)
        for found in (nd.condition_number(g, c), *nd.condition_number(g, stack), np.linalg.cond(j)):
            assert_allclose(found, exact, rtol=1e-15 / min(distance, 1e-3) * 10.0 if distance > 1e-7 else 1e-9)
        length = nd.leg_lengths(g, c)[3 + k % 3]
        difference = [Fraction(float(c.internal_point[i])) - Fraction(float(c.position[i])) for i in range(3)]
        for i in range(3):
            difference[i] -= sum(
                Fraction(float(c.rotation[i, n])) * Fraction(float(g.platform_internal[k % 3, n])) for n in range(3)
            )
        if distance < 1e-7:
            assert_allclose(length, float(sum(x * x for x in difference)) ** 0.5, rtol=1e-14)
