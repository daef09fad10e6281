"""Regions of poses: entries, files, the poses of their coordinates. Studies are in optimize/test_region_study.py."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from region_oracle import random_poses
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof import _core

REGIONS = {
    "box": nd.Region(box=(0.1, 0.0, 0.3), tilt=0.3, yaw=0.2),
    "ball": nd.Region(ball=0.4, tilt=0.1, unit="zp", internal_point="held"),
    "cylinder": nd.Region(cylinder=(0.2, 0.1), yaw=1.0),
    "path": nd.Region(path=((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.0)), tilt=0.2),
    "turns alone": nd.Region(tilt=0.5, yaw=0.5),
    "best O": nd.Region(box=(0.1, 0.1, 0.0), tilt=0.1, internal_point="best"),
}
EVERY = pytest.mark.parametrize("region", REGIONS.values(), ids=REGIONS)


@EVERY
def test_a_file_gives_the_same_region(region, tmp_path):
    study = nd.Study(objective={"region": region})
    study.save(tmp_path / "study.toml")
    assert nd.Study.load(tmp_path / "study.toml").objective.region == region
    assert nd.Region.from_dict(region.to_dict()) == region


@EVERY
def test_poses_of_coordinates(region):
    rng = np.random.default_rng(1)
    for _ in range(20):
        at = 1.5 * np.array(region.reach) * rng.uniform(-1.0, 1.0, 6)
        position, rotation, internal = _core.region_poses(region.for_core(), [at])[0, 6:].reshape(3, 3)
        turn = Rotation.from_rotvec(rotation)
        tilted = math.acos(np.clip(turn.as_matrix()[2, 2], -1.0, 1.0))
        assert tilted <= region.tilt + 1e-7
        assert_allclose(internal, position if region.internal_point == "shifted" else 0.0 * position)
        if region.ball is not None:
            assert np.linalg.norm(position) <= region.ball * (1.0 + 1e-12)
        if region.cylinder is not None:
            assert np.linalg.norm(position[:2]) <= region.cylinder[0] * (1.0 + 1e-12)
        if region.path is not None:
            assert min(abs(position[1]), abs(position[0] - 1.0)) <= 1e-12
        inside = 0.5 * np.array(region.reach) * rng.uniform(-1.0, 1.0, 6)
        expected = Rotation.from_rotvec([*inside[3:5], 0.0]) * Rotation.from_rotvec([0.0, 0.0, inside[5]])
        found = Rotation.from_rotvec(_core.region_poses(region.for_core(), [inside])[0, 9:12])
        assert (found * expected.inv()).magnitude() < 1e-12


@EVERY
def test_random_poses_are_in_the_region(region):
    reach = np.array(region.reach)
    for pose in random_poses(region, 200, np.random.default_rng(2)):
        turn = Rotation.from_rotvec(pose.rotation)
        assert math.acos(np.clip(turn.as_matrix()[2, 2], -1.0, 1.0)) <= region.tilt + 1e-7
        if region.path is None:
            assert (np.abs(pose.position) <= reach[:3] * (1.0 + 1e-12)).all()


def test_the_objective_has_defaults_for_its_region():
    table = {"internal_point": "held", "unit": "zp", "region": {"ball": 0.1}}
    assert nd.Objective.from_dict(table).region == nd.Region(ball=0.1, internal_point="held", unit="zp")
    own = table | {"region": {"ball": 0.1, "internal_point": "best"}}
    assert nd.Objective.from_dict(own).region == nd.Region(ball=0.1, internal_point="best", unit="zp")
    shifted = table | {"internal_point": [0.0, 0.0, 0.1]}
    assert nd.Objective.from_dict(shifted).region == nd.Region(ball=0.1, unit="zp")
