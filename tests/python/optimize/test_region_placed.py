"""Studies over a region with O placed at every pose.

Oracle: poses drawn in numpy, and O placed at each by a search of its own, in region_oracle.py.
"""

import re
from dataclasses import replace
from functools import cache

import pytest
from region_oracle import worst_placed
from sizes import size

import ninedof as nd

TURNS = nd.Study(
    constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 2.5)},
    objective={"index": "frobenius", "region": {"tilt_deg": 20, "internal_point": "best"}},
    starts=1,
)
BOX = nd.Study(
    "symmetric",
    constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0), "stroke": {"max": 0.4, "of": "zp"}},
    objective={"region": {"box": [0.1, 0.1, 0.1], "tilt_deg": 5, "unit": "zp", "internal_point": "best"}},
    starts=1,
)
LINE = nd.Study(
    constraints={"radius_ratio": (None, 2.0), "stroke_ratio": (None, 1.3)},
    objective={
        "index": "speed",
        "condition_limit": 6.0,
        "region": {"path": [[0, 0, 0], [0.3, 0, 0]], "unit": "zp", "internal_point": "best"},
    },
    starts=1,
)
LENGTHS = {
    **dict.fromkeys(("base_external_radius", "base_internal_radius"), (50.0, 500.0)),
    **dict.fromkeys(("platform_external_radius", "platform_internal_radius"), (30.0, 200.0)),
    "zp": (300.0, 700.0),
    "zs": (50.0, 650.0),
}
MACHINE = nd.Study(
    "symmetric",
    characteristic_length=150.0,
    variables=LENGTHS,
    constraints={"stroke_ratio": (None, 1.6), "leg_clearance": (20.0, None)},
    objective={"region": {"box": [50.0, 50.0, 50.0], "tilt_deg": 10.0, "internal_point": "best"}},
    starts=4,
)
STUDIES = {"line": LINE, "turns": TURNS, "box": BOX, "machine": MACHINE}


def with_rule(study, rule):
    region = replace(study.objective.region, internal_point=rule)
    return replace(study, objective=replace(study.objective, region=region))


@cache
def solved(name, rule="best"):
    return nd.optimize(with_rule(STUDIES[name], rule))


@pytest.mark.slow
@pytest.mark.parametrize("name", STUDIES)
def test_limits_hold_between_the_poses(name):
    result = solved(name)
    assert result.status == "optimal"
    assert result.region.margin >= -1e-7
    assert result.region.objective <= result.objective * (1.0 + 3e-7)
    found = nd.check(result, perturbations=0, seed=7)["region"]
    assert found.passed, found.sentence
    index, margin = worst_placed(result.study, result.best, result.region, size(300, 1000), 7)
    assert index <= result.objective * (1.0 + 1e-6)
    assert margin >= -1e-6


@pytest.mark.slow
@pytest.mark.parametrize("name", ["line", "turns", "box"])
def test_the_index_is_at_most_that_of_the_other_rules(name):
    for rule in ("shifted", "held"):
        assert solved(name).objective <= solved(name, rule).objective * (1.0 + 1e-6)


@pytest.mark.slow
def test_a_run_is_read_back(tmp_path):
    result = solved("line")
    assert nd.load(nd.save(result, tmp_path / "run")) == result
    assert "placing O is permitted leg lengths from" in result.summary()
    assert "with O placed at every pose" in result.summary()


@pytest.mark.slow
def test_an_impossible_region_is_infeasible():
    region = {"ball": 20.0, "internal_point": "best"}
    study = nd.Study(constraints={"leg_ratio": (None, 1.01)}, objective={"region": region}, starts=1)
    result = nd.optimize(study)
    assert (result.status, result.best, result.region) == ("infeasible", None, None)
    assert re.search(r"at the poses neutral, neutral shifted by \([^()]+\),", result.reason)
    assert "turned" not in result.reason  # the ball has no tilts
    # A warm start has the variables of the study, and none for O at the poses.
    warm = {"a1": 0.0, "a2": 5.0, "b1": 3.0, "b2": 0.0, "zp": 4.0, "zs": 2.0, "theta_z": 0.0}
    assert nd.optimize(study, warm=[warm]).status == "infeasible"


def test_poses_that_exclude_a_design_are_named_with_their_turns():
    region = {"ball": 20.0, "tilt_deg": 10.0}
    study = nd.Study(constraints={"leg_ratio": (None, 1.01)}, objective={"region": region}, starts=1)
    assert re.search(r"neutral shifted by \([^()]+\) and turned \([^()]+\)°", nd.optimize(study).reason)
