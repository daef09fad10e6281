"""The argument DESIGN, and the commands that ask one question about a design: their numbers are the library's."""

import json
import re

import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.posed import named_design

STUDY = nd.Study(
    family="symmetric",
    constraints={"leg_ratio": (None, 2.5), "radius_ratio": (None, 2.0)},
    objective={"poses": nd.poses.box(half=(0.3, 0.0, 0.0))},
    starts=3,
)
GENERAL = """
characteristic_length = 2.0
[geometry]
base_external = [[3.0, 0.1, 0.0], [-1.4, 2.6, 0.1], [-1.6, -2.5, 0.0]]
base_internal = [[1.9, 1.0, 0.0], [-1.8, 1.1, 0.0], [0.1, -2.0, 0.1]]
platform_external = [[1.0, 0.9, 0.0], [-1.3, 0.3, 0.1], [0.2, -1.4, 0.0]]
platform_internal = [[1.2, -0.5, 0.0], [0.0, 1.3, 0.0], [-1.2, -0.6, 0.1]]
[configuration]
zp = 3.5
zs = 1.6
theta_z = 0.1
"""
LOAD = "'0 1 0 0 0 -100'"
KAPPA = 1e-12  # relative


def data_of(run, line, expected=0):
    """What a command says with --json, which has no literal that JSON lacks."""
    status, out, err = run(line + " --json")
    assert status == expected, err

    def refuse(literal):
        raise AssertionError(literal)

    return json.loads(out, parse_constant=refuse)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A run, a front and a design file of no symmetry."""
    place = tmp_path_factory.mktemp("designs")
    nd.save(nd.optimize(STUDY), place / "run")
    nd.save(nd.pareto(STUDY, "leg_ratio", values=[2.0, 2.5]), place / "front")
    (place / "design.toml").write_text(GENERAL)
    (place / "poses.csv").write_text("t,x,y,z,yaw_deg\n0,0,0,3.6,0\n")
    return place


@pytest.fixture(autouse=True)
def _there(folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("COLUMNS", "80")


NAMES = ("design.toml", "run", "run/record.json", "front#2")


@pytest.mark.parametrize("name", NAMES)
def test_every_command_takes_every_name(run, tmp_path, name):
    """The same design for all of them: its condition number, leg lengths or joints say so."""
    found = nd.load(name)
    g, c, lc = found.geometry, found.configuration, found.characteristic_length
    kappa = float(nd.condition_number(g, c, lc))
    assert data_of(run, f"evaluate {name}")["condition_number"] == pytest.approx(kappa, rel=KAPPA)
    sheet = data_of(run, f"sheet {name}")
    assert np.array(sheet["joints"]["base_external_1"]["own_frame"]) == pytest.approx(g.base_external[0])
    followed = data_of(run, f"path {name} --line 0 0 0.01 --points 5 --no-figures --out {tmp_path / 'path'}")
    assert followed["motion"]["condition_number"]["first"] == pytest.approx(kappa, rel=KAPPA)
    swept = data_of(run, f"sweep {name} --over x_p=0,0.1 --no-figures --out {tmp_path / 'sweep'}")
    assert swept["sweep"]["arrays"]["condition_number"][0] == pytest.approx(kappa, rel=KAPPA)
    line = f"workspace {name} --method sample --points 2000 --legs 0.1 90 --no-study-limits --no-figures"
    assert data_of(run, f"{line} --out {tmp_path / 'space'}")["workspace"]["home_allowed"]
    modes = data_of(run, f"modes {name}")
    assert modes["condition_number"][modes["given_pose"] - 1] == pytest.approx(kappa, rel=1e-6)


def test_the_numbers_of_each_command_are_those_of_its_function(run):
    found = nd.load("design.toml")
    g, home = found.geometry, found.configuration
    turned = home.moved([0.0, np.radians(5.0), 0.0, 0.1, 0.0, -0.2, 0.0, 0.0, 0.0])
    held = " --position 0.1 0 3.3 --rotation-deg 0 5 0 --internal-point held"
    bounds = nd.error_bounds(g, turned, 0.01, 0.02)
    data = data_of(run, f"accuracy design.toml --leg-error 0.01 --joint-error 0.02 --samples 50 {held}")
    assert data["position"] == pytest.approx([bounds.position], rel=1e-9)
    assert data["rotation_deg"] == pytest.approx([np.degrees(bounds.rotation)], rel=1e-9)
    off = np.linalg.norm(nd.error_samples(g, turned, 0.01, 0.02, samples=50)[:, 3:6], axis=1)
    assert data["samples"]["position"] == pytest.approx(np.quantile(off, 0.95), rel=1e-6)
    forces = nd.leg_forces(g, turned, [0, 1, 0], [0, 0, -100]).forces
    data = data_of(run, f"forces design.toml --load {LOAD} --load '0 0 0 1 0 0' {held}")
    assert np.array(data["forces"]).shape == (2, 1, 9)
    assert np.array(data["forces"])[0, 0] == pytest.approx(forces, rel=1e-9, abs=1e-9)
    data = data_of(run, f"stiffness design.toml --leg-stiffness 2e4 {held}")
    assert np.array(data["stiffness"])[0] == pytest.approx(nd.stiffness(g, turned, 2e4), rel=1e-9, abs=1e-6)
    motion = [0, 0, 0.1, 0, 0, -1.0, 0, 0, 0]
    reached = nd.distance_to_singularity(g, turned, motion, most=4.0)
    text = " ".join(map(str, motion))
    data = data_of(run, f"singularity design.toml --direction '{text}' --most 4 {held}")
    assert data["distance"] == pytest.approx([reached.distance], rel=1e-9)
    assert data["at"] == [str(reached.mechanism)]
    best = nd.best_internal_point(
        g, turned.position, turned.rotation, start=turned.internal_point, **{"characteristic_length": 2.0}
    )
    data = data_of(run, f"best design.toml {held}")
    assert data["value"] == pytest.approx([best.value], rel=1e-9)
    assert data["now"] == pytest.approx([nd.condition_number(g, turned, 2.0)], rel=1e-9)
    data = data_of(run, f"modes design.toml {held}")
    assert data["count"] == nd.forward_position(g, nd.leg_lengths(g, turned)).count
    proof = data_of(run, f"modes design.toml --certify {held}")["certificate"]
    assert (proof["complete"], proof["proved"], proof["undecided"]) == (True, data["count"], 0)


def test_modes_say_what_is_proved(run, tmp_path):
    _, text, _ = run("modes design.toml --certify")
    assert re.search(r"proved: exactly \d+ modes, each to \d\.?\d*e-1\d of the longest leg \(\d+ boxes\)", text)
    similar = nd.Design(nd.Geometry.hexagonal(0.0, 4.0, 0.0, 3.0), nd.Configuration.neutral(3.0, 2.0))  # singular
    nd.save(similar, tmp_path / "similar.toml")
    status, text, _ = run(f"modes {tmp_path / 'similar.toml'} --certify")
    assert status == 0
    assert re.search(r"proved: 16 modes; \d+ boxes are undecided and may hold others \(\d+ boxes\)", text)
    proof = data_of(run, f"modes {tmp_path / 'similar.toml'} --certify")["certificate"]
    assert len(proof["places"]) == len(proof["place_radius"]) == proof["undecided"]


def test_places_of_the_internal_point(run):
    found = nd.load("design.toml")
    home = found.configuration
    own = home.rotation.T @ (home.internal_point - home.position)
    at = " --position 0.1 0.2 3.4 --rotation-deg 0 0 10"
    turned = home.moved([0, 0, np.radians(10.0), 0, 0, 0, 0, 0, 0]).rotation
    there = np.array([0.1, 0.2, 3.4])
    expected = {
        "carried": there + turned @ own,
        "shifted": there + home.internal_point - home.position,
        "held": home.internal_point,
        "'1 2 3'": [1, 2, 3],
    }
    for word, place in expected.items():
        data = data_of(run, f"forces design.toml --load {LOAD} --internal-point {word} {at}")
        assert data["poses"][0]["internal_point"] == pytest.approx(place, abs=1e-12)
        assert np.array(data["poses"][0]["rotation"]) == pytest.approx(turned, abs=1e-12)
    assert data_of(run, f"forces design.toml --load {LOAD} {at}")["poses"][0]["internal_point"] == pytest.approx(
        expected["carried"], abs=1e-12
    )
    half = data_of(run, f"forces design.toml --load {LOAD} --internal-point 0.5 {at}")["poses"][0]
    below, above = found.geometry.base_internal.mean(axis=0), found.geometry.platform_internal.mean(axis=0)
    assert half["internal_point"] == pytest.approx(0.5 * (below + [0.1, 0.2, 3.4] + turned @ above), abs=1e-12)
    placed = data_of(run, f"best design.toml {at}")["internal_point"][0]
    best = data_of(run, f"forces design.toml --load {LOAD} --internal-point best {at}")["poses"][0]
    assert best["internal_point"] == pytest.approx(placed, abs=1e-9)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("rule", ["shifted", "held", "best"])
def test_o_is_where_the_region_of_the_study_has_it(run, tmp_path, rule):
    region = {"box": (0.2, 0.2, 0.1), "tilt": 0.1, "internal_point": rule}
    sides = {"a1": 0.0, "a2": (5.0, 6.0), "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4}
    nd.save(nd.optimize(nd.Study(variables=sides, objective={"region": region}), starts=1), tmp_path / "run")
    at = f"forces {tmp_path / 'run'} --load {LOAD} --position 0.1 0.2 4.1 --rotation-deg 4 0 0"
    there, said = (data_of(run, at + more)["poses"][0]["internal_point"] for more in ("", f" --internal-point {rule}"))
    assert there == said
    assert there != data_of(run, f"{at} --internal-point carried")["poses"][0]["internal_point"]
    (tmp_path / "path.csv").write_text(
        "t,x,y,z,rx_deg,ry_deg,rz_deg\n" + "".join(f"{t},0.1,0.2,{4.1 + 1e-3 * t},4,0,0\n" for t in range(-3, 4))
    )
    assert run(f"path {tmp_path / 'run'} {tmp_path / 'path.csv'} --no-figures --out {tmp_path / 'path'}")[0] in (0, 3)
    assert nd.load(tmp_path / "path").configurations.internal_point[3] == pytest.approx(there, abs=1e-6)


def test_the_workspace_of_a_region_says_where_o_is(run, tmp_path):
    region = {"box": (0.2, 0.2, 0.1), "tilt_deg": 5.0}
    sides = {"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4}
    study = nd.Study(variables=sides, constraints={"leg_length": (1.0, 9.0)}, objective={"region": region})
    nd.save(nd.optimize(study), tmp_path / "run")
    for options, words in (
        ("", "of its frame; without turns as shifted"),
        ("--archetype orientation --angle-deg 20", "O: held in the base, at (0, 0, "),
        ("--internal-point held", "O: held in the base, at (0, 0, "),
        ("--legs 1 9", "limit: all legs 1 to 9"),
    ):
        line = (
            f"workspace {tmp_path / 'run'} {options} --no-figures --resolution 4 --tolerance 0.2 --out {tmp_path}/space"
        )
        assert words in " ".join(run(f"{line}-{len(options)}")[1].split())


BEYOND = "beyond a singularity: det {} is {} at the neutral pose, {}; every way from the neutral pose passes det {} = 0"
COMMANDS = [f"forces {{}} --load {LOAD}", "stiffness {} --leg-stiffness 10", "accuracy {} --leg-error 1"]


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    ("pose", "name"),
    [("--internal-point '0 0 -1'", "B"), ("--rotation-deg 0 0 150", "N"), ("--internal-point '0 0 5'", "C")],
)
def test_a_pose_beyond_a_singularity_is_named(run, monkeypatch, command, pose, name):
    monkeypatch.setenv("COLUMNS", "200")
    found = nd.load("design.toml")
    sign = getattr(nd.singularity_margins(found.geometry, found.configuration), f"det_{name.lower()}")
    ends = ("positive", "negative here") if sign > 0 else ("negative", "positive here")
    for line in ("", "--position 0.1 0.1 3.4"):
        status, out, _ = run(command.format("design.toml") + " " + line)
        assert (status, "beyond" in out) == (0, False)
    status, out, _ = run(f"{command.format('design.toml')} {pose}")
    assert status == 0
    assert BEYOND.format(name, *ends, name) in out
    assert out.count("beyond") == 1


def test_no_side_where_the_neutral_pose_is_singular(run, folder):
    (folder / "flat.toml").write_text(GENERAL.replace("zs = 1.6", "zs = 0.0").replace("-2.0, 0.1]]", "-2.0, 0.0]]"))
    for z in (-1, 1):
        assert "beyond" not in run(f"forces flat.toml --load {LOAD} --internal-point '0 0 {z}'")[1]


def test_poses_of_a_study_beyond_a_singularity_are_named(run, folder, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    shifts = [
        nd.Pose(position=(0.1, 0, 0)),
        nd.Pose(internal_point=(0, 0, -1.0), unit="zp"),
        nd.Pose(rotation=(0, 0.1, 0)),
    ]
    study = nd.Study(
        family="symmetric", constraints={"radius_ratio": (None, 2.0)}, objective={"poses": shifts}, starts=1
    )
    nd.save(nd.optimize(study), folder / "crossing")
    for line in ("evaluate crossing", f"forces crossing --load {LOAD} --all-poses"):
        status, out, _ = run(line)
        assert status == 0
        assert "at 1 of 4 poses, the first 2; every way from the neutral pose passes det B = 0" in out
    assert "beyond" not in run("evaluate run")[1] + run("evaluate crossing --json")[1]


def test_all_poses_of_a_study(run):
    result = nd.load("run")
    stack = result.configurations
    data = data_of(run, f"forces run --load {LOAD} --all-poses")
    forces = nd.leg_forces(result.geometry, stack, [0, 1, 0], [0, 0, -100]).forces
    assert np.array(data["forces"])[0] == pytest.approx(forces, rel=1e-9, abs=1e-9)
    assert len(data["poses"]) == len(stack) == 4
    worst = max(nd.error_bounds(result.geometry, stack, 0.01).position)
    status, out, _ = run("accuracy run --leg-error 0.01 --all-poses")
    assert status == 0
    assert f"{worst:.4g}" in out
    assert "4 poses of the study" in out
    best = data_of(run, "best run --all-poses")
    assert all(a <= b * (1 + 1e-9) for a, b in zip(best["value"], best["now"], strict=True))
    together = "Both hold together"
    assert together in run("accuracy run --within 0.1")[1]
    assert together not in run("accuracy run --within 0.1 --weights 1 0")[1]
    assert "p along any axis, O at rest: nearest" in run("singularity run")[1]
    nearest = data_of(run, "singularity run --all-poses")["distance"]["position"]["nearest"]
    expected = nd.nearest_singularity(result.geometry, stack, "position")
    assert nearest["distance"] == pytest.approx(expected.distance, rel=1e-9)
    assert (nearest["pose"], nearest["kind"]) == (expected.pose, str(expected.mechanism))
    assert nearest["distance"] <= min(data_of(run, "singularity run")["distance"]["position"]["backward"])


def test_a_singular_design_has_words_for_infinity(run, folder):
    (folder / "flat.toml").write_text(GENERAL.replace("zs = 1.6", "zs = 0.0").replace("-2.0, 0.1]]", "-2.0, 0.0]]"))
    assert data_of(run, "accuracy flat.toml --leg-error 0.01")["position"] == ["inf"]
    status, out, _ = run("forces flat.toml --load '0 0 0 1 2 3'")
    assert status == 0
    assert "singular: at some pose no leg forces balance all of load 1" in out
    assert data_of(run, "singularity flat.toml")["distance"]["internal_point"]["nearest"]["distance"] == 0.0
    data_of(run, "stiffness flat.toml --leg-stiffness 1")
    data_of(run, "best flat.toml", expected=3)


def test_leg_limits_of_the_study_bound_the_best_point(run, folder):
    study = nd.Study(constraints={"upper_length": (None, 2.4), "radius_ratio": (None, 2.0)}, starts=4)
    if not (folder / "limited").exists():
        nd.save(nd.optimize(study), folder / "limited")
    data = data_of(run, "best limited --position 0.2 0 3.2")
    assert data["limits"][1][3:6] == [2.4] * 3
    free = data_of(run, "best limited --position 0.2 0 3.2 --legs 0.1 99")
    assert free["value"][0] <= data["value"][0] * (1.0 + 1e-14)


# --- Sweeps of any family ---------------------------------------------------------------------------------------------


def swept(run, tmp_path, line):
    return data_of(run, f"sweep {line} --no-figures --out {tmp_path / 'sweep'}")["sweep"]


def test_a_sweep_over_variables_of_a_symmetric_run(run, tmp_path):
    result = nd.load("run")
    turned = swept(run, tmp_path, "run --over platform_internal_angle_deg=-30,10 --index condition_number")
    angle = np.radians([-30.0, 10.0])
    assert turned["coords"]["platform_internal_angle_deg"] == [-30.0, 10.0]
    for value, kappa in zip(angle, turned["arrays"]["condition_number"], strict=True):
        point = result.study.evaluate(result.variables | {"platform_internal_angle": value})
        assert kappa == pytest.approx(point.neutral_condition_number, rel=1e-9)


def test_names_that_no_family_of_the_design_has(run, tmp_path):
    for name, over in (("run", "a1=1:2:3"), ("design.toml", "base_external_radius=1:2:3")):
        status, _, err = run(f"sweep {name} --over {over} --out {tmp_path / 'sweep'}")
        assert status == 2
        assert f"which {name} does not have as variables" in err


def test_the_published_design_without_a_name():
    assert named_design(None).geometry == nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)


def test_a_sweep_of_a_region_study_says_that_it_is_not_over_the_region(run, tmp_path):
    region = {"region": {"box": [0.1, 0.1, 0.1], "tilt_deg": 2.0}}
    nd.save(nd.optimize(nd.Study(variables={"a1": 0.0, "b2": 0.0}, objective=region), starts=1), tmp_path / "box")
    nd.save(nd.optimize(nd.Study.paper(), starts=1), tmp_path / "plain")
    words = {
        "x_p=0,0.1": "with O shifted, in one orientation",
        "z_s=0,0.1": "with O moved, in one orientation, at one position",
        "theta_z=0,0.1": "with O shifted, at one position",
        "a2=5,6": "at the neutral pose alone",
    }
    for name, said in (("box", True), ("plain", False)):
        for number, (over, where) in enumerate(words.items()):
            options = f"--over {over} --no-figures --out {tmp_path / f'{name}-sweep-{number}'}"
            status, out, _ = run(f"sweep {tmp_path / name} {options}")
            assert status == 0
            said_words = " ".join(out.split())
            assert (where if said else where.replace("shifted", "held")) in said_words
            assert (f"{where}, not over the region of the study" in said_words) is said


FIXED = """
unit = "mm"
[design]
family = "hexagonal"
characteristic_length = 150.0
[variables]
a1 = 0.0
a2 = 2850.0
b1 = 1290.0
b2 = 0.0
zp = 1480.0
zs = 1320.0
[constraints]
radius_ratio = { max = 1.2 }
leg_length = { min = 250, max = 5000 }
"""


def test_a_fixed_design_that_violates_a_limit_shows_its_index_and_all_margins(run, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    (tmp_path / "fixed.toml").write_text(FIXED)
    status, optimized, _ = run(f"optimize {tmp_path}/fixed.toml --out {tmp_path}/run --no-figures")
    assert status == 3
    status, evaluated, _ = run(f"evaluate {tmp_path}/run")
    assert status == 0
    point = nd.Study.load(tmp_path / "fixed.toml").evaluate({})
    assert f"has condition number {point.condition_number:.6f}" in optimized
    assert f"{point.condition_number:.6f}" in evaluated
    assert nd.load(tmp_path / "run").best is None
    for text in (optimized, evaluated):
        assert "infeasible: " in text
        rows = [line for line in text.splitlines() if line.startswith(("│ radius_ratio", "│ leg_length"))]
        assert [("violated" in row) for row in rows] == [True, False, False]
        assert f"{100.0 * point.margins['radius_ratio']:.2f} %" in rows[0]


def test_poses_that_coincide_are_named_once(run, folder):
    """Poses 3 and 4 are poses 0 and 2 but for rounding, as poses found by a search are."""
    poses = [{}, {"position": [0.05, 0.0, 0.0]}, {}, {"position": [0.05 + 1e-12, 0.0, 0.0]}]
    study = nd.Study(
        family="symmetric", constraints={"radius_ratio": (None, 2.0)}, objective={"poses": poses}, starts=1
    )
    nd.save(nd.optimize(study), folder / "twice")
    for line in ("accuracy twice --leg-error 0.01 --all-poses", "stiffness twice --leg-stiffness 2e4 --all-poses"):
        status, out, _ = run(line)
        assert status == 0
        names = set(re.findall(r"pose (\d)\b", out)) - {"0"}
        assert names <= {"2"}
        assert out.count("pose 2:") == len(names)
    numbers = [
        row.split("│")[-2].strip()
        for row in run("accuracy twice --leg-error 0.01 --all-poses")[1].splitlines()
        if row.startswith("│")
    ]
    assert set(numbers) == {"0", "2"}
