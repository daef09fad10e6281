"""`nd.export`, the table of formats, and what a writer knows of a design."""

import sys
from dataclasses import replace

import exported
import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.export.export import formats
from ninedof.export.model import model_of

room = sys.modules["ninedof.export"]
SIMULATORS = ("mjcf", "urdf", "sdf")


@pytest.mark.parametrize("name", SIMULATORS)
def test_the_file_is_the_path_given_and_is_replaced(name, tmp_path):
    file = tmp_path / f"my robot{formats()[name].suffix}"
    assert nd.export(exported.general(), name, file) == file
    first = file.read_bytes()
    assert nd.export(exported.general(), name, str(file)) == file
    assert file.read_bytes() == first  # nothing in it depends on the day
    assert b'"my_robot"' in first
    assert len(list(tmp_path.iterdir())) == (2 if name == "urdf" else 1)


def test_every_row_has_a_suffix_of_its_own():
    suffixes = [row.suffix for row in formats().values()]
    assert len(set(suffixes)) == len(suffixes)


TOY = """
from ninedof.export.model import Format


def text(model, digits=3):
    return f"written by ninedof {model.name} {model.neutral_lengths[0]:.{digits}f}"


FORMAT = Format("toy", ".toy", "length of the first leg", text)
"""


def test_a_new_format_is_one_module(run, tmp_path, monkeypatch):
    """Beside its test and its section of docs/exports.md, which test_page.py asks for."""
    (tmp_path / "toy_format.py").write_text(TOY)
    monkeypatch.setattr(room, "__path__", [*room.__path__, str(tmp_path)])
    formats.cache_clear()
    try:
        design = exported.general()
        first = nd.leg_lengths(design.geometry, design.configuration)[0]
        path = nd.export(design, "toy", tmp_path / "robot.toy", digits=2)
        assert path.read_text() == f"written by ninedof robot {first:.2f}"
        design_file = nd.save(design, tmp_path / "design.toml")
        status, out, _ = run(f"export {design_file} --out {path}")
        assert status == 0
        assert "length of the first leg" in out
        assert path.read_text() == f"written by ninedof robot {first:.3f}"
    finally:
        formats.cache_clear()


def test_ranges_of_legs_are_those_that_are_known():
    machine = exported.machine()
    ranges = model_of(machine).leg_ranges
    lengths = nd.leg_lengths(machine.geometry, machine.best.configurations)
    assert_allclose(np.transpose(ranges), [lengths.min(axis=0), lengths.max(axis=0)], rtol=1e-15)
    assert model_of(exported.general()).leg_ranges is None
    neutral_alone = nd.Study(starts=2, constraints={"radius_ratio": (None, 2.0)})
    assert model_of(nd.optimize(neutral_alone)).leg_ranges is None
    limited = nd.Study(starts=2, constraints={"radius_ratio": (None, 2.0), "leg_length": (1.0, 30.0)})
    assert model_of(nd.optimize(limited)).leg_ranges == ((1.0, 30.0),) * 9


def test_what_a_model_says_of_a_design():
    model = model_of(exported.machine(), "a b/ü")
    assert (model.name, model.unit) == ("a_b__", "mm")
    with pytest.raises(ValueError, match=r"^unit: got m, expected mm, the unit of the design"):
        model_of(exported.machine(), unit="m")


def test_the_unit_of_a_design_that_names_none_must_be_said():
    """A simulator would take millimetres for metres."""
    found = nd.optimize(nd.Study.paper(), starts=1).best
    assert model_of(found, unit="mm").unit == "mm"
    with pytest.raises(ValueError, match=r"^unit: got none, expected the length unit of a"):
        model_of(replace(found, study=None))


def test_a_suffix_of_another_format_is_refused(run, tmp_path):
    """Else MuJoCo would be given a file of SDFormat."""
    nd.export(exported.machine(), "csv", tmp_path / "j.csv")
    status, _, err = run(f"export {tmp_path / 'j.csv'} --to sdf --out {tmp_path / 'j.urdf'}")
    assert status == 2
    assert "with --to sdf, expected a file that ends in .sdf" in " ".join(err.split())
    assert not (tmp_path / "j.urdf").exists()


def test_what_cannot_be_read_back_is_named(tmp_path):
    nd.export(exported.machine(), "urdf", tmp_path / "j.urdf")
    with pytest.raises(
        ValueError, match=r"j.urdf: got a file that ends in .urdf, expected .toml, .csv, .xml, or a run"
    ):
        nd.load(tmp_path / "j.urdf")


def test_a_design_is_not_overwritten(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    nd.export(nd.optimize(nd.Study.paper(), starts=1), "csv", "joints.csv")
    before = (tmp_path / "joints.csv").read_bytes()
    assert run("export joints.csv --to csv")[0] == 2
    assert (tmp_path / "joints.csv").read_bytes() == before
