"""The duty of a machine in a study file: what is written is read back, and what does not fit is named."""

import math

import numpy as np
import pytest

import ninedof as nd
from ninedof.design.duty import DUTIES
from ninedof.support.structs import entries, keys

TABLES = {
    "about": {"project": "Polishing head", "author": "N. N.", "revision": "B"},
    "tool": {"position": [1.0, 2.0, -100.0], "rotation_deg": [0.0, 0.0, 90.0]},
    "loads": {"gravity": [0.0, 0.0, 9.81], "wrenches": [[0.0, 0.0, 0.5, 0.0, 0.0, -400.0], [1.0, 0, 0, 0, 0, 0]]},
    "masses": {
        "platform": 12.0,
        "centre": [0.0, 0.0, -30.0],
        "inertia": [2.0, 2.0, 3.0, 0.1, 0.0, -0.1],
        "cylinder": 1.5,
        "rod": 0.5,
        "cylinder_centre": 100.0,
        "rod_centre": 80.0,
        "cylinder_inertia": 0.25,
        "rod_inertia": 0.125,
        "internal_point": 0.75,
    },
    "speeds": {"linear": 200.0, "angular_deg": 30.0, "acceleration": 2.0, "angular_acceleration_deg": 10.0},
    "tolerances": {"joints": 0.02, "legs": 0.01},
}


def test_a_study_keeps_its_duty_in_its_file(tmp_path):
    study = nd.Study(unit="mm", **TABLES)
    assert {name: study.to_dict()[name] for name in TABLES} == TABLES
    study.save(tmp_path / "study.toml")
    assert nd.Study.load(tmp_path / "study.toml") == study
    assert nd.Study(unit="mm", **{name: DUTIES[name].from_dict(one) for name, one in TABLES.items()}) == study
    assert study.with_solver(3).tool == study.tool


def test_every_key_is_in_the_round_trip():
    for name, kind in DUTIES.items():
        degrees = {key.removesuffix("_deg") for key in TABLES[name]}
        assert degrees == {one.name for one in entries(kind)} == {key.removesuffix("_deg") for key in keys(kind)}


def test_a_study_without_them_is_written_as_before():
    assert not set(nd.Study().to_dict()) & set(DUTIES)
    assert repr(nd.Study()).endswith("constraints={})")
    assert nd.Study.from_dict({"tool": {}}) == nd.Study()


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"tool": {"positon": [0, 0, 1]}}, r"tool: got the entry 'positon'.*did you mean 'position'"),
        ({"tool": {"position": [0, 0]}}, r"tool\.position: got \[0, 0\], expected three finite numbers"),
        ({"tool": {"rotation": [0, 0, 1], "rotation_deg": [0, 0, 1]}}, r"tool\.rotation: got both"),
        ({"tool": {"unit": "mm"}}, r"tool\.unit: .*at the top of the file"),
        ({"loads": {"wrenches": [[0] * 6, [0] * 5]}}, r"loads\.wrenches\[1\]: .*expected \[mx, my, mz, fx, fy, fz\]"),
        ({"loads": {"gravity": [0, 0, math.inf]}}, r"loads\.gravity: "),
        ({"masses": {"rod": -1.0}}, r"masses\.rod: got -1.0, expected a finite number at least 0"),
        ({"masses": {"inertia": [1, 1, 3, 0, 0, 0]}}, r"masses\.inertia: got principal moments 1, 1, 3"),
        ({"speeds": {"angular_deg": -1}}, r"speeds\.angular_deg: got -1"),
        ({"tolerances": {"joints": "small"}}, r"tolerances\.joints: got 'small', expected a number"),
        (
            {"unit": "mm", "variables": {"zp": [300, 700]}, "tolerances": {"joints": 70}},
            r"tolerances\.joints: got 70 mm, expected less than a tenth of the greatest zp, 70 mm",
        ),
        (
            {"variables": {"zp": 5.0, "zs": 2.0}, "tolerances": {"joints": 0.49, "legs": 0.6}},
            r"tolerances\.legs: got 0.6, expected less than a tenth of the greatest zp, 0.5",
        ),
        ({"about": {"project": 7}}, r"about\.project: got 7, expected text"),
        ({"about": "me"}, r"about: got 'me', expected a table"),
        ({"mass": {}}, r"study: got the entry 'mass'.*did you mean 'masses'"),
    ],
)
def test_what_does_not_fit_is_named(tables, message):
    with pytest.raises(ValueError, match=message):
        nd.Study.from_dict(tables)


def test_centre_and_inertia_in_the_frame_of_the_tool():
    """Held against the same cloud of point masses, seen from both frames."""
    tool = nd.Tool((10.0, -20.0, 30.0), (0.3, -0.4, 1.2))
    masses, at = np.array([1.0, 2.0, 0.5, 0.7]), np.random.default_rng(1).normal(size=(4, 3))

    def body(points):
        centre = masses @ points / masses.sum()
        arms = points - centre
        m = sum(w * (a @ a * np.eye(3) - np.outer(a, a)) for w, a in zip(masses, arms, strict=True))
        return centre, (m[0, 0], m[1, 1], m[2, 2], m[0, 1], m[0, 2], m[1, 2])

    x, y, z = np.array(tool.rotation) / np.linalg.norm(tool.rotation)
    turn = np.cos(np.linalg.norm(tool.rotation))
    axes = turn * np.eye(3) + (1 - turn) * np.outer([x, y, z], [x, y, z])
    axes += np.sqrt(1 - turn**2) * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    centre, inertia = body(at)
    seen = nd.Masses(masses.sum(), centre=tuple(centre), inertia=inertia).seen_from(tool)
    expected = body((at - tool.position) @ axes)
    assert np.allclose(seen.centre, expected[0], atol=1e-12)
    assert np.allclose(seen.inertia, expected[1], atol=1e-12)
