"""The MJCF file in MuJoCo: it settles in the poses of commanded leg lengths, and its loops have the Jacobian J'."""

import exported
import mujoco_models as models
import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.export import mjcf

mujoco = pytest.importorskip("mujoco")

DESIGNS = {"machine in mm": (exported.machine, 1e-3, 40.0), "general, no unit": (exported.general, 1.0, 0.1)}
EVERY = pytest.mark.parametrize("kind", DESIGNS)
AT_REST = 1e-8

# a1 a2 b1 b2, (zp, zs), the condition number, and simulated seconds in which the model settles; None: not in ten
SETTLING = [
    ((2.0274, 2.0939, 0.5330, 0.1205), (0.7950, 0.5452), 5.26, 3.0),
    ((0.8518, 1.7503, 2.4261, 0.8382), (1.7743, 1.1174), 10.45, 4.0),
    ((2.8869, 2.1881, 1.6466, 0.8669), (1.2229, 0.8413), 19.0, 9.0),
    ((0.6788, 2.3468, 0.8697, 2.7424), (2.8182, 1.1878), 277.0, None),
    ((2.0548, 1.2363, 1.9011, 1.1350), (1.0267, 0.3082), 1850.0, None),
]


def written(kind, folder, **options):
    """The design, metres of its unit, size of a path, and the model at its neutral keyframe."""
    design, metre, size = DESIGNS[kind]
    file = nd.export(design(), "mjcf", folder / "robot.xml", **options)
    engine = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(engine)
    mujoco.mj_resetDataKeyframe(engine, data, engine.key("neutral").id)
    mujoco.mj_forward(engine, data)
    return design(), metre, size, engine, data


def settle(engine, data, controls):
    assert (engine.actuator_ctrlrange[:, 0] <= controls).all()
    assert (controls <= engine.actuator_ctrlrange[:, 1]).all()
    assert models.settle(engine, data, controls, 20000 * engine.opt.timestep, AT_REST), "still moving after 10 s"


def errors(data, target, metre, size):
    """Of position and O by the size of the robot, of the rotation in radians."""
    result = [data.body(name).xpos / metre for name in ("platform", "O")]
    apart = [np.abs(a - b).max() / size for a, b in zip(result, (target.position, target.internal_point), strict=True)]
    return [*apart, np.abs(data.body("platform").xmat.reshape(3, 3) - target.rotation).max()]


@EVERY
def test_the_neutral_keyframe_is_the_neutral_configuration(kind, tmp_path):
    design, metre, _, engine, data = written(kind, tmp_path)
    assert max(errors(data, design.configuration, metre, 1.0 / metre)) < 1e-15
    assert np.abs(data.efc_pos).max() < 1e-14  # no loop is open
    expected = nd.leg_lengths(design.geometry, design.configuration) * metre
    assert_allclose(data.qpos[models.slides(engine)[0]], expected, rtol=1e-14)
    assert_allclose(data.ctrl, expected, rtol=1e-14)
    assert [engine.actuator(k).name for k in range(9)] == exported.LEGS


@EVERY
def test_the_model_follows_a_path_of_leg_lengths(kind, tmp_path):
    """The figure to reach is 1e-6 of the size; what is left is the velocity at which the wait ends."""
    design, metre, size, engine, data = written(kind, tmp_path)
    path = exported.path(design, size)
    for target in path:
        settle(engine, data, nd.leg_lengths(design.geometry, target) * metre)
        assert max(errors(data, target, metre, np.ptp(design.geometry.base_external))) < 1e-8
        assert data.warning.number.sum() == 0


@EVERY
def test_a_path_is_followed_without_lag_if_the_rates_are_fed_forward(kind, tmp_path):
    design, metre, size, engine, data = written(kind, tmp_path)
    lag = float(-engine.actuator_biasprm[0, 2] / engine.actuator_gainprm[0, 0])
    assert lag == pytest.approx(mjcf.LAG, rel=1e-5)
    assert f"length + {mjcf.LAG} s * its rate" in (tmp_path / "robot.xml").read_text()
    line = nd.Trajectory.line(design.configuration, (0.5 * size, 0.3 * size, 0.3 * size), duration=0.5)
    motion = nd.follow(design, line)
    assert line.time[1] == pytest.approx(engine.opt.timestep)
    off = []
    for lead in (0.0, lag):
        mujoco.mj_resetDataKeyframe(engine, data, engine.key("neutral").id)
        path = zip(motion.leg_lengths, motion.leg_rates, motion.configurations.position, strict=True)
        off.append(0.0)
        for lengths, rates, position in path:
            data.ctrl = metre * (lengths + lead * rates)
            mujoco.mj_step(engine, data)
            off[-1] = max(off[-1], np.linalg.norm(data.body("platform").xpos / metre - position) / size)
    assert off[0] > 0.02
    assert off[1] < 0.05 * off[0]


@pytest.mark.parametrize(("joints", "heights", "condition", "seconds"), SETTLING)
def test_the_time_to_settle_grows_with_the_condition_number(joints, heights, condition, seconds, tmp_path):
    """Figures of docs/exports.md: well-conditioned designs settle to 1e-10 of the size, others keep swinging."""
    g, c = nd.Geometry.hexagonal(*joints), nd.Configuration.neutral(*heights)
    lc = float(np.linalg.norm(g.platform_external, axis=-1).mean())
    assert nd.condition_number(g, c, lc) == pytest.approx(condition, rel=0.02)
    engine = mujoco.MjModel.from_xml_path(str(nd.export(nd.Design(g, c, 1.0), "mjcf", tmp_path / "robot.xml")))
    data = mujoco.MjData(engine)
    mujoco.mj_resetDataKeyframe(engine, data, engine.key("neutral").id)
    size = float(np.ptp(g.base_external))
    target = c.moved([0.05, 0.0, 0.03, *(size * np.array([0.02, -0.01, 0.015, 0.01, 0.0, 0.005]))])
    data.ctrl[:] = nd.leg_lengths(g, target)
    at_rest = False
    while not at_rest and data.time < (seconds or 10.0):
        mujoco.mj_step(engine, data, 100)
        at_rest = np.abs(data.qvel).max() < AT_REST
    assert at_rest == (seconds is not None)
    if at_rest:
        assert max(errors(data, target, 1.0, size)[:2]) < 1e-10


@EVERY
def test_slides_move_the_platform_as_the_jacobian_says(kind, tmp_path):
    design, metre, _, engine, data = written(kind, tmp_path)
    lc = float(np.linalg.norm(design.geometry.platform_external, axis=-1).mean())
    expected = nd.jacobian(design.geometry, design.configuration, lc)
    assert_allclose(
        models.slide_to_twist(engine, data, lc * metre, independent=1e-3),
        expected,
        rtol=0.0,
        atol=1e-11 * np.abs(expected).max(),
    )


def test_ranges_are_the_strokes_of_the_sheet(tmp_path):
    design, metre, _, engine, _ = written("machine in mm", tmp_path)
    for leg in design.sheet().legs:
        ends = np.array([leg.shortest, leg.longest]) * metre
        if leg.stroke < 0.01 * leg.neutral:  # carried with the platform: a range that is a point is widened
            assert np.ptp(engine.joint(leg.name).range) == pytest.approx(0.01 * leg.neutral * metre, rel=1e-6)
        else:
            assert_allclose(engine.joint(leg.name).range, ends, rtol=1e-14)
        assert_allclose(engine.actuator(leg.name).ctrlrange, engine.joint(leg.name).range)


def test_a_design_without_a_study_has_ranges_about_its_neutral_lengths(tmp_path):
    design, _, _, engine, _ = written("general, no unit", tmp_path)
    neutral = nd.leg_lengths(design.geometry, design.configuration)
    assert_allclose(engine.actuator_ctrlrange, neutral[:, None] * [0.7, 1.3], rtol=1e-14)


def test_masses_and_gravity_are_those_asked_for(tmp_path):
    _, _, _, engine, data = written("machine in mm", tmp_path, leg_mass=2.0, platform_mass=7.0, gravity=9.81)
    assert engine.body_mass.sum() == pytest.approx(9 * 2.0 + 7.0 + 0.2)
    assert engine.body("platform").mass[0] == 7.0
    assert engine.opt.gravity.tolist() == [0.0, 0.0, -9.81]
    height = data.body("platform").xpos[2]
    settle(engine, data, data.ctrl.copy())
    assert 0.0 < height - data.body("platform").xpos[2] < 1e-3
