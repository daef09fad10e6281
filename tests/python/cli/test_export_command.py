"""`ninedof export` and the commands on what it wrote."""

import json
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.export.export import formats

DESIGN = Path(__file__).resolve().parents[3] / "examples" / "04_design.toml"


def test_a_design_is_written_with_its_name_in_this_folder(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, out, _ = run(f"export {DESIGN} --to mjcf")
    assert (status, out) == (0, "MuJoCo model with closed loops and nine actuators: 04_design.xml\n")
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


def test_a_run_folder_that_cannot_be_written_is_known_before_the_work(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, _, err = run(f"optimize --out {300 * 'a'}")
    assert (status, err.count("\n")) == (2, 1)
    assert err.startswith("ninedof: --out: got 'aaa")
    assert run("optimize --out there --threads=0")[2].startswith("ninedof: --threads: got 0, expected ")
