"""The MJCF file has the masses of its study: MuJoCo needs the leg forces of the package, at rest and in motion."""

import mujoco_models as models
import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd

mujoco = pytest.importorskip("mujoco")

# Of a machine in mm with a tool; no centre is in the middle of its body.
PLATFORM = {"platform": 12.0, "centre": (12.0, -20.0, -30.0), "inertia": (9e4, 7e4, 1.2e5, 5e3, -8e3, 1e4)}
LEGS = {"cylinder": 1.4, "cylinder_centre": 75.0, "rod": 0.6, "rod_centre": 140.0, "internal_point": 0.3}
LEGS |= {"cylinder_inertia": 9e3, "rod_inertia": 4e3}
VALUES = {"a1": 60.0, "a2": 500.0, "b1": 250.0, "b2": 30.0, "zp": 400.0, "zs": 200.0}
TOOL = {"position": (10.0, 5.0, -80.0), "rotation": (0.1, -0.2, 0.3)}
MOVES = [[0.0] * 9, [0.05, -0.03, 0.1, 30.0, -20.0, 15.0, 20.0, 0.0, 5.0], [-0.04, 0.06, 0.0, 0, 25, -30, -10, 15, -20]]


def machine(**masses):
    study = nd.Study(variables=VALUES, characteristic_length=150.0, unit="mm", masses=masses, tool=TOOL)
    return nd.optimize(study)


def engine_of(result, folder):
    engine = mujoco.MjModel.from_xml_path(str(nd.export(result, "mjcf", folder / "robot.xml")))
    engine.opt.gravity[:] = nd.Loads().gravity
    return engine


def both(result, engine, move, motion):
    """Leg forces of the package and of MuJoCo; a motion is that of the plate's origin, in mm."""
    home, tool, masses = result.configuration, result.study.tool, result.study.masses
    plate = tool.plate(home).moved(move)
    expected = nd.inverse_dynamics(tool.plates(result.geometry), plate, motion, masses, unit="mm").forces
    metres = np.array([1.0] * 3 + [1e-3] * 6)
    pose = nd.Configuration(1e-3 * plate.position, plate.rotation, 1e-3 * plate.internal_point)
    return models.leg_forces(engine, pose, *(metres * np.array(one) for one in motion)), expected


def test_forces_are_those_of_the_package_at_rest_and_in_motion(tmp_path):
    result = machine(**PLATFORM, **LEGS)
    engine, rest = engine_of(result, tmp_path), ([0.0] * 9, [0.0] * 9)
    for leg in models.LEGS:  # thin about their axis, as the package takes them
        for part in ("cylinder", "rod"):
            assert engine.body(f"{leg}_{part}").inertia[2] < 0.03 * engine.body(f"{leg}_{part}").inertia[0]
            engine.body(f"{leg}_{part}").inertia[2] = 1e-14
    by = np.array([1.0] * 3 + [300.0] * 6)
    fast = by * np.random.default_rng(4).normal(size=(2, 9))
    for move, motion in [*((move, rest) for move in MOVES), (MOVES[1], fast)]:
        forces, expected = both(result, engine, move, motion)
        assert_allclose(forces, expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())


def test_what_a_study_leaves_out_is_as_drawn(tmp_path):
    """With the masses alone: MuJoCo has centres in the middle of the bodies, as before."""
    engine = engine_of(machine(platform=12.0, cylinder=1.4, rod=0.6, cylinder_inertia=9e3), tmp_path)
    leg = engine.body("l1_cylinder"), engine.body("l1_rod")
    assert leg[0].ipos[2] == pytest.approx(-leg[1].ipos[2])
    assert leg[0].ipos[2] > 0.1
    assert leg[0].inertia[0] == pytest.approx(9e-3)
    assert 0.0 < leg[1].inertia[2] < 0.1 * leg[1].inertia[0]
    x, y, z = engine.body("platform").inertia
    assert (x, x) == pytest.approx((y, 0.5 * z))


@pytest.mark.parametrize(
    "inertia", [(5e4, 5e4, 0, 0, 0, 0), (3e4, 6e4, 9e4, 0, 0, 0), (6e4, 6e4, 6e4, -3e4, -3e4, -3e4)]
)
@pytest.mark.parametrize("across", [0.0, 1e-3])
def test_thin_bodies_are_taken(inertia, across, tmp_path):
    """A bar and a sheet of no thickness: MuJoCo refuses a moment of 0, and one above the sum of the others."""
    engine = engine_of(machine(**(PLATFORM | {"inertia": inertia}), rod_inertia=across), tmp_path)
    platform = engine.body("platform")
    axes = np.empty(9)
    mujoco.mju_quat2Mat(axes, platform.iquat)
    turn = axes.reshape(3, 3)
    xx, yy, zz, xy, xz, yz = 1e-6 * np.array(inertia)
    stated = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    assert_allclose(turn @ np.diag(platform.inertia) @ turn.T, stated, rtol=0.0, atol=1e-8 * max(xx, yy, zz))


@pytest.mark.parametrize("kind", ["urdf", "sdf"])
def test_the_other_formats_have_the_same_bodies(kind, tmp_path):
    text = nd.export(machine(**PLATFORM, **LEGS), kind, tmp_path / f"robot.{kind}").read_text()
    if kind == "sdf":
        assert text.count("<pose>0 0 0.075 0 0 0</pose>\n        <mass>1.4</mass>") == 9
        assert text.count("<pose>0 0 -0.14 0 0 0</pose>\n        <mass>0.6</mass>") == 9
        assert "<ixx>0.09</ixx><iyy>0.07</iyy><izz>0.12</izz><ixy>0.005</ixy><ixz>-0.008</ixz><iyz>0.01</iyz>" in text
        return
    engine = mujoco.MjModel.from_xml_string(text)
    assert engine.body("l2_cylinder").ipos == pytest.approx([0.0, 0.0, 0.075])
    assert engine.body("r3_rod").ipos == pytest.approx([0.0, 0.0, -0.14])
    assert engine.body("q1_rod").inertia[:2] == pytest.approx([4e-3] * 2)
    assert 'ixx="0.09" iyy="0.07" izz="0.12" ixy="0.005" ixz="-0.008" iyz="0.01"' in text
