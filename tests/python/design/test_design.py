"""One design of a study: condition number, margins, and their gradients in all seven variables.

Oracle: central differences of the general path (nd.condition_number on the geometry and configuration of the design,
whose joints and poses are rebuilt here from eqs. (6), (37), (38) by numpy_model). The gradients under test come from
dual numbers through the closed form; the two share no formula.
"""

import math

import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import ninedof as nd

NAMES = ("a1", "a2", "b1", "b2", "zp", "zs", "theta_z")
K = math.sqrt(3.0) / 6.0
STUDY = nd.Study(
    variables={"theta_z": (-4.0, 4.0)},
    constraints={"radius_ratio": (0.5, 2.0), "leg_ratio": (None, 3.0), "zs_fraction": (0.1, 0.9)},
)


def joints(s1, s2):
    """Joint 1 of eqs. (37a)-(37b); the others by C3, which test_geometry checks against the printed ones."""
    radius, angle = math.hypot(0.5 * s1, K * (s1 + 2.0 * s2)), math.atan2(-K * (s1 + 2.0 * s2), 0.5 * s1)
    return model.orbit(radius, angle, 0.0), model.orbit(radius, math.pi - angle, 0.0)


def robot(x):
    a1, a2, b1, b2, zp, zs, theta = x
    turn = Rotation.from_euler("z", theta).as_matrix()
    return model.Robot(*joints(a1, a2), *joints(b1, b2), np.array([0, 0, zp]), turn, np.array([0, 0, zs]))


def log_kappa(x, lc=1.0):
    m = robot(x)
    return math.log(nd.condition_number(m.geometry(), m.configuration(), lc))


def margins(x):
    """Smallest margin of each constraint of STUDY, from leg lengths and circumradii."""
    m = robot(x)
    ratio = np.linalg.norm(m.r[0]) / np.linalg.norm(m.u[0])
    legs = model.lengths(m)
    fraction = x[5] / x[4]
    return {
        "radius_ratio": min(1.0 - ratio / 2.0, ratio / 0.5 - 1.0),
        "leg_ratio": 1.0 - legs.max() / legs.min() / 3.0,
        "zs_fraction": min(1.0 - fraction / 0.9, fraction / 0.1 - 1.0),
    }


def differences(f, x, h=2e-4):
    """Central differences, Richardson-extrapolated."""
    out = []
    for step in h * np.eye(7):
        d1, d2 = (f(x + step) - f(x - step)) / (2 * h), (f(x + 2 * step) - f(x - 2 * step)) / (4 * h)
        out.append((4.0 * d1 - d2) / 3.0)
    return np.array(out)


def point(x, study=STUDY):
    return study.evaluate(dict(zip(NAMES, map(float, x), strict=True)))


def values(mapping):
    return np.array([mapping[name] for name in NAMES])


def designs(regime):
    """Neutral: designs like the published one. Tiny: the same nudged by 1e-9. Random: anywhere, twisted."""
    rng = np.random.default_rng(17)
    neutral = np.array([[0.2, 5.8124, 2.9062, 0.1, 3.9828, 2.3745, 0.0], [2.0, 0.4, 0.5, 1.6, 2.0, 0.8, 0.0]])
    if regime == "neutral":
        return neutral
    if regime == "tiny":
        return neutral + 1e-9 * rng.normal(size=neutral.shape)
    zp = rng.uniform(0.5, 8.0, size=25)
    sides = np.exp(rng.uniform(-1.0, 1.5, size=(25, 4)))
    return np.column_stack([sides, zp, zp * rng.uniform(0.1, 0.9, size=25), rng.uniform(-3.0, 3.0, size=25)])


REGIMES = pytest.mark.parametrize("regime", ["neutral", "tiny", "random"])


@REGIMES
def test_gradient_of_the_condition_number(regime):
    for x in designs(regime):
        p = point(x)
        expected = math.exp(log_kappa(x)) * differences(log_kappa, x)
        assert_allclose(
            values(p.gradient), expected, rtol=0.0, atol=3e-9 * p.condition_number * (1 + np.abs(expected).max())
        )


@REGIMES
def test_margins_and_their_gradients(regime):
    for x in designs(regime):
        p = point(x)
        assert p.margins == pytest.approx(margins(x), abs=1e-13)
        for name in ("radius_ratio", "leg_ratio", "zs_fraction"):
            expected = differences(lambda y, name=name: margins(y)[name], x)
            assert_allclose(values(p.margin_gradients[name]), expected, atol=1e-8)


def test_a_design_point_has_its_robot_and_poses():
    x = designs("random")[0]
    p = point(x)
    assert p.variables == dict(zip(NAMES, x, strict=True))
    assert p.geometry == nd.Geometry.hexagonal(*x[:4])
    assert p.configuration == nd.Configuration.neutral(*x[4:])
    assert p.condition_number == pytest.approx(nd.condition_number(p.geometry, p.configuration), rel=1e-12)


def test_fixed_variables_may_be_left_out():
    study = nd.Study(variables={"a1": 0.0, "b2": 0.0})
    p = study.evaluate({"a2": 5.8124, "b1": 2.9062, "zp": 3.9828, "zs": 2.3745})
    assert p.variables["theta_z"] == p.variables["a1"] == 0.0
    assert p.condition_number == pytest.approx(3.9110, abs=5e-5)
