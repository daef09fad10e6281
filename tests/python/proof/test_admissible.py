"""Sets of admissible designs, held against designs drawn at random and evaluated in numpy at poses drawn at random."""

import math

import numpy as np
import pytest
from design_set_oracle import DesignSetOracle
from limit_oracle import limits_of, margins, robot_of
from region_oracle import SPREADS, condition_margins, index_at, random_poses
from region_poses import drawn
from robots import NONPLANAR
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd
from ninedof.design.domains.region_poses import posed

ROUNDING = 1e-9
SIZES = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": (2.0, 8.0), "zs": (1.0, 6.0)}
BOX = {"box": (0.4, 0.4, 0.3), "tilt": 0.12}
ALL_LIMITS = {
    "radius_ratio": (1.2, 3.0),
    "stroke_ratio": (None, 1.55),
    "leg_length": (1.3, 7.0),
    "lower_length": {"max": 0.95, "of": "zp"},
    "zs_fraction": (0.3, 0.8),
    "footprint": (None, 4.5),
    "base_cone": {"max_deg": 60, "axis": (0, 0, 1)},
    "platform_cone_internal": {"max_deg": 25},
    "leg_clearance": (0.12, None),
    "singularity_free": (0.01, None),
}
HEXAGON = nd.Study(variables=SIZES, constraints=ALL_LIMITS, objective={"region": BOX})
AT = {"zp": 5.0, "zs": 3.0}
CASES = {
    "all limits": (HEXAGON, ("a2", "b1"), {"at": AT}),
    "three variables": (HEXAGON, ("a2", "b1", "zp"), {"at": {"zs": 3.0}, "resolution": 0.1}),
    "condition number": (
        nd.Study(variables=SIZES, constraints={"radius_ratio": (None, 2.0)}, objective={"region": {"ball": 0.2}}),
        ("b1", "zs"),
        {"at": {"a2": 7.0, "zp": 5.0}, "condition_number": 5.0, "resolution": 0.06},
    ),
    "tool, yaw, O held, zp": (
        nd.Study(
            variables=SIZES,
            constraints={"stroke": (None, 1.4), "platform_cone": (None, math.radians(32))},
            objective={
                "region": {"cylinder": (0.05, 0.03), "tilt": 0.05, "yaw": 0.05, "internal_point": "held", "unit": "zp"}
            },
            tool={"position": (0.1, -0.2, -0.8), "rotation": (0.1, 0.0, 0.3)},
        ),
        ("a2", "zp"),
        {"at": {"b1": 2.5, "zs": 2.8}},
    ),
    "non-planar": (
        nd.Study(
            "symmetric_nonplanar",
            variables=NONPLANAR,
            constraints={
                "leg_ratio": (None, 2.6),
                "joint_spacing": {"min": 0.3, "of": "radius"},
                "joint_height": (None, 0.4),
                "leg_clearance": (0.1, None),
                "external_length": (None, 7.0),
            },
            objective={"region": BOX | {"unit": "zp", "box": (0.06, 0.05, 0.06)}},
        ),
        ("base_external_radius", "base_internal_height"),
        {"at": {"base_internal_radius": 3.0, "platform_external_radius": 2.5, "zp": 5.0}},
    ),
    "duty": (
        nd.Study(
            variables=SIZES,
            constraints={"force": (None, 90.0), "external_rate": (None, 1.75), "power": (None, 85.0)},
            objective={"region": {"ball": 0.15}},
            loads={"wrenches": [(0, 0, 0, 0, 0, -60.0), (0, 10.0, 0, 20.0, 0, -40.0)]},
            masses={"platform": 1.0},
            speeds={"linear": 1.0, "angular": 0.5},
        ),
        ("a2", "b1"),
        {"at": AT},
    ),
    "poses": (
        nd.Study(
            variables=SIZES | {"theta_z": 0.2},
            constraints={
                "stroke_ratio": (None, 1.3),
                "base_cone": [
                    {"max_deg": 55, "axis": (0, 0, 1), "at": "neutral"},
                    {"max_deg": 62, "axis": (0, 0, 1)},
                ],
            },
            objective={
                "poses": [
                    {"position": (0.1, 0.0, 0.05), "rotation": (0.1, 0.2, 0.0), "unit": "zp"},
                    {"position": (0, 0.5, 0)},
                ],
                "condition_limit": 6.0,
            },
        ),
        ("a2", "zp"),
        {"at": {"b1": 2.5, "zs": 3.0}},
    ),
}


def everything(study, poses, variables):
    """All margins of a design at poses by limit, in numpy."""
    there = posed(study, poses) if study.objective.region is not None else study
    robot = robot_of(there, variables)
    out = {limit.label: margins(limit, robot) for limit in limits_of(there)}
    for name, values in zip(("condition_limit", "neutral"), condition_margins(there, robot), strict=False):
        out[name] = values
    return out, index_at(there, robot)


DRAWN_INSIDE = size((8, 200), (1000, 1000))  # designs and poses of each: 10^6 in all
DRAWN_OUTSIDE = size((4, 1000), (100, 10_000))
DEAR = 10  # of duty fewer poses: one takes milliseconds
SLOW = ("condition number", "three variables")


@pytest.fixture(
    scope="module",
    params=[pytest.param(name, marks=pytest.mark.slow) if name in SLOW else name for name in CASES],
    ids=[name.replace(" ", "-") for name in CASES],
)
def case(request):
    study, vary, options = CASES[request.param]
    return nd.admissible(study, vary, **({"resolution": 0.04} | options))


def drawn_in(boxes, count, rng):
    """Designs in boxes, by their volume: their rows, and which box each is of."""
    volume = np.prod(boxes[..., 1] - boxes[..., 0], axis=1)
    which = rng.choice(len(boxes), count, p=volume / volume.sum())
    return boxes[which, :, 0] + rng.random((count, boxes.shape[1])) * np.ptp(boxes[which], axis=-1), which


def variables_of(found, row):
    return dict(found.of.at) | dict(zip(found.vary, row.tolist(), strict=True))


@pytest.mark.slow
def test_its_certificate_is_confirmed_by_the_checker(case, tmp_path):
    found = nd.check_certificate(case.save_certificate(tmp_path / "designs.certificate"))
    assert found.proved, found.words
    assert found.words.startswith(f"{case.shares['inside']:.3%}")
    assert found.boxes == len(case.state)


def test_something_is_proved_on_both_sides(case):
    assert case.shares["inside"] > 0.001
    assert case.shares["outside"] > 0.01
    assert case.shares["undecided"] < 0.35


def least_margins_inside(found, designs, poses, seed):
    """The least margin at random poses of each of some designs drawn from the boxes inside."""
    oracle, rng = DesignSetOracle(found.study, found.of.condition_number), np.random.default_rng(seed)
    for row in drawn_in(found.inside, designs, rng)[0]:
        variables = variables_of(found, row)
        at = at_random(found.study, variables, poses, rng)
        yield oracle.kept(oracle.robot(variables, *at))


def least_margins_outside(found, designs, poses, seed):
    """The least margin of each of some designs from the boxes outside, at random poses and those of the reason."""
    oracle, rng = DesignSetOracle(found.study, found.of.condition_number), np.random.default_rng(seed)
    of_boxes = found.poses[found.state == 1].reshape(-1, 2, 7)
    for row, which in zip(*drawn_in(found.outside, designs, rng), strict=True):
        variables, at = variables_of(found, row), ()
        if (region := found.study.objective.region) is not None:
            reason = of_boxes[which]
            middle = variables_of(found, found.outside[which].mean(axis=1))["zp"]  # whose pose the reason has
            shift = reason[:, 1:4] * (variables["zp"] / middle if region.unit == "zp" else 1.0)
            own = shift, np.pad(reason[:, 4:6], ((0, 0), (0, 1))), reason[:, 6:]
            drawn_there = at_random(found.study, variables, poses, rng)
            at = tuple(np.concatenate(both) for both in zip(own, drawn_there, strict=True))
        yield oracle.kept(oracle.robot(variables, *at))


def at_random(study, variables, count, rng):
    region = study.objective.region
    return () if region is None else drawn(region, variables["zp"], rng, count)


def test_designs_drawn_in_numpy_contradict_nothing(case):
    """Of designs inside none breaks a limit, of those outside none keeps all; in numpy, without the core."""
    share = DEAR if "force" in case.study.constraints else 1
    (inside, poses), (outside, more) = DRAWN_INSIDE, DRAWN_OUTSIDE
    if case.study.objective.region is None:
        inside, outside = size((100, 100), (50_000, 50_000))  # the two listed poses of each
    assert min(least_margins_inside(case, inside, poses // share, 11)) > -ROUNDING
    assert max(least_margins_outside(case, outside, more // share, 12)) < ROUNDING


def test_a_box_of_designs_with_forces_over_tilts_is_proved_whole():
    """Of a machine in millimetres, in one look: no division of designs, which are near each other."""
    study = nd.Study(
        variables=SIZES | {"a2": (100.0, 850.0), "b1": (50.0, 350.0), "zp": 500.0, "zs": 330.0},
        constraints={"force": (None, 220.0), "upper_rate": (None, 400.0)},
        characteristic_length=150.0,
        objective={"region": {"box": (60.0, 60.0, 40.0), "tilt_deg": 10.0}},
        loads={"wrenches": [(0.0, 0.0, 0.0, 0.0, 0.0, 400.0)]},
        masses={"platform": 12.0},
        speeds={"linear": 200.0, "angular_deg": 30.0},
    )
    found = nd.admissible(study, {"a2": (597.0, 603.0), "b1": (198.0, 202.0)}, resolution=1.0)
    assert found.shares["inside"] == 1.0
    assert (found.designs, len(found.state)) == (1, 1)
    assert found.boxes < 20_000


def test_every_design_outside_breaks_the_limit_that_is_named_at_the_pose_that_is_named(case):
    rng = np.random.default_rng(3)
    region = case.study.objective.region
    for row, which in zip(*drawn_in(case.outside, 80, rng), strict=True):
        reason = case.reasons[which]
        variables = variables_of(case, row)
        pose = reason.pose
        if region is None or pose.listed is not None:
            there = ()
        else:
            shift = np.array(pose.shift)
            held = region.internal_point == "held"
            both = Rotation.from_rotvec(pose.tilt) * Rotation.from_rotvec((0.0, 0.0, pose.yaw))
            if region.unit == "zp":  # given for the design in the middle of the box
                box = case.outside[which]
                middle = variables_of(case, box.mean(axis=1))["zp"]
                shift = shift / middle
            there = (nd.Pose(tuple(shift), tuple(both.as_rotvec()), (0.0,) * 3 if held else tuple(shift), region.unit),)
        if reason.limit in SPREADS and region is not None:
            continue  # two poses: see the next test
        every, index = everything(case.study, there, variables)
        if reason.limit == "condition_number":
            limit = min(x for x in (case.of.condition_number, case.study.objective.condition_limit) if x is not None)
            assert index.max() > limit * (1.0 - ROUNDING)
        elif reason.limit == "no singularity":
            robot = robot_of(posed(case.study, there) if there else case.study, variables)
            home, seen = (nd.singularity_margins(robot.geometry, c) for c in (robot.neutral, robot.poses))
            name = "det_" + reason.part.removeprefix("det ").lower()
            assert (np.sign(getattr(home, name)) * getattr(seen, name)).min() < ROUNDING
        elif reason.limit == "zp > zs":
            assert not 0.0 < variables["zs"] < variables["zp"]
        else:
            assert every[reason.limit].min() < ROUNDING, (reason, row)


def test_designs_outside_by_a_spread_have_legs_of_such_lengths(case):
    region = case.study.objective.region
    if region is None:
        return
    rng = np.random.default_rng(4)
    for row, which in zip(*drawn_in(case.outside, 80, rng), strict=True):
        reason = case.reasons[which]
        if reason.limit not in SPREADS:
            continue
        every, _ = everything(case.study, random_poses(region, 2000, rng, 1.0), variables_of(case, row))
        # The worst pose is hardly drawn: most designs outside are far enough from the limit.
        assert every[reason.limit].min() < 0.02, (reason, row)


def test_a_limit_of_lengths_at_the_neutral_pose_is_of_that_pose():
    at = {"zp": 5.0, "zs": 3.0}
    ranges = {"a2": (2.0, 10.0), "b1": (1.0, 5.0)}
    limits = {"leg_ratio": {"max": 2.0, "at": "neutral"}}
    over_region = nd.Study(variables=SIZES, constraints=limits, objective={"region": BOX})
    alone = nd.Study(variables=SIZES, constraints={"leg_ratio": (None, 2.0)})
    one, two = (nd.admissible(study, ranges, at=at, resolution=0.05) for study in (over_region, alone))
    assert one.excluded["leg_ratio at neutral"] == pytest.approx(two.excluded["leg_ratio"], abs=0.02)


def test_legs_that_share_a_joint_in_the_study_may_collide_where_more_is_asked_about():
    """With a1 = 0 joints coincide in pairs; with a1 free they do not, and legs that meet there are too near."""
    study = nd.Study(
        variables={"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0, "zp": 5.0, "zs": 3.0},
        constraints={"leg_clearance": (0.5, None)},
    )
    found = nd.admissible(study, {"a1": (0.0, 2.0)}, resolution=0.01)
    for a1, state in ((0.1, "outside"), (1.9, "inside")):
        assert found.state_of([[a1]]) == [state]
    free = nd.Study(variables=dict(study.variables) | {"a1": (0.0, 2.0)}, constraints={"leg_clearance": (0.5, None)})
    assert nd.admissible(free, ("a1",), resolution=0.01).shares == pytest.approx(found.shares, abs=1e-9)


def test_o_beyond_a_plate_is_outside():
    study = nd.Study(variables={"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0})
    found = nd.admissible(study, {"zp": (2.0, 6.0), "zs": (1.0, 5.0)}, resolution=0.02)
    assert found.excluded["zp > zs"] == pytest.approx(9.0 / 32.0, abs=0.01)
    assert found.state_of([[3.0, 3.5], [5.0, 3.0]]) == ["outside", "inside"]


def test_no_box_inside_has_designs_of_both_signs_at_home():
    """Along theta_z det N at the neutral pose changes its sign: its zeros are in no box that is inside."""
    study = nd.Study(
        variables={"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0, "zp": 5.0, "zs": 3.0, "theta_z": (-2.0, 2.0)}
    )
    found = nd.admissible(study, ("theta_z",), resolution=0.002)

    def sign(theta):
        robot = robot_of(study, dict(found.of.at) | {"theta_z": float(theta)})
        return float(np.sign(nd.singularity_margins(robot.geometry, robot.neutral).det_n))

    signs = [{sign(theta) for theta in np.linspace(*ends, 5)} for ends in found.inside[:, 0, :]]
    assert all(len(seen) == 1 for seen in signs)
    assert {value for seen in signs for value in seen} == {-1.0, 1.0}
    assert found.shares["undecided"] < 0.01
    assert found.shares["inside"] > 0.9


@pytest.mark.parametrize(
    ("objective", "constraints", "words"),
    [
        (
            {"poses": [{"position": (0, 0.5, 0)}]},
            {"singularity_free": (0.01, None)},
            "singularity_free: got a limit of the",
        ),
        ({}, {}, "a2: got .*, expected a length"),
    ],
)
def test_what_has_no_bounds_over_boxes_of_designs_is_refused(objective, constraints, words):
    study = nd.Study(variables=SIZES, objective=objective, constraints=constraints)
    with pytest.raises(ValueError, match=words):
        nd.admissible(study, {"a2": (-2.0, 10.0) if not constraints else (2.0, 10.0)}, at={"b1": 3.0, **AT})
