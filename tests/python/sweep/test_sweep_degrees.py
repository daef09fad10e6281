"""Axes of a sweep in degrees, and the name of its length unit."""

import math

import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.sweep_job import describe, json_data
from ninedof.sweep.result import summary_table

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
HOME = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
SYMMETRIC = {
    "base_external_radius": 3.0,
    "base_internal_radius": 3.0,
    "platform_external_radius": 1.5,
    "platform_internal_radius": 1.5,
    "platform_external_angle_deg": 60.0,
    "zp": 4.0,
    "zs": 2.0,
}


def test_an_axis_in_degrees_has_the_values_of_the_same_radians():
    degrees = np.array([-30.0, 0.0, 12.5])
    found = nd.sweep(G, HOME, {"x_p": [0.0, 0.3], "theta_z_deg": degrees}, chunk=1)
    same = nd.sweep(G, HOME, {"x_p": [0.0, 0.3], "theta_z": np.radians(degrees)})
    assert found["condition_number"].tobytes() == same["condition_number"].tobytes()
    assert found["theta_z_deg"].tolist() == degrees.tolist()
    assert (found.units["theta_z_deg"], same.units["theta_z"]) == ("deg", "rad")
    assert found.least("condition_number")[1].keys() == {"x_p", "theta_z_deg"}


def test_a_range_in_degrees_has_round_values():
    found = nd.sweep(G, HOME, {"theta_x_deg": (-30, 30, 5)}, relative=False)
    assert found["theta_x_deg"].tolist() == [-30.0, -15.0, 0.0, 15.0, 30.0]


def test_designs_are_swept_over_angles_in_degrees():
    over = {"base_internal_angle_deg": [0.0, 20.0], "platform_internal_angle_deg": (0, 60, 3)}
    found = nd.sweep_designs(SYMMETRIC, over, family="symmetric")
    plain = {k: v for k, v in SYMMETRIC.items() if not k.endswith("_deg")}
    radians = {"base_internal_angle": np.radians([0.0, 20.0]), "platform_internal_angle": np.radians([0.0, 30.0, 60.0])}
    same = nd.sweep_designs(plain | {"platform_external_angle": math.radians(60.0)}, radians, family="symmetric")
    assert found["condition_number"].tobytes() == same["condition_number"].tobytes()
    assert found.attributes["design"]["platform_external_angle"] == math.radians(60.0)
    twisted = nd.sweep_designs(
        {"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4}, {"theta_z_deg": [7.0]}
    )
    turned = nd.Configuration.neutral(4.0, 2.4, math.radians(7.0))
    geometry = nd.Geometry.hexagonal(0.0, 5.8, 2.9, 0.0)
    assert twisted["condition_number"][0] == pytest.approx(nd.condition_number(geometry, turned), rel=1e-12)


def test_a_variable_stands_in_one_place_however_it_is_named():
    with pytest.raises(ValueError, match="design: got platform_external_angle, which is swept"):
        nd.sweep_designs(SYMMETRIC, {"platform_external_angle": [0.1]}, family="symmetric")
    both = SYMMETRIC | {"platform_external_angle": 1.0}
    with pytest.raises(ValueError, match=r"^platform_external_angle: got both .* and platform_external_angle_deg"):
        nd.sweep_designs(both, {"zs": [2.0]}, family="symmetric")


def test_the_length_unit_stands_in_units_and_attributes(tmp_path):
    found = nd.sweep(G, HOME, {"x_p": [0.0], "theta_z": [0.0]}, ["leg_lengths", "leg_ratio"], unit="mm")
    assert dict(found.units) == {"x_p": "mm", "theta_z": "rad", "leg_lengths": "mm", "leg_ratio": "1"}
    assert nd.SweepResult.load(found.save(tmp_path / "sweep")).attributes["unit"] == "mm"
    plain = nd.sweep(G, HOME, {"x_p": [0.0]}, "leg_lengths")
    assert dict(plain.units) == {"x_p": "length", "leg_lengths": "length"}
    assert "unit" not in plain.attributes
    with pytest.raises(ValueError, match="unit: got 'km'"):
        nd.sweep(G, HOME, {"x_p": [0.0]}, unit="km")


def test_the_summary_is_in_degrees_and_json_says_the_units():
    found = nd.sweep(G, HOME, {"theta_z": [-0.5, 0.1]}, "leg_lengths", unit="mm")
    summary = {"leg_lengths": describe(found, "leg_lengths")}
    cells = [str(cell) for row in summary_table(summary, "", found.units).rows for cell in row]
    assert any("theta_z = -28.648 deg" in cell for cell in cells)
    assert any(cell.endswith(" mm") for cell in cells)
    assert json_data(found, summary)["sweep"]["units"] == {"theta_z": "rad", "leg_lengths": "mm"}
