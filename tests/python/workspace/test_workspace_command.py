"""The command `ninedof workspace`."""

import importlib
import json

import numpy as np
import pytest
from interrupts import interrupted_on_entry
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.cli.workspace_figures import _planes, _section
from ninedof.paper.published import published_variables
from ninedof.records.record import write_run
from ninedof.workspace.study_question import EASE, leg_ranges, own_fraction, study_criteria, study_limits
from ninedof.workspace.tables import criterion_words

BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
IN_BOX = "--x -2.5 2.5 --y -2.5 2.5 --z 3 7"
LEGS = {"leg_limits": (2.5, 6.5)}
OWN = published_variables()["zs"] / published_variables()["zp"]  # where the published design has O
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)


@pytest.mark.slow(sanitized=True)
def test_the_command_leaves_a_run_folder(run, tmp_path, published):
    line = f"workspace --legs 2.5 6.5 --condition 5 --tolerance 5e-3 {IN_BOX} --json"
    code, out, err = run(f"{line} --out {tmp_path / 'run'}")
    assert code == 0
    assert "\nworkspace: positions of the platform at the neutral rotation alone" in err
    numbers = json.loads(out)["workspace"]
    expected = nd.workspace(
        published, BOX, criteria=LEGS | {"condition_number": 5.0}, internal_point=OWN, tolerance=5e-3
    )
    assert_allclose(numbers["volume"], expected.volume, rtol=1e-12)
    figures = {f"{stem}.{kind}" for stem in ("workspace", "workspace_body") for kind in ("png", "svg", "pdf")}
    kept = {"question.json", "pieces"}
    assert {p.name for p in (tmp_path / "run").iterdir()} == {"record.json", "map.npz", "report.html"} | kept | figures
    record = json.loads((tmp_path / "run" / "record.json").read_text())
    assert record["results"]["workspace"]["volume"] == numbers["volume"]
    assert record["question"]["criteria"]["leg_limits"] == [2.5, 6.5]
    assert nd.WorkspaceMap.load(tmp_path / "run" / "map.npz").volume == numbers["volume"]


def test_the_horizontal_section_goes_through_home(published):
    found = nd.workspace(published, BOX, criteria=LEGS, internal_point=OWN, tolerance=0.1, home=HOME)
    sections = [_section(found, HOME, None, found.ball_centre, *plane) for plane in _planes(found, HOME, np.ones(3))]
    assert [section.plane.plane[0] for section in sections] == ["y", "x", "z"]
    assert sections[2].plane.plane[1] == HOME.position[2]
    assert_allclose(sections[2].home, [0.0, 0.0])
    away = nd.Configuration.neutral(zp=50.0, zs=25.0)  # no section has it
    assert [at for _, at in _planes(found, away, np.array([0.2, -0.4, 4.0]))] == [-0.4, 0.2, 4.0]


def test_the_command_with_orientations_and_with_an_empty_workspace(run, tmp_path):
    region = "--archetype orientation --tilt-deg 40 --torsion-deg 30 --resolution 8"
    code, out, _ = run(f"workspace {region} --legs 2 6.5 --no-figures --out {tmp_path / 'a'}")
    assert code == 0
    assert "volume" in out
    assert out.startswith("workspace: rotations of the platform at one position\n")
    assert "the workspace reaches the boundary of the region: it is larger in a larger region" in " ".join(out.split())
    assert "box" not in "".join(line for line in out.splitlines() if "boundary" in line or "share" in line)
    code, out, _ = run(f"workspace --legs 0 1 --no-figures --out {tmp_path / 'b'}")
    assert code == 3
    assert "no allowed pose" in out
    code, _, err = run(f"workspace --out {tmp_path / 'c'}")
    assert code == 2
    assert "expected at least one" in err
    assert not (tmp_path / "c").exists()


def test_the_first_line_names_the_faces_that_cut_and_the_options_for_more(run, tmp_path):
    line = "workspace --legs 2 6.5 --tolerance 0.1 --no-figures --x -5 5 --y -5 5"
    _, out, _ = run(f"{line} --z 4 14 --out {tmp_path / 'a'}")
    assert out.startswith("the box cuts the workspace: z low; a larger one: --z -1 14\n")
    _, out, _ = run(f"{line} --z -10 14 --out {tmp_path / 'b'}")
    assert out.startswith("workspace: positions of the platform at the neutral rotation alone")


@pytest.mark.slow(sanitized=True)
def test_the_command_passes_on_position_length_and_sample(run, tmp_path, published):
    at = "--archetype orientation --angle-deg 40 --position 0.5 0 4 --lc 2 --resolution 8"
    code, out, _ = run(f"workspace {at} --legs 2 6.5 --condition 6 --json --no-figures --out {tmp_path / 'a'}")
    assert code == 0
    expected = nd.workspace(
        published,
        archetype="orientation",
        position=(0.5, 0.0, 4.0),
        region={"angle": np.radians(40.0)},
        criteria={"leg_limits": (2.0, 6.5), "condition_number": 6.0},
        internal_point=OWN,
        characteristic_length=2.0,
        resolution=8,
    )
    assert_allclose(json.loads(out)["workspace"]["volume"], expected.volume, rtol=1e-12)
    sample = "--method sample --points 500 --seed 3 --legs 2.5 6.5"
    code, out, _ = run(f"workspace {sample} {IN_BOX} --json --out {tmp_path / 'b'}")
    expected = nd.workspace(published, BOX, criteria=LEGS, internal_point=OWN, method="sample", points=500, seed=3)
    assert json.loads(out)["workspace"]["volume"] == expected.volume


def test_ctrl_c_before_the_first_level_leaves_a_record(run, tmp_path, monkeypatch):
    """All numbers are NaN, and the command ends as after any other interruption."""
    monkeypatch.setattr(
        importlib.import_module("ninedof.cli.commands.runs.workspace"),
        "find_workspace",
        lambda *arguments, **options: nd.workspace(*arguments, **options | {"resolution": 128}),
    )
    with interrupted_on_entry("workspace"):
        code, out, err = run(f"workspace --condition 6 --internal-point best --json --out {tmp_path / 'run'}")
    assert code == 130
    numbers = json.loads(out)["workspace"]
    assert numbers["status"] == "stopped"
    assert numbers["levels"] == []
    again = nd.WorkspaceMap.load(tmp_path / "run" / "map.npz")
    assert again.percentiles.shape == (101,)
    assert np.isnan(again.percentiles).all()
    assert "interrupted" in err


def test_ctrl_c_after_the_search_keeps_the_map(run, tmp_path, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(importlib.import_module("ninedof.cli.commands.runs.workspace"), "workspace_table", interrupted)
    assert run(f"workspace --legs 2.5 6.5 --tolerance 0.1 --out {tmp_path / 'run'}")[0] == 130
    assert nd.load(tmp_path / "run").volume > 0.0


def test_the_command_starts_from_the_published_design_at_its_best(run, tmp_path):
    assert run(f"workspace --legs 0 1 --json --no-figures --out {tmp_path / 'run'}")[0] == 3
    asked = json.loads((tmp_path / "run" / "record.json").read_text())["question"]
    zs = asked["home"]["internal_point"][2]
    heights = nd.Configuration.neutral(asked["home"]["position"][2], zs + np.array([-1e-4, 0.0, 1e-4]))
    around = nd.condition_number(nd.Geometry(**asked["geometry"]), heights)
    assert around.argmin() == 1


@pytest.fixture(scope="module")
def a_run(tmp_path_factory):
    """The folder of a run whose study limits legs by kind, cones, clearance and singularities."""
    study = nd.Study(
        variables={"zp": (3.0, 5.0), "theta_z": (-0.5, 0.5)},
        constraints={
            "radius_ratio": (None, 2.0),
            "leg_length": (1.0, None),
            "external_length": (None, 6.0),
            "upper_length": {"max": 1.3, "of": "zp"},
            "lower_length": {"max": 6.0, "at": "neutral"},
            "zs_fraction": (None, 0.3),
            "base_cone": {"max_deg": 75, "axis": [0, 0, 1]},
            "leg_clearance": {"radius": 0.05},
            "singularity_free": {},
        },
        starts=4,
    )
    folder = tmp_path_factory.mktemp("run")
    found = nd.optimize(study)
    write_run(found, folder)
    return folder, found.candidates[0].configuration


QUICK = "--method grid --resolution 4 --json --no-figures"


def test_a_run_brings_its_limits_and_its_rule_for_the_internal_point(run, tmp_path, a_run):
    folder, home = a_run
    _, out, err = run(f"workspace {folder} {QUICK} --out {tmp_path / 'a'}")
    asked = json.loads((tmp_path / "a" / "record.json").read_text())["question"]
    zp, zs = home.position[2], home.internal_point[2]
    assert zs < 0.31 * zp
    assert_allclose(asked["internal_point"], zs / zp, rtol=1e-12)
    low, high = asked["criteria"]["leg_limits"]
    assert_allclose(low, np.ones(9), rtol=2 * EASE)
    assert_allclose(high[:6], np.repeat([6.0, 1.3 * zp], 3), rtol=2 * EASE)
    assert all(end in (None, np.inf, "inf", "Infinity") for end in high[6:])  # the limit at neutral is none here
    assert_allclose(asked["criteria"]["base_cone"]["max"], np.radians(75.0), rtol=2 * EASE)
    assert asked["criteria"]["base_cone"]["axis"] == [0.0, 0.0, 1.0]
    assert_allclose(asked["criteria"]["leg_clearance"], 0.1, rtol=2 * EASE)
    assert asked["criteria"]["singularity_free"] is True
    lines = err.splitlines()
    for words in (
        "home: p = ",
        f"O: at {zs / zp:.4g} of the way",
        "limit: external legs 1 to 6, of the study",
        "limit: base cone 75 degrees about the axis (0, 0, 1), of the study",
        "limit: leg clearance at least 0.1, of the study",
        "of the study, no limit of a single pose: radius_ratio, lower_length at neutral",
    ):
        assert sum(line.startswith(words) for line in lines) == 1, words
    assert json.loads(out)["workspace"]["home_allowed"]


def test_every_limit_of_a_run_is_replaced_by_its_option(run, tmp_path, a_run):
    folder, home = a_run
    own = "--legs 0.5 8 --lower 0 7 --base-cone-deg 70 --clearance 0.01 --any-singularity --internal-point held"
    run(f"workspace {folder} {QUICK} {own} --base-cone-axis 0 1 1 --out {tmp_path / 'a'}")
    asked = json.loads((tmp_path / "a" / "record.json").read_text())["question"]
    assert asked["internal_point"] == home.internal_point.tolist()
    assert_allclose(asked["criteria"]["leg_limits"][0], np.full(9, 0.5))
    assert_allclose(asked["criteria"]["leg_limits"][1], np.repeat([8.0, 8.0, 7.0], 3))
    assert asked["criteria"]["base_cone"] == {"max": np.radians(70.0), "axis": [0.0, 1.0, 1.0]}
    assert asked["criteria"]["leg_clearance"] == 0.01
    assert "singularity_free" not in asked["criteria"]
    code, _, err = run(f"workspace {folder} {QUICK} --no-study-limits --out {tmp_path / 'b'}")
    assert code == 2
    assert "expected at least one" in err


def test_ranges_by_kind_and_the_own_fraction():
    """A range of all nine legs stays two numbers; O beside the line of the centroids has no fraction."""
    assert leg_ranges({}) is None
    assert leg_ranges({"leg_length": (1.0, 3.0)}) == (1.0, 3.0)
    low, high = leg_ranges({"leg_length": (1.0, 3.0), "upper_length": (2.0, 9.0), "lower_length": (0.0, 2.5)})
    assert low.tolist() == [1, 1, 1, 2, 2, 2, 1, 1, 1]
    assert high.tolist() == [3, 3, 3, 3, 3, 3, 2.5, 2.5, 2.5]
    with pytest.raises(ValueError, match="external_length: got 3 to 2"):
        leg_ranges({"external_length": (3.0, 2.0)})
    upper, lower = np.array([0.0, 0.0, 5.0]), np.array([0.0, 0.0, 1.0])
    assert own_fraction(upper, lower, np.array([0.0, 0.0, 2.0])) == 0.25
    assert own_fraction(upper, lower, np.array([0.1, 0.0, 2.0])) is None


def test_a_limit_that_limits_nothing_is_no_criterion():
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0), nd.Configuration.neutral(3.9828, 2.4432)
    assert study_limits(nd.Study(constraints={"leg_clearance": {"min": 0.0}}), g, home) == ({}, [])


def test_joints_that_coincide_in_one_design_alone_collide():
    """As for optimize and certify, legs may share a joint where they do in every design of the study."""
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0), nd.Configuration.neutral(3.9828, 2.4432)
    limits = {"leg_clearance": {"min": 0.1}}
    box = ([-2.0, -2.0, 3.0], [2.0, 2.0, 5.0])
    for variables, allowed in (({}, False), ({"a1": 0.0, "b2": 0.0}, True)):
        study = nd.Study(variables=variables, constraints=limits)
        own = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.4432}
        assert (study.evaluate(own).margins["leg_clearance"] > 0.0) == allowed
        criteria, left = study_limits(study, g, home)
        assert not left
        found = nd.workspace(g, box, criteria=criteria, home=home, method="grid", resolution=4)
        assert found.home_allowed == allowed
        assert allowed or found.home_limit.startswith("leg_clearance")
        words = list(criterion_words("leg_clearance", criteria["leg_clearance"], ""))
        assert words == ["leg clearance at least 0.1"]
    with pytest.raises(ValueError, match=r"leg_clearance .exempt.: got 'l1'"):
        nd.workspace(g, box, criteria={"leg_clearance": {"min": 0.1, "exempt": ["l1"]}})


def test_limits_of_legs_and_what_the_poses_need_hold_together():
    """A least length in the study does not make room for legs that its limit on strokes excludes."""
    limits = {"stroke_ratio": (None, 1.5), "external_length": (4.0, None)}
    result = nd.optimize(nd.Study(constraints=limits, objective={"poses": nd.poses.box((0.3, 0.3, 0.2))}), starts=2)
    lengths = nd.leg_lengths(result.geometry, result.configurations)
    short, long = lengths.min(axis=0), lengths.max(axis=0)
    permitted = np.sqrt(short * long / 1.5), np.sqrt(short * long * 1.5)
    for actuators, (low, high) in {"needed": (short, long), "permitted": permitted}.items():
        asked = study_criteria(result, actuators=actuators)
        least, most = asked.criteria["leg_limits"]
        assert_allclose(least, np.maximum(low, np.repeat([4.0, 0.0, 0.0], 3)), rtol=2 * EASE)
        assert_allclose(most, high, rtol=2 * EASE)
        assert (asked.own, asked.left) == (set(), [])
    typed = study_criteria(result, {"upper_length": (1.0, 9.0)})
    assert (typed.left, typed.actuators) == (["stroke_ratio"], "")
    assert typed.criteria["leg_limits"][0].tolist() == pytest.approx(np.repeat([4.0, 1.0, 0.0], 3).tolist())


def test_an_option_of_all_joints_or_legs_replaces_those_of_each_kind(run, tmp_path):
    limits = {
        "base_cone_external": {"max_deg": 30.0},
        "base_cone_internal": {"max_deg": 60.0},
        "platform_cone_internal": {"max_deg": 50.0},
        "upper_length": (0.5, 9.0),
    }
    result = nd.optimize(nd.Study(variables={"a1": 0.0, "b2": 0.0}, constraints=limits), starts=2)
    typed = study_criteria(result, {"base_cone": 0.7})
    assert typed.replaced == ["base_cone_external", "base_cone_internal"]
    assert sorted(typed.criteria) == ["base_cone", "leg_limits", "platform_cone_internal"]
    assert typed.own == {"leg_limits", "platform_cone_internal"}
    assert study_criteria(result, {"base_cone_external": 0.7}).replaced == ["base_cone_external"]
    assert study_criteria(result, {"leg_length": (1.0, 8.0)}).replaced == ["upper_length"]
    assert study_criteria(result, {"external_length": (1.0, 8.0)}).replaced == []
    assert study_criteria(result).replaced == []
    folder = nd.save(result, tmp_path / "run").parent
    status, out, _ = run(f"workspace {folder} --base-cone-deg 40 --no-figures --tolerance 0.2 --out {tmp_path / 'w'}")
    assert status == 0
    words = " ".join(out.split())
    assert "limits of the study that options replace: base_cone_external, base_cone_internal " in words
    assert "limit: base cone 40 degrees" in words
    assert "base cone external" not in words
