"""Every kinematic quantity against values computed elsewhere with 50 digits.

The reference shares nothing with the package: another language, multiple precision, general inverses where the package
has closed forms. Tolerances are those a backward-stable double computation can be held to, taken from the case itself.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from reference_cases import reference_cases

import ninedof as nd

CASES = {f"{case['id']}-{'-'.join(case['tags'])}".replace(" ", "_"): case for case in reference_cases()}
TRIPLES = ("r", "rh", "u", "ut")
EPS = np.finfo(float).eps


def geometry(case):
    return nd.Geometry(*(case["joints"][name] for name in TRIPLES))


def configuration(case):
    return nd.Configuration(case["p"], case["Q"], case["s"])


def vector(case, *names):
    return np.concatenate([case[name] for name in names])


def alone(case, function, *lc):
    return function(geometry(case), configuration(case), *lc)


def stacked(case, function, *lc):
    """The same pose as one of six in a (2, 3) stack; the others differ and must not affect it."""
    shift = np.zeros((2, 3, 3))
    shift[..., 2] = np.array([[0.3, 0.2, 0.1], [0.4, 0.0, 0.5]]) * np.linalg.norm(case["p"])
    c = nd.Configuration(case["p"] + shift, case["Q"], case["s"] + 0.5 * shift)
    result = function(geometry(case), c, *(np.full((2, 3), x) * [[2, 3, 4], [5, 1, 6]] for x in lc))
    if isinstance(result, tuple):
        return type(result)(*(part[1, 1] for part in result))
    return result[1, 1]


@pytest.fixture(params=CASES.values(), ids=CASES.keys())
def case(request):
    return request.param


@pytest.fixture(params=[alone, stacked])
def call(request):
    return request.param


def test_the_file_is_whole():
    assert len(CASES) == 34
    assert {"general", "scale", "near-singular", "neutral", "coupled", "tilt60"} <= {
        t for c in CASES.values() for t in c["tags"]
    }


def test_hexagonal_gives_the_joints(case):
    sides = case["geometry"]
    if sides["type"] == "hexagon":
        g = nd.Geometry.hexagonal(sides["a1"], sides["a2"], sides["b1"], sides["b2"])
        for name, joints in zip(
            TRIPLES, (g.base_external, g.base_internal, g.platform_external, g.platform_internal), strict=True
        ):
            assert_allclose(joints, case["joints"][name], rtol=0.0, atol=4 * EPS * max(sides["a2"], sides["b1"]))
    else:
        assert_array_equal(geometry(case).platform_internal, case["joints"]["ut"])


def test_leg_lengths(case, call):
    assert_allclose(call(case, nd.leg_lengths), vector(case, "l", "q", "r"), rtol=1e-13, atol=0.0)


def test_velocity_matrices(case, call):
    m = call(case, nd.velocity_matrices, case["lc"])
    F, B, G = (np.array(case[name]) for name in "FBG")
    assert_array_equal(m.F, np.vstack([m.A, m.E]))
    assert_array_equal(m.E, np.hstack([m.D, m.C]))
    # u x e cancels where a leg points along its joint vector: absolute in the size of the block's largest lever.
    assert_allclose(m.F[:, 3:], F[:, 3:], rtol=0.0, atol=20 * EPS)
    levers = np.abs([case["joints"]["u"], case["joints"]["ut"]]).max() / case["lc"]
    assert_allclose(m.F[:, :3], F[:, :3], rtol=0.0, atol=20 * EPS * levers)
    assert_allclose(m.B, B, rtol=0.0, atol=20 * EPS)
    assert_allclose(m.G, G, rtol=0.0, atol=20 * EPS * case["kappa_B"] * np.abs(G).max())
    assert_array_equal(m.G[:, :6], G[:, :6])


def test_determinants(case, call):
    """Signs decide on which side of a singularity a pose lies; values follow to the precision of the matrices."""
    m = call(case, nd.velocity_matrices, case["lc"])
    outcome = {name: np.linalg.det(getattr(m, name)) for name in "FBC"}
    for name, value in outcome.items():
        assert np.sign(value) == np.sign(case[f"det{name}"])
    # det B and det C are at most 1: an absolute bound is appropriate near zero.
    assert_allclose([outcome["B"], outcome["C"]], [case["detB"], case["detC"]], rtol=0.0, atol=100 * EPS)
    assert_allclose(outcome["F"], case["detM"] * case["detC"] / case["lc"] ** 3, rtol=100 * EPS * case["kappa_F"])


def test_jacobian(case, call):
    J, expected = call(case, nd.jacobian, case["lc"]), np.array(case["J"])
    for rows in (slice(0, 3), slice(3, 6)):
        assert np.abs(J[rows] - expected[rows]).max() <= case["rel_tol_J"] * np.abs(expected[rows]).max()


def test_singular_values_and_condition_number(case, call):
    tolerance = 1e-12 * max(1.0, case["kappa_F"] * case["kappa_B"])
    assert_allclose(call(case, nd.singular_values, case["lc"]), case["singular_values"], rtol=tolerance)
    assert_allclose(call(case, nd.condition_number, case["lc"]), case["cond2"], rtol=tolerance)


def test_forward_velocity(case):
    rates = vector(case, "ldot", "qdot", "rdot")
    omega, pdot, sdot = nd.forward_velocity(geometry(case), configuration(case), rates)
    # The bound of J', row block by row block, carried through the product J' udot.
    J = np.abs(case["J"])
    reach = np.abs(rates).sum() * np.array([J[:3].max() / case["lc"], J[3:].max()])
    assert np.abs(omega - case["omega"]).max() <= case["rel_tol_J"] * reach[0]
    assert np.abs(pdot - case["pdot"]).max() <= case["rel_tol_J"] * reach[1]
    assert np.abs(sdot - case["sdot"]).max() <= 20 * EPS * case["kappa_B"] * np.abs(case["sdot"]).max()


def test_inverse_velocity(case):
    rates = nd.inverse_velocity(geometry(case), configuration(case), case["omega"], case["pdot"], case["sdot"])
    size = np.abs([case["joints"]["u"], case["joints"]["ut"]]).max()
    terms = np.linalg.norm(case["pdot"]) + np.linalg.norm(case["sdot"]) + np.linalg.norm(case["omega"]) * size
    assert_allclose(rates, vector(case, "ldot", "qdot", "rdot"), rtol=0.0, atol=20 * EPS * terms)


def motion(case, *names):
    return [np.array(case[name]) for name in names]


def leg_accelerations_bound(case):
    """Rounding of what is added up: accelerations of joints, and squared speeds over the shortest leg of a kind."""
    omega, pdot, sdot, alpha, pddot, sddot = map(
        np.linalg.norm, motion(case, "omega", "pdot", "sdot", "alpha", "pddot", "sddot")
    )
    size = np.abs([case["joints"]["u"], case["joints"]["ut"]]).max()
    speed = pdot + sdot + omega * size
    return pddot + sddot + (alpha + omega**2) * size + speed**2 / np.min(case["l"] + case["q"] + case["r"])


def test_inverse_acceleration(case):
    outcome = nd.inverse_acceleration(
        geometry(case), configuration(case), *motion(case, "omega", "pdot", "sdot", "alpha", "pddot", "sddot")
    )
    expected = vector(case, "lddot", "qddot", "rddot")
    assert_allclose(outcome, expected, rtol=0.0, atol=20 * EPS * leg_accelerations_bound(case))


def test_forward_acceleration(case):
    rates, accelerations = vector(case, "ldot", "qdot", "rdot"), vector(case, "lddot", "qddot", "rddot")
    alpha, pddot, sddot = nd.forward_acceleration(geometry(case), configuration(case), rates, accelerations)
    # As in forward velocity. B is met twice: sddot comes from squares of an sdot that was itself computed.
    J, reach = np.abs(case["J"]), leg_accelerations_bound(case)
    assert np.abs(alpha - case["alpha"]).max() <= case["rel_tol_J"] * reach * J[:3].max() / case["lc"]
    assert np.abs(pddot - case["pddot"]).max() <= case["rel_tol_J"] * reach * J[3:].max()
    assert np.abs(sddot - case["sddot"]).max() <= 20 * EPS * reach * case["kappa_B"] ** 2


def test_jacobian_rate(case, call):
    velocity = motion(case, "omega", "pdot", "sdot")
    rate = call(case, lambda g, c, lc: nd.jacobian_rate(g, c, *velocity, lc), case["lc"])
    expected = np.array(case["Jdot"])
    for rows in (slice(0, 3), slice(3, 6)):
        assert np.abs(rate[rows] - expected[rows]).max() <= case["rel_tol_J"] * np.abs(expected[rows]).max()


def test_poses_of_one_robot_in_one_call():
    """The four poses that share a geometry, at condition numbers from 30 to 3e8, side by side."""
    group = [c for c in CASES.values() if "O near base plane" in c["tags"]]
    assert len(group) == 4
    assert all(c["joints"] == group[0]["joints"] for c in group)
    stack = nd.Configuration(*(np.array([c[name] for c in group]) for name in ("p", "Q", "s")))
    g, lc = geometry(group[0]), [c["lc"] for c in group]
    for function in (nd.jacobian, nd.singular_values, nd.condition_number):
        assert_array_equal(function(g, stack, lc), [alone(c, function, c["lc"]) for c in group])
    rates = np.array([vector(c, "ldot", "qdot", "rdot") for c in group])
    single = [nd.forward_velocity(g, configuration(c), r) for c, r in zip(group, rates, strict=True)]
    assert_array_equal(np.stack(nd.forward_velocity(g, stack, rates), axis=1), single)
    motion = (np.array([c[name] for c in group]) for name in ("omega", "pdot", "sdot"))
    assert_allclose(nd.inverse_velocity(g, stack, *motion), rates, rtol=0.0, atol=1e-14)
