"""Records: what is written is read back, whole or not at all."""

import json
import math

import pytest

import ninedof as nd
from ninedof.runs.design_file import load_design
from ninedof.runs.records import Record, describe_result, load_record, to_json, write_record


def record():
    study = nd.Study(
        variables={"a2": (0.0, math.inf), "theta_z": (-1.0, 1.0)}, constraints={"radius_ratio": (None, 2.0)}
    )
    return Record(study, {"optimization": describe_result(nd.optimize(study))})


def test_round_trip_with_infinite_bounds(tmp_path):
    written = record()
    path = write_record(written, tmp_path)
    for place in (path, tmp_path):
        read = load_record(place)
        assert read.study == written.study
        assert read.versions == written.versions
        assert read.created == written.created
    assert load_record(path).results["optimization"]["status"] == "optimal"


def test_json_has_no_infinity_of_its_own():
    text = to_json({"a": math.inf, "b": [-math.inf, math.nan]})
    assert json.loads(text) == {"a": "inf", "b": ["-inf", "nan"]}


def test_a_failed_write_leaves_the_old_record(tmp_path, monkeypatch):
    path = write_record(record(), tmp_path)
    before = path.read_bytes()

    def broken(*_):
        raise OSError("disk full")

    monkeypatch.setattr("pathlib.Path.replace", broken)
    with pytest.raises(OSError, match="disk full"):
        write_record(record(), tmp_path)
    assert path.read_bytes() == before


@pytest.mark.parametrize("text", ["", "[1]", "{}", '{"format": "other"}', "not json"], ids=repr)
def test_other_files_are_refused_by_name(tmp_path, text):
    file = tmp_path / "record.json"
    file.write_text(text)
    with pytest.raises(ValueError, match=r"record\.json: "):
        load_record(file)


def test_missing_record_is_named(tmp_path):
    with pytest.raises(ValueError, match="cannot be read"):
        load_record(tmp_path)


def test_design_of_a_record(tmp_path):
    write_record(record(), tmp_path)
    design = load_design(tmp_path)
    assert nd.condition_number(design.geometry, design.configuration) == pytest.approx(3.749827, abs=5e-7)


def test_record_without_a_design(tmp_path):
    study = nd.Study(constraints={"leg_ratio": (None, 0.5)})
    write_record(Record(study, {"optimization": describe_result(nd.optimize(study))}), tmp_path)
    with pytest.raises(ValueError, match="holds no design"):
        load_design(tmp_path)


@pytest.mark.parametrize("family", ["hexagonal", "symmetric", "symmetric_nonplanar", "general"])
def test_design_of_a_record_of_any_family(tmp_path, family):
    objective = nd.Objective(poses=(nd.Pose(position=(0.1, 0, 0), internal_point="best"),))
    study = nd.Study(family=family, characteristic_length="optimal", objective=objective, starts=4)
    x = study.problem().starts(1, 0)[0].tolist()
    variables = dict(zip(study.problem().names, x, strict=True))
    write_record(Record(study, {"optimization": {"candidates": [{"variables": variables}]}}), tmp_path)
    point, design = study.evaluate(variables), load_design(tmp_path)
    assert design == (point.geometry, point.configuration, point.characteristic_length)
    assert load_record(tmp_path).study == study


BAD_CANDIDATES = {
    "none": None,
    "text": "best",
    "number": [3],
    "no variables": [{}],
    "unknown variable": [{"variables": {"a9": 1.0}}],
    "variables as list": [{"variables": [1.0, 2.0]}],
    "variable as text": [{"variables": dict.fromkeys(("a1", "a2", "b1", "b2", "zp", "zs"), "1")}],
}


@pytest.mark.parametrize("candidates", BAD_CANDIDATES.values(), ids=BAD_CANDIDATES.keys())
def test_a_record_changed_by_hand_is_refused_by_name(tmp_path, candidates):
    write_record(Record(nd.Study(), {"optimization": {"candidates": candidates}}), tmp_path)
    with pytest.raises(ValueError, match=str(tmp_path)):
        load_design(tmp_path)
