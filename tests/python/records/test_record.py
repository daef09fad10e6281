"""Run folders: every kind is written whole or not at all, and read back."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.posed import named_design
from ninedof.paper.comparison import compare
from ninedof.records.record import Record, load_record, write_record, write_run
from ninedof.records.record import load_run as load
from ninedof.support.running import running
from ninedof.support.text import decode, encode


def record():
    study = nd.Study(
        variables={"a2": (0.0, math.inf), "theta_z": (-1.0, 1.0)}, constraints={"radius_ratio": (None, 2.0)}
    )
    return Record("optimization", study, {"optimization": nd.optimize(study).to_dict()})


def test_round_trip_with_infinite_bounds(tmp_path):
    written = record()
    path = write_record(written, tmp_path)
    for place in (path, tmp_path):
        read = load_record(place)
        assert read.study == written.study
        assert read.versions == written.versions
        assert read.created == written.created
    assert load_record(path).results["optimization"]["status"] == "optimal"


def test_non_finite_numbers_are_words_in_json():
    text = encode({"a": math.inf, "b": [-math.inf, math.nan], "c": np.array([0.1, math.inf]), "d": np.int64(3)})
    assert json.loads(text) == {"a": "inf", "b": ["-inf", "nan"], "c": [0.1, "inf"], "d": 3}
    assert repr(decode(text)) == "{'a': inf, 'b': [-inf, nan], 'c': [0.1, inf], 'd': 3}"
    texts = {"project": "inf", "parts": ["nan", "-inf", "'inf", "'", "infinity"]}  # no numbers
    assert decode(encode(texts)) == texts


KEYS = ["format", "kind", "study", "results", "versions", "created", "files", "digest"]


def test_every_kind_of_run_has_a_record_and_is_read_back(tmp_path, published):
    """One form of record for all of them; arrays lie beside it."""
    home = nd.Configuration.neutral(3.9828, 2.4435)
    runs = {
        "optimization": nd.optimize(nd.Study(starts=4)),
        "comparison": compare(),
        "front": nd.pareto(nd.Study(starts=4), "radius_ratio", values=[2.0]),
        "workspace": nd.workspace(published, ([-1, -1, 3], [1, 1, 5]), criteria={"leg_limits": (2.5, 6.5)}),
        "sweep": nd.sweep(published, home, {"x_p": (-1.0, 1.0, 3)}),
        "atlas": nd.atlas(1000),
    }
    for kind, run in runs.items():
        folder = tmp_path / kind
        folder.mkdir()
        path = write_run(run, folder, question={"archetype": "constant_orientation"})
        data = json.loads(path.read_text())
        arrays = kind in ("workspace", "sweep", "atlas")
        assert list(data) == [{"study": "question"}.get(key, key) if arrays else key for key in KEYS]
        assert data["kind"] == load_record(path).kind == kind
        assert sorted(data["files"]) == sorted(p.name for p in folder.iterdir() if p != path)
    assert load(tmp_path / "comparison") == runs["comparison"].result  # the others: test_load.py


def test_design_of_a_record(tmp_path):
    write_record(record(), tmp_path)
    design = named_design(str(tmp_path))
    assert nd.condition_number(design.geometry, design.configuration) == pytest.approx(3.749827, abs=5e-7)


def test_record_without_a_design(tmp_path):
    study = nd.Study(constraints={"leg_ratio": (None, 0.5)})
    write_run(nd.optimize(study), tmp_path)
    assert load(tmp_path).best is None
    with pytest.raises(ValueError, match="holds no design"):
        named_design(str(tmp_path))


def test_a_record_keeps_the_command_line_and_python_has_none(tmp_path):
    with running("ninedof", ["optimize", "my study.toml"]):
        made = record()
    assert load_record(write_record(made, tmp_path)).command == "ninedof optimize 'my study.toml'"
    without = record()
    assert "command" not in json.loads(write_record(without, tmp_path).read_text())
    assert load_record(tmp_path).command == ""


def test_an_interrupted_run_leaves_the_record_of_an_earlier_one(tmp_path):
    result = nd.optimize(nd.Study(starts=2))
    cut = replace(result, interrupted=True, evaluations=1)
    write_run(result, tmp_path)
    write_run(cut, tmp_path)
    assert load(tmp_path) == result
