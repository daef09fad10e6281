"""Tolerances for an error that is allowed: the inverse of the accuracy of a machine."""

from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd

STUDY = nd.Study(
    family="symmetric",
    constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)},
    objective={"region": {"box": [0.3, 0.3, 0.2], "tilt_deg": 8}},
    characteristic_length=1.0,
    starts=2,
)
OTHERS = nd.Tolerances(joints=5e-4, legs=7e-4)  # of the study, and not of this question


@pytest.fixture(scope="module")
def result():
    return replace(nd.optimize(STUDY), study=replace(STUDY, tolerances=OTHERS))


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize(("weights", "share"), [((3, 1), 0.75), ((0, 1), 0.0)])
def test_each_group_makes_its_part_of_the_error(result, weights, share):
    kept = nd.tolerances_for(result, position=0.01, weights=weights)
    apart = (kept.joints, 0.0), (0.0, kept.legs)
    joints, legs = (result.sheet(joint_errors=a, leg_errors=b).accuracy.position.value for a, b in apart)
    assert joints == pytest.approx(share * 0.01, rel=1e-9, abs=1e-15)
    assert legs == pytest.approx((1.0 - share) * 0.01, rel=1e-9, abs=1e-15)


@pytest.mark.slow(sanitized=True)
def test_no_pose_of_the_region_errs_by_more(result):
    """At random poses of the region, by the bounds at each."""
    kept = nd.tolerances_for(result, position=0.01, rotation=np.radians(0.3))
    rng, home = np.random.default_rng(3), result.configuration
    worst = np.zeros(2)
    for _ in range(400):
        turn, heading = np.radians(8.0) * np.sqrt(rng.uniform()), rng.uniform(0.0, 2.0 * np.pi)
        tilt, shift = turn * np.array([np.cos(heading), np.sin(heading), 0.0]), rng.uniform(-1, 1, 3) * [0.3, 0.3, 0.2]
        tangent = np.concatenate([tilt, shift, shift])
        bounds = nd.error_bounds(result.geometry, home.moved(tangent), kept.legs, kept.joints)
        worst = np.maximum(worst, [bounds.position / 0.01, bounds.rotation / np.radians(0.3)])
    assert worst.max() <= 1.0
    assert worst.max() > 0.8


def test_a_design_of_a_file_has_its_neutral_pose():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    design = nd.Design(g, nd.Configuration.neutral(3.9828, 2.4432), 1.0)
    kept = nd.tolerances_for(design, position=0.01)
    assert nd.error_bounds(design, kept.legs, 0.0).position == pytest.approx(0.005, rel=1e-9)
    assert nd.error_bounds(design, 0.0, kept.joints).position == pytest.approx(0.005, rel=1e-9)


def test_a_singular_pose_has_no_tolerance():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    with pytest.raises(ValueError, match="singular pose"):
        nd.tolerances_for(nd.Design(g, nd.Configuration.neutral(3.9828, 0.0)), position=0.1)
