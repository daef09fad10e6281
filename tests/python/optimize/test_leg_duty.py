"""Limits of forces, rates and powers of legs: a design of a region, its proof, its workspace, a path, a payload."""

import math
from dataclasses import replace

import duty_oracle
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.design.objective import internal_motion
from ninedof.sheet.path_limits import limits_at_poses
from ninedof.workspace.study_question import design_question

BOUNDS = {"a1": 0.0, "a2": 850.0, "b1": (200.0, 350.0), "b2": 0.0, "zp": (400.0, 560.0), "zs": (200.0, 400.0)}
REGION = {"box": (40.0, 40.0, 20.0), "tilt": 0.09}
WRENCHES = [[0, 0, 0, 0, 0, -500], [1000, 0, 0, 50, 0, -200]]
MASSES = {"platform": 12.0, "centre": (0, 0, 30), "cylinder": 1.4, "rod": 0.6, "cylinder_centre": 100, "rod_centre": 80}
STUDY = nd.Study(
    variables=BOUNDS | {"theta_z": 0.0},
    constraints={"force": (None, 500.0), "rate": (None, 300.0), "power": (None, 1.05e5)},
    objective={"region": REGION},
    loads={"wrenches": WRENCHES},
    masses=MASSES,
    speeds={"linear": 200.0, "angular": 0.5},
    characteristic_length=150.0,
    starts=2,
    unit="mm",
)


@pytest.fixture(scope="module")
def result():
    return nd.optimize(STUDY)


def random_poses(home, count):
    """Poses of the region, two thirds of them at corners and greatest tilts."""
    rng = np.random.default_rng(5)
    u = rng.uniform(-1.0, 1.0, (count, 3))
    u[count // 3 :] = np.sign(u[count // 3 :])
    angle, size = rng.uniform(0.0, 2.0 * math.pi, count), np.sqrt(rng.uniform(size=count))
    size[count // 3 :] = 1.0
    tilt = 0.09 * size[:, None] * np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    shift = u * np.array(REGION["box"])
    turned = Rotation.from_rotvec(tilt).as_matrix() @ home.rotation
    return nd.Configuration(home.position + shift, turned, home.internal_point + shift)


def forces_at(result, c):
    """The greatest moduli over both loads without masses of legs, by `leg_forces` alone."""
    arm = c.rotation @ np.array(MASSES["centre"], float)
    weight = 12.0 * np.array([0.0, 0.0, -9.81])
    found = [
        nd.leg_forces(result.geometry, c, np.array(w[:3]) + np.cross(arm, weight), np.array(w[3:]) + weight).forces
        for w in np.array(WRENCHES, float)
    ]
    return np.abs(found).max(axis=0)


@pytest.mark.slow
def test_a_force_that_rules_is_kept_at_every_pose_and_proved():
    study = replace(STUDY, masses={"platform": 12.0, "centre": (0, 0, 30)}, constraints={"force": (None, 480.0)})
    found = nd.optimize(study)
    assert found.active == ("force",)
    most = forces_at(found, random_poses(found.configuration, 2000)).max()
    assert 0.99 * 480.0 < most < 480.0 * (1.0 + 1e-6)
    proof = found.certify(time_limit=60.0, gap=0.5).limits[1]
    assert (proof.name, proof.kind, proof.answer) == ("force", "number", "proved")
    tighter = replace(study, constraints={"force": (None, 479.0)})
    assert replace(found, study=tighter).certify(time_limit=60.0, gap=0.5).limits[1].answer == "violated"


@pytest.mark.slow
def test_power_is_force_times_rate_and_all_are_those_of_the_sheet(result):
    poses = random_poses(result.configuration, 40)
    rows = limits_at_poses(STUDY, result.geometry, poses, result.configuration, result.characteristic_length)
    of = {(row.name, row.part): row.value for row in rows}
    sheet = nd.sheet(result)
    for k, leg in enumerate(sheet.legs):
        force, rate, power = (of[name, leg.name] for name in ("force", "rate", "power"))
        assert power == pytest.approx(force * rate, rel=1e-12)
        assert force.max() <= np.abs(sheet.forces()[:, :, k]).max() * (1.0 + 1e-6)
        assert rate.max() <= leg.speed * (1.0 + 1e-6)
    for row in sheet.limits:
        assert -1e-6 < row.margin < 0.2
    assert STUDY.leg_duty.internal == sheet.motion.internal == "shifted"


@pytest.mark.slow
def test_workspaces_have_them_as_criteria(result):
    found = nd.workspace(result, tolerance=5e-3)
    assert not design_question(result)[1]
    proved = nd.certified_workspace(result, gap=0.1)
    assert proved.volume[0] <= found.volume + 3.0 * found.error
    assert proved.volume[1] >= found.volume - 3.0 * found.error
    assert sum(share for name, share in found.limits().items() if name.startswith(("force", "power"))) > 0.1
    with pytest.raises(ValueError, match=r"^power: got no loads and speeds, expected the limit of a study"):
        nd.workspace(result.geometry, ([-9, -9, 300], [9, 9, 500]), criteria={"power": 1.0})


def test_a_path_names_the_leg_that_passes_one(result):
    motion = nd.follow(result, nd.Trajectory.line(result.configuration, [250.0, 0.0, 0.0]))
    broken = nd.path_limits(STUDY, motion, result.configuration).breaks
    assert {entry.limit for entry in broken} >= {"force r3 max"}


def test_a_path_is_held_against_its_own_rates_and_forces(result):
    line = nd.Trajectory.line(result.configuration, [30.0, 0.0, 0.0], duration=0.05)
    motion = nd.follow(result, line, load=([0.0, 0.0, -5.0], None), masses=nd.Masses())  # not those of the study
    limits = nd.path_limits(STUDY, motion, result.configuration).limits
    for name, numbers in (
        ("rate", motion.leg_rates),
        ("force", motion.leg_forces),
        ("power", motion.leg_forces * motion.leg_rates),
    ):
        values = np.stack([one.value for one in limits if one.name == name], axis=-1)
        np.testing.assert_array_equal(values, np.abs(numbers))
    of_kinds = replace(STUDY, constraints={"upper_force": (None, 400.0), "lower_rate": (None, 200.0)})
    parts = {(one.name, one.part): one.value for one in nd.path_limits(of_kinds, motion, result.configuration).limits}
    assert set(parts) == {("upper_force", f"q{k}") for k in (1, 2, 3)} | {("lower_rate", f"r{k}") for k in (1, 2, 3)}
    np.testing.assert_array_equal(parts["upper_force", "q2"], np.abs(motion.leg_forces[:, 4]))
    np.testing.assert_array_equal(parts["lower_rate", "r1"], np.abs(motion.leg_rates[:, 6]))
    worst = {row["name"]: row["margin"] for row in nd.path_limits(STUDY, motion, result.configuration).worst()}
    assert worst["rate"] < 0.0 < worst["force"]


@pytest.mark.slow
def test_the_largest_payload_is_proved(result):
    with_legs = replace(STUDY, constraints={})
    mass = nd.largest_payload(replace(result, study=with_legs), force=600.0).mass
    for share, answer in ((0.999, "proved"), (1.001, "violated")):
        centre = tuple(12.0 / (12.0 + share * mass) * np.array(MASSES["centre"], float))  # the payload is at p
        carried = MASSES | {"platform": 12.0 + share * mass, "centre": centre}
        study = replace(STUDY, masses=carried, constraints={"force": (None, 600.0)})
        assert replace(result, study=study).certify(time_limit=60.0, gap=0.5).limits[1].answer == answer


@pytest.mark.slow
@pytest.mark.parametrize(
    ("objective", "rule"),
    [
        ({}, "least"),
        ({"poses": [{"rotation": (0.1, 0, 0)}]}, "held"),
        ({"poses": [{"position": (0.1, 0, 0), "internal_point": "held"}]}, "held"),
        ({"poses": [{"position": (0.1, 0, 0)}, {"position": (0, 0.1, 0)}]}, "carried"),
        ({"poses": [{"position": (0.1, 0, 0)}, {"rotation": (0, 0.1, 0)}]}, "shifted"),
        ({"poses": [{"position": (0.1, 0, 0), "rotation": (0, 0.1, 0), "internal_point": (0, 0.1, 0)}]}, "least"),
        ({"region": {"box": (0.1, 0.1, 0.1)}}, "carried"),
        ({"region": {"box": (0.1, 0.1, 0.1), "tilt": 0.1}}, "shifted"),
        ({"region": {"box": (0.1, 0.1, 0.1), "tilt": 0.1, "internal_point": "held"}}, "held"),
        ({"region": {"tilt": 0.1}}, "held"),
        ({"region": {"box": (0.1, 0.1, 0.1), "tilt": 0.1, "internal_point": "best"}}, "least"),
    ],
)
def test_o_moves_as_the_sheet_finds_it(objective, rule):
    study = nd.Study(variables={"a1": 0.0, "b2": 0.0}, objective=objective, starts=1)
    assert internal_motion(study.objective) == rule
    if study.objective.region is None or study.objective.region.internal_point != "best":
        assert nd.sheet(nd.optimize(study), samples=50).motion.internal == rule


def test_loads_and_masses_are_those_of_the_tool():
    tool = nd.Tool((0.4, -0.3, -1.2), (0.3, -0.2, 0.5))
    study = nd.Study(constraints={"force": (None, 50.0)}, tool=tool, **duty_oracle.DUTY)
    at = {"a1": 0.4, "a2": 5.0, "b1": 2.5, "b2": 0.2, "zp": 4.0, "zs": 2.5, "theta_z": 0.1}
    point = study.evaluate(at)
    most = duty_oracle.forces(study, point.geometry, point.configuration).max()
    assert point.margins["force"] == pytest.approx(1.0 - most / 50.0, rel=1e-9)
    # The same load at the plate's own origin, with the mass where the plate has it.
    plate, g = tool.plate(point.configuration), tool.plates(point.geometry)
    bare = replace(study, tool=nd.Tool(), loads={"wrenches": []})
    light = replace(study, loads={"wrenches": []})
    assert duty_oracle.forces(bare, g, plate) == pytest.approx(
        duty_oracle.forces(light, point.geometry, point.configuration), rel=1e-9
    )


@pytest.mark.parametrize(
    ("name", "tables", "missing"),
    [
        ("force", {}, "without loads, expected wrenches in [loads], or [masses]"),
        ("rate", {}, "without speeds, expected linear or angular in [speeds]"),
        ("power", {"speeds": {"linear": 1.0}}, "without loads"),
        ("power", {"masses": {"rod": 1.0}}, "without speeds"),
    ],
)
def test_a_study_without_what_a_limit_is_about_is_refused(name, tables, missing):
    with pytest.raises(ValueError, match=r"^constraints") as refused:
        nd.Study(constraints={name: (None, 1.0)}, **tables)
    assert f"constraints.{name}: got a study {missing}" in str(refused.value)
    of_duty = nd.Study(constraints={name: (None, 1.0)}, **duty_oracle.DUTY).limits[0]
    assert of_duty.unit("mm") == {"power": "force mm/s", "rate": "mm/s"}.get(name.rpartition("_")[2], "")
