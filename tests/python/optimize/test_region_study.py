"""Studies over a region: no limit is violated at poses that the solver did not choose.

Oracle: poses drawn and limits evaluated in numpy, by region_oracle.py. `check`, the search of the core, is no better.
"""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from interrupts import InterruptedPhase
from region_oracle import random_poses, worst_at_random
from sizes import size

import ninedof as nd
from ninedof.design.domains.region_poses import posed

UPRIGHT = {"axis": [0.0, 0.0, 1.0]}
STUDIES = {
    "box, strokes": nd.Study(
        "symmetric",
        constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0), "stroke_ratio": (None, 1.5)},
        objective={"region": {"box": [0.1, 0.1, 0.1], "tilt_deg": 10, "unit": "zp"}},
        starts=2,
    ),
    "ball, held": nd.Study(
        constraints={"radius_ratio": (None, 2.0), "stroke": {"max": 0.5, "of": "zp"}},
        objective={"region": {"ball": 0.15, "tilt_deg": 15, "unit": "zp", "internal_point": "held"}},
        starts=2,
    ),
    "cylinder, speed": nd.Study(
        "symmetric",
        constraints={"radius_ratio": (None, 2.0), "leg_length": {"min": 0.3, "of": "zp"}},
        objective={
            "index": "speed",
            "condition_limit": 6.0,
            "region": {"cylinder": [0.2, 0.1], "yaw_deg": 20, "unit": "zp"},
        },
        starts=2,
    ),
    "path, cones": nd.Study(
        "symmetric_nonplanar",
        constraints={
            "radius_ratio": (None, 2.0),
            "leg_ratio": (None, 3.0),
            "joint_height": {"max": 0.3, "of": "radius"},
            "base_cone": {"max_deg": 50} | UPRIGHT,
            "leg_clearance": {"min": 0.02, "of": "zp"},
            "singularity_free": {},
        },
        objective={"region": {"path": [[0, 0, 0], [0.2, 0.1, 0], [0.2, 0.2, 0.2]], "tilt_deg": 5, "unit": "zp"}},
        starts=2,
    ),
    "turns, frobenius": nd.Study(
        constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 2.5)},
        objective={"index": "frobenius", "region": {"tilt_deg": 20, "yaw_deg": 20}},
        starts=2,
    ),
    "natural length, flat": nd.Study(
        "symmetric",
        constraints={"radius_ratio": (None, 2.5), "stroke_ratio": (None, 1.4), "zs_fraction": (0.2, 0.8)},
        objective={"region": {"box": [0.2, 0.2, 0.0], "unit": "zp", "internal_point": "held"}},
        characteristic_length="natural",
        starts=2,
    ),
    "limit on the condition number": nd.Study(
        constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)},
        objective={"index": "frobenius", "condition_limit": 4.2, "region": {"ball": 0.1, "tilt_deg": 5, "unit": "zp"}},
        starts=2,
    ),
    "mean, one variable": nd.Study(
        variables={"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": (0.5, 3.5)},
        constraints={"leg_ratio": (None, 2.4)},
        objective={"index": "frobenius", "aggregate": "mean_inverse", "region": {"ball": 0.3, "tilt_deg": 15}},
        starts=1,
    ),
    "worst and mean, path": nd.Study(
        constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)},
        objective={
            "aggregate": "weighted",
            "region": {"path": [[0, 0, 0], [0.2, 0, 0], [0.2, 0.2, 0.1]], "yaw_deg": 10, "unit": "zp"},
        },
        starts=2,
    ),
    "any joints": nd.Study(
        "general",
        variables={"base_external_1_x": (-3, 3), "platform_external_1_y": (-3, 3), "zp": (2, 8), "zs": (0.5, 6)},
        constraints={"leg_ratio": (None, 3.0), "stroke_ratio": (None, 1.6)},
        objective={"region": {"ball": 0.2, "tilt_deg": 8, "yaw_deg": 8}},
        starts=2,
    ),
}
HUGE = 10**5  # starts: minutes of work


@cache
def solved(name):
    return nd.optimize(STUDIES[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", STUDIES)
def test_limits_hold_between_the_poses(name):
    result = solved(name)
    assert result.status == "optimal", result.reason
    assert result.region.margin >= -1e-7
    assert 0.0 <= result.region.gain <= 1e-6
    worst = max(result.conditions) if result.study.objective.aggregate == "weighted" else result.objective
    if result.study.objective.aggregate != "mean_inverse":
        assert result.region.objective <= worst * (1.0 + 3e-7)
    assert result.region.looked_at >= 100_000
    report = nd.check(result, perturbations=size(200, 2000), seed=size(1, 7))
    assert report.passed, report.report()
    index, margin = worst_at_random(result.study, result.variables, 4000, size(1, 7))
    assert margin >= -1e-6
    if result.study.objective.aggregate != "mean_inverse":
        assert index <= worst * (1.0 + 1e-6)
    assert report["region"].figure >= -margin - 1e-9  # it was searched for, and not only drawn


@pytest.mark.slow
def test_what_a_dear_limit_gains_is_not_left_over():
    """Near the least stroke that a design can keep 1e-8 of it changes the condition number by 1e-6."""
    study = nd.Study(
        "symmetric",
        variables={
            "zp": (3.0, 6.0),
            "zs": (0.5, 5.5),
            "platform_external_radius": (1.8, 2.2),
            "base_external_radius": 5.0,
        },
        constraints={"stroke_ratio": (None, 1.28)},
        objective={"region": {"box": [0.5, 0.5, 0.5], "tilt_deg": 10}},
        characteristic_length=1.5,
        starts=4,
    )
    result = nd.optimize(study)
    assert result.status == "optimal"
    assert result.best.prices["stroke_ratio"] > 20.0
    assert 0.0 <= result.region.gain <= 1e-7


@pytest.mark.slow
def test_check_finds_a_wrong_mean():
    result = solved("mean, one variable")
    average = result.region.mean
    assert average.nodes >= 64
    assert abs(average.value - average.quadrature) <= average.error <= 2e-3 * average.value
    wrong = replace(average, value=average.value * 1.01)
    report = replace(result.region, mean=wrong)
    assert not nd.check(replace(result, region=report), perturbations=0)["region"].passed


@pytest.mark.slow
def test_a_mean_is_stated_as_it_is_at_poses_that_the_optimizer_did_not_use():
    """Oracle: the condition numbers of poses drawn in numpy, with a standard error of their own."""
    result = solved("mean, one variable")
    average = result.region.mean
    assert result.objective == pytest.approx(average.value, rel=1e-14)
    assert average.value != average.quadrature
    assert average.standard_error < 0.5 * average.error
    there = posed(result.study, random_poses(result.study.objective.region, 9000, np.random.default_rng(12), 0.0))
    c = there.evaluate(result.variables).configurations[1:]
    inverse = 1.0 / nd.condition_number(result.geometry, c, result.characteristic_length, norm="frobenius")
    mean = 1.0 / inverse.mean()
    error = mean**2 * inverse.std() / len(inverse) ** 0.5
    assert abs(mean - result.objective) < 3.0 * np.hypot(error, average.standard_error)
    assert nd.check(result, perturbations=0).passed
    assert f"{average.value:.6f}, standard error" in result.region.words
    assert replace(result.study.objective, aggregate="weighted", weight=0.25).mean_share == 0.75


@pytest.mark.slow
def test_a_result_is_read_back(tmp_path):
    result = solved("turns, frobenius")
    assert nd.load(nd.save(result, tmp_path / "run")) == result
    assert "of the region ruled" in result.summary()


@pytest.mark.slow
@pytest.mark.parametrize("search", ["round 1, ", "round 2, "])
def test_an_interruption_keeps_the_best_design(search):
    """Ctrl-C before the first round and the second: the design of the last one that was solved."""
    study = STUDIES["turns, frobenius"]
    bar = InterruptedPhase(search)
    result = nd.optimize(study, progress=bar)
    assert (result.status, result.interrupted) == ("stopped", True)
    assert bar.phases[-1].startswith(search)
    there = nd.optimize(posed(study, first_poses(study.objective.region)))
    assert result.objective == pytest.approx(there.objective, rel=1e-9)
    assert result.words in result.summary()
    assert f"over {len(result.region.poses)} poses of the neutral position, tilts" in result.words
    if search == "round 1, ":
        assert result.region.looked_at == 0
        assert math.isinf(result.region.gain)
        assert "not looked at" in result.summary()
    else:
        assert result.reason.startswith("ended in round 2; the best so far at the poses imposed")
        assert result.region.looked_at > 4000
        assert 0.0 < result.region.gain < 1.0
        assert result.region.margin < -1e-7


def first_poses(region):
    """The poses at which a study is solved before it is searched over its region."""

    def stop(done, total, best):
        if math.isfinite(best):
            raise KeyboardInterrupt

    study = nd.Study(constraints={"radius_ratio": (None, 2.0)}, objective={"region": region}, starts=HUGE)
    result = nd.optimize(study, progress=stop)
    assert result.region.looked_at == 0
    return result.region.poses


def test_corners_of_a_path_are_imposed_first():
    region = nd.Region(path=((1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 3.0, 0.0)))
    poses = [pose.position for pose in first_poses(region)]
    for corner in region.path:
        assert min(np.linalg.norm(np.subtract(corner, p)) for p in poses) < 1e-12


@pytest.mark.slow
def test_check_and_sheet_see_a_limit_on_the_condition_number():
    study = replace(
        STUDIES["turns, frobenius"],
        constraints={"radius_ratio": (None, 2.0)},
        objective={"index": "speed", "condition_limit": 6.0, "region": {"tilt_deg": 5}},
    )
    result = nd.optimize(study)
    tight = replace(study, objective=replace(study.objective, condition_limit=2.0))
    assert nd.check(result, perturbations=0)["region"].passed
    assert not nd.check(replace(result, study=tight), perturbations=0)["region"].passed
    row = next(row for row in result.sheet().limits if row.name == "condition_limit")
    assert row.value == pytest.approx(max(result.conditions), rel=1e-7)


def test_first_poses_are_in_the_region():
    """The corners about a ball or a cylinder are outside of it."""
    for region in (nd.Region(ball=2.0, tilt=0.1), nd.Region(cylinder=(1.0, 2.0), yaw=0.2), nd.Region(box=(1, 2, 3))):
        at = np.array([pose.position for pose in first_poses(region)])
        assert np.all(np.linalg.norm(at, axis=1) <= (2.0 if region.ball else 4.0) * (1 + 1e-12))
        if region.cylinder is not None:
            assert np.all(np.linalg.norm(at[:, :2], axis=1) <= 1.0 + 1e-12)
        assert len(at) >= 9


def test_a_mean_over_a_region_beside_a_listed_pose_of_no_weight():
    study = replace(STUDIES["mean, one variable"], starts=1)
    objective = replace(study.objective, poses=(nd.Pose((0.5, 0.0, 0.0), weight=0.0),))
    study = replace(study, objective=objective)
    point = study.evaluate({"zs": 2.4})
    assert point.condition_number > 1.0
