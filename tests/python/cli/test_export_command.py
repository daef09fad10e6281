"""`ninedof export` and the commands on what it wrote."""

import json
import shlex
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.cli.app import main

DESIGN = Path(__file__).resolve().parents[3] / "examples" / "04_design.toml"


def run(capsys, line):
    with pytest.raises(SystemExit) as end:
        main(shlex.split(line))
    captured = capsys.readouterr()
    return end.value.code, captured.out, captured.err


def test_a_design_is_written_with_its_name_in_this_folder(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, out, _ = run(capsys, f"export {DESIGN} --to mjcf")
    assert (status, out) == (0, "MuJoCo model with closed loops and nine actuators: 04_design.xml\n")
    status, out, _ = run(capsys, "evaluate 04_design.xml --json")
    assert status == 0
    found, expected = json.loads(out), json.loads(run(capsys, f"evaluate {DESIGN} --json")[1])
    assert found["condition_number"] == pytest.approx(expected["condition_number"], rel=1e-12)


def test_the_suffix_names_the_format(capsys, tmp_path):
    status, out, _ = run(capsys, f"export {DESIGN} --out {tmp_path / 'a.urdf'} --leg-mass 2 --unit mm --json")
    assert (status, json.loads(out)) == (0, {"format": "urdf", "file": str(tmp_path / "a.urdf")})
    assert {path.name for path in tmp_path.iterdir()} == {"a.urdf", "a.loops.json"}


def test_a_run_is_written_with_the_name_of_its_folder(capsys, tmp_path, monkeypatch):
    result = nd.optimize(nd.Study(starts=2, constraints={"radius_ratio": (None, 2.0)}))
    nd.save(result, tmp_path / "run")
    monkeypatch.chdir(tmp_path)
    assert run(capsys, "export run#1 --to sdf")[0] == 0
    assert run(capsys, "export run/ --to sdf")[0] == 0
    assert (tmp_path / "run-1.sdf").read_text().replace("run-1", "run") == (tmp_path / "run.sdf").read_text()


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("", "--to: got nothing, expected one of mjcf, urdf, sdf, csv, step, dxf, c, latex"),
        ("--to mjfc", "--to: got 'mjfc', expected one of"),
        ("--out a.stl", "--out: got a.stl, expected --to with a format, or a file that ends in .xml, .urdf"),
        ("--to sdf --gravity 9", "options: got the entry 'gravity', expected only leg_mass, platform_mass"),
        ("--out none/a.xml", "path: got none/a.xml, expected a file in a folder that exists"),
        ("--to mjcf --unit mile", "unit: got 'mile'"),
        ("--to mjcf --leg-mass 0", "leg_mass: got 0, expected a mass above 0"),
    ],
)
def test_bad_input_is_one_line(line, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, out, err = run(capsys, f"export {DESIGN} {line}")
    assert (status, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
