"""`ninedof payload`, and what forces and paths take from a study with masses."""

import json
from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd

DUTY = {
    "loads": {"wrenches": [[0.0, 0.0, 0.0, 12.0, 0.0, 0.0]]},
    "masses": {"platform": 1.0, "cylinder": 0.3, "cylinder_centre": 0.6, "rod": 0.1},
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    study = nd.Study(
        variables={"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": (2.3, 2.5)},
        objective={"region": {"box": [0.3, 0.3, 0.0]}},
        characteristic_length=1.0,
        **DUTY,
    )
    folder = tmp_path_factory.mktemp("runs") / "machine"
    nd.save(nd.optimize(study, starts=1), folder)
    return folder


@pytest.fixture(scope="module")
def mass(folder):
    return nd.largest_payload(nd.load(folder), 60.0).mass


@pytest.mark.slow(sanitized=True)
def test_the_payload(folder, mass, run):
    status, out, _ = run(f"payload {folder} --force 60 --json")
    assert status == 0
    data = json.loads(out)
    assert data["mass"] == pytest.approx(mass, rel=1e-12)
    assert data["proved"] is False
    said = " ".join(run(f"payload {folder} --force 60")[1].split())
    assert "searched, not proved" in said
    assert f"largest payload {mass:.6g}, in kg where forces are in N: " in said
    assert "reaches its limit of 60 (" in said
    assert "a point mass at (0, 0, 0) in the frame of the plate (--centre); gravity (0, 0, -9.81)" in said
    assert "beside it load 1: moment (0, 0, 0), force (12, 0, 0) and the masses of the study" in said
    alone = " ".join(run(f"payload {folder} --force 60 --centre 0 0 1 --load '0 0 0 0 0 -5'")[1].split())
    assert "at (0, 0, 1) in the frame of the plate (--centre); gravity" in alone
    assert "force (0, 0, -5) and" in alone
    beside = nd.largest_payload(nd.load(folder), 60.0, centre=(0.0, 0.0, 1.0), loads=[[0.0, 0.0, 0.0, 0.0, 0.0, -5.0]])
    assert f"largest payload {beside.mass:.6g}" in alone
    assert "kg:" not in said
    status, out, _ = run(f"payload {folder} --force 1")
    assert status == 3
    assert "no payload" in out


def test_with_a_tool_the_payload_is_at_the_origin_of_the_plate(run, tmp_path):
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0), nd.Configuration.neutral(3.9828, 2.4432)
    nd.save(nd.Design(g, home, unit="m", tool=nd.Tool(position=(0.0, 0.0, -0.5))), tmp_path / "tooled.toml")
    said = " ".join(run(f"payload {tmp_path / 'tooled.toml'} --force 60")[1].split())
    assert "a point mass at (0, 0, 0) m in the frame of the plate (--centre), not at the tool's point;" in said
    assert said.endswith("beside it nothing")
    assert "│ l1 │ 0 │" in said  # rounding is not a force


@pytest.mark.slow(sanitized=True)
def test_the_force_is_that_of_the_study_where_it_has_one(folder, mass, run, tmp_path):
    machine = nd.load(folder)
    limits = {"force": [{"max": 60.0}, {"max": 9.0, "at": "neutral"}], "power": (None, 9.0), "rate": (None, 9.0)}
    limited = replace(machine, study=replace(machine.study, constraints=limits, speeds={"linear": 0.1}))
    nd.save(limited, tmp_path / "limited")
    assert nd.largest_payload(limited).mass == pytest.approx(mass, rel=1e-12)
    status, out, _ = run(f"payload {tmp_path / 'limited'}")
    assert status == 0
    assert "from the study: force at most 60" in out
    assert "limits of the study that are not looked at: force at neutral, power" in out
    assert nd.largest_payload(limited).not_looked_at == ("force at neutral", "power")
    assert nd.largest_payload(limited, 50.0).not_looked_at == ("force", "force at neutral", "power")
    assert "from the study" not in run(f"payload {tmp_path / 'limited'} --force 50")[1]
    assert run(f"payload {folder}")[0] == 2


def test_json_has_no_number_that_was_not_asked_for(folder, run):
    def refuse(literal):
        raise AssertionError(literal)

    text = run(f"payload {folder} --force inf --json")[1]
    data = json.loads(text, parse_constant=refuse)
    assert data["mass"] == "inf"  # no leg reaches it
    assert data["region"].keys() == {"region", "looked_at"}


def test_forces_and_paths_have_the_masses_of_the_study(folder, run, tmp_path):
    machine = nd.load(folder)
    wrench = DUTY["loads"]["wrenches"][0]
    assert "each with the weights of the legs and of O" in run(f"forces {folder}")[1]
    data = json.loads(run(f"forces {folder} --json")[1])
    expected = nd.inverse_dynamics(machine.geometry, machine.configuration, masses=machine.study.masses, load=wrench)
    assert data["forces"][0][0] == pytest.approx(expected.forces.tolist(), abs=1e-9)
    status, out, _ = run(f"path {folder} --line 0.1 0 0.1 --points 51 --no-figures --json --out {tmp_path / 'along'}")
    assert status == 0
    legs = json.loads(out)["motion"]["legs"]
    assert legs["r1"]["work"] > 0.0
    line = nd.Trajectory.line(machine.configuration, (0.1, 0.0, 0.1), points=51)
    load = (wrench[3:], wrench[:3])
    motion = nd.follow(machine.geometry, line, machine.configuration, "shifted", load=load, masses=machine.study.masses)
    assert [legs[leg]["rms"] for leg in legs] == pytest.approx(motion.drives["rms"].tolist(), rel=1e-12)


@pytest.mark.slow(sanitized=True)
def test_a_path_tells_the_forces_of_every_load_of_the_study(folder, run, tmp_path):
    machine = nd.load(folder)
    wrenches = [[0.0, 0.0, 0.0, 12.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 90.0, 0.0]]
    study = replace(machine.study, loads={"wrenches": wrenches}, constraints={"force": {"max": 50.0}})
    nd.save(replace(machine, study=study), tmp_path / "two")
    line = "--line 0.1 0 0.1 --points 51"
    status, out, _ = run(f"path {tmp_path / 'two'} {line} --out {tmp_path / 'along'}")
    assert "largest of 2 loads" in out
    assert "from the study: 2 loads of [loads], [masses]" in out
    motion = nd.load(tmp_path / "along")
    each = []
    for wrench in wrenches:
        load = (wrench[3:], wrench[:3])
        each.append(nd.follow(machine, motion.trajectory, load=load, masses=machine.study.masses).leg_forces)
    assert motion.leg_forces == pytest.approx(np.array(each), rel=1e-9, abs=1e-9)
    most = np.abs(each).max(axis=(0, 1))
    (limit,) = json.loads((tmp_path / "along" / "record.json").read_text())["results"]["motion"]["limits"]
    assert limit["value"] == pytest.approx(most.max(), rel=1e-9)
    assert np.abs(each[0]).max() < 50.0 < most.max()  # the first load alone breaks nothing
    assert status == 3
    assert "each figure the largest of 2 loads" in (tmp_path / "along" / "report.html").read_text()


def test_legs_that_never_carry_are_named(run, tmp_path):
    hexagons = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    nd.save(nd.Design(hexagons, nd.Configuration.neutral(3.9828, 2.4432)), tmp_path / "design.toml")
    out = " ".join(run(f"forces {tmp_path / 'design.toml'} --load '0 0 0 0 0 -100'")[1].split())
    assert "never carry load 1: l1, l2, l3; no force closes their play" in out
