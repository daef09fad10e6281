"""Every screen shows the length unit where a length stands, and degrees where an angle stands."""

import json
import math
import re
import shlex
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.cli.app import main

STUDY = """
[design]
characteristic_length = 150.0
[variables]
a1 = 0.0
a2 = 500.0
b1 = 250.0
b2 = 0.0
zp = [300.0, 450.0]
zs = [100.0, 300.0]
theta_z_deg = [7.0, 11.0]
[constraints]
footprint = { max = 300.0 }
leg_length = { min = 100.0 }
platform_cone = { max_deg = 55.0 }
base_cone = { max_deg = 38.05 }
leg_clearance = { min = 1.0 }
[objective.box]
half = [40.0, 40.0, 0.0]
points = 2
tilt_deg = [10.0, 0.0, 0.0]
[solver]
starts = 2
"""
DESIGN = """
characteristic_length = 150.0
[geometry]
a1 = 0.0
a2 = 500.0
b1 = 250.0
b2 = 0.0
[configuration]
zp = 400.0
zs = 200.0
theta_z_deg = 9.0
"""
WORKSPACE = "--z 380 420 --x -20 20 --y -20 20 --tolerance 0.1 --resolution 4 --points 64"
SCREENS = {  # what stands where the unit is mm
    "optimize study.toml": ("zp (mm)", "zs (mm)", "characteristic length (mm)"),
    "evaluate run": ("legs l1 l2 l3 (mm)", "characteristic length (mm)", ") mm, O = (", "300.0000 mm"),
    "sheet run --load '0 0 0 0 0 -10' --leg-error 0.01 --leg-stiffness 1e4": (
        *("(mm/s)", "0 mm", "force/mm", "force mm", "platform speed of 1 mm/s", ") mm, O = (", ") force mm, force ("),
    ),
    "path run --circle 20 --points 21 --force 0 0 -10": ("(mm)", "(mm/s)", "(mm/s²)", "speed at most 125."),
    f"workspace run {WORKSPACE}": (
        *("volume (mm³)", "radius (mm)", "centre (mm)", "sides (mm)", "inf mm, of the study", "at least 1 mm"),
        *(") mm, O = (", "420) mm"),
    ),
    "pareto study.toml --against footprint --value 295 --value 300": ("at most (mm)",),
    "sweep run --over x_p=-20:20:3 --index leg_lengths": ("x_p = -20 mm", "leg lengths"),
    "accuracy run --leg-error 0.1": ("displacement of p", " mm "),
    "forces run --load '0 0 0 0 0 -10'": ("force mm, force",),
    "stiffness run --leg-stiffness 1e4": ("in force/mm, the platform", "in force mm per radian", ") mm, O = ("),
    "singularity run": (" mm ", ") mm, O = ("),
    "modes run": ("p (mm)", "O (mm)"),
    "best run": ("best O (", ") mm: condition"),
    "evaluate design.toml": ("legs l1 l2 l3 (mm)", "natural length"),
    "sheet design.toml": ("(mm/s)",),
    "path design.toml --line 10 0 0 --points 21 --legs 100 401": ("(mm/s)", "mm at "),
    f"workspace design.toml --legs 100 500 {WORKSPACE}": ("legs 100 to 500 mm", "volume (mm³)"),
    "sweep design.toml --over z_s=-20:20:3 --index leg_lengths": ("20 mm",),
}
OTHERWISE = re.compile(r"runs?\S*|\d+:\d\d:\d\d|╺|╸|━")


def run(capsys, line):
    with pytest.raises(SystemExit) as end:
        main(shlex.split(line))
    captured = capsys.readouterr()
    assert end.value.code in (0, 3), captured.err
    return " ".join(captured.out.split())


@pytest.fixture(scope="module", params=["mm", ""])
def folder(request, tmp_path_factory):
    """A folder with a study, a design and the run of the study, with a unit and without."""
    folder = tmp_path_factory.mktemp("named" if request.param else "plain")
    head = f'unit = "{request.param}"\n' if request.param else ""
    (folder / "study.toml").write_text(head + STUDY)
    (folder / "design.toml").write_text(head + DESIGN)
    with pytest.raises(SystemExit):
        main(["optimize", str(folder / "study.toml"), "--no-figures", "--out", str(folder / "run")])
    return folder, request.param


@pytest.fixture
def here(folder, tmp_path, monkeypatch):
    for name in ("study.toml", "design.toml", "run"):
        (tmp_path / name).symlink_to(folder[0] / name)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "300")
    return folder[1]


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("line", SCREENS)
def test_every_screen_has_the_unit_where_it_is_given(capsys, here, line):
    drawing = ("optimize", "path", "workspace", "pareto", "sweep")
    figures = " --no-figures" if line.split()[0] in drawing else ""
    said = run(capsys, line + figures)
    if here:
        assert [words for words in SCREENS[line] if words not in said] == []
    else:
        assert re.search(r"\bmm", said) is None


ROWS = {  # of the sheet: the unit behind the value
    "leg clearance": "mm",
    "position error": "mm",
    "error of O": "mm",
    "least stiffness": "force/mm",
    "least turning stiffness, per rad": "force mm",
    "footprint │ max": "mm",
    "leg_length │ min": "mm",
    "leg_clearance │ min": "mm",
}


def test_every_length_of_the_sheet_has_its_unit(capsys, here):
    said = run(capsys, "sheet run --load '0 0 0 0 0 -10' --leg-error 0.01 --leg-stiffness 1e4")
    cells = {row: row.replace(" │ ", r" +│(?:[^│]*│)? ") for row in ROWS}  # limits: a leg between name and side
    found = {row: re.search(cells[row] + r" │ +[\d.e+]+ ?([^│]*?) │", said) for row in ROWS}
    units = {row: match[1] for row, match in found.items() if match}
    assert units == (ROWS if here else dict.fromkeys(ROWS, ""))
    text = nd.load("run").sheet(leg_errors=0.01, leg_stiffness=1e4).summary()
    unit = " mm" if here else ""
    for line in (
        "leg clearance {}",
        "position error {}",
        "error of O {}",
        "footprint max {} {}",
        r"leg_clearance \S+ min {} {}",
    ):
        assert re.search(line.replace("{}", rf"[\d.]+{unit}"), re.sub(" +", " ", text)), line
    assert ("force/mm" in text) == ("(mm/s)" in text) == bool(here)


def test_records_json_and_csv_have_the_unit(capsys, here):
    unit = {"unit": "mm"} if here else {}
    record = json.loads(Path("run/record.json").read_text())
    assert {k: v for k, v in record["study"].items() if k == "unit"} == unit
    result = nd.load("run")
    assert result.study.unit == here
    lines = {
        "evaluate run": lambda data: data,
        "sheet run --csv sheet.csv": lambda data: data,
        "path run --circle 20 --points 21 --no-figures --out path": lambda data: data["motion"],
        f"workspace run {WORKSPACE} --no-figures --out workspace": lambda data: data["workspace"],
        "pareto study.toml --against footprint --value 300 --no-figures": lambda data: data["front"],
        "sweep run --over x_p=-20:20:3 --no-figures --out sweep": lambda data: data["sweep"]["attributes"],
        "optimize study.toml --no-figures": lambda data: data,
    }
    for line, part in lines.items():
        data = part(json.loads(run(capsys, line + " --json")))
        assert {k: v for k, v in data.items() if k == "unit"} == unit, line
    assert nd.load("workspace").unit == here
    assert nd.load("sweep").units["x_p"] == (here or "length")
    head = Path("path/legs.csv").read_text().split("\n")[0].split(",")
    units = {0: "t (s)", 1: "l1 (mm)", 10: "l1_rate (mm/s)", 19: "l1_acceleration (mm/s²)"}
    assert {k: head[k] for k in units} == (units if here else {k: name.split()[0] for k, name in units.items()})


# --- Degrees ----------------------------------------------------------------------------------------------------------

ANGLES = {  # line: the angles in degrees that it shows, and others that stand in it
    "optimize study.toml": ("theta_z (deg)",),
    "evaluate run": ("38.05°", "55.00°", "turned (0, 0, 0)°"),
    "sheet run --turn-deg 25": ("38.05°", "55.00°", "turning 25° per time unit"),
    "path run --circle 20 --points 21": ("turning at most 0 degrees",),
    f"workspace run {WORKSPACE}": ("base cone 38.05 degrees", "platform cone 55 degrees"),
    "workspace run --archetype orientation --angle-deg 12 --tolerance 0.5 --resolution 4 --points 64": (
        *("region: angle to 12 degrees", "radius (deg) │ 11.93", "centre (deg)"),
    ),
    "sweep run --over theta_z=-0.35:0.35:3": ("20.054 deg",),
    "sweep run --over theta_z_deg=-20:20:3 --over theta_x_deg=0,17": ("theta_z = 20 deg", "theta_x = 17 deg"),
    "sweep figure-6 --points 5": ("displacement = -57.296 deg", "displacement = 28.648 deg"),
    "pareto study.toml --against base_cone --value 38.05 --value 50": ("at most (deg)", "│ 38.05 │", "│ 50 │"),
    "pareto study.toml --against base_cone_deg --value 38.05": ("at most (deg)", "│ 38.05 │"),
}
DEGREES = (7.0, 9.0, 10.0, 11.0, 12.0, 17.0, 20.0, 25.0, 38.05, 50.0, 55.0, math.degrees(0.35))


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("line", ANGLES)
def test_no_screen_shows_radians(capsys, here, line):
    figures = "" if line.split()[0] in ("evaluate", "sheet") else " --no-figures"
    said = run(capsys, line + figures)
    if here:
        said = said.replace("per second", "per time unit")
    if line.startswith("sweep figure-6"):
        assert any(words in said for words in ANGLES[line])
    else:
        assert [words for words in ANGLES[line] if words not in said] == []
    numbers = {float(text) for text in re.findall(r"-?\d+\.\d+", OTHERWISE.sub(" ", said))}
    variables = nd.load("run").variables
    shown = [*DEGREES, math.degrees(variables["theta_z"])]
    in_radians = {sign * math.radians(angle) for angle in shown for sign in (1, -1)}
    wrong = [(n, r) for n in numbers for r in in_radians if abs(n - r) <= 6e-5 * abs(r)]
    assert wrong == []
    assert "rad)" not in said


def test_a_free_angle_without_bounds_is_assumed_in_degrees(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("study.toml").write_text('unit = "mm"\n[design]\nfamily = "symmetric"\n[solver]\nstarts = 1\n')
    said = run(capsys, "optimize study.toml --no-figures")
    assert "base_internal_angle is not given: [-inf, inf] deg assumed" in said
    assert "zp is not given: [0.05, 80] mm assumed" in said
