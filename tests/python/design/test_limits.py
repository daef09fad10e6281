"""Limits of constraints: every form of every name, in normal form, to files and back."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.design import limits

NAN, INF = math.nan, math.inf


def documented():
    """The constraints of docs/study-file.md as name: (sides, units, default low side)."""
    text = (Path(__file__).parents[3] / "docs" / "study-file.md").read_text(encoding="utf-8")
    out = {}
    for line in text.split("## Constraints")[1].split("| option |")[0].splitlines():
        cells = re.split(r"(?<!\\)\|", line)
        if not line.startswith("| `"):
            continue
        sides = {side for side in ("min", "max") if re.search(rf"\b{side}\b", cells[3])}
        default = re.search(r"\(([\d.]+)\)", cells[3])
        for name in re.findall(r"`(\w+)`", cells[1]):
            out[name] = (sides, {"length", *re.findall(r"`(\w+)`", cells[4])}, default and float(default[1]))
    return out


DOCUMENTED = documented()
BOTH, MOST, LEAST = (
    {name for name, row in DOCUMENTED.items() if row[0] == sides} for sides in ({"min", "max"}, {"max"}, {"min"})
)


def test_every_constraint_is_documented_with_its_sides_and_units():
    assert {name: (set(row.sides), set(row.units), row.default_low) for name, row in limits.ROWS.items()} == DOCUMENTED
    assert set(limits.CONSTRAINTS) == BOTH | MOST | LEAST


@pytest.mark.parametrize("name", sorted(BOTH | MOST | LEAST))
def test_sides(name):
    for side, limit, names in (("min", (0.5, None), BOTH | LEAST), ("max", (None, 0.6), BOTH | MOST)):
        if name in names:
            assert limits.parse(name, limit) == limits.parse(name, {side: max(x for x in limit if x)}) == limit
            assert nd.Study(constraints={name: limit}).constraints[name] == limit
        else:
            with pytest.raises(ValueError, match=rf"^{name}: got a {side}, .+, expected only a (min|max)"):
                limits.parse(name, limit)
            with pytest.raises(ValueError, match=rf"{name}: got the entry '{side}', expected only"):
                limits.parse(name, {side: 0.5})


def test_defaults_are_left_out():
    assert limits.parse("stroke", {"max": 1, "of": "length"}) == (None, 1.0)
    assert limits.parse("singularity_free", {"steps": 4}) == limits.parse("singularity_free", {}) == (1e-3, None)
    assert limits.parse("singularity_free", (None, None)) == (1e-3, None)
    assert limits.parse("radius_ratio", {}) == (None, None)
    assert limits.parse("radius_ratio", {"min": None, "max": np.float32(2)}) == (None, 2.0)


def test_options():
    assert limits.parse("leg_clearance", {"radius": 0.02, "of": "zp"}) == {"min": 0.04, "of": "zp"}
    assert limits.parse("leg_clearance", {"radius": 0.02}) == (0.04, None)
    cone = limits.parse("base_cone", {"max_deg": 45, "axis": np.array([0, 0, 2])})
    assert cone == {"max": math.radians(45), "axis": (0.0, 0.0, 2.0)}
    assert limits.parse("base_cone", cone) == cone
    assert limits.parse("singularity_free", {"steps": np.int64(9)}) == {"min": 1e-3, "steps": 9}


def test_for_the_core():
    assert limits.for_core("radius_ratio", (None, 2.0)) == {
        "name": "radius_ratio", "low": 0.0, "high": 2.0, "of": "length", "axis": [], "steps": 4, "at": "poses",
    }  # fmt: skip
    cone = limits.parse("base_cone", {"max_deg": 45, "axis": [0, 3, 4]})
    assert limits.for_core("base_cone", cone)["axis"] == pytest.approx([0.0, 0.6, 0.8])
    assert limits.for_core("leg_clearance", limits.parse("leg_clearance", {"radius": 1, "of": "zp"})) == {
        "name": "leg_clearance", "low": 2.0, "high": INF, "of": "zp", "axis": [], "steps": 4, "at": "poses",
    }  # fmt: skip


@pytest.mark.parametrize("degrees", [45, 30, 10.1, 0.1, 57.3, 89.999, 180, 1e-3, 1 / 3])
def test_degrees_survive_a_file(degrees):
    limit = limits.parse("base_cone", {"max_deg": degrees})
    table = limits.to_table("base_cone", limit)
    assert limits.parse("base_cone", table) == limit
    if degrees != 1 / 3:
        assert table == {"max_deg": degrees}


@pytest.mark.parametrize("radians", np.random.default_rng(5).uniform(1e-6, math.pi, size=50))
def test_radians_survive_a_file_to_the_last_bit(radians):
    limit = limits.parse("platform_cone", (None, radians))
    assert limits.parse("platform_cone", limits.to_table("platform_cone", limit)) == limit


BAD = {
    "unknown option": ("stroke", {"max": 1, "off": "zp"}, r"did you mean 'of'"),
    "option of another": ("radius_ratio", {"max": 2, "axis": [0, 0, 1]}, "'axis'"),
    "degrees of a ratio": ("radius_ratio", {"max_deg": 2}, "'max_deg'"),
    "steps of another": ("base_cone", {"max": 1, "steps": 3}, "'steps'"),
    "of a height": ("height", {"max": 1, "of": "zp"}, "'of'"),
    "of the wrong thing": ("stroke", {"max": 1, "of": "radius"}, "length, zp"),
    "of a number": ("stroke", {"max": 1, "of": 3}, "length, zp"),
    "unit alone": ("stroke", {"of": "zp"}, "max too"),
    "axis alone": ("base_cone", {"axis": [0, 0, 1]}, "max too"),
    "radius and min": ("leg_clearance", {"min": 1, "radius": 1}, "both"),
    "radius negative": ("leg_clearance", {"radius": -1}, "low <= high"),
    "radius nan": ("leg_clearance", {"radius": NAN}, "low <= high"),
    "radius as text": ("leg_clearance", {"radius": "1"}, "a number"),
    "both units": ("base_cone", {"max": 1, "max_deg": 45}, "both"),
    "degrees as radians": ("base_cone", {"max": 45}, "max_deg"),
    "over half a turn": ("base_cone", {"max_deg": 181}, "at most pi"),
    "infinite cone": ("base_cone", (None, INF), "at most pi"),
    "axis zero": ("base_cone", {"max": 1, "axis": [0, 0, 0]}, "direction"),
    "axis nan": ("base_cone", {"max": 1, "axis": [0, 0, NAN]}, "finite"),
    "axis as text": ("base_cone", {"max": 1, "axis": "z"}, "three"),
    "no steps": ("singularity_free", {"steps": 0}, "whole number"),
    "steps bool": ("singularity_free", {"steps": True}, "whole number"),
    "determinant of one": ("singularity_free", {"min": 1.0}, "between 0 and 1"),
    "determinant of zero": ("singularity_free", {"min": 0}, "between 0 and 1"),
    "bool": ("height", {"max": True}, "a number"),
    "numpy bool": ("height", (None, np.bool_(True)), "a number"),
    "list in a mapping": ("height", {"max": [1.0]}, "a number"),
    "nan": ("height", {"max": NAN}, "low <= high"),
    "reversed": ("height", {"min": 2, "max": 1}, "low <= high"),
    "set": ("height", {1.0, 2.0}, "low, high"),
    "text": ("height", "2", "low, high"),
}


@pytest.mark.parametrize(("name", "value", "says"), BAD.values(), ids=BAD.keys())
def test_bad_limits(name, value, says):
    with pytest.raises(ValueError, match=rf"(?s)^(constraints\.)?{name}[.\w]*: got .+, expected .*") as caught:
        nd.Study(constraints={name: value})
    assert says in str(caught.value)
