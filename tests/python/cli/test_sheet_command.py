"""`ninedof sheet` on runs and design files, and what `ninedof evaluate` says of a run's poses."""

import json
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.records.record import load_run as load
from ninedof.records.record import write_run

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


@pytest.fixture(scope="module")
def machine(tmp_path_factory):
    folder = tmp_path_factory.mktemp("machine")
    study = nd.Study(
        variables={"a1": 0.0, "a2": 500.0, "b1": 250.0, "b2": 0.0, "zp": 400.0, "zs": (100.0, 300.0)},
        constraints={"leg_ratio": (None, 3.0), "platform_cone": {"max_deg": 55}},
        objective={"poses": nd.poses.box(half=(40.0, 40.0, 40.0), internal_point="held")},
        characteristic_length=150.0,
    )
    write_run(nd.optimize(study, starts=2), folder)
    return folder


def test_the_sheet_of_a_run(run, machine, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    line = f"sheet {machine} --csv {tmp_path / 'legs.csv'} --load '0 0 0 0,0,-10' --leg-error 0.01 --leg-stiffness 1e4"
    status, out, _ = run(line)
    assert status == 0
    for words in (
        "r1, r2, r3 never move",
        "O held in the base",
        "platform_cone",
        "55.00°",
        "position error",
        "stiffness",
    ):
        assert words in out
    assert "legs.csv" in "".join(out.split())
    assert (tmp_path / "legs.csv").read_text().startswith("leg,shortest,longest,neutral,stroke,stroke_ratio,idle,")
    status, out, _ = run(line + " --turn-deg 30 --json")
    data, expected = json.loads(out), load(machine).sheet()
    assert data["motion"]["angular_speed_deg"] == pytest.approx(30.0)
    assert [leg["longest"] for leg in data["legs"]] == [leg.longest for leg in expected.legs]
    assert data["condition_number"] == expected.condition_number._asdict()
    assert len(data["limits"]) == len(expected.limits) == 2


def test_the_sheet_of_a_design_file(run):
    status, out, _ = run(f"sheet {EXAMPLES / '04_design.toml'} --json")
    data = json.loads(out)
    assert status == 0
    assert (len(data["poses"]), data["limits"], data["idle"]) == (1, [], [])


def test_evaluate_shows_the_poses_and_limits_of_a_run(run, machine, monkeypatch):
    monkeypatch.setenv("COLUMNS", "120")
    found = load(machine).sheet()
    status, out, _ = run(f"evaluate {machine}")
    assert status == 0
    assert f"{found.condition_number.value:.6f}" in out
    assert found.condition_number.value >= load(machine).condition_number * (1.0 - 1e-12)
    assert f"{found.legs[3].shortest:.4f} to {found.legs[3].longest:.4f}" in out
    assert "platform_cone" in out
    data = json.loads(run(f"evaluate {machine} --json --lc 100")[1])
    again = load(machine).sheet(characteristic_length=100.0)
    assert data["sheet"]["condition_number"]["value"] == again.condition_number.value
    assert data["sheet"]["limits"][0]["name"] == "leg_ratio"
