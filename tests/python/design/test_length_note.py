"""A study with a unit and without a characteristic length: what is assumed is said before the work, and once."""

import copy
import pickle
import warnings
from dataclasses import replace

import pytest

import ninedof as nd

SIDES = {"a1": 0.0, "a2": 800.0, "b1": 350.0, "b2": 0.0, "zp": (400.0, 600.0), "zs": (200.0, 400.0), "theta_z": 0.0}


def test_the_assumed_length_is_said_in_python():
    study = nd.Study(variables=SIDES, unit="mm", starts=2)
    read_again = nd.Study.from_dict(study.to_dict())
    assert read_again == study
    for same in (study, copy.copy(study), pickle.loads(pickle.dumps(study)), study.with_solver(3), read_again):
        assert same.length_note.startswith("characteristic_length is not given: 1 mm assumed")
    with pytest.warns(UserWarning, match="characteristic_length is not given: 1 mm assumed"):
        poor = nd.optimize(study)
    with pytest.warns(UserWarning, match="characteristic_length is not given"):
        nd.pareto(study, "leg_ratio", values=[3.0])
    given = replace(study, characteristic_length=150.0)
    assert nd.optimize(given).condition_number < 0.1 * poor.condition_number


def test_nothing_is_said_of_a_length_that_was_given_or_has_no_unit():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for study in (
            nd.Study(variables=SIDES, starts=2),
            nd.Study(variables=SIDES, starts=2, unit="m", characteristic_length=1.0),
            nd.Study(variables=SIDES, starts=2, unit="mm", characteristic_length="optimal"),
            nd.Study.from_dict(nd.Study(variables=SIDES, starts=2, unit="mm", characteristic_length=1.0).to_dict()),
        ):
            assert study.length_note == ""
            nd.optimize(study)


@pytest.mark.parametrize("command", ["optimize {}", "pareto {} --against leg_ratio --value 3"])
def test_the_command_says_it_first(command, run, tmp_path):
    study = tmp_path / "study.toml"
    nd.Study(variables=SIDES, unit="mm", starts=2).save(study)
    out = run(f"{command.format(study)} --no-figures --no-report --out {tmp_path / 'run'}")[1]
    said = " ".join(out.split())
    assert said.startswith("characteristic_length is not given: 1 mm assumed. A turn of 1 rad then counts as much")
    assert said.count("characteristic_length is not given") == 1


def test_gravity_that_is_of_other_masses_than_kilograms_is_said_too(run, tmp_path):
    """Pounds, or inches per second squared, gave wrong forces without a word."""
    fixed = {**SIDES, "zp": 500.0, "zs": 300.0}
    for size, told in ((1.0, True), (386.1, True), (9.81, False), (1.62, False), (0.0, False)):
        duty = {"masses": {"platform": 5.0}, "loads": {"gravity": [0.0, 0.0, -size]}, "characteristic_length": 150.0}
        assert bool(nd.Study(variables=fixed, unit="in", **duty).gravity_note) is told
        assert nd.Study(variables=fixed, **duty).gravity_note == ""
        assert nd.Study(variables=fixed, unit="in", **duty | {"masses": {}}).gravity_note == ""
    study = nd.Study(variables=fixed, unit="in", **duty | {"loads": {"gravity": [0.0, 0.0, -1.0]}})
    with pytest.warns(UserWarning, match="gravity is 1: with a unit of lengths masses are kilograms"):
        nd.optimize(study)
    assert study.gravity_note.endswith("1 lb is 0.45359237 kg, 1 lbf is 4.4482216 N")
    study.save(tmp_path / "study.toml")
    _, out, errors = run(f"optimize {tmp_path / 'study.toml'} --no-figures --no-report --out {tmp_path / 'run'}")
    assert (out + errors).count("gravity is 1:") == 1
