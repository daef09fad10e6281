"""Numbers of a design by the rules of its study: how O moves, at which poses, on which sides."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.design.design_point import DesignPoint
from ninedof.workspace.study_question import built_ranges, design_question

PLATES = {"a1": 0.0, "a2": 800.0, "b1": 290.0, "b2": 0.0, "zp": 480.0, "zs": 320.0, "theta_z": 0.0}
AWAY = {"position": [150.0, 0.0, 0.0]}


def machine(objective, constraints=None):
    study = nd.Study(
        variables=PLATES,
        unit="mm",
        characteristic_length=150.0,
        constraints=constraints or {},
        objective=objective,
        speeds={"linear": 100.0, "angular": 0.3},
    )
    return nd.optimize(study, starts=1)


@pytest.mark.parametrize(
    "objective",
    [
        {"region": {"tilt_deg": 5.0}, "poses": [{"position": [30.0, 0.0, 0.0]}]},
        {"region": {"box": [60.0, 60.0, 40.0], "yaw_deg": 10.0}},
        {"poses": [{}]},
        {"region": {"box": [20.0, 20.0, 20.0]}},
    ],
)
def test_speeds_of_the_sheet_are_those_that_the_limits_of_the_study_have(objective):
    result = machine(objective, {"upper_rate": (None, 1e4), "lower_rate": (None, 1e4)})
    sheet = result.sheet(samples=1000)
    assert sheet.motion.internal == result.study.leg_duty.internal
    for name, kind in (("upper_rate", "q"), ("lower_rate", "r")):
        (row,) = [row for row in sheet.limits if row.name == name]
        assert row.value == pytest.approx(max(leg.speed for leg in sheet.legs if leg.name[0] == kind), rel=1e-6)


def test_needed_and_permitted_lengths_hold_listed_poses_beside_a_region_and_no_other():
    beside = machine({"region": {"box": [20.0, 20.0, 20.0]}, "poses": [AWAY]}, {"stroke": (None, 400.0)})
    alone = machine({"poses": [AWAY, {"position": [200.0, 0.0, 0.0]}]}, {"stroke": (None, 60.0)})
    for result in (beside, alone):
        c = result.best.configurations[1 : 1 + len(result.study.objective.poses)]
        lengths = nd.leg_lengths(result.geometry, c)
        for actuators in ("needed", "permitted"):
            low, high = built_ranges(result, actuators)
            assert (low <= lengths).all()
            assert (lengths <= high).all()
    least, most = lengths.min(axis=0), lengths.max(axis=0)
    assert_allclose(built_ranges(alone, "needed"), [least, most], rtol=1e-6)
    assert_allclose(sum(built_ranges(alone, "permitted")), least + most, rtol=1e-6)


def test_a_least_spread_of_a_path_counts_at_its_end():
    study = nd.Study(variables=PLATES, unit="mm", characteristic_length=150.0, constraints={"leg_ratio": (2.75, None)})
    point = study.evaluate(PLATES)
    assert isinstance(point, DesignPoint)
    home = point.configurations[0]
    motion = nd.follow(point.geometry, nd.Trajectory.line(home, [150.0, 0.0, 0.0]), home)
    (row,) = [row for row in nd.path_limits(study, motion, home).limits if row.name == "leg_ratio"]
    lengths = nd.leg_lengths(point.geometry, motion.configurations)
    assert_allclose(row.value, lengths.max() / lengths.min())


def test_a_region_of_turns_alone_has_a_workspace_about_home():
    result = machine({"region": {"tilt_deg": 5.0}})
    low, high = design_question(result)[0]["box"]
    assert (np.asarray(low) < result.configuration.position).all()
    assert (result.configuration.position < np.asarray(high)).all()


@pytest.fixture(scope="module")
def two():
    """A result of two candidates of a study with loads, masses, a tool and a region."""
    study = nd.Study(
        variables=PLATES,
        unit="mm",
        characteristic_length=150.0,
        constraints={"base_cone": {"max_deg": 50.0}, "force": (None, 400.0), "leg_length": (200.0, 900.0)},
        objective={"region": {"box": [20.0, 20.0, 20.0]}},
        loads={"wrenches": [[0.0, 0.0, 0.0, 30.0, 0.0, 0.0]]},
        masses={"platform": 3.0, "rod": 0.2},
        speeds={"linear": 100.0},
        tolerances={"legs": 0.1},
        tool={"position": [0.0, 0.0, -100.0]},
    )
    result = nd.optimize(study, starts=1)
    return replace(result, candidates=(result.best, result.with_changes(zs="+4%").best))


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("k", [0, 1])
def test_a_candidate_says_what_its_result_says(two, k, tmp_path):
    result, candidate = replace(two, candidates=two.candidates[k:]), two.candidates[k]
    sheets = [nd.sheet(one) for one in (result, candidate)]
    assert str(sheets[0].to_dict()) == str(sheets[1].to_dict())
    assert sheets[1].stated == ("speeds", "loads", "tolerances", "masses")
    assert sheets[1].region.looked_at > 1000
    assert [row.name for row in sheets[1].limits] == ["base_cone", "force", "leg_length", "leg_length"]
    assert sheets[1].legs[0].permitted == (200.0, 900.0)
    payloads = [nd.largest_payload(one) for one in (result, candidate)]
    assert str(payloads[0].to_dict()) == str(payloads[1].to_dict())
    assert 0.0 < payloads[1].mass < np.inf
    for form in ("csv", "mjcf"):
        texts = [nd.export(one, form, tmp_path / "machine.x").read_text() for one in (result, candidate)]
        assert texts[0] == texts[1]
    assert nd.load(nd.export(candidate, "csv", tmp_path / "plates.csv")).geometry == result.study.tool.plates(
        candidate.geometry
    )
    spaces = [nd.workspace(one, tolerance=0.05) for one in (result, candidate)]
    assert spaces[0].volume == spaces[1].volume > 0.0
    assert str(nd.failure(result, pairs=False, samples=100).to_dict()) == str(
        nd.failure(candidate, pairs=False, samples=100).to_dict()
    )


@pytest.mark.slow(sanitized=True)
def test_a_design_point_knows_its_study(two):
    point = two.study.evaluate(two.variables)
    assert str(nd.sheet(point).limits) == str(two.sheet().limits)
    assert nd.largest_payload(point).mass == pytest.approx(nd.largest_payload(two).mass, rel=1e-6)
    assert point.permitted_lengths[1][0] == 900.0
    assert "study" not in repr(point)
    assert "study" not in repr(two.best)
    assert "study" not in two.best.to_dict()


def test_a_design_point_does_not_know_limits_that_compare_lengths_where_o_is_placed():
    region = {"box": [0.2, 0.2, 0.1], "internal_point": "best"}
    study = nd.Study(constraints={"stroke_ratio": (None, 3.0), "base_cone": (None, 1.2)}, objective={"region": region})
    point = study.evaluate({"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4, "theta_z": 0.0})
    assert [row.name for row in nd.sheet(point).limits] == ["base_cone"]
    assert built_ranges(point, "needed") is None


def test_candidates_are_of_the_study_of_their_result(two):
    other = replace(two, study=replace(two.study, masses={"platform": 9.0}))
    assert {one.study.masses.platform for one in other.candidates} == {9.0}
    assert two.best == other.best  # the same design
