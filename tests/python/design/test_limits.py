"""Limits of constraints: every form of every name, in normal form, to files and back."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from duty_oracle import DUTY

import ninedof as nd
from ninedof.design import limits

INF = math.inf


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


def parsed(name, value):
    """As `Study.constraints` has it."""
    return limits.form(limits.parse(name, value))


@pytest.mark.parametrize("name", sorted(BOTH | MOST | LEAST))
def test_sides(name):
    for side, limit, names in (("min", (0.5, None), BOTH | LEAST), ("max", (None, 0.6), BOTH | MOST)):
        if name in names:
            assert parsed(name, limit) == parsed(name, {side: max(x for x in limit if x)}) == limit
            assert nd.Study(constraints={name: limit}, **DUTY).constraints[name] == limit
        else:
            for value in (limit, {side: 0.5}):
                with pytest.raises(ValueError, match=rf"^constraints.{name}: got the entry '{side}', expected only"):
                    limits.parse(name, value)


def test_defaults_are_left_out():
    assert parsed("stroke", {"max": 1, "of": "length"}) == (None, 1.0)
    assert parsed("singularity_free", {"steps": 4}) == parsed("singularity_free", {}) == (1e-3, None)
    assert parsed("singularity_free", (None, None)) == (1e-3, None)
    assert parsed("radius_ratio", {}) == parsed("radius_ratio", (0, INF)) == (None, None)
    assert parsed("radius_ratio", {"min": None, "max": np.float32(2)}) == (None, 2.0)


def test_options():
    assert parsed("leg_clearance", {"radius": 0.02, "of": "zp"}) == {"min": 0.04, "of": "zp"}
    assert parsed("leg_clearance", {"radius": 0.02}) == (0.04, None)
    cone = parsed("base_cone", {"max_deg": 45, "axis": np.array([0, 0, 2])})
    assert cone == {"max": math.radians(45), "axis": (0.0, 0.0, 2.0)}
    assert parsed("base_cone", cone) == cone
    assert parsed("singularity_free", {"steps": np.int64(9)}) == {"min": 1e-3, "steps": 9}
    for name, alone in (("stroke", {"max": INF, "of": "zp"}), ("leg_clearance", {"min": 0.0, "of": "zp"})):
        assert parsed(name, parsed(name, alone)) == alone


def test_for_the_core():
    (cone,) = limits.parse("base_cone", {"max_deg": 45, "axis": [0, 3, 4]})
    assert cone.for_core(nd.Tool()).axis == pytest.approx((0.0, 0.6, 0.8))
    (clearance,) = limits.parse("leg_clearance", {"radius": 1, "of": "zp"})
    one = clearance.for_core(nd.Tool())
    assert (one.name, one.low, one.high, one.of, one.steps, one.at) == ("leg_clearance", 2.0, INF, "zp", 4, "poses")
    assert not one.axis.any()


@pytest.mark.parametrize("degrees", [45, 30, 10.1, 0.1, 57.3, 89.999, 180, 1e-3, 1 / 3])
def test_degrees_survive_a_file(degrees):
    (limit,) = limits.parse("base_cone", {"max_deg": degrees})
    table = limit.to_dict()
    assert limits.parse("base_cone", table) == (limit,)
    if degrees != 1 / 3:
        assert table == {"max_deg": degrees}


@pytest.mark.parametrize("radians", np.random.default_rng(5).uniform(1e-6, math.pi, size=50))
def test_radians_survive_a_file_to_the_last_bit(radians):
    (limit,) = limits.parse("platform_cone", (None, radians))
    assert limits.parse("platform_cone", limit.to_dict()) == (limit,)


# --- At the neutral pose alone ----------------------------------------------------------------------------------------


def test_normal_form():
    assert parsed("leg_ratio", {"max": 3, "at": "poses"}) == parsed("leg_ratio", [{"max": 3}]) == (None, 3.0)
    assert parsed("leg_ratio", {"max": 3, "at": "neutral"}) == {"max": 3.0, "at": "neutral"}
    assert parsed("singularity_free", {"at": "neutral"}) == {"min": 1e-3, "at": "neutral"}
    two = parsed("leg_ratio", [{"max": 2, "at": "neutral"}, (None, 3)])
    assert two == parsed("leg_ratio", two) == ({"max": 3.0}, {"max": 2.0, "at": "neutral"})
    assert parsed("leg_ratio", [1, 2]) == (1.0, 2.0)  # a pair as before
    assert [limit.at for limit in limits.parse("leg_ratio", two)] == ["poses", "neutral"]


def test_two_limits_of_a_file(tmp_path):
    text = """
        [constraints]
        base_cone = [
            { max_deg = 30, axis = [0, 0, 1], at = "neutral" },
            { max_deg = 45, axis = [0, 0, 1], at = "poses" },
        ]
        [[constraints.leg_ratio]]
        max = 3.0
    """
    (tmp_path / "typed.toml").write_text(text)
    study = nd.Study.load(tmp_path / "typed.toml")
    assert study.to_dict()["constraints"] == {
        "base_cone": [
            {"max_deg": 45.0, "axis": [0.0, 0.0, 1.0]},
            {"max_deg": 30.0, "axis": [0.0, 0.0, 1.0], "at": "neutral"},
        ],
        "leg_ratio": {"max": 3.0},
    }
    study.save(tmp_path / "study.toml")
    assert nd.Study.load(tmp_path / "study.toml") == study
    with pytest.raises(TypeError):
        study.constraints["base_cone"][1]["max"] = 1.0


def test_without_poses_both_hold_at_the_neutral_pose():
    study = nd.Study(constraints={"leg_ratio": [{"max": 3.0}, {"max": 2.0, "at": "neutral"}]})
    margins = study.evaluate({"a1": 0.2, "a2": 5.0, "b1": 2.5, "b2": 0.3, "zp": 4.0, "zs": 2.0}).margins
    assert (1.0 - margins["leg_ratio at neutral"]) / (1.0 - margins["leg_ratio"]) == pytest.approx(1.5)
