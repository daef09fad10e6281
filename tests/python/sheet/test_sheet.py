"""The engineering sheet against plain numpy, and against the second opinion on limits."""

import csv
import io
import re
from itertools import combinations

import numpy as np
import numpy_model as model
import pytest
from robots import rates, robots_at_poses
from scipy.optimize import lsq_linear
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd
from ninedof import _core
from ninedof.cli.posed import PoseOptions, named_design
from ninedof.design.limit_numbers import PARTS, apart
from ninedof.report.optimization import sheet_html
from ninedof.sheet.pose_words import outside_words, pose_words
from ninedof.sheet.sheet import Extreme
from ninedof.sheet.tables import sheet_parts

LEGS = [f"{kind}{i}" for kind in "lqr" for i in (1, 2, 3)]


def ends(m):
    """Start and end of the nine legs, (9, 3)."""
    out, up = m.p + m.u @ m.Q.T, m.p + m.ut @ m.Q.T
    return np.vstack([m.r, up, m.rh]), np.vstack([out, np.tile(m.s, (6, 1))])


def distance(a, b, c, d):
    """Least distance of two segments: a bounded least-squares problem."""
    found = lsq_linear(np.column_stack([b - a, c - d]), c - a, bounds=(0.0, 1.0), method="bvls")
    return np.sqrt(2.0 * found.cost)


def turned(x, y):
    return np.arccos(np.clip(x @ y / np.linalg.norm(x) / np.linalg.norm(y), -1.0, 1.0))


@pytest.mark.parametrize("seed", range(size(6, 100)))
def test_every_number_of_random_robots(seed):
    g, c, rng = robots_at_poses(seed)
    models = [model.robot(g, pose) for pose in c]
    load, v, w = rng.normal(size=(2, 6)), 1.7, 0.6
    k = rng.uniform(1.0, 3.0, size=9)
    found = nd.sheet(
        g, c, linear_speed=v, angular_speed=w, loads=load, leg_errors=1e-3, leg_stiffness=k, characteristic_length=1.3
    )
    lengths = np.array([model.lengths(m) for m in models])
    kappa = np.array([model.condition_number(m, 1.3) for m in models])
    H = np.array([rates(m) for m in models])
    least = np.array([np.linalg.pinv(model.jacobian(m)) for m in models])
    speed = (w * np.linalg.norm(least[:, :, :3], axis=-1) + v * np.linalg.norm(least[:, :, 3:], axis=-1)).max(axis=0)
    forces = np.array([[np.linalg.solve(h.T, -np.concatenate([f, np.zeros(3)])) for h in H] for f in load])
    start, end = zip(*(ends(m) for m in models), strict=True)

    assert [leg.name for leg in found.legs] == LEGS
    for i, leg in enumerate(found.legs):
        low, high = lengths[:, i].min(), lengths[:, i].max()
        expected = (low, high, lengths[0, i], high - low, high / low, speed[i])
        got = (leg.shortest, leg.longest, leg.neutral, leg.stroke, leg.stroke_ratio, leg.speed)
        assert got == pytest.approx(expected, rel=1e-9)
        assert not leg.idle
        assert np.allclose(leg.forces, [(f[:, i].min(), f[:, i].max()) for f in forces], rtol=1e-8, atol=1e-10)
        along = [e[i] - s[i] for s, e in zip(start, end, strict=True)]
        base = max(turned(x, along[0]) for x in along)
        platform = max(turned(m.Q.T @ x, models[0].Q.T @ along[0]) for m, x in zip(models, along, strict=True))
        assert leg.base_cone == (None if 3 <= i < 6 else pytest.approx(base, abs=1e-7))
        assert leg.platform_cone == (None if i >= 6 else pytest.approx(platform, abs=1e-7))

    assert found.condition_number == (pytest.approx(kappa.max(), rel=1e-9), int(kappa.argmax()))
    assert found.mean_condition_number == pytest.approx(kappa.mean(), rel=1e-9)
    pairs = [(a, b) for a, b in combinations(range(9), 2) if a < 3]  # the internal legs meet in O
    apart_by = [[distance(s[a], e[a], s[b], e[b]) for a, b in pairs] for s, e in zip(start, end, strict=True)]
    pose, pair = np.unravel_index(np.argmin(apart_by), np.shape(apart_by))
    assert found.clearance.value == pytest.approx(apart_by[pose][pair], abs=1e-7)
    assert (found.clearance.pose, found.clearance.legs) == (pose, tuple(LEGS[x] for x in pairs[pair]))

    def units(x):
        return x / np.linalg.norm(x, axis=-1, keepdims=True)

    dets = {"det_b": [], "det_c": [], "det_n": []}
    for m, s, e in zip(models, start, end, strict=True):
        dets["det_b"].append(np.linalg.det(units((e - s)[6:])))
        dets["det_c"].append(np.linalg.det(units((e - s)[3:6])))
        dets["det_n"].append(np.linalg.det(np.cross(units(s[:3] - m.s), units(e[:3] - m.s))))
    for name, values in dets.items():
        one = found.determinants[name]
        assert (one.value, one.pose) == (pytest.approx(np.abs(values).min(), rel=1e-7), int(np.abs(values).argmin()))
        assert one.changes_sign == (min(values) * max(values) < 0.0)
    assert found.determinants[found.nearest_singularity].value == min(d.value for d in found.determinants.values())

    inverse = np.linalg.inv(H)  # changes of (rotation, p, s) per change of length
    corners = 1e-3 * np.array(np.meshgrid(*[[-1.0, 1.0]] * 9)).reshape(9, -1)
    for name, rows in {"rotation": slice(0, 3), "position": slice(3, 6), "internal_point": slice(6, 9)}.items():
        worst = np.array([np.linalg.norm(x[rows] @ corners, axis=0).max() for x in inverse])
        assert getattr(found.accuracy, name) == (pytest.approx(worst.max(), rel=1e-8), int(worst.argmax()))
    compliance = inverse @ (np.eye(9) / k) @ np.swapaxes(inverse, -1, -2)
    for name, rows in {"rotation": slice(0, 3), "translation": slice(3, 6)}.items():
        soft = np.linalg.eigvalsh(compliance[:, rows, rows])[:, -1]
        assert getattr(found.stiffness, name) == (pytest.approx(1.0 / soft.max(), rel=1e-7), int(soft.argmax()))


@pytest.mark.parametrize("internal", ["held", "carried"])
def test_leg_speeds_with_o_held_and_carried(internal):
    g, c, _ = robots_at_poses(11)
    models = [model.robot(g, pose) for pose in c]
    found = nd.sheet(g, c, linear_speed=2.0, angular_speed=0.5, internal=internal)
    worst = []
    for m in models:
        x, y, z = m.s - m.p
        cross = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])  # omega x (s - p)
        sdot = np.hstack([cross, np.eye(3)]) if internal == "carried" else np.zeros((3, 6))
        rows = rates(m) @ np.vstack([np.eye(6), sdot])
        worst.append(0.5 * np.linalg.norm(rows[:, :3], axis=1) + 2.0 * np.linalg.norm(rows[:, 3:], axis=1))
    assert [leg.speed for leg in found.legs] == pytest.approx(np.max(worst, axis=0), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(("internal", "words"), [("shifted", "shift with O"), ("held", "shift, O at rest")])
def test_the_nearest_singularity_says_whether_o_moves_with_the_platform(internal, words):
    g, c, _ = robots_at_poses(2)
    assert f"nearest singularity: {words} " in nd.sheet(g, c, internal=internal).summary()


def test_the_rule_of_o_is_that_of_the_poses():
    g, c, _ = robots_at_poses(3)
    o = np.broadcast_to(c.internal_point[0], (5, 3))
    rest = nd.sheet(g, nd.Configuration(c.position, c.rotation, o))
    assert rest.motion.internal == "held"
    assert rest.idle == ("r1", "r2", "r3")
    assert [leg.speed for leg in rest.legs[6:]] == [0.0, 0.0, 0.0]
    own = c.rotation[0].T @ (c.internal_point[0] - c.position[0])
    carried = nd.sheet(g, nd.Configuration(c.position, c.rotation, c.position + c.rotation @ own))
    assert carried.motion.internal == "carried"
    assert carried.idle == ("q1", "q2", "q3")
    assert nd.sheet(g, c).motion.internal == "least"
    assert nd.sheet(g, c[:1]).idle == ()


def test_legs_with_a_common_joint_are_exempt():
    g = nd.Geometry.hexagonal(a1=0.0, a2=3.0, b1=1.5, b2=0.0)  # joints in pairs
    meeting = [name for k, name in enumerate(PARTS["leg_clearance"]) if k not in apart(g)]
    assert len(meeting) == 6  # each of the joints of l shared with one q and one r
    assert sorted(name[0] + name[3] for name in meeting) == ["lq"] * 3 + ["lr"] * 3


def test_joints_that_coincide_in_one_design_collide_where_a_study_limits_the_distance():
    sides = {"a1": (0.0, 1.0), "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4, "theta_z": 0.0}
    for limits in ({}, {"leg_clearance": {"min": 0.1}}):
        free, fixed = (nd.Study(variables=sides | {"a1": a1}, constraints=limits) for a1 in ((0.0, 1.0), 0.0))
        g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8, b1=2.9, b2=0.0), nd.Configuration.neutral([4.0], 2.4)
        distances = _core.limit_numbers(_core.Limit(name="leg_clearance"), g, home[0], home, 1.0)
        assert (distances[:, apart(g, free)].min() > 0.5) == (not limits)
        assert distances[:, apart(g, fixed)].min() > 0.5


def test_a_crossed_singularity_is_said():
    g = nd.Geometry.hexagonal(a1=0.0, a2=3.0, b1=1.5, b2=0.0)
    above, below = (
        nd.sheet(g, nd.Configuration.neutral(3.0, [1.0, 2.0])),
        nd.sheet(g, nd.Configuration.neutral(3.0, [1.0, -2.0])),
    )
    assert not above.determinants["det_b"].changes_sign
    assert below.determinants["det_b"].changes_sign
    singular = nd.sheet(g, nd.Configuration.neutral(3.0, [1.0, 0.0]), leg_stiffness=1.0, leg_errors=1.0)
    assert singular.condition_number == Extreme(np.inf, 1)
    assert singular.determinants["det_b"][1:] == (1, True)
    without_length = nd.sheet(g, nd.Configuration.neutral(3.0, [0.0, 1.0]), characteristic_length="optimal")
    assert without_length.condition_number == Extreme(np.inf, 0)
    assert singular.stiffness.translation.value == pytest.approx(0.0, abs=1e-9)


def test_the_sheet_of_a_result_has_the_limits():
    study = nd.Study(
        variables={"a1": 0.0, "a2": 5.0, "b1": 2.5, "b2": 0.0, "zp": 4.0},
        constraints={"leg_ratio": (None, 3.0), "base_cone": {"max_deg": 45}},
        objective={"poses": nd.poses.box(half=(0.1, 0.1, 0.1))},
    )
    result = nd.optimize(study, starts=2)
    found = result.sheet(linear_speed=2.0)
    assert [row.name for row in found.limits] == ["leg_ratio", "base_cone"]
    assert found.limits[1].value == pytest.approx(max(leg.base_cone for leg in found.legs if leg.base_cone is not None))
    assert found.condition_number.value == pytest.approx(max(*result.conditions, result.condition_number))
    assert found.motion.linear_speed == 2.0
    lines = found.summary().splitlines()
    assert [line.split()[0] for line in lines].count("l1") == 2  # lengths, speeds
    assert re.search(rf"condition number +{found.condition_number.value:.6f}", found.summary())
    assert re.match(r"base_cone +[lr][123] +max +45.00°", lines[-1])
    assert repr(found).startswith("<Sheet over 28 poses")


def test_csv_and_plain_values_are_in_degrees():
    g, c, _ = robots_at_poses(2)
    found = nd.sheet(g, c, loads=[0, 0, 0, 0, 0, -1], angular_speed=np.pi, joint_errors=1e-3)
    rows = list(csv.DictReader(io.StringIO(found.to_csv())))
    plain = found.to_dict()
    for leg, row, entry in zip(found.legs, rows, plain["legs"], strict=True):
        assert row["leg"] == entry["leg"] == leg.name
        assert float(row["longest"]) == entry["longest"] == leg.longest
        assert row["base_cone_deg"] == ("" if leg.base_cone is None else repr(np.degrees(leg.base_cone).item()))
        assert entry["platform_cone_deg"] == (None if leg.platform_cone is None else np.degrees(leg.platform_cone))
        assert float(row["force_1_max"]) == entry["forces"][0]["max"] == leg.forces[0][1]
        assert float(row["force_largest"]) == max(map(abs, leg.forces[0]))
        assert (float(row["platform_speed"]), float(row["platform_turn_deg"])) == (1.0, 180.0)  # of its speeds
    assert plain["motion"]["angular_speed_deg"] == pytest.approx(180.0)
    assert plain["accuracy"]["rotation_deg"]["value"] == np.degrees(found.accuracy.rotation.value)
    placed = plain["joints"]["platform_internal_2"]["neutral_pose"]
    assert np.allclose(placed, c.position[0] + c.rotation[0] @ g.platform_internal[1])


def test_poses_are_said_as_they_are_typed_and_numbered_once(run, tmp_path):
    """What terminal, page and JSON say of a pose, given to a command, is that pose; turns about other axes differ."""
    rng = np.random.default_rng(7)
    poses = [
        {"position": rng.uniform(-0.3, 0.3, 3).tolist(), "rotation": rng.uniform(-0.3, 0.3, 3).tolist()}
        for _ in range(4)
    ]
    poses += [{"rotation_deg": turn} for turn in ([9.0, 0.0, 0.0], [0.0, 9.0, 0.0])]
    study = nd.Study(variables={"theta_z": 0.2}, constraints={"radius_ratio": (None, 2.0)}, objective={"poses": poses})
    result = nd.optimize(study, starts=2)
    kept = nd.save(result, tmp_path / "run")
    found, chosen = nd.sheet(result), named_design(str(kept))
    said = [pose_words(c, found.configurations.rotation[0]) for c in found.configurations]
    assert len(set(said)) == len(said)
    listed = found.to_dict()["poses"]
    for k, words in enumerate(said):
        p, o, turn = (re.search(rf"{name} \(([^)]*)\)", words)[1].replace(",", "") for name in ("p =", "O =", "turned"))
        p, turn = (tuple(map(float, text.split())) for text in (p, turn))
        there = PoseOptions(design="", position=p, rotation_deg=turn, internal_point=o).poses(chosen)[0]
        for name in ("position", "rotation", "internal_point"):
            np.testing.assert_allclose(getattr(there, name), getattr(found.configurations[k], name), atol=2e-5)
            np.testing.assert_allclose(listed[k][name], getattr(found.configurations[k], name))
        turned = Rotation.from_rotvec(listed[k]["rotation_deg"], degrees=True) * Rotation.from_matrix(
            found.configurations.rotation[0]
        )
        np.testing.assert_allclose(turned.as_matrix(), found.configurations.rotation[k], atol=1e-12)
    terminal = " ".join(run(f"sheet {kept}")[1].split())
    page = str(sheet_html(found))
    numbered = [k for k in range(1, len(said)) if f"pose {k}: {said[k]}" in terminal]
    assert numbered
    for k in numbered:
        assert f">pose {k}: {said[k]}<" in page


def test_drives_without_a_force_are_zero():
    """A weight along the axis that the external legs do not carry: 2e-14 is rounding."""
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    sheet = nd.sheet(g, nd.Configuration.neutral(zp=[3.9828], zs=2.3745), mass=5.0)
    beside = next(part for part in sheet_parts(sheet) if isinstance(part, tuple) and part[1].title.startswith("Drives"))
    drives = beside[1]
    forces = [row[1] for row in drives.rows if row]
    assert forces[:3] == ["0"] * 3
    assert all(float(x) > 1.0 for x in forces[3:])


def test_an_internal_point_that_is_not_between_the_plates_is_said(run, tmp_path):
    place, turn = np.array([0.0, 0.0, 4.0]), Rotation.from_rotvec([0.3, 0.0, 0.0]).as_matrix()

    def words(*points, tool=None):
        return list(outside_words(nd.Configuration([place] * len(points), turn, points), tool or nd.Tool(), "mm"))

    assert words((0.0, 0.0, 2.0), place + turn @ [3.0, 0.0, -0.1]) == []
    below, above = words((0.0, 0.0, -1.0), (0.1, 0.2, -1.5), place + turn @ [0.5, 0.5, 0.25])
    assert below == "O lies below the base, by up to 1.5 mm: at p = (0, 0, 4), O = (0.1, 0.2, -1.5)."
    assert above.startswith("O lies above the platform, by up to 0.25 mm: at p = (0, 0, 4), O = (0.5")
    assert len(words(place + turn @ [0.0, 0.0, 0.5], tool=nd.Tool(position=(0.0, 0.0, -1.0)))) == 0
    assert words((np.nan, np.nan, np.nan)) == []
    file = tmp_path / "design.toml"
    text = "[geometry]\n" + "".join(f"{name} = {value}\n" for name, value in {
        "base_external": [[3.0, 0.0, 0.0], [-1.5, 2.6, 0.0], [-1.5, -2.6, 0.0]],
        "base_internal": [[1.5, 1.0, 0.0], [-1.7, 0.8, 0.0], [0.1, -1.8, 0.0]],
        "platform_external": [[1.0, 0.9, 0.0], [-1.3, 0.5, 0.0], [0.2, -1.4, 0.0]],
        "platform_internal": [[1.2, -0.5, 0.0], [0.0, 1.3, 0.0], [-1.2, -0.6, 0.0]],
    }.items())  # fmt: skip
    file.write_text(text + "[configuration]\nposition = [0, 0, 3.5]\ninternal_point = [0, 0, -1]\n")
    assert "O lies below the base, by 1: at p" in run(f"sheet {file}")[1]
