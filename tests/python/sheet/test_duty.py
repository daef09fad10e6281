"""What a study says of its duty is what sheets and commands take where they are told nothing."""

import json

import numpy as np
import pytest

import ninedof as nd
from ninedof.support.text import encode

DUTY = {
    "tool": {"position": (10.0, 0.0, -100.0), "rotation_deg": (0.0, 10.0, 0.0)},
    "loads": {"gravity": (0.0, 9.81, 0.0), "wrenches": [[0, 0, 50, 0, 0, -400], [100, 0, 0, 0, 0, 0]]},
    "masses": {"platform": 12.0, "centre": (0.0, 0.0, -30.0)},
    "speeds": {"linear": 200.0, "angular_deg": 30.0},
    "tolerances": {"joints": 0.02, "legs": 0.01},
}
VALUES = {"a1": 0.0, "a2": 871.9, "b1": 435.9, "b2": 0.0, "zp": 597.4, "zs": 366.5}
POSES = [{"position": (30.0, 20.0, 10.0), "rotation_deg": (5.0, 0.0, 3.0)}]


@pytest.fixture(scope="module")
def result():
    return nd.optimize(
        nd.Study(variables=VALUES, unit="mm", characteristic_length=150.0, objective={"poses": POSES}, **DUTY)
    )


@pytest.fixture(scope="module")
def plain():
    study = nd.Study(variables=VALUES, unit="mm", characteristic_length=150.0, objective={"poses": POSES})
    return nd.optimize(nd.Study.from_dict(study.to_dict() | {"tool": DUTY["tool"]}))


GIVEN = {
    "linear_speed": 200.0,
    "angular_speed": np.radians(30.0),
    "loads": DUTY["loads"]["wrenches"],
    "mass": 12.0,
    "centre": (0.0, 0.0, -30.0),
    "gravity": (0.0, 9.81, 0.0),
    "leg_errors": 0.01,
    "joint_errors": 0.02,
}


def test_a_sheet_of_a_study_with_duty_is_one_that_is_told(result, plain):
    stated, told = result.sheet(), plain.sheet(**GIVEN)
    assert json.loads(encode(stated.to_dict())) | {"stated": []} == json.loads(encode(told.to_dict()))
    assert stated.stated == ("speeds", "loads", "tolerances", "masses")
    assert "From the study: [speeds], [loads], [tolerances], [masses]." in stated.summary()
    assert "tool's point, (10, 0, -100) mm, in the frame of the plate" in stated.summary()


def test_an_option_beats_the_study(result, plain):
    more = {"linear_speed": 7.0, "loads": [0, 0, 0, 0, 0, 1.0], "leg_errors": 0.5, "gravity": (0, 0, -1), "mass": 2.0}
    one, other = (json.loads(encode(x.to_dict())) for x in (result.sheet(**more), plain.sheet(**(GIVEN | more))))
    assert one | {"stated": []} == other
    assert result.sheet(**more).stated == ("speeds", "tolerances")


def test_the_weight_acts_where_the_study_has_it(result):
    """Held against the moment of the weight about the tool's point, in numpy, and leg_forces."""
    sheet, best = result.sheet(loads=[0.0] * 6), result.best
    tool, expected = result.study.tool, []
    for k in range(2):
        c = best.configurations[k]
        plate = tool.plate(c)
        arm = plate.position + plate.rotation @ [0.0, 0.0, -30.0] - c.position
        force = 12.0 * np.array([0.0, 9.81, 0.0])
        expected.append(nd.leg_forces(best.geometry, c, np.cross(arm, force), force).forces)
    ends = np.array([leg.forces[0] for leg in sheet.legs])
    assert np.allclose(ends[:, 0], np.min(expected, axis=0), atol=1e-9)
    assert np.allclose(ends[:, 1], np.max(expected, axis=0), atol=1e-9)


def test_joints_of_the_sheet_are_in_the_frame_of_their_plate(result):
    g = nd.Geometry.hexagonal(*(VALUES[name] for name in ("a1", "a2", "b1", "b2")))
    joints = {name: (own, there) for name, own, there in result.sheet().joints()}
    for triple in ("base_external", "base_internal", "platform_external", "platform_internal"):
        for i, point in enumerate(getattr(g, triple), start=1):
            own, there = joints[f"{triple}_{i}"]
            assert own == pytest.approx(point, abs=1e-9)
            assert there == pytest.approx(point + np.array([0, 0, 597.4 * triple.startswith("platform")]), abs=1e-9)


@pytest.fixture(scope="module")
def folder(result, tmp_path_factory):
    directory = tmp_path_factory.mktemp("runs") / "run"
    nd.save(result, directory)
    return directory


def answer(run, line):
    status, out, err = run(f"{line} --json")
    assert status == 0, err
    return json.loads(out), err


def test_commands_take_the_duty_of_a_run(run, folder, result):
    data, words = answer(run, f"accuracy {folder}")
    assert (data["leg_error"], data["joint_error"]) == (0.01, 0.02)
    assert "tolerances: legs 0.01 mm of the study, joints 0.02 mm of the study" in words
    assert (
        "tolerances: legs 0.03 mm, joints 0.02 mm of the study" in answer(run, f"accuracy {folder} --leg-error 0.03")[1]
    )
    data, words = answer(run, f"forces {folder} --all-poses")
    assert "from the study: [loads], [masses]" in words
    forces = np.array(data["forces"])
    for k, leg in enumerate(result.sheet().legs):
        assert np.allclose(forces[:, :, k].min(axis=1), [least for least, _ in leg.forces], atol=1e-9)
    data, _ = answer(run, f"sheet {folder}")
    assert data["motion"]["linear_speed"] == 200.0
    assert data["stated"] == ["speeds", "loads", "tolerances", "masses"]


def test_a_design_without_duty_must_be_told(run, tmp_path):
    file = tmp_path / "design.toml"
    file.write_text("[geometry]\na1 = 0.0\na2 = 5.8\nb1 = 2.9\nb2 = 0.0\n[configuration]\nzp = 4.0\nzs = 2.4\n")
    for command, message in (("forces", "--load: got none"), ("accuracy", "neither --leg-error nor --joint-error")):
        status, _, err = run(f"{command} {file}")
        assert status == 2
        assert message in err


def test_a_design_file_with_a_tool(run, tmp_path):
    text = "[geometry]\na1 = 0.0\na2 = 5.8\nb1 = 2.9\nb2 = 0.0\n[configuration]\nzp = 4.0\nzs = 2.4\n"
    (tmp_path / "own.toml").write_text(text)
    (tmp_path / "tool.toml").write_text(text + "[tool]\nposition = [0.5, 0.0, -1.0]\nrotation_deg = [0, 20, 0]\n")
    own, design = nd.load(tmp_path / "own.toml"), nd.load(tmp_path / "tool.toml")
    assert design.configuration.position.tolist() == [0.5, 0.0, 3.0]
    assert np.allclose(nd.leg_lengths(*design[:2]), nd.leg_lengths(*own[:2]), rtol=1e-14)
    values = {"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4}
    study = nd.Study(variables=values, tool=design.tool)
    assert design.condition_number == pytest.approx(study.evaluate(values).condition_number, rel=1e-12)
    data, words = answer(run, f"evaluate {tmp_path / 'tool.toml'}")
    assert data["condition_number"] == pytest.approx(design.condition_number, rel=1e-12)
    assert "O is not between" not in words
