"""Legs far shorter than the others: lengths, directions, J' and the condition number against 400 bits."""

import numpy as np
import pytest
from exact_robot import ExactRobot, unit
from scipy.spatial.transform import Rotation

import ninedof as nd


def robot(rng, kind, length):
    """A robot whose first leg of a kind has about this length."""
    base, base_internal, platform, platform_internal = rng.normal(size=(4, 3, 3))
    p, s = np.array([[0.0, 0.0, 4.0], [0.0, 0.0, 2.0]]) + rng.normal(size=(2, 3))
    q = Rotation.from_rotvec(rng.normal(size=3)).as_matrix()
    leg = rng.normal(size=3)
    leg *= length / np.linalg.norm(leg)
    if kind == "external":
        base[0] = p + q @ platform[0] - leg
    else:
        s = leg + (p + q @ platform_internal[0] if kind == "upper" else base_internal[0])
    return nd.Geometry(base, base_internal, platform, platform_internal), nd.Configuration(p, q, s)


def number(ball):
    return float(ball.mid())


@pytest.mark.parametrize("kind", ["external", "upper", "lower"])
def test_no_length_of_a_leg_costs_half_the_digits(kind):
    rng = np.random.default_rng(7)
    for length in 10.0 ** np.arange(-12.0, 0.0, 0.25):
        g, c = robot(rng, kind, length)
        exact = ExactRobot(g, c)
        np.testing.assert_allclose(nd.leg_lengths(g, c), [number(x) for x in exact.lengths()], rtol=5e-11)
        result = nd.velocity_matrices(g, c)
        for rows, legs in ((result.A[:, 3:], exact.external), (result.C, exact.upper), (result.B, exact.lower)):
            directions = [[number(x) for x in unit(leg)] for leg in legs]
            np.testing.assert_allclose(rows, directions, rtol=0.0, atol=5e-11)
        kappa = number(exact.condition_number())
        stack = nd.Configuration([c.position] * 8, c.rotation, [c.internal_point] * 8)
        for value in (nd.condition_number(g, c), *nd.condition_number(g, stack)):
            assert abs(value / kappa - 1.0) < 1e-11 * kappa
        jacobian = np.array([[number(x) for x in row] for row in exact.jacobian().tolist()])
        assert abs(nd.jacobian(g, c) - jacobian).max() < 1e-11 * kappa * abs(jacobian).max()
