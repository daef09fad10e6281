"""Single designs of studies: objective, condition numbers and margins, for every family and option.

Oracle: design_oracle, which rebuilds everything from the tables of the study file and shares no formula with the core.
"""

import itertools
import math

import numpy as np
import pytest
from design_oracle import TRIPLES, Oracle, family_names, is_angle, joints
from duty_oracle import DUTY
from numpy.testing import assert_allclose
from sizes import size

import ninedof as nd

FAMILIES = ("hexagonal", "symmetric", "symmetric_nonplanar", "general")
LIMITS = (
    {
        "radius_ratio": {"min": 0.5, "max": 2.0},
        "leg_ratio": {"max": 3.0},
        "stroke_ratio": {"max": 1.5},
        "zs_fraction": {"min": 0.1, "max": 0.9},
        "stroke": {"max": 0.7},
        "leg_length": {"min": 0.2, "max": 9.0},
        "height": {"min": 0.5, "max": 8.0},
        "footprint": {"max": 6.0},
        "joint_height": {"max": 0.6, "of": "radius"},
        "joint_spacing": {"min": 0.1, "of": "radius"},
        "leg_clearance": {"min": 0.05, "of": "zp"},
        "base_cone": {"max_deg": 70.0, "axis": [0.1, -0.2, 2.0]},
        "platform_cone": {"max_deg": 60.0},
        "singularity_free": {},
        "force": {"max": 60.0},
        "power": {"max": 80.0},
    },
    {
        "radius_ratio": {"min": 0.9},
        "leg_ratio": {"min": 1.3, "max": 4.0},
        "stroke": {"max": 0.2, "of": "zp"},
        "leg_length": {"max": 2.0, "of": "zp"},
        "external_length": {"min": 0.1, "max": 5.0},
        "upper_length": {"min": 0.2, "of": "zp"},
        "lower_length": {"max": 7.0},
        "zs_fraction": {"max": 0.8},
        "footprint": {"min": 0.3, "max": 9.0},
        "joint_height": {"max": 2.0},
        "joint_spacing": {"min": 0.05},
        "leg_clearance": {"radius": 0.02},
        "base_cone": {"max_deg": 50.0},
        "platform_cone": {"max_deg": 80.0, "axis": [0.0, 0.3, -1.0]},
        "singularity_free": {"min": 1e-2, "steps": 3},
        "rate": {"max": 1.2},
    },
)
# (characteristic length, index and aggregate, how many poses, whether O is placed by the tool at the last of them)
ASKED = (
    (1.3, {}, 0, False),
    ("natural", {"aggregate": "worst"}, 3, False),
    ([0.05, 20.0], {"aggregate": "mean_inverse"}, 3, True),
    ("mean_leg", {"index": "frobenius", "aggregate": "weighted", "weight": 0.3}, 3, False),
    ("platform_radius", {"index": "speed"}, 2, True),
    ("optimal", {"index": "six_legged"}, 0, False),
)


def rounded(a):
    return [float(x) for x in np.round(a, 6)]


def random_design(family, rng):
    """Values of a family's variables: a robot of ordinary proportions, O between the plates."""
    v = {}
    for name in family_names(family) if family != "general" else []:
        draw = {"angle": rng.uniform(-3.0, 3.0), "height": rng.uniform(-0.5, 0.5)}
        v[name] = draw.get(name.rsplit("_", 1)[-1], math.exp(rng.uniform(-0.5, 1.0)))
    if family == "general":  # orbits, each joint then moved on its own
        for triple in joints("symmetric_nonplanar", random_design("symmetric_nonplanar", rng)):
            moved = triple + 0.3 * rng.normal(size=(3, 3))
            v |= dict(zip(itertools.islice(family_names(family), len(v), None), moved.ravel(), strict=False))
    v["zp"] = rng.uniform(1.5, 4.0)
    v["zs"] = v["zp"] * rng.uniform(0.25, 0.75)
    if family in ("hexagonal", "general"):
        v["theta_z"] = rng.uniform(-1.0, 1.0)
    return {n: np.float64(x) for n, x in v.items()}


def bounds(name):
    return [-9.0, 9.0] if is_angle(name) or name[-2:] in ("_x", "_y", "_z", "ht") else [1e-3, 50.0]


def random_study(family, asked, limits, rng):
    """Tables of a study file, and a design of it by name."""
    length, objective, count, placed = asked
    design = random_design(family, rng)
    poses = [
        {
            "position": rounded(0.15 * rng.normal(size=3)),
            "rotation": rounded(0.15 * rng.normal(size=3)),
            "internal_point": rounded(0.1 * rng.normal(size=3)),
            "unit": ("length", "zp")[k % 2],
        }
        for k in range(count)
    ]
    if placed:
        poses[-1]["internal_point"] = "best"
    if count == 3:
        poses[0] = {}  # the neutral pose, all by default
    variables = {n: bounds(n) for n in design}
    if family == "general" and rng.uniform() < 0.5:  # a part of the joints stays where it is
        variables |= {n: float(design[n]) for n in family_names(family)[3:20]}
    data = {
        "design": {"family": family, "characteristic_length": length},
        "variables": variables,
        "constraints": limits,
        **DUTY,
        "objective": objective | ({"poses": poses} if poses else {}),
    }
    if length == "optimal" or isinstance(length, list):
        design["characteristic_length"] = rng.uniform(0.5, 2.0)
    if placed:
        design |= {f"pose{count}.s_{axis}": x for axis, x in zip("xyz", 0.05 * rng.normal(size=3), strict=True)}
    return data, design


def cases():
    """Designs of each family: some seeds for each of the questions asked, each with both sets of limits."""
    for family, (k, asked), seed in itertools.product(FAMILIES, enumerate(ASKED), range(size(2, 5))):
        if (family, asked[1].get("index")) != ("general", "six_legged"):
            rng = np.random.default_rng([FAMILIES.index(family), k, seed])
            yield family, *random_study(family, asked, LIMITS[(k + seed) % 2], rng)


CASES = list(cases())
BY_FAMILY = pytest.mark.parametrize("family", FAMILIES)


def of_family(family):
    return [(data, design) for f, data, design in CASES if f == family]


def set_up(data, design):
    """The core's problem, the oracle, and the design as a vector in the core's order."""
    problem, oracle = nd.Study.from_dict(data).problem(), Oracle(data)
    assert set(problem.names) == set(design)
    return problem, oracle, np.array([design[n] for n in problem.names])


def margins_of(core):
    return {one.name: one.value for one in core.margins}


@BY_FAMILY
def test_values(family):
    for data, design in of_family(family):
        problem, oracle, x = set_up(data, design)
        core, expected = problem.evaluate(x), oracle.evaluate(problem.names, x)
        exact = 1e-10 * max(1.0, expected["conditions"].max(), expected["condition_number"])
        for key in ("objective", "condition_number", "conditions"):
            assert_allclose(getattr(core, key), expected[key], rtol=exact, err_msg=f"{key} of {data}")
        assert problem.characteristic_length(x) == pytest.approx(expected["characteristic_length"], rel=exact)
        margins = margins_of(core)
        assert set(margins) == set(data["constraints"])
        for name, value in oracle.margins(problem.names, x).items():
            assert margins[name] == pytest.approx(value, rel=exact, abs=exact), (name, data)


@BY_FAMILY
def test_joints_and_poses(family):
    for data, design in of_family(family):
        problem, oracle, x = set_up(data, design)
        g = problem.geometry(x)
        for triple, expected in zip(TRIPLES, joints(family, design), strict=True):
            assert_allclose(getattr(g, triple), expected, atol=1e-13)
        for found, expected in zip(
            problem.configurations(x), oracle.evaluate(problem.names, x)["configurations"], strict=True
        ):
            assert_allclose(found, expected, atol=1e-13)


@BY_FAMILY
def test_a_study_evaluates_as_its_problem(family):
    data, design = of_family(family)[5]
    point = nd.Study.from_dict(data).evaluate({n: float(x) for n, x in design.items()})
    oracle, x = Oracle(data), np.array(list(design.values()))
    expected, margins = oracle.evaluate(list(design), x), oracle.margins(list(design), x)
    assert point.objective == pytest.approx(expected["objective"], rel=1e-8)
    assert point.neutral_condition_number == pytest.approx(expected["condition_number"], rel=1e-8)
    assert point.condition_number == max(point.conditions)
    assert_allclose(point.conditions, expected["conditions"], rtol=1e-8)
    assert point.margins == pytest.approx(margins, rel=1e-8, abs=1e-8)


# --- Shared joints ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("limit", [(None, 3.0), (2.0, None), {"max": 3.0, "at": "neutral"}])
def test_ratios_with_a_leg_of_no_length_have_no_gradient_but_zero(limit):
    """It was NaN and infinite with a least ratio."""
    joints = {
        "base_external": [(2.0, 0.0, 3.0), (-1.0, -2.0, 0.0), (-1.0, 2.0, 0.0)],
        "platform_external": [(2.0, 0.0, 0.0), (-1.0, -1.0, 0.0), (-1.0, 1.0, 0.0)],
    }
    fixed = {
        f"{triple}_{k}_{axis}": x
        for triple, rows in joints.items()
        for k, row in enumerate(rows, 1)
        for axis, x in zip("xyz", row, strict=True)
    }
    study = nd.Study(
        family="general", variables=fixed | {"zp": (1.0, 5.0), "zs": (0.1, 2.0)}, constraints={"leg_ratio": limit}
    )
    point = study.evaluate({"zp": 3.0, "zs": 1.5})
    for slopes in point.margin_gradients.values():
        assert np.isfinite(list(slopes.values())).all()
    (margin,) = point.margins.values()
    assert (margin > 1e100) if limit == (2.0, None) else (margin < -1e100)
