"""Objectives, poses and sets of poses: what they are. What they refuse is in test_bad_entries.py."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof import poses

INF = math.inf


def positions(found):
    return np.array([pose.position for pose in found])


# --- Pose -------------------------------------------------------------------------------------------------------------


def test_the_neutral_pose_is_the_default():
    assert nd.Pose() == nd.Pose((0, 0, 0), np.zeros(3), [0, 0, 0], "length")
    assert nd.Pose().to_dict() == {}
    neutral = nd.Pose().for_core()
    assert not np.any([neutral.position, neutral.rotation, neutral.internal])
    assert (neutral.best_internal, neutral.in_zp, neutral.weight) == (False, False, 1.0)


def test_numbers_of_any_kind_become_floats():
    pose = nd.Pose(np.array([1, 2, 3], dtype=np.int32), (np.float32(0.5), 0, 1), [0, np.int8(1), 0], "zp")
    assert (pose.position, pose.rotation, pose.internal_point) == ((1.0, 2.0, 3.0), (0.5, 0.0, 1.0), (0.0, 1.0, 0.0))
    assert {type(x) for v in (pose.position, pose.rotation, pose.internal_point) for x in v} == {float}
    assert len({pose, pickle.loads(pickle.dumps(pose))}) == 1


def test_best_internal_point_has_no_shift():
    for point, shift, best in (("best", [0, 0, 0], True), ((1, 0, 0), [1, 0, 0], False)):
        pose = nd.Pose(internal_point=point).for_core()
        assert (list(pose.internal), pose.best_internal) == (shift, best)


# --- Sets -------------------------------------------------------------------------------------------------------------


def test_box():
    found = positions(poses.box((0.1, 0.2, 0.3)))
    assert len({*map(tuple, found)}) == 27
    assert_allclose(np.abs(found).max(axis=0), [0.1, 0.2, 0.3])
    assert set(found[:, 0]) == {-0.1, 0.0, 0.1}
    assert len(poses.box((0.1, 0.0, 0.3))) == 9
    assert poses.box((0, 0, 0)) == (nd.Pose(),)
    assert set(positions(poses.box((1, 0, 0), points=2))[:, 0]) == {-1.0, 1.0}
    assert set(positions(poses.box((1, 0, 0), points=5))[:, 0]) == {-1.0, -0.5, 0.0, 0.5, 1.0}
    assert poses.box((1, 1, 1), points=1) == (nd.Pose(),)


def test_grids_are_exactly_symmetric():
    for points in range(2, 30):
        found = positions(poses.box((0.1, 0, 0), points=points))[:, 0]
        assert np.array_equal(found, -found[::-1])


def test_tilts_are_at_the_centre_one_axis_at_a_time():
    tilted = poses.box((0.1, 0, 0), tilt_deg=(10, 0, 5))[3:]
    ten, five = math.radians(10), math.radians(5)
    assert [p.rotation for p in tilted] == [(ten, 0, 0), (-ten, 0, 0), (0, 0, five), (0, 0, -five)]
    assert {p.position for p in tilted} == {(0.0, 0.0, 0.0)}
    assert tilted == poses.ball(1.0, points=2, tilt=(ten, 0, five))[2:]


def test_ball_is_filled_evenly():
    found = positions(poses.ball(2.0, points=1001))
    distance = np.linalg.norm(found, axis=1)
    assert np.array_equal(found[0], np.zeros(3))
    assert distance.max() == pytest.approx(2.0)
    assert (distance < 1.0).mean() == pytest.approx(1 / 8, abs=2e-3)  # an eighth of the volume
    octants = np.unique(found[1:] > 0.0, axis=0, return_counts=True)[1]
    assert octants == pytest.approx(125, abs=8)
    assert poses.ball(1.0, points=1) == (nd.Pose(),)
    assert len(poses.ball(1.0)) == 33
    assert poses.ball(0.0, points=2) == (nd.Pose(), nd.Pose())


def test_path_is_even_in_arc_length():
    found = positions(poses.path([[0, 0, 0], [1, 0, 0], [1, 3, 0]], points=9))
    assert_allclose(np.linalg.norm(np.diff(found, axis=0), axis=1), 0.5)
    assert_allclose(found[[0, 2, -1]], [[0, 0, 0], [1, 0, 0], [1, 3, 0]])
    assert len(poses.path([[0, 0, 0], [1, 0, 0]])) == 17


def test_path_turns_between_its_corners():
    turned = poses.path([[0, 0, 0], [1, 0, 0], [1, 1, 0]], rotations_deg=[[0, 0, 0], [0, 20, 0], [0, 20, 30]], points=5)
    assert_allclose(np.degrees([p.rotation for p in turned])[[1, 3]], [[0, 10, 0], [0, 20, 15]])
    in_place = poses.path([[0, 0, 1]] * 2, rotations=[[0, 0, 0], [0, 0, 1]], points=3)
    assert [p.rotation[2] for p in in_place] == [0.0, 0.5, 1.0]


def test_unit_and_internal_point_apply_to_the_whole_set():
    same = {"unit": "zp", "internal_point": "best"}
    for found in (
        poses.box((0.1, 0.1, 0.1), tilt_deg=(1, 1, 1), **same),
        poses.ball(0.1, tilt_deg=(1, 1, 1), **same),
        poses.path([[0, 0, 0], [1, 0, 0]], **same),
    ):
        assert {(p.unit, p.internal_point) for p in found} == {("zp", "best")}


# --- Objective --------------------------------------------------------------------------------------------------------


def test_the_default_is_the_neutral_condition_number():
    assert nd.Study().objective == nd.Objective()
    assert nd.Objective().to_dict() == {"index": "condition_number"}
    assert nd.Objective().words == "condition number"
    assert nd.Objective().for_core().condition_limit == INF


def test_an_objective_is_a_value():
    one = nd.Objective(index="speed", condition_limit=10, poses=[{"position": [1, 0, 0]}, nd.Pose()])
    assert one.poses == (nd.Pose((1, 0, 0)), nd.Pose())
    assert one == nd.Objective.from_dict(one.to_dict()) == pickle.loads(pickle.dumps(one))
    assert len({one, nd.Objective.from_dict(one.to_dict())}) == 1
    with pytest.raises(AttributeError):
        one.index = "frobenius"


def test_the_objective_has_defaults_for_its_region():
    table = {"internal_point": "held", "unit": "zp", "region": {"ball": 0.1}}
    assert nd.Objective.from_dict(table).region == nd.Region(ball=0.1, internal_point="held", unit="zp")
    own = table | {"region": {"ball": 0.1, "internal_point": "best"}}
    assert nd.Objective.from_dict(own).region == nd.Region(ball=0.1, internal_point="best", unit="zp")
    shifted = table | {"internal_point": [0.0, 0.0, 0.1]}
    assert nd.Objective.from_dict(shifted).region == nd.Region(ball=0.1, unit="zp")


def test_an_infinite_condition_limit_is_none():
    assert nd.Objective(condition_limit=INF, neutral_condition_limit=INF) == nd.Objective()


def test_a_limit_on_the_neutral_condition_number_alone():
    study = nd.Study(
        "symmetric",
        constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)},
        objective={"poses": [{"position": [0.3, 0.1, 0.2], "unit": "zp"}, {"rotation_deg": [0, 20, 0]}]},
        starts=6,
    )
    free = nd.optimize(study).best
    limit = 0.5 * (2.3430924 + free.neutral_condition_number)
    objective = replace(study.objective, neutral_condition_limit=limit)
    found = nd.optimize(replace(study, objective=objective)).best
    assert limit < free.neutral_condition_number
    assert found.neutral_condition_number == pytest.approx(limit, rel=1e-8)
    assert found.active.count("condition_limit at neutral") == 1
    assert found.objective > free.objective
    # The margin and its gradient, by the number that the point itself has.
    tight = replace(study, objective=objective, constraints={})
    at = {name: value * (1.0 + 0.01 * k) for k, (name, value) in enumerate(free.variables.items())}

    def margin(variables):
        return 1.0 - tight.evaluate(variables).neutral_condition_number / limit

    point = tight.evaluate(at)
    assert point.margins == {"condition_limit at neutral": pytest.approx(margin(at), abs=1e-13)}
    for name, slope in point.margin_gradients["condition_limit at neutral"].items():
        h = 1e-5
        up, down = (margin(at | {name: at[name] + way * h}) for way in (1, -1))
        assert slope == pytest.approx((up - down) / (2 * h), abs=1e-7)
