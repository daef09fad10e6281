"""Optimizations that do not end in an optimum: unbounded, infeasible, no free variables, singular designs only.

Oracles: the theory notes for the unbounded study; for the others the truth is plain from how the study is made.
"""

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from sizes import size

import ninedof as nd

INF = math.inf
OPEN = {name: (0.0, INF) for name in ("a1", "a2", "b1", "b2", "zp", "zs")}
TWICE = {"radius_ratio": (None, 2.0)}
PUBLISHED = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.3745}


def solve(variables=None, constraints=None, **others):
    options = {"starts": size(24, 64)} | others
    return nd.optimize(nd.Study(variables=variables or {}, constraints=constraints or {}, **options))


# --- Unbounded --------------------------------------------------------------------------------------------------------


def test_planar_triples_without_a_size_are_unbounded():
    """Theory of limits, section 1: the infimum of planar designs is 1, with ever larger robots."""
    triples = ("base_external", "base_internal", "platform_external", "platform_internal")
    open_ended = {f"{triple}_radius": (0.05, INF) for triple in triples} | dict.fromkeys(("zp", "zs"), (0.05, INF))
    assert solve(open_ended, family="symmetric").status == "unbounded"


@pytest.mark.parametrize("limit", [30.0, 100.0, 1000.0])
def test_no_optimum_lies_on_an_internal_bound(limit):
    """However the run treats open bounds inside: a wider study is never worse, and what is called active must exist."""
    constraints = {"leg_ratio": (None, limit)}
    wide, narrow = solve(OPEN, constraints), solve(dict.fromkeys(OPEN, (1e-3, 5000.0)), constraints)
    assert narrow.status == "optimal"
    assert wide.condition_number <= narrow.condition_number * (1.0 + 1e-6)
    if wide.status == "optimal":
        assert not {name for name in wide.active if wide.variables.get(name, 0.0) > 0.0}


def test_an_angle_without_bounds_has_no_internal_bound_at_its_optimum():
    """theta_z without bounds: where a run is cut inside, no local optimum may be claimed there."""
    for seed in range(8):
        result = solve({"theta_z": (-INF, INF)}, TWICE, seed=seed)
        assert result.condition_number == pytest.approx(3.749827, abs=5e-7)
        assert not [c.active for c in result.candidates if "theta_z" in c.active]


@pytest.mark.parametrize("low", [1.0, 100.0, 1000.0, 20_000.0])
def test_unbounded_from_a_large_base_on(low):
    """The flight begins later from a large base; that zs comes close to zp on the way is not the limit of (9b)."""
    result = solve(OPEN | {"a2": (low, INF)})
    assert result.status == "unbounded"
    assert "zp > zs" not in result.active


@pytest.mark.parametrize("starts", [64, size(80, 200)])
@pytest.mark.parametrize("lc", [1.0, 1000.0])
def test_heights_from_zero_as_9b_has_them(starts, lc):
    """Bounds as printed in (9): plates may shrink to nothing and O sink into the base, but no such end is an answer."""
    bounds = dict.fromkeys(("zp", "zs"), (0.0, 80.0 * lc))
    result = solve(bounds, TWICE, characteristic_length=lc, starts=starts)
    assert result.status == "optimal"
    assert result.condition_number == pytest.approx(3.762659078596, rel=1e-9)
    assert solve(OPEN, characteristic_length=lc, starts=starts).status == "unbounded"


# --- Infeasible -------------------------------------------------------------------------------------------------------

CONFLICTS = {
    "legs shorter than the shortest": ({}, {"leg_ratio": (None, 0.5)}, {"leg_ratio"}),
    "base too large": (
        dict.fromkeys(("a1", "a2"), (5.0, 6.0)) | dict.fromkeys(("b1", "b2"), (0.0, 0.1)),
        TWICE,
        {"b1", "b2", "radius_ratio"},
    ),
    "fixed design over its limit": (PUBLISHED | {"b1": 1.9062}, TWICE, {"radius_ratio"}),
    "two constraints": (
        {"zp": 4.0, "a1": 0.0, "a2": (0.0, 1.0)},
        {"leg_ratio": (None, 1.2), "zs_fraction": (0.9, 0.95)},
        {"leg_ratio", "a2"},  # whatever O's height
    ),
}


@pytest.mark.parametrize(("variables", "constraints", "causes"), CONFLICTS.values(), ids=CONFLICTS.keys())
def test_infeasible(variables, constraints, causes):
    result = solve(variables, constraints)
    assert result.status == "infeasible"
    assert causes <= set(result.causes)
    for name in result.causes:
        assert name in result.reason
    assert result.candidates == ()
    assert (result.starts_done == 1) == (len(variables) == 6), "a design without free variables is tried once"


def test_what_else_is_in_conflict_is_named_with_its_unit():
    study = nd.Study(
        variables={"a1": 0.0, "b2": 0.0},
        constraints={"leg_ratio": (None, 0.5), "rate": (None, 1e-3)},
        characteristic_length=1.0,
        speeds={"linear": 1.0},
        unit="in",
    )
    first, _, besides = nd.optimize(study, starts=4).reason.partition("; other limits of the study are in conflict ")
    assert {"leg_ratio", "rate"} == {
        name for words in (first, besides) for name in ("leg_ratio", "rate") if name in words
    }
    assert besides.startswith("besides: the nearest found without these violates ")
    assert besides.endswith(" (lengths in inches, rates in in/s)")


def test_internal_point_in_the_base_breaks_9b():
    """zs = 0 is outside 0 < zs < zp, and every such design is singular."""
    result = solve({"zs": 0.0})
    assert result.status == "infeasible"
    assert "zs" in " ".join(result.causes)


# --- Nothing to look for ----------------------------------------------------------------------------------------------


def test_sides_that_may_both_vanish_are_no_error():
    result = solve({"a1": (0.0, 1e-3), "a2": (0.0, 1e-3)})
    assert result.status in ("optimal", "stopped")


# --- Bounds always hold -----------------------------------------------------------------------------------------------


def test_limits_of_the_box_that_named_nothing():
    """Only a far higher platform has legs that change so little; once a violation shared by two rows hid all limits."""
    ten = [{}, {"position": (0, 0, 1)}, *({"position": p} for p in itertools.product((-1, 1), repeat=3))]
    study = nd.Study(
        family="symmetric",
        variables={"zp": (1, 4)},
        constraints={"stroke_ratio": (None, 1.05)},
        objective=size({"poses": ten}, {"box": {"half": [1, 1, 1]}}),
        starts=2,
    )
    result = nd.optimize(study)
    assert result.status == "infeasible"
    assert result.causes[0] == "stroke_ratio"
    assert "zp" in result.causes
    assert "stroke_ratio <= 1.05" in result.reason
    assert "in these poses" in result.reason
    least = float(result.reason.split("nearest found have stroke_ratio <= ")[1].split()[0])
    assert 1.2 < least < 1.31


def test_heights_are_not_blamed_on_the_order_of_the_plates_by_any_number_of_threads():
    study = nd.Study(constraints={"height": (None, 1), "leg_length": (3, None), "footprint": (None, 1)}, starts=8)
    result = nd.optimize(study, threads=3)
    assert result.reason == nd.optimize(study, threads=1).reason
    assert set(result.causes) == {"height", "leg_length", "footprint"}
    # A leg from the rim of the base to O below the platform: sqrt(1 + 1), or 3 = sqrt(1 + 8).
    for words in ("leg_length >= 1.414", "height <= 2.829", "footprint <= 2.829"):
        assert words in result.reason


def test_angles_in_degrees():
    """The legs of a base cannot all point one way."""
    result = solve({}, {"base_cone": {"max_deg": 20, "axis": [1, 0, 0]}}, starts=4)
    assert result.causes == ("base_cone",)
    assert re.search(r"base_cone <= 20 deg; the nearest found has base_cone <= \d+(\.\d+)? deg$", result.reason)


def scaled(family, rng):
    """Return lengths of a random design of a family, and its angles."""
    study = nd.Study(family=family)
    lengths = {name: float(rng.uniform(0.5, 3.0)) for name in study.variables if name not in study.angles}
    lengths["zp"] = float(rng.uniform(2.0, 4.0))
    lengths["zs"] = float(rng.uniform(0.2, 0.8)) * lengths["zp"]
    return lengths, {name: float(rng.uniform(-1.0, 1.0)) for name in study.angles}


def largest(study, name, variables):
    """Return the least limit `name <= max` that allows a design."""
    return 1e6 * (1.0 - replace(study, constraints={name: (None, 1e6)}).evaluate(variables).margins[name])


@pytest.mark.parametrize("seed", range(size(12, 300)))
def test_two_limits_in_conflict_are_named_and_nothing_else(seed):
    """By construction: a large and a small design meet all limits but one each, and no design can meet these two."""
    rng = np.random.default_rng(seed)
    family = ("hexagonal", "symmetric")[seed % 2]
    lengths, angles = scaled(family, rng)
    large, small = ({n: c * x for n, x in lengths.items()} | angles for c in (30.0, 0.02))
    study = nd.Study(family=family, variables=dict.fromkeys(lengths, (0.01, 1000.0)) | angles, starts=4)
    height = 0.9 * large["zp"]
    legs = (
        0.9
        * 1e-9
        * (1.0 + replace(study, constraints={"leg_length": (1e-9, None)}).evaluate(large).margins["leg_length"])
    )
    constraints, bound = (
        ({"leg_length": (legs, None), "external_length": (None, 0.8 * legs)}, {}),
        ({"height": (height, None), "external_length": (None, 0.9 * height)}, {}),  # planar plates, level
        ({"height": (height, None)}, {"zp": (0.01, 0.8 * height)}),
    )[seed % 3]
    culprits = {*constraints, *bound}
    for name in ("radius_ratio", "leg_ratio", "footprint", "upper_length", "lower_length"):
        if rng.random() < 0.6:
            constraints[name] = (None, 1.2 * max(largest(study, name, x) for x in (large, small)))
    result = nd.optimize(replace(study, variables=study.variables | bound, constraints=constraints))
    assert result.status == "infeasible"
    assert set(result.causes) == culprits


def test_an_optimum_far_out_is_not_unbounded():
    """Legs of at most 1000 to 1 stop the flight at a base of 17 466: beyond the first cuts, not beyond all."""
    result = solve(OPEN, {"leg_ratio": (None, 1000.0)})
    assert result.status == "optimal"
    assert result.condition_number == pytest.approx(2.539702, abs=5e-6)
    assert result.active.count("leg_ratio") == 1


def test_a_weight_that_rounding_leaves_above_zero_ends_the_search():
    """The least-squares test of stationarity once ran for ever on this study."""
    study = nd.Study(
        constraints={"radius_ratio": (None, 2.0), "base_cone": {"max": 0.7 * math.exp(1e-4), "axis": [0, 0, 1]}},
        objective={"poses": [{}, {"position": (0.1, 0.05, 0), "unit": "zp"}, {"rotation": (0.1, 0.05, 0)}]},
    )
    assert nd.optimize(study).status == "optimal"


def test_legs_that_meet_in_one_design_only_collide():
    """Free sides may not slip out of a clearance by letting two joints coincide; sides fixed at zero share joints."""
    wanted = {"constraints": {"leg_clearance": {"min": 0.3, "of": "zp"}}, "starts": size(16, 64)}
    free = nd.optimize(nd.Study(**wanted))
    assert nd.check(free, perturbations=size(500, 4000)).passed
    assert min(free.variables[side] for side in ("a1", "a2", "b1", "b2")) > 0.05
    coupled = nd.optimize(nd.Study(variables={"a1": 0.0, "b2": 0.0}, **wanted))
    assert coupled.status == "optimal"
    assert nd.check(coupled, perturbations=size(500, 4000)).passed


@pytest.mark.parametrize(("starts", "seed"), [(2, 3), (2, 7), (3, 3)])
def test_few_starts_that_find_nothing_are_followed_by_others(starts, seed):
    """The first of them end where no design is regular, or outside of the limits: others find one."""
    study = nd.Study(
        variables={k: (0.2, 8.0) for k in ("a1", "a2")}
        | {k: (0.2, 4.0) for k in ("b1", "b2")}
        | {"zp": (0.5, 6.0), "zs": (0.1, 5.5)},
        constraints={
            "leg_ratio": (None, 1.2),
            "leg_clearance": {"radius": 0.2},
            "base_cone": {"max_deg": 25, "axis": [0, 0, 1]},
        },
        starts=starts,
        seed=seed,
    )
    result = nd.optimize(study)
    assert result.status == "optimal"
    assert starts < result.starts_done <= 16 + starts


@pytest.mark.parametrize(
    "objective", [{"poses": [{"position": (0.2, 0, 0)}, {"position": (0, 0.2, 0.1)}]}, {"region": {"ball": 0.2}}]
)
def test_a_least_ratio_of_legs_alone_excludes_no_other_design(objective):
    """With no greatest ratio beside it every design was called infeasible."""
    free = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": (1.0, 4.0)}
    open_ended = nd.optimize(nd.Study(variables=free, objective=objective, starts=8))
    bound = nd.optimize(
        nd.Study(variables=free, objective=objective, starts=8, constraints={"leg_ratio": (1.05, None)})
    )
    assert bound.status == "optimal"
    assert bound.objective == pytest.approx(open_ended.objective, rel=1e-9)
    tight = nd.optimize(nd.Study(variables=free, objective=objective, starts=8, constraints={"leg_ratio": (5.0, None)}))
    assert tight.status == "optimal"
    assert "leg_ratio" in tight.active
    assert tight.objective > bound.objective
