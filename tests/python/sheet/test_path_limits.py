"""Margins along a path against those of the study at the poses passed so far."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd
from ninedof.motion.tables import limits_table

EVERY = {
    "leg_ratio": (None, 3.0),
    "stroke_ratio": (None, 1.1),
    "stroke": {"max": 0.5, "of": "zp"},
    "leg_length": (0.5, 9.0),
    "joint_spacing": {"min": 0.1},
    "leg_clearance": {"radius": 0.05},
    "base_cone": [{"max_deg": 60, "axis": [0, 0, 1]}, {"max_deg": 50, "axis": [0, 0, 1], "at": "neutral"}],
    "platform_cone": {"max_deg": 4},
    "singularity_free": {"steps": 1},
}
AXES = EVERY | {"base_cone": {"max_deg": 40}, "platform_cone": {"max_deg": 70, "axis": [0.1, 0.2, -1]}}


@pytest.mark.parametrize("constraints", [EVERY, AXES])
@pytest.mark.parametrize("seed", range(size(3, 100)))
def test_margins_are_those_of_the_study(seed, constraints):
    rng = np.random.default_rng(seed)
    turns, shift, internal = 0.1 * rng.normal(size=(3, 6, 3))
    poses = [nd.Pose(*(tuple(x.tolist()) for x in row)) for row in zip(shift, turns, internal, strict=True)]
    study = nd.Study(
        family="symmetric_nonplanar",
        constraints=constraints,
        objective={"poses": poses, "condition_limit": 20.0},
        characteristic_length=1.0,
    )
    problem = study.problem()
    variables = dict(zip(problem.names, problem.starts(1, seed)[0].tolist(), strict=True))
    point = study.evaluate(variables)
    g, home, c = point.geometry, point.configuration, point.configurations[1:]
    trajectory = nd.Trajectory(np.arange(6.0), c.position, c.rotation)
    followed = nd.follow(g, trajectory, home, internal_point="held")
    object.__setattr__(followed, "configurations", c)  # O where the study has it
    found = nd.path_limits(study, followed, home)
    assert {one.name for one in found.limits} == {*constraints, "condition_limit"} - {"leg_length", "joint_spacing"}
    for until in range(6):
        some = nd.Study(
            family="symmetric_nonplanar",
            constraints=constraints,
            objective={"poses": poses[: until + 1], "condition_limit": 20.0},
            characteristic_length=1.0,
        )
        margins = some.evaluate(variables).margins
        for name, values in found.margins.items():
            if name == "singularity_free":  # the study tests the way from the neutral pose too
                assert values[: until + 1].min() >= margins[name] - 1e-9
                continue
            assert values[: until + 1].min() == pytest.approx(margins[name], abs=1e-9)
    signs = np.sign(nd.singularity_margins(g, home))
    least = (np.stack(nd.singularity_margins(g, c), axis=1) * signs).min(axis=1)
    assert found.margins["singularity_free"] == pytest.approx(least - 0.001, abs=1e-12)
    for row in found.worst():
        assert row["margin"] <= found.margins[row["name"]].min() + 1e-12 or row["side"] == "min"
    broken = {entry.limit.rsplit(" ", 1)[0].split(" ")[0] for entry in found.breaks}
    assert broken == {name for name, values in found.margins.items() if values.min() < -1e-6}


def test_a_break_begins_where_the_limit_is_met():
    study = nd.Study(constraints={"base_cone": {"max_deg": 5.0}})
    g, home = nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0), nd.Configuration.neutral(3.9828, 2.4432)
    followed = nd.follow(g, nd.Trajectory.line(home, [0.5, 0.0, 0.0], points=4001), home)
    for broken in nd.path_limits(study, followed, home).breaks:
        leg = {"l": 0, "q": 3, "r": 6}[broken.limit.split()[1][0]] + int(broken.limit.split()[1][1]) - 1
        k = int(np.searchsorted(followed.time, broken.begin))
        start = np.vstack([g.base_external, g.base_internal, g.base_internal])[leg]

        def along(pose, leg=leg, start=start):
            end = pose.position + pose.rotation @ g.platform_external[leg % 3] if leg < 3 else pose.internal_point
            return (end - start) / np.linalg.norm(end - start)

        angle = np.degrees(np.arccos(along(home) @ along(followed.configurations[k])))
        assert angle == pytest.approx(5.0, abs=2e-3)


def test_shifted_keeps_the_arm_of_o():
    g, home = nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0), nd.Configuration.neutral(3.9828, 2.4432)
    turns = Rotation.from_rotvec(np.linspace(0.0, 0.2, 9)[:, None] * [0.0, 1.0, 0.0]).as_matrix()
    trajectory = nd.Trajectory(np.arange(9.0), home.position + 0.01 * np.arange(9.0)[:, None], turns)
    c = nd.follow(g, trajectory, home, internal_point="shifted").configurations
    assert np.allclose(c.internal_point - c.position, home.internal_point - home.position)


def test_rows_as_text_have_the_unit_of_their_limit():
    cone = {"name": "base_cone", "kind": "angle", "part": "l2", "side": "max", "margin": 17 / 18}
    cone |= {"limit_deg": 45.0, "value_deg": 2.5}
    length = {"name": "leg_clearance", "kind": "length", "part": "", "side": "min", "margin": 0.5}
    length |= {"limit": 20.0, "value": 30.0}
    ratio = length | {"name": "stroke_ratio", "kind": "ratio"}
    sign = length | {"name": "singularity_free", "kind": "sign", "limit": 0.1, "value": 0.35, "margin": 0.25}
    rows = limits_table({"unit": "mm", "limits": [row | {"at": 0.5} for row in (cone, length, ratio, sign)]}).rows
    assert rows[0] == ("base_cone l2", "max", "45.00°", "2.50°", "94.44 %", "0.5")
    assert rows[1] == ("leg_clearance", "min", "20 mm", "30 mm", "50.00 %", "0.5")
    assert rows[2][2:4] == ("20", "30")
    assert rows[3][4] == "0.2500"


def test_a_path_of_a_result_has_loads_masses_and_all_limits_of_its_study(tmp_path):
    """It said "within limits" of the legs alone, and had no forces."""
    study = nd.Study(
        unit="mm",
        family="hexagonal",
        variables={"a1": 0.0, "a2": 580.0, "b1": 290.0, "b2": 0.0, "zp": 400.0, "zs": 240.0, "theta_z": 0.0},
        characteristic_length=100.0,
        constraints={"base_cone": {"max_deg": 1.5}, "force": {"max": 1000.0}, "leg_length": (1.0, 900.0)},
        objective={"region": {"box": [1.0, 1.0, 1.0]}},
        tool={"position": [0.0, 0.0, -10.0]},
        loads={"gravity": [0.0, 9.81, 0.0], "wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, -90.0], [0.0] * 6]},
        masses={"platform": 3.0, "centre": [0.0, 0.0, 5.0]},
    )
    result = nd.optimize(study)
    home, masses = result.configuration, study.masses.seen_from(study.tool)
    line = nd.Trajectory.line(home, [0.5, 0.0, 0.0], points=51)
    along = nd.follow(result, line)
    by_hand = nd.follow(
        result.geometry,
        nd.Trajectory.line(home, [0.5, 0.0, 0.0], points=51, unit="mm"),
        home,
        "shifted",
        load=(np.array([[[0.0, 0.0, -90.0]], [[0.0] * 3]]), None),
        masses=masses,
        gravity=study.loads.gravity,
    )
    assert (along.leg_forces == by_hand.leg_forces).all()
    assert (along.unit, along.force_unit, along.load_count) == ("mm", "N", 2)
    assert repr(along) == "<Followed: 51 poses, within limits>"
    assert repr(by_hand) == "<Followed: 51 poses, no limits given>"
    far = nd.Trajectory.line(home, [20.0, 0.0, 0.0], points=51)
    least = nd.follow(result.geometry, far, home, limits=(1.0, np.inf))
    assert repr(least) == "<Followed: 51 poses, legs within their lengths, no other limit looked at>"
    point = study.evaluate(result.best.variables)
    bounded = replace(study, constraints={**study.constraints, "leg_length": (1.0, 900.0)}).evaluate(point.variables)
    assert repr(nd.follow(bounded, far)).endswith("legs within their lengths, no other limit looked at>")
    broken = nd.follow(result, far)
    assert broken.breaks == nd.path_limits(study, broken, home).breaks != ()
    assert "breaks base_cone l" in repr(broken)
    assert repr(nd.follow(result.geometry, far, home, limits=(1.0, 900.0))).endswith(
        "legs within their lengths, no other limit looked at>"
    )
    nd.save(broken, tmp_path / "path")
    assert nd.load(tmp_path / "path").breaks == broken.breaks
    assert "worst_deg" in (tmp_path / "path" / "record.json").read_text()
    with pytest.raises(ValueError, match="trajectory: got lengths in in, expected mm as in the design"):
        nd.follow(result, nd.Trajectory.line(home, [20.0, 0.0, 0.0], points=51, unit="in"))
