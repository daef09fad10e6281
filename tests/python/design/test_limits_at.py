"""Limits at the neutral pose alone, beside those at all poses: forms, and values and gradients bit by bit.

What the values are is held against limit_oracle.py in test_design_point.py.
"""

import copy
import math
import pickle

import numpy as np
import pytest
from design_oracle import is_angle
from duty_oracle import DUTY
from limit_oracle import EVERY_LIMIT
from sizes import size

import ninedof as nd
from ninedof.design import limits

FAMILIES = ("hexagonal", "symmetric", "symmetric_nonplanar", "general")
POSES = [
    {"position": [0.1, 0.05, -0.04], "rotation": [0.05, -0.12, 0.1], "unit": "zp"},
    {"position": [-0.2, 0.3, 0.1], "internal_point": [0.02, 0.1, 0.05]},
    {"position": [0.0, -0.3, 0.0], "internal_point": "best"},
]
# Every constraint that has a meaning at one pose, with every side and unit it has.
LIMITS = (
    {name: limit for name, limit in EVERY_LIMIT.items() if name not in ("stroke", "stroke_ratio")},
    {
        "leg_length": {"min": 0.2, "max": 2.0, "of": "zp"},
        "joint_height": {"max": 0.2, "of": "radius"},
        "joint_spacing": {"min": 0.2, "of": "radius"},
        "leg_clearance": {"radius": 0.05, "of": "zp"},
        "leg_ratio": {"max": 2.0},
    },
)


def signed(name):
    return is_angle(name) or name[-2:] in ("_x", "_y", "_z") or name.endswith("_height")


def neutral(options):
    return {name: limit | {"at": "neutral"} for name, limit in options.items()}


def random_design(family, rng):
    """Values of a family's variables: a robot of ordinary proportions, O between the plates, no two joints in one."""
    v = {}
    for name, bound in nd.Study(family).variables.items():
        if is_angle(name):
            v[name] = rng.uniform(-1.0, 1.0)
        elif name[-2:] in ("_x", "_y", "_z"):
            v[name] = bound + 0.3 * rng.normal()
        else:
            v[name] = rng.uniform(-0.5, 0.5) if name.endswith("_height") else math.exp(rng.uniform(-0.5, 1.0))
    v["zp"] = rng.uniform(1.5, 4.0)
    return v | {"zs": v["zp"] * rng.uniform(0.25, 0.75)}


def study(family, design, constraints, poses=POSES):
    variables = {name: (-9.0, 9.0) if signed(name) else (1e-3, 50.0) for name in design}
    return nd.Study(family, variables=variables, constraints=constraints, objective={"poses": poses}, **DUTY)


def cases():
    for family in FAMILIES:
        for seed in range(size(2, 40)):
            rng = np.random.default_rng([FAMILIES.index(family), seed])
            design = random_design(family, rng)
            yield family, design, {f"pose3.s_{axis}": rng.uniform(-0.1, 0.1) for axis in "xyz"}


CASES = list(cases())


@pytest.mark.parametrize("family", FAMILIES)
def test_margins_are_those_of_the_study_without_poses(family):
    """To the last bit, and so are the gradients: the robot at one pose is computed in one way."""
    for f, design, offsets in CASES:
        for options in LIMITS if f == family else ():
            posed = study(f, design, neutral(options)).evaluate(design | offsets)
            alone = study(f, design, options, poses=[]).evaluate(design)
            for name in options:
                assert posed.margins[f"{name} at neutral"] == alone.margins[name]
                slopes = posed.margin_gradients[f"{name} at neutral"]
                assert {v: slopes[v] for v in design} == alone.margin_gradients[name]
                assert all(slopes[v] == 0.0 for v in offsets)


@pytest.mark.parametrize("family", FAMILIES)
def test_both_limits_are_kept_apart(family):
    """A limit at the poses and another at the neutral pose, in either order, have the margins each has alone."""
    _, design, offsets = next(case for case in CASES if case[0] == family)
    at = design | offsets
    for options in LIMITS:
        tighter = {name: limit | {"max": 0.9 * limit["max"]} if "max" in limit else limit
                   for name, limit in options.items()}  # fmt: skip
        alone = study(family, design, options).evaluate(at), study(family, design, neutral(tighter)).evaluate(at)
        for order in (1, -1):
            both = {name: [limit, tighter[name] | {"at": "neutral"}][::order] for name, limit in options.items()}
            point = study(family, design, both).evaluate(at)
            assert point.margins == alone[0].margins | alone[1].margins
            assert point.margin_gradients == alone[0].margin_gradients | alone[1].margin_gradients


def test_without_poses_both_hold_at_the_neutral_pose():
    _, design, _ = CASES[0]
    point = study("hexagonal", design, {"leg_ratio": [{"max": 3.0}, {"max": 2.0, "at": "neutral"}]}, []).evaluate(
        design
    )
    assert (1.0 - point.margins["leg_ratio at neutral"]) / (1.0 - point.margins["leg_ratio"]) == pytest.approx(1.5)


# --- Forms ------------------------------------------------------------------------------------------------------------

CONE = {"max_deg": 45, "axis": [0, 0, 1]}
BOTH = [CONE, {"max_deg": 30, "axis": [0, 0, 1], "at": "neutral"}]


def test_normal_form():
    def parse(name, value):
        return limits.form(limits.parse(name, value))

    assert parse("leg_ratio", {"max": 3, "at": "poses"}) == parse("leg_ratio", [{"max": 3}]) == (None, 3.0)
    assert parse("leg_ratio", {"max": 3, "at": "neutral"}) == {"max": 3.0, "at": "neutral"}
    assert parse("singularity_free", {"at": "neutral"}) == {"min": 1e-3, "at": "neutral"}
    two = parse("leg_ratio", [{"max": 2, "at": "neutral"}, (None, 3)])
    assert two == parse("leg_ratio", two) == ({"max": 3.0}, {"max": 2.0, "at": "neutral"})
    assert parse("leg_ratio", [1, 2]) == (1.0, 2.0)  # a pair as before
    assert [limit.at for limit in limits.parse("leg_ratio", two)] == ["poses", "neutral"]


def test_files_and_copies(tmp_path):
    given = nd.Study(
        constraints={"base_cone": BOTH, "height": {"max": 5, "at": "neutral"}, "leg_ratio": (None, 3.0)},
        objective={"poses": POSES},
    )
    given.save(tmp_path / "study.toml")
    text = """
        [constraints]
        base_cone = [
            { max_deg = 30, axis = [0, 0, 1], at = "neutral" },
            { max_deg = 45, axis = [0, 0, 1], at = "poses" },
        ]
        height = { max = 5, at = "neutral" }
        [[constraints.leg_ratio]]
        max = 3.0
    """
    (tmp_path / "typed.toml").write_text(text)
    typed = nd.Study.load(tmp_path / "typed.toml")
    assert typed.constraints == given.constraints
    others = [nd.Study.load(tmp_path / "study.toml"), pickle.loads(pickle.dumps(given)), copy.deepcopy(given)]
    for other in others:
        assert other == given
        with pytest.raises(TypeError):
            other.constraints["base_cone"][1]["max"] = 1.0
    assert given.to_dict()["constraints"]["base_cone"] == [
        {"max_deg": 45.0, "axis": [0.0, 0.0, 1.0]},
        {"max_deg": 30.0, "axis": [0.0, 0.0, 1.0], "at": "neutral"},
    ]
