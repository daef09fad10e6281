"""Numbers of a design by the rules of its study: how O moves, at which poses, on which sides."""

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
    sheet = result.sheet()
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
