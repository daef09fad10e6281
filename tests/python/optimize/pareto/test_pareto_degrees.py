"""Fronts against a limit on an angle: degrees with base_cone_deg, radians without."""

import math
from dataclasses import replace

import pytest

import ninedof as nd
from ninedof.optimize.pareto import solving
from ninedof.optimize.pareto.limits import unit_of, with_degrees, without_degrees

STUDY = nd.Study(
    "symmetric",
    constraints={"radius_ratio": (None, 2.0), "base_cone": {"max_deg": 45, "axis": [0, 0, 1]}},
    objective={"poses": [{}, {"position": [0.1, 0, 0], "unit": "zp"}]},
    starts=4,
)


@pytest.fixture(scope="module")
def fronts():
    values = [35, 38.05]
    in_degrees = nd.pareto(STUDY, "base_cone_deg", values=values)
    return in_degrees, nd.pareto(STUDY, "base_cone", values=[math.radians(value) for value in values])


def test_both_are_the_same_front(fronts):
    degrees, radians = fronts
    assert (degrees.against, degrees.limits, degrees.unit) == ("base_cone_deg", (35.0, 38.05), "deg")
    assert (radians.against, radians.unit) == ("base_cone", "rad")
    assert radians.limits == (math.radians(35.0), math.radians(38.05))
    assert degrees.limit_name == radians.limit_name == "base_cone"
    assert degrees.objectives == radians.objectives
    assert degrees.prices == radians.prices
    assert degrees.prices[0] > 0.0
    assert [result.study for result in degrees] == [result.study for result in radians]
    assert [row["limit"] for row in degrees.table()] == [35.0, 38.05]
    assert degrees.to_dict()["limit_unit"] == "deg"


def test_limits_found_are_in_degrees():
    front = nd.pareto(replace(STUDY, starts=1), "base_cone_deg", points=2)
    assert 20.0 < front.limits[-1] < 90.0
    assert front.results[-1].study.constraints["base_cone"]["max"] == pytest.approx(math.radians(front.limits[-1]))


def test_names_with_degrees():
    assert without_degrees("base_cone_deg at neutral") == ("base_cone at neutral", True)
    assert with_degrees("base_cone at neutral") == "base_cone_deg at neutral"
    assert with_degrees("leg_ratio") == "leg_ratio"
    assert with_degrees("speed") == "speed"
    assert without_degrees("height_deg") == ("height_deg", False)


@pytest.mark.parametrize(
    ("against", "unit"),
    [
        ("height", "mm"),
        ("leg_length", "mm"),
        ("stroke", ""),
        ("leg_ratio", ""),
        ("condition_limit", ""),
        ("platform_cone_deg", "deg"),
    ],
)
def test_the_unit_of_a_limit(against, unit):
    study = replace(STUDY, unit="mm", constraints={"stroke": {"max": 0.3, "of": "zp"}})
    assert unit_of(study, against) == unit


def test_reasons_say_degrees():
    solver = solving.FrontSolver(STUDY, "base_cone", None, None)
    assert solver._words(math.radians(38.05)) == "38.05 deg"
    assert solving.FrontSolver(replace(STUDY, unit="mm"), "height", None, None)._words(300.0) == "300 mm"
    assert solving.FrontSolver(STUDY, "height", None, None)._words(300.0) == "300"
