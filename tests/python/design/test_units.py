"""The name of the length unit, and angles in degrees, in studies and their files."""

import math
from dataclasses import replace

import numpy as np
import pytest
from sizes import size

import ninedof as nd
from ninedof.support.arguments import bound
from ninedof.support.units import angle_entry, degrees_of, in_radians

ANGLES = {
    "hexagonal": ["theta_z"],
    "symmetric": ["base_internal_angle", "platform_external_angle", "platform_internal_angle"],
    "general": ["theta_z"],
}


@pytest.mark.parametrize("unit", ["mm", "cm", "m", "in", "ft"])
def test_a_unit_is_kept_by_files_and_copies_and_converts_nothing(tmp_path, unit):
    plain = nd.Study(variables={"zp": (3.0, 7.0)}, constraints={"height": (None, 6.0)}, starts=2)
    study = replace(plain, unit=unit)
    study.save(tmp_path / "study.toml")
    assert (tmp_path / "study.toml").read_text().startswith(f'unit = "{unit}"\n')
    assert nd.Study.load(tmp_path / "study.toml") == study != plain
    assert study.with_solver(starts=3).unit == unit
    assert nd.optimize(study).variables == nd.optimize(plain).variables


def test_without_a_unit_files_have_none():
    assert "unit" not in nd.Study().to_dict()
    assert nd.Study(unit=None) == nd.Study(unit="") == nd.Study()


def test_the_scale_of_shifts_stays_a_key_of_its_own():
    study = nd.Study(unit="mm", objective={"unit": "zp", "box": {"half": [0.1, 0.1, 0.1]}})
    assert study.unit == "mm"
    assert {pose.unit for pose in study.objective.poses} == {"zp"}


@pytest.mark.parametrize(
    ("region", "words"),
    [
        ({"box": [50, 40, 30], "tilt_deg": 10}, "a box of half edges 50, 40, 30 mm, tilts of at most 10 degrees"),
        ({"ball": 25}, "a ball of radius 25 mm"),
        ({"cylinder": [25, 10]}, "a cylinder of radius 25 mm and half height 10 mm"),
        ({"ball": 0.1, "unit": "zp"}, "a ball of radius 0.1 zp"),
    ],
)
def test_a_region_is_said_with_the_unit(region, words):
    study = nd.Study(unit="mm", objective={"region": region})
    assert study.words == f"worst condition number over {words}"
    assert "mm" not in study.objective.words


# --- Angles in degrees ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("family", "name"), [(f, name) for f, names in ANGLES.items() for name in names])
def test_a_variable_in_degrees_is_the_same_study_and_comes_back_from_its_file(tmp_path, family, name):
    for given, radians in ((30, math.radians(30)), ((-60.5, 45), (math.radians(-60.5), math.radians(45)))):
        study = nd.Study(family, {f"{name}_deg": given})
        assert study.variables[name] == radians
        assert study == nd.Study(family, {name: radians})
        assert name not in study.defaulted
        study.save(tmp_path / "study.toml")
        assert f"{name}_deg = " in (tmp_path / "study.toml").read_text()
        assert nd.Study.load(tmp_path / "study.toml") == study


def test_files_of_random_angles_read_back_to_the_same_bits():
    rng = np.random.default_rng(31)
    for k in range(size(200, 20000)):
        low, high = sorted(rng.uniform(-200.0, 200.0, 2).round(int(rng.integers(0, 12))).tolist())
        given = {"theta_z_deg": (low, high)} if k % 2 else {"theta_z": tuple(np.radians([low, high]).tolist())}
        study = nd.Study(variables=given)
        assert nd.Study.from_dict(study.to_dict()) == study
        angle = math.radians(low)
        assert math.radians(degrees_of(angle)) == pytest.approx(angle, rel=3e-16, abs=0.0)


def test_zero_and_infinity_keep_the_plain_name():
    assert nd.Study().to_dict()["variables"]["theta_z"] == 0.0
    assert nd.Study("symmetric").to_dict()["variables"]["base_internal_angle"] == [-math.inf, math.inf]
    assert angle_entry("theta_z", (0.0, 1.0)) == ("theta_z", (0.0, 1.0))  # 1 rad has no short degrees
    assert angle_entry("theta_z", (0.0, math.pi)) == ("theta_z_deg", (0.0, 180.0))


def test_a_design_and_a_start_may_have_degrees():
    study = nd.Study(variables={"theta_z": (-1.0, 1.0)}, starts=2)
    design = {"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.5, "zp": 4.0, "zs": 2.0}
    in_degrees = study.evaluate(design | {"theta_z_deg": 12.0})
    assert in_degrees.objective == study.evaluate(design | {"theta_z": math.radians(12.0)}).objective
    fixed = replace(study, variables={"theta_z_deg": 12.0})
    assert nd.optimize(fixed, warm=design | {"theta_z_deg": 5.0}).variables["theta_z"] == math.radians(12.0)
    with pytest.raises(ValueError, match="theta_z: got both theta_z and theta_z_deg"):
        study.evaluate(design | {"theta_z_deg": 12.0, "theta_z": 0.1})


def test_other_entries_pass_unchanged():
    assert in_radians({"a1": (0, 1), "b": "c"}, {"theta_z": bound}) == {"a1": (0, 1), "b": "c"}


def test_limits_and_prices_are_said_with_their_unit():
    study = nd.Study(
        variables={"a1": 0.0, "a2": (100.0, 500.0), "b1": 250.0, "b2": 0.0, "zp": (300.0, 700.0), "zs": (100.0, 600.0)},
        constraints={"height": (None, 400.0), "leg_length": (100.0, 900.0)},
        characteristic_length=150.0,
        starts=4,
        unit="mm",
    )
    said = nd.optimize(study).summary()
    assert "a2 (500 mm)" in said
    assert "1 % more a2 (5 mm) gains" in said
    assert "mm" not in nd.optimize(replace(study, unit="")).summary()
