"""Region studies come to optima no worse than those on record, whose sheets and certificates oracles hold."""

import pytest

import ninedof as nd

REQUIREMENT = {
    "family": "hexagonal",
    "unit": "mm",
    "characteristic_length": 150.0,
    "variables": {"a1": 0.0, "a2": (100.0, 850.0), "b1": (50.0, 350.0), "b2": 0.0}
    | {"zp": (300.0, 700.0), "zs": (50.0, 650.0), "theta_z": 0.0},
    "constraints": {"stroke_ratio": (None, 1.4), "leg_clearance": {"min": 20.0}}
    | {f"{body}_cone": {"max_deg": 45.0} for body in ("base", "platform")},
}
BOX = {"box": [60.0, 60.0, 40.0], "tilt_deg": 10.0}
NARROW = {"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0), "singularity_free": (0.05, None)}
UPRIGHT = {"radius_ratio": (None, 2.0), "base_cone": {"max_deg": 50.0, "axis": [0.0, 0.0, 1.0]}}
LOW = {"radius_ratio": (None, 2.0), "height": (None, 6.0)}
HELD = {"box": [0.1, 0.1, 0.1], "internal_point": "held"}
RECORD = {
    "requirement": (REQUIREMENT | {"objective": {"region": BOX}}, 4.0234203034),
    "O best": (REQUIREMENT | {"objective": {"region": BOX | {"internal_point": "best"}}}, 3.8867526769),
    "mean": (REQUIREMENT | {"objective": {"region": BOX, "aggregate": "mean_inverse"}}, 3.8443572065),
    "ball": (
        {"constraints": NARROW, "objective": {"unit": "zp", "region": {"ball": 0.08, "tilt_deg": 8.0}}},
        4.025118916,
    ),
    "cylinder": (
        {"constraints": UPRIGHT, "objective": {"unit": "zp", "region": {"cylinder": [0.1, 0.05], "yaw_deg": 8.0}}},
        4.2256643656,
    ),
    "held": ({"constraints": LOW, "objective": {"unit": "zp", "region": HELD}}, 4.7614374388),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", RECORD)
def test_region_studies_are_no_worse_than_on_record(name):
    study, known = RECORD[name]
    result = nd.optimize(nd.Study(**study, starts=2))
    assert result.objective <= known * (1.0 + 1e-7)
    assert result.region.margin >= -1.1e-7
