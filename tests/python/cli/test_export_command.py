"""`ninedof export` and the commands on what it wrote."""

import json
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.export.export import formats

DESIGN = Path(__file__).resolve().parents[3] / "examples" / "04_design.toml"


def test_a_design_is_written_with_its_name_in_this_folder(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, out, _ = run(f"export {DESIGN} --to mjcf")
    first, masses = out.split("\n", 1)
    assert (status, first) == (0, "MuJoCo model with closed loops and nine actuators: 04_design.xml")
    assert " ".join(masses.split()).startswith(
        "masses: platform 5 kg (assumed), each cylinder 0.5 kg (assumed), each rod 0.5 kg (assumed)"
    )
    status, out, _ = run("evaluate 04_design.xml --json")
    assert status == 0
    found, expected = json.loads(out), json.loads(run(f"evaluate {DESIGN} --json")[1])
    assert found["condition_number"] == pytest.approx(expected["condition_number"], rel=1e-12)


def test_the_suffix_names_the_format(run, tmp_path):
    status, out, _ = run(f"export {DESIGN} --out {tmp_path / 'a.urdf'} --leg-mass 2 --unit mm --json")
    assert (status, json.loads(out)) == (0, {"format": "urdf", "file": str(tmp_path / "a.urdf")})
    assert {path.name for path in tmp_path.iterdir()} == {"a.urdf", "a.loops.json"}


def test_a_run_is_written_with_the_name_of_its_folder(run, tmp_path, monkeypatch):
    result = nd.optimize(nd.Study(starts=2, constraints={"radius_ratio": (None, 2.0)}))
    nd.save(result, tmp_path / "run")
    monkeypatch.chdir(tmp_path)
    assert run("export run#1 --to sdf")[0] == 0
    assert run("export run/ --to sdf")[0] == 0
    assert (tmp_path / "run-1.sdf").read_text().replace("run-1", "run") == (tmp_path / "run.sdf").read_text()


def test_the_masses_of_a_study_are_those_of_the_model(run, tmp_path, monkeypatch):
    mujoco = pytest.importorskip("mujoco")
    masses = {"platform": 12.0, "centre": (0.0, 10.0, 30.0), "rod": 0.6, "rod_centre": 90.0, "internal_point": 0.3}
    values = {"a1": 60.0, "a2": 500.0, "b1": 250.0, "b2": 30.0, "zp": 400.0, "zs": 200.0}
    study = nd.Study(variables=values, characteristic_length=150.0, unit="mm", masses=masses)
    nd.save(nd.optimize(study), tmp_path / "run")
    monkeypatch.chdir(tmp_path)
    for name, place in (("mjcf", "run.xml"), ("urdf", "run.urdf"), ("sdf", "run.sdf")):
        status, out, _ = run(
            f"export run --to {name} --platform-mass 7" if name == "sdf" else f"export run --to {name}"
        )
        mass = 7 if name == "sdf" else 12
        words = f"platform {mass} kg, each cylinder 0.5 kg (assumed), each rod 0.6 kg, O 0.3 kg; as drawn: "
        words += "inertia of the platform, centre of each cylinder, inertia of each cylinder, inertia of each rod"
        assert (status, words in " ".join(out.split())) == (0, True)
        if name == "sdf":
            assert "<pose>0 0.01 0.03 0 0 0</pose>\n        <mass>7</mass>" in Path(place).read_text()
            continue
        model = mujoco.MjModel.from_xml_path(place)
        plate = model.body("platform" if name == "mjcf" else "plate")
        assert (plate.mass[0], model.body("O").mass[0]) == (12.0, 0.3)
        assert (model.body("l1_cylinder").mass[0], model.body("l1_rod").mass[0]) == (0.5, 0.6)
        first = np.zeros(3) if name == "mjcf" else 0.001 * nd.load("run").geometry.platform_external[0]
        assert plate.ipos + first == pytest.approx([0.0, 0.01, 0.03], abs=1e-12)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", formats())
def test_only_a_file_that_export_wrote_is_replaced(name, run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if name == "dxf":
        pytest.importorskip("ezdxf")
    assert run(f"export {DESIGN} --to {name}")[0] == 0
    assert run(f"export {DESIGN} --to {name}")[0] == 0
    row = formats()[name]
    (file,) = tmp_path.glob(f"*{row.suffix}")
    for place in (file, *([file.with_suffix(row.beside[0])] if row.beside else [])):
        own = place.read_bytes()
        place.write_text("weeks of work")
        for line in (f"--to {name}", f"--to {name} --out {file.name}"):
            status, out, err = run(f"export {DESIGN} {line}")
            assert (status, out) == (2, "")
            assert err == f"ninedof: --out: got {place.name}, which exists and was not written by ninedof, " + (
                "expected another name\n"
            )
        assert place.read_text() == "weeks of work"
        place.write_bytes(own)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("line", ["sheet design.toml --csv kept.txt", "report run --out kept.txt"])
def test_other_files_are_not_replaced_either(line, run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "design.toml").write_text(DESIGN.read_text())
    nd.save(nd.optimize(nd.Study(starts=1, constraints={"radius_ratio": (None, 2.0)})), "run")
    (tmp_path / "kept.txt").write_text("weeks of work")
    option = line.split()[2]
    status, _, err = run(line)
    assert (status, (tmp_path / "kept.txt").read_text()) == (2, "weeks of work")
    assert err.startswith(f"ninedof: {option}: got kept.txt, which exists")
    for _ in range(2):
        assert run(line.replace("kept", "own"))[0] == 0
