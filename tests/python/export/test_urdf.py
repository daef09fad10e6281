"""The URDF tree in MuJoCo and in yourdfpy: with the loops of its table closed it has the poses of the robot."""

import json
import warnings

import exported
import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd

DESIGNS = {"machine in mm": (exported.machine, 1e-3, 40.0), "general, no unit": (exported.general, 1.0, 0.1)}


@pytest.fixture(params=DESIGNS)
def robot(request, tmp_path):
    """The design, metres of its unit, poses, the file, and its table."""
    make, metre, size = DESIGNS[request.param]
    file = nd.export(make(), "urdf", tmp_path / "robot.urdf")
    table = json.loads((tmp_path / "robot.loops.json").read_text())
    return make(), metre, exported.path(make(), size), file, table


def in_yourdfpy(file):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the packages behind it
        yourdfpy = pytest.importorskip("yourdfpy")
        tree = yourdfpy.URDF.load(str(file), load_meshes=False, build_scene_graph=True)
    assert tree.validate()
    return tree


def closed(engine, data, table, lengths):
    """Close the loops at given leg lengths by Newton's method, from where the tree stands."""
    import mujoco

    def point(link, at):
        body = engine.body(link).id
        place = data.xpos[body] + data.xmat[body].reshape(3, 3) @ at
        slopes = np.zeros((3, engine.nv))
        mujoco.mj_jac(engine, data, slopes, None, place, body)
        return place, slopes

    slides = [engine.joint(leg["joint"]).qposadr[0] for leg in table["legs"]]
    neutral = np.array([leg["length_at_zero"] for leg in table["legs"]])
    for _ in range(12):
        mujoco.mj_forward(engine, data)
        rows, gaps = [np.eye(engine.nv)[slides]], [data.qpos[slides] + neutral - lengths]
        for loop in table["loops"]:
            ends = [point(loop[f"link_{k}"], np.array(loop[f"point_{k}"])) for k in (1, 2)]
            gaps.append(ends[0][0] - ends[1][0])
            rows.append(ends[0][1] - ends[1][1])
        step = np.linalg.solve(np.concatenate(rows), np.concatenate(gaps))
        data.qpos -= step
        if np.abs(step).max() < 1e-13:
            break
    mujoco.mj_forward(engine, data)
    assert max(np.abs(gap).max() for gap in gaps) < 1e-12


def test_the_tree_with_its_loops_closed_has_the_poses_of_the_robot(robot):
    """Thirty joints, thirty equations: 21 of loops and nine lengths. Two programs place the platform there."""
    mujoco = pytest.importorskip("mujoco")
    design, metre, path, file, table = robot
    engine = mujoco.MjModel.from_xml_path(str(file))
    assert (engine.nv, len(table["loops"]), len(table["legs"])) == (30, 7, 9)
    data, tree = mujoco.MjData(engine), in_yourdfpy(file)
    for target in path:
        closed(engine, data, table, nd.leg_lengths(design.geometry, target) * metre)
        joints = {engine.joint(k).name: data.qpos[k] for k in range(30)}
        tree.update_cfg(joints)
        assert set(tree.actuated_joint_names) == set(joints)
        for name, at, turned in [
            ("platform", target.position, target.rotation),
            ("O", target.internal_point, None),
        ]:
            placement = tree.get_transform(name, "base")
            assert_allclose(data.body(name).xpos, at * metre, rtol=0.0, atol=1e-12)
            assert_allclose(placement[:3, 3], at * metre, rtol=0.0, atol=1e-12)
            if turned is not None:
                assert_allclose(data.body(name).xmat.reshape(3, 3), turned, rtol=0.0, atol=1e-12)
                assert_allclose(placement[:3, :3], turned, rtol=0.0, atol=1e-12)


def test_all_joints_at_zero_is_the_neutral_configuration_and_limits_are_about_it(robot):
    design, metre, _, file, table = robot
    tree, c = in_yourdfpy(file), design.configuration
    assert_allclose(tree.get_transform("platform", "base")[:3, :3], c.rotation, rtol=0.0, atol=1e-14)
    for name, at in {"platform": c.position, "O": c.internal_point}.items():
        assert_allclose(tree.get_transform(name, "base")[:3, 3], at * metre, rtol=0.0, atol=1e-14)
    lengths = [leg["length_at_zero"] for leg in table["legs"]]
    assert_allclose(lengths, nd.leg_lengths(design.geometry, c) * metre, rtol=1e-14)
    for loop in table["loops"]:
        one, two = (tree.get_transform(loop[f"link_{k}"], "base") @ [*loop[f"point_{k}"], 1.0] for k in (1, 2))
        assert_allclose(one, two, rtol=0.0, atol=1e-14)
    for leg in table["legs"]:
        limit = tree.joint_map[leg["joint"]].limit
        ends = [leg["shortest"] - leg["length_at_zero"], leg["longest"] - leg["length_at_zero"]]
        assert_allclose([limit.lower, limit.upper], ends, rtol=0.0, atol=1e-15)
        assert limit.lower < 0.0 < limit.upper
