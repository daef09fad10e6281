"""A tool: poses, index and limits at poses belong to the tool's point, limits of the design to the plates."""

import math

import numpy as np
import numpy_model
import pytest
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.proof.machine import certify

OWN = {
    "base_external_radius": 3.0,
    "base_internal_radius": 2.5,
    "base_internal_angle": 0.7,
    "platform_external_radius": 1.5,
    "platform_external_angle": 1.0,
    "platform_internal_radius": 1.25,
    "platform_internal_angle": 0.2,
    "zp": 4.0,
    "zs": 2.0,
    "base_external_height": 0.25,
    "base_internal_height": 0.0,
    "platform_external_height": 0.5,
    "platform_internal_height": -0.25,
}
HEIGHT = -1.5  # of the tool: all sums with it are exact
LIMITS = {
    "leg_length": (1.0, 9.0),
    "platform_cone": {"max_deg": 60, "axis": (0.0, 0.0, -1.0)},
    "base_cone": {"max_deg": 70},
    "stroke": (None, 3.0),
    "singularity_free": {"min": 1e-3},
}
REGION = {"box": (0.5, 0.25, 0.25), "tilt_deg": 10, "yaw_deg": 5}


def twin(values, height=HEIGHT):
    """The same machine with the heights of its platform joints counted from the tool's point."""
    heights = {name: values[name] - height for name in values if name.startswith("platform") and "height" in name}
    return values | heights | {"zp": values["zp"] + height}


def both(values=OWN, **study):
    tool = {"position": (0.0, 0.0, HEIGHT)}
    own = nd.Study("symmetric_nonplanar", values, LIMITS, tool=tool, **study)
    return own, nd.Study("symmetric_nonplanar", twin(values), LIMITS, **study)


@pytest.mark.slow
def test_searches_of_a_region_agree_to_the_last_bit():
    one, other = both(objective={"region": REGION})
    a, b = nd.optimize(one), nd.optimize(other)
    assert (a.objective, a.region.looked_at, a.region.margin) == (b.objective, b.region.looked_at, b.region.margin)
    how = {"linear_speed": 3.0, "angular_speed": 0.1, "leg_errors": 0.1, "joint_errors": 0.2, "leg_stiffness": 5.0}
    centres = (0.0, 0.0, 0.25), (0.0, 0.0, 0.25 - HEIGHT)  # in the frame of the plate, and of the twin
    first, second = (r.sheet(mass=2.0, centre=x, **how) for r, x in zip((a, b), centres, strict=True))
    assert first.condition_number == second.condition_number
    assert (first.accuracy, first.stiffness) == (second.accuracy, second.stiffness)
    for leg, same in zip(first.legs, second.legs, strict=True):
        for name in ("shortest", "longest", "speed", "forces", "base_cone", "platform_cone"):
            assert getattr(leg, name) == getattr(same, name), name
    proofs = [r.certify(gap=1.0, threads=1).limits for r in (a, b)]
    assert [p.value for p in proofs[0]] == [p.value for p in proofs[1]]
    assert nd.check(a).passed


TOOL = nd.Tool((0.4, -0.3, -1.2), (0.3, -0.2, 0.5))
POSES = [
    {"position": (0.3, 0.1, 0.2), "rotation": (0.1, 0.2, -0.1)},
    {"position": (0.03, -0.1, 0.05), "rotation": (0.1, 0.0, -0.1), "unit": "zp", "internal_point": "best"},
]
BESIDE = {
    "leg_length": (1.0, 9.0),
    "platform_cone": {"max_deg": 80, "axis": (0.1, 0.2, -1.0)},
    "base_cone": {"max_deg": 80},
    "leg_clearance": {"min": 0.01},
    "singularity_free": {"min": 1e-6},
    "stroke": {"max": 0.3, "of": "zp"},
}
OF_PLATES = {
    "radius_ratio": (None, 9.0),
    "joint_height": {"max": 2.0, "of": "radius"},
    "joint_spacing": {"min": 0.01, "of": "radius"},
    "height": (1.0, 9.0),
    "footprint": (None, 9.0),
    "zs_fraction": (0.1, 0.9),
}


def general():
    """A robot without any symmetry."""
    rng = np.random.default_rng(3)
    names = nd.Study("general").variables
    values = {n: float(v + 0.2 * rng.normal()) for n, v in names.items() if not isinstance(v, tuple)}
    return values | {"zp": 4.0, "zs": 2.2, "theta_z": 0.3}


def study_with(tool, length=1.3, **more):
    limits, objective = BESIDE | OF_PLATES, {"poses": POSES} | more
    return nd.Study("general", general(), limits, objective=objective, characteristic_length=length, tool=tool)


def test_a_tool_beside_the_axis_is_the_robot_made_by_hand():
    """Joints and poses moved in numpy; index, lengths and cones from their definitions."""
    study, own = study_with(TOOL), nd.Study("general", general()).evaluate(general())
    a = study.evaluate(general())
    t, r = np.array(TOOL.position), Rotation.from_rotvec(TOOL.rotation).as_matrix()
    g, p0, q0 = own.geometry, own.configuration.position, own.configuration.rotation
    u, ut = ((joints - t) @ r for joints in (g.platform_external, g.platform_internal))
    shifts = np.array([(0.0, 0.0, 0.0), (0.3, 0.1, 0.2), np.array((0.03, -0.1, 0.05)) * 4.0])
    turns = Rotation.from_rotvec([(0.0, 0.0, 0.0), (0.1, 0.2, -0.1), (0.1, 0.0, -0.1)]).as_matrix()
    p, q = p0 + q0 @ t + shifts, turns @ q0 @ r
    s = np.array([0.0, 0.0, 2.2]) + shifts * np.array([[0.0], [1.0], [0.0]])
    robot = numpy_model.Robot(g.base_external, g.base_internal, u, ut, p, q, s)
    assert np.allclose(numpy_model.lengths(robot), nd.leg_lengths(a.geometry, a.configurations), rtol=1e-13)
    kappa = numpy_model.condition_number(robot, 1.3)
    assert np.allclose(kappa, [a.neutral_condition_number, *a.conditions], rtol=1e-10)
    # The axis of the cone is in the frame of the plate, whose axes are q r^T.
    axis = (q @ r.T) @ (np.array([0.1, 0.2, -1.0]) / np.linalg.norm([0.1, 0.2, -1.0]))
    x, y, _, _, _ = numpy_model.legs(robot)
    away = np.concatenate([-x, y], axis=-2)[1:]  # from the joints of the platform
    cosine = (away / np.linalg.norm(away, axis=-1, keepdims=True) @ axis[1:, :, None])[..., 0]
    assert a.values["platform_cone"] == pytest.approx(np.arccos(cosine).max(), rel=1e-12)
    assert a.values["stroke"] == pytest.approx(np.ptp(numpy_model.lengths(robot)[1:], axis=0).max() / 4.0, rel=1e-12)


def test_limits_of_the_design_are_those_of_the_plates():
    with_tool, without = study_with(TOOL).evaluate(general()), study_with(nd.Tool()).evaluate(general())
    assert {n: with_tool.margins[n] for n in OF_PLATES} == {n: without.margins[n] for n in OF_PLATES}


def test_proofs_of_limits_of_the_design_hold_those_of_the_plates():
    study = study_with(TOOL)
    point = study.evaluate(general())
    values = general()
    result = certify(study, point.geometry, point.configurations, 1.3, time_limit=0.0)
    by_name = {(proof.name, proof.side): proof.value for proof in result.limits}
    joints = [
        [values[f"{t}_{i}_{axis}"] for axis in "xyz"] for t in ("base_external", "base_internal") for i in (1, 2, 3)
    ]
    upper = [
        [values[f"{t}_{i}_{axis}"] for axis in "xyz"]
        for t in ("platform_external", "platform_internal")
        for i in (1, 2, 3)
    ]
    wide, narrow = (np.linalg.norm(np.array(one)[:, :2], axis=1).max() for one in (joints, upper))
    low, high = by_name["radius_ratio", "max"]
    assert low <= wide / narrow * (1 + 1e-15)
    assert high >= wide / narrow * (1 - 1e-15)
    assert high - low < 1e-12
    low, high = by_name["height", "max"]
    assert low <= 4.0 <= high < low + 1e-12
    assert by_name["zs_fraction", "min"][0] == pytest.approx(0.55, rel=1e-13)


def test_loads_are_about_the_point_of_the_tool():
    """Held against the plate's frame with the moment moved there."""
    a, own = (study_with(tool).evaluate(general()) for tool in (TOOL, nd.Tool()))
    c, moment, force = a.configurations[1], np.array([0.3, -0.1, 0.2]), np.array([1.0, 2.0, -3.0])
    plate = TOOL.plate(c)
    arm = c.position - plate.position
    expected = nd.leg_forces(own.geometry, plate, moment + np.cross(arm, force), force).forces
    assert np.allclose(nd.leg_forces(a.geometry, c, moment, force).forces, expected, rtol=1e-11, atol=1e-12)


@pytest.mark.slow
def test_positions_in_zp_are_of_the_plate():
    tool = {"position": (0.25, 0.0, -1.5)}
    region = {"box": (0.1, 0.05, 0.05), "tilt_deg": 5, "unit": "zp"}
    result = nd.optimize(nd.Study("symmetric_nonplanar", OWN, LIMITS, objective={"region": region}, tool=tool))
    sheet, home = result.sheet(samples=500), result.configuration
    assert home.position.tolist() == [0.25, 0.0, 2.5]
    shift = np.abs(sheet.configurations.position - home.position).max(axis=0)
    assert shift == pytest.approx([0.4, 0.2, 0.2], rel=1e-9)
    assert nd.check(result).passed


@pytest.mark.slow
def test_o_placed_anew_stays_between_the_plates():
    tool = nd.Tool((0.5, 0.25, -3.0), (0.0, 0.2, 0.3))
    region = {"box": (0.4, 0.4, 0.3), "tilt_deg": 12, "internal_point": "best"}
    free = OWN | {"zs": (0.5, 3.5), "zp": (3.0, 5.0)}
    study = nd.Study("symmetric_nonplanar", free, objective={"region": region}, tool=tool, starts=4)
    result = nd.optimize(study)
    assert result.status == "optimal"
    c = result.best.configurations
    plate = tool.plate(c)
    below = np.einsum("ni,ni->n", plate.position - c.internal_point, plate.rotation[:, :, 2])
    assert (c.internal_point[:, 2] > 0.0).all()
    assert (below > 0.0).all()
    assert nd.check(result).passed


def test_what_a_tool_does_not_go_with_names_it():
    beside = {"position": (1.0, 0.0, 0.0)}
    with pytest.raises(ValueError, match=r'"six_legged" and a tool beside .*\[tool\] position = \[0, 0, z\]'):
        nd.Study(objective={"index": "six_legged"}, tool=beside)
    with pytest.raises(ValueError, match=r"tool\.position"):
        nd.Study(tool={"position": (0.0, 0.0, 1e200)})


def test_a_bound_of_the_optimum_is_that_of_the_study_with_the_tool():
    free = {"a1": 0.0, "b2": 0.0, "a2": (4.0, 8.0), "b1": (2.0, 4.0), "zp": 5.0, "zs": 3.0}
    plain, tool = (nd.Study(variables=free, tool=one) for one in ({}, {"position": (1.0, 0.0, 0.0)}))
    best = nd.optimize(tool, certify=True)
    assert best.proof.complete
    assert best.proof.gap(best.condition_number) < 1.1e-3
    assert abs(best.lower_bound - nd.optimize(plain).condition_number) > 0.01


def test_six_legs_with_a_tool_on_the_axis_are_those_of_the_twin():
    one, other = both(objective={"index": "six_legged"})
    assert one.evaluate(OWN).objective == other.evaluate(twin(OWN)).objective
    assert math.isfinite(one.evaluate(OWN).objective)
