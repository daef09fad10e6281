"""Comparison with a physics engine: lengths, rates, Jacobian and equilibrium poses of MuJoCo.

What the two share is in mujoco_models: where the joints are. MuJoCo finds lengths and moment arms from the sites on its
bodies, J' from the gradients of 27 constraints, and poses by waiting until the mechanism has come to rest.
"""

import mujoco_models as models
import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

mujoco = pytest.importorskip("mujoco")

ROUNDING = 1e-12
AT_REST = 1e-10  # of every velocity, in lengths and radians a second


def general(seed):
    """Twelve joints in general position: of a hundred robots the best conditioned."""
    robots = model.random_robots(np.random.default_rng(seed), 100)
    m = robots.at(int(np.argmin(model.condition_number(robots))))
    return m.geometry(), m.configuration()


ROBOTS = {
    "published": (nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0), nd.Configuration.neutral(3.9828, 2.3745)),
    "hexagonal": (nd.Geometry.hexagonal(0.7, 4.9, 2.6, 0.4), nd.Configuration.neutral(3.5, 2.0, 0.3)),
    "symmetric": (
        nd.Geometry.symmetric(
            base_external=(3.0, 0.0, 0.2),
            base_internal=(2.5, 0.9, -0.3),
            platform_external=(1.5, 1.1, -0.1),
            platform_internal=(1.8, 0.2, 0.4),
        ),
        nd.Configuration.neutral(4.0, 2.2, -0.2),
    ),
} | {f"general {seed}": general(seed) for seed in range(size(1, 3))}

EVERY_ROBOT = pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)


def loaded(xml):
    engine = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(engine)
    mujoco.mj_forward(engine, data)
    return engine, data


def pose(data):
    s, p, (w, x, y, z) = np.split(data.qpos[:10], [3, 6])
    return nd.Configuration(p, Rotation.from_quat([x, y, z, w]), s)


def assert_same_pose(result, expected, tolerance):
    for part in ("position", "rotation", "internal_point"):
        assert_allclose(getattr(result, part), getattr(expected, part), rtol=0.0, atol=tolerance, err_msg=part)


def nearby(robot, seed):
    """A pose nearby and far from singular ones, so that the path to it stays in the assembly mode."""
    g, c = robot
    target = c.moved(0.1 * np.random.default_rng(seed).normal(size=9))
    assert nd.condition_number(g, target) < 15.0
    return target


def settle(engine, data, lengths, seconds):
    assert models.settle(engine, data, lengths, seconds, AT_REST), f"still moving after {seconds} s: {data.qvel}"


# --- Legs as tendons --------------------------------------------------------------------------------------------------


def anywhere(rng, g, count):
    """Poses of any orientation and place, as far from the base as the robot is large."""
    reach = np.abs(g.base_external).max()
    p, s = reach * rng.normal(size=(2, count, 3))
    return nd.Configuration(p, model.random_rotations(rng, count), s)


def put(engine, data, c, velocity):
    """Place platform and O; `velocity` is omega, pdot, sdot in base axes, MuJoCo takes omega in platform axes."""
    omega, pdot, sdot = velocity
    x, y, z, w = Rotation.from_matrix(c.rotation).as_quat()
    data.qpos[:] = [*c.internal_point, *c.position, w, x, y, z]
    data.qvel[:] = [*sdot, *pdot, *(c.rotation.T @ omega)]
    mujoco.mj_forward(engine, data)


def rate_matrix(engine, data, c):
    """H of udot = H (omega, pdot, sdot): tendon velocities under nine unit velocities."""
    columns = []
    for unit in np.eye(9):
        put(engine, data, c, unit.reshape(3, 3))
        columns.append(data.ten_velocity.copy())
    return np.transpose(columns)


def scaled(g, c, scale):
    triples = (g.base_external, g.base_internal, g.platform_external, g.platform_internal)
    larger = nd.Configuration(scale * c.position, c.rotation, scale * c.internal_point)
    return nd.Geometry(*(scale * triple for triple in triples)), larger


@EVERY_ROBOT
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])  # below, MuJoCo takes a site so near its body's origin to be there
def test_lengths_and_rates_are_those_of_tendons(robot, scale):
    rng = np.random.default_rng(1)
    g, start = scaled(*robot, scale)
    engine, data = loaded(models.tendon_model(g, start))
    for c in anywhere(rng, g, 20):
        omega, pdot, sdot = rng.normal(size=(3, 3))
        motion = omega, scale * pdot, scale * sdot
        put(engine, data, c, motion)
        assert_allclose(nd.leg_lengths(g, c), data.ten_length, rtol=ROUNDING)
        assert_allclose(nd.inverse_velocity(g, c, *motion), data.ten_velocity, rtol=0.0, atol=ROUNDING * scale)


@EVERY_ROBOT
def test_jacobian_and_forward_velocity_undo_tendon_rates(robot):
    """Poses of any orientation, the nearly singular ones left out: there the rounding of any inverse grows."""
    g, _ = robot
    engine, data = loaded(models.tendon_model(*robot))
    poses = anywhere(np.random.default_rng(3), g, 120)
    poses = poses[nd.condition_number(g, poses) < 40.0]
    assert len(poses) >= 10
    lc = 0.7
    for c in poses:
        inverse = np.linalg.inv(rate_matrix(engine, data, c))
        expected = np.concatenate([lc * inverse[:3], inverse[3:6]])
        assert_allclose(nd.jacobian(g, c, lc), expected, rtol=0.0, atol=ROUNDING * np.abs(inverse).max())
        result = np.concatenate(nd.forward_velocity(g, c, np.eye(9)), axis=-1).T
        assert_allclose(result, inverse, rtol=0.0, atol=ROUNDING * np.abs(inverse).max())


@EVERY_ROBOT
def test_accelerations_are_differences_of_tendon_velocities(robot):
    """d/dt of H(t) v(t) along any path with the right velocity, by central differences with three steps, order h^6."""
    rng = np.random.default_rng(4)
    g, c = robot
    engine, data = loaded(models.tendon_model(g, c))
    velocity, acceleration = 0.3 * rng.normal(size=(2, 3, 3))
    put(engine, data, c, velocity)
    at, v = data.qpos.copy(), data.qvel.copy()
    put(engine, data, c, acceleration)  # omega and alpha turn into platform axes alike, since omega x omega = 0
    a = data.qvel.copy()

    def tendon_velocity(t):
        data.qpos[:], data.qvel[:] = at, v + t * a
        mujoco.mj_integratePos(engine, data.qpos, v, t)
        mujoco.mj_forward(engine, data)
        return data.ten_velocity.copy()

    h = 2e-3
    d1, d2, d3 = ((tendon_velocity(k * h) - tendon_velocity(-k * h)) / (2 * k * h) for k in (1, 2, 3))
    result = nd.inverse_acceleration(g, c, *velocity, *acceleration)
    assert_allclose(result, 1.5 * d1 - 0.6 * d2 + 0.1 * d3, rtol=0.0, atol=1e-10)


@EVERY_ROBOT
def test_tendons_pull_to_the_commanded_pose(robot):
    g, start = robot
    target = nearby(robot, 7)
    engine, data = loaded(models.tendon_model(g, start))
    settle(engine, data, nd.leg_lengths(g, target), seconds=60.0)
    mujoco.mj_step(engine, data, 2000)  # for the last digits
    assert_same_pose(pose(data), target, 1e-13)


# --- Legs as struts, loops closed -------------------------------------------------------------------------------------


@EVERY_ROBOT
def test_jacobian_is_in_the_null_space_of_the_loops(robot):
    g, start = robot
    rng = np.random.default_rng(6)
    for c in [start, *start.moved(0.3 * rng.normal(size=(4, 9)))]:
        engine, data = loaded(models.closed_loop_model(g, c))
        result = nd.jacobian(g, c)
        assert_allclose(result, models.slide_to_twist(engine, data), rtol=0.0, atol=ROUNDING * np.abs(result).max())


@EVERY_ROBOT
def test_struts_push_to_the_commanded_pose(robot):
    """Direct kinematics by physics."""
    g, start = robot
    target = nearby(robot, 7)
    engine, data = loaded(models.closed_loop_model(g, start))
    settle(engine, data, nd.leg_lengths(g, target), seconds=20.0)
    assert_same_pose(pose(data), target, 1e-8)
    assert np.abs(data.efc_pos).max() < 1e-12  # no loop is open
    assert_allclose(models.slide_to_twist(engine, data), nd.jacobian(g, target), rtol=0.0, atol=1e-6)


@EVERY_ROBOT
def test_measured_slides_give_the_pose_under_gravity(robot):
    """The struts sag, so the pose is not the commanded one; it is that of the lengths they then have."""
    g, start = robot
    target = nearby(robot, 7)
    engine, data = loaded(models.closed_loop_model(g, start, gravity=9.81, timestep=5e-4))
    settle(engine, data, nd.leg_lengths(g, target), seconds=20.0)
    end_pose = pose(data)
    measured = data.qpos[models.slides(engine)[0]]
    assert np.abs(measured - nd.leg_lengths(g, target)).max() > 1e-4
    assert_allclose(nd.leg_lengths(g, end_pose), measured, rtol=0.0, atol=1e-7)
    assert_same_pose(nd.track(g, measured, start), end_pose, 1e-6)
