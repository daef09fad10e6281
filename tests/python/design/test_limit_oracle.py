"""The definitions of the limits in numpy, by hand or by SciPy. That they agree with the core is tested elsewhere."""

import math

import numpy as np
import pytest
from limit_oracle import (
    EVERY_LIMIT,
    RULES,
    Limit,
    Robot,
    between_segments,
    cone,
    determinants,
    margins,
    measured,
)
from scipy.optimize import minimize
from sizes import size

import ninedof as nd
from ninedof.design.limits import ROWS

PAIRS = np.array([(0, 1), (0, 2), (1, 2), (0, 4), (0, 7)])


def robot(poses=None, heights=(0.0, 0.0)):
    g = nd.Geometry.symmetric(
        base_external=(4.0, 0.0, heights[0]),
        base_internal=(2.0, 1.0, 0.0),
        platform_external=(2.0, 0.4, 0.0),
        platform_internal=(1.0, -0.5, heights[1]),
    )
    neutral = nd.Configuration.neutral(5.0, 3.0)
    return Robot(g, neutral, neutral.moved(np.zeros((1, 9))) if poses is None else poses, 1.0, PAIRS)


def least(robot, name, **limit):
    return float(margins(Limit(name, **limit), robot).min())


def test_every_limit_has_a_definition_and_is_stated():
    assert set(EVERY_LIMIT) == set(RULES) == set(ROWS)


def test_ratios_and_lengths_by_hand():
    r = robot()
    legs = nd.leg_lengths(r.geometry, r.neutral)
    assert least(r, "radius_ratio", high=3.0) == pytest.approx(1.0 - 2.0 / 3.0)
    assert least(r, "radius_ratio", low=1.5) == pytest.approx(2.0 / 1.5 - 1.0)
    assert least(r, "leg_ratio", high=3.0) == pytest.approx(1.0 - legs.max() / legs.min() / 3.0)
    assert least(r, "leg_ratio", low=1.2) == pytest.approx(legs.max() / legs.min() / 1.2 - 1.0)
    assert least(r, "zs_fraction", high=0.5) == pytest.approx(1.0 - 0.6 / 0.5)
    assert least(r, "height", low=4.0, high=6.0) == pytest.approx(1.0 - 5.0 / 6.0)
    assert least(r, "footprint", high=3.0) == pytest.approx(1.0 - 4.0 / 3.0)
    assert least(r, "lower_length", high=1.0, of="zp") == pytest.approx(1.0 - math.sqrt(13.0) / 5.0)
    assert least(r, "upper_length", low=2.0) == pytest.approx(math.sqrt(5.0) / 2.0 - 1.0)
    assert least(r, "external_length", high=9.0) == pytest.approx(1.0 - legs[0] / 9.0)
    assert least(r, "leg_length", low=1.0) == pytest.approx(legs.min() - 1.0)


def test_joints_by_hand():
    r = robot(heights=(0.8, -0.6))
    assert least(r, "joint_height", high=1.0) == pytest.approx(0.2)
    assert least(r, "joint_height", high=0.25, of="radius") == pytest.approx(1.0 - 0.8 / 4.0 / 0.25)
    flat = robot()
    apart = abs(4.0 - 2.0 * np.exp(1j * (1.0 + 0.0)))  # nearest joints of the base: 0 and 1 radian
    on_platform = abs(2.0 * np.exp(0.4j) - np.exp(-0.5j))
    assert least(flat, "joint_spacing", low=1.0) == pytest.approx(min(apart, on_platform) - 1.0)
    scaled = min(apart / 4.0, on_platform / 2.0)
    assert least(flat, "joint_spacing", low=0.1, of="radius") == pytest.approx(scaled / 0.1 - 1.0)


def test_strokes_by_hand():
    up = np.zeros((3, 9))
    up[1, 5], up[2, 5] = 0.5, -0.25  # the platform 0.5 up, 0.25 down; O stays
    r = robot(robot().neutral.moved(up))
    upper = np.sqrt(1.0 + np.array([2.0, 2.5, 1.75]) ** 2)
    legs = nd.leg_lengths(r.geometry, r.poses)
    assert legs[:, 3] == pytest.approx(upper)
    stroke = np.ptp(legs, axis=0).max()
    assert least(r, "stroke", high=1.0) == pytest.approx(1.0 - stroke)
    assert least(r, "stroke", high=0.2, of="zp") == pytest.approx(1.0 - stroke / 5.0 / 0.2)
    assert least(r, "stroke_ratio", high=2.0) == pytest.approx(1.0 - upper.max() / upper.min() / 2.0)


def test_cones_by_hand():
    r = robot()
    tilt = math.atan2(2.0, 3.0)  # of a lower internal leg from the vertical
    external = math.acos(5.0 / nd.leg_lengths(r.geometry, r.neutral)[0])
    found = cone(r, "base", (0.0, 0.0, 1.0)).reshape(2, 3)
    assert found[0] == pytest.approx([external] * 3)
    assert found[1] == pytest.approx([tilt] * 3)
    down = cone(r, "platform", (0.0, 0.0, -1.0)).reshape(2, 3)
    assert down[1] == pytest.approx([math.atan2(1.0, 2.0)] * 3)
    turned = robot().neutral.moved(np.array([[0.3, 0.0, 0.0, 0, 0, 0, 0, 0, 0]]))
    about_itself = cone(robot(turned), "platform", ())
    assert about_itself[3:].max() > 0.05  # O's direction turns in the platform's frame
    assert cone(robot(), "platform", ()) == pytest.approx(np.zeros(6))
    widest = max(tilt, external)
    assert least(r, "base_cone", high=0.5 * widest, axis=(0.0, 0.0, 1.0)) == pytest.approx(-1.0)
    assert least(r, "base_cone", high=0.5) == 1.0  # about the legs themselves


@pytest.mark.parametrize("seed", range(size(9, 30)))
def test_distance_of_segments_agrees_with_a_search(seed):
    rng = np.random.default_rng(seed)
    a, b, c, d = rng.normal(size=(4, 3))
    if seed % 3 == 0:
        d = c + (b - a) * rng.uniform(0.2, 2.0)  # parallel

    def apart(x):
        return float(np.sum((a + x[0] * (b - a) - c - x[1] * (d - c)) ** 2))

    best = min(
        minimize(apart, start, bounds=[(0, 1), (0, 1)], options={"ftol": 1e-15, "gtol": 1e-12}).fun
        for start in ([0, 0], [1, 0], [0, 1], [1, 1], [0.5, 0.5])
    )
    found = float(between_segments(a, b, c, d))
    assert found == pytest.approx(math.sqrt(best), abs=2e-6)


def test_determinants_change_sign_through_a_singularity():
    """O crosses the plane of the base: det B changes sign, det C does not."""
    down = np.zeros((1, 9))
    down[0, 8] = -4.0
    r = robot(robot().neutral.moved(down))
    b, c, _ = determinants(r, 4)[3:].reshape(4, 3).T
    start = determinants(r, 4)[:3]
    assert np.all(start > 0.0)
    assert np.all(b[:2] > 0.0)
    assert abs(b[2]) < 1e-12  # three quarters of the way: O lies in the plane
    assert b[3] < 0.0
    assert np.all(c > 0.0)
    assert least(r, "singularity_free", low=1e-3) < -0.01
    assert least(robot(), "singularity_free", low=1e-3) == pytest.approx(start.min() - 1e-3)


@pytest.mark.parametrize("name", ["radius_ratio", "leg_ratio", "height", "footprint", "stroke_ratio", "stroke"])
def test_value_at_is_the_least_limit_that_allows_the_design(name):
    up = np.zeros((2, 9))
    up[1, 5] = 0.5
    r = robot(robot().neutral.moved(up))
    value = measured(Limit(name, high=1.0), r)
    assert least(r, name, high=value) == pytest.approx(0.0, abs=1e-12)
