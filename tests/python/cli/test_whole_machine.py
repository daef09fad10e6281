"""One machine with everything a study file can say, through every command as a user would take it.

Tool, loads, masses, speeds, tolerances, limits of each kind of legs, a catalogue: each has a test of its own; what
goes wrong is what they do to each other.
"""

import functools
import json
import math
from importlib import import_module

import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.app import FILES

pytestmark = pytest.mark.slow

CATALOGUE = """name,shortest (in),longest (in),force,rate,price
SA6,7.0,11.0,900,6.0,140
SA10,11.0,18.5,1200,5.0,220
SA12,14.0,23.0,1200,4.5,265
"""
MACHINE = """
unit = "in"
actuators = "catalogue.csv"
[about]
project = "Drill head positioner"
author = "J. Doe"
revision = "B"
[design]
family = "hexagonal"
characteristic_length = 6.0
[variables]
a1 = 0.0
a2 = [6.0, 34.0]
b1 = [3.0, 14.0]
b2 = 0.0
zp = [12.0, 28.0]
zs = [3.0, 25.0]
theta_z = 0.0
[constraints]
base_cone = { max_deg = 45.0 }
platform_cone = { max_deg = 45.0 }
leg_clearance = { radius = 0.6 }
power = { max = 4000.0 }
singularity_free = {}
[objective.region]
box = [1.0, 0.0, 0.0]
tilt_deg = 4.0
[solver]
starts = 2
[tool]
position = [0.0, 0.0, -3.5]
[loads]
gravity = [0.0, 0.0, -9.81]
wrenches = [[0.0, 0.0, 40.0, 0.0, 0.0, 300.0], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]]
[masses]
platform = 14.0
centre = [0.0, 0.0, -1.0]
cylinder = 1.4
rod = 0.6
cylinder_centre = 4.0
rod_centre = 4.0
[speeds]
linear = 3.0
angular_deg = 15.0
[tolerances]
joints = 0.001
legs = 0.0005
"""
LINES = {
    "evaluate": "evaluate run",
    "evaluate --set": "evaluate run --set a2=+1%",
    "compare": "compare run run",
    "sheet": "sheet run",
    "certify": "certify run --time 20",
    "workspace": "workspace run --tolerance 0.2 --no-figures --out space",
    "path": "path run --line 0.8 0 0.4 --duration 2 --points 101 --out along",
    "forces": "forces run --all-poses",
    "accuracy": "accuracy run --within 0.01",
    "stiffness": "stiffness run --leg-stiffness 1e5",
    "payload": "payload run",
    "failure": "failure run --no-pairs",
    "best": "best run",
    "modes": "modes run",
    "singularity": "singularity run",
    "sweep": "sweep run --over x_p=-2:2:5 --no-figures --out swept",
    "admissible": "admissible run --vary zp --time 5",
    "report": "report run",
    **{f"export {name}": f"export run --to {name}" for name in ("mjcf", "urdf", "sdf", "dxf", "c", "csv", "latex")},
}
ELSEWHERE = {"optimize", "atlas", "paper", "pareto", "check", "view", "export"}
"""Commands that take no such run, or have no answer in text; `pareto` refuses a catalogue."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("machine")
    (place / "catalogue.csv").write_text(CATALOGUE)
    (place / "machine.toml").write_text(MACHINE)
    return place


@pytest.fixture(autouse=True)
def _there(folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("COLUMNS", "80")
    sheets = functools.cache(lambda: nd.load(folder / "run").sheet())
    model = import_module("ninedof.export.model")
    monkeypatch.setattr(model, "sheet", lambda _: sheets())  # seven formats, one machine: one search


def test_a_machine_goes_through_every_command(run, folder):
    status, out, errors = run("optimize machine.toml --out run")
    assert status == 0, out + errors
    assert set(FILES) - {line.split()[0] for line in LINES} <= ELSEWHERE
    result = nd.load("run")
    assert result.reserve.proved
    says = {}
    for name, line in LINES.items():
        status, out, errors = run(line)
        assert status in (0, 3), f"{line}: {errors}"
        assert "Traceback" not in errors
        assert max(map(len, out.splitlines()), default=0) <= 80, name
        assert "…" not in out, name
        says[name] = " ".join(out.split())
    assert "proved" in says["certify"]
    assert f"{result.objective:.6f}"[:6] in says["evaluate"]
    motion = nd.load("along")
    again = nd.follow(result, motion.trajectory)
    assert np.abs(again.leg_forces - motion.leg_forces).max() <= 1e-9 * np.abs(motion.leg_forces).max()
    assert again.breaks == motion.breaks
    assert repr(again) == repr(motion)
    forces = json.loads(run("forces run --json")[1])["forces"]
    at_rest = nd.inverse_dynamics(
        result.geometry,
        result.configuration,
        masses=result.study.masses.seen_from(result.study.tool),
        load=result.study.loads.wrenches[0],
        unit="in",
    ).forces
    assert forces[0][0] == pytest.approx(at_rest.tolist(), rel=1e-9)
    assert math.isfinite(json.loads(run("payload run --json")[1])["mass"])
