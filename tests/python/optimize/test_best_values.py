"""The best known values, all with the default settings: reached or improved, with consistent checks.

Oracles: values of the theory notes (long searches by other programs), bounds proved there, and design_oracle for what a
result says of itself. What is found may be better than what is printed; it may not be better than what is proved.
"""

import functools
import math

import numpy as np
import pytest
from design_oracle import Oracle
from height_bound import least_by_height
from sizes import size

import ninedof as nd

INF = math.inf
SIDES, HEIGHTS = ("a1", "a2", "b1", "b2"), ("zp", "zs")
TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")
TWIST = {"theta_z": [-math.pi, math.pi]}


def limits(ratio=None, legs=None):
    pairs = {"radius_ratio": ratio, "leg_ratio": legs}
    return {name: {"max": high} for name, high in pairs.items() if high is not None}


def hexagonal(side=60.0, height=80.0, lowest=0.05, constraints=None, **other):
    """All sides up to `side`, heights from `lowest` to `height`."""
    variables = {key: [0.0, side] for key in SIDES} | {key: [lowest, height] for key in HEIGHTS} | {"theta_z": 0.0}
    return {
        "design": {"family": "hexagonal"},
        "variables": variables | other,
        "constraints": constraints or {},
    }


def symmetric(ratio=None, legs=None):
    """Planar triples in the room of the note: radii 0.05 to 12, heights up to 20."""
    variables = {f"{t}_radius": [0.05, 12.0] for t in TRIPLES}
    variables |= {f"{t}_angle": [-math.pi, math.pi] for t in TRIPLES[1:]} | {key: [0.05, 20.0] for key in HEIGHTS}
    return {"design": {"family": "symmetric"}, "variables": variables, "constraints": limits(ratio, legs)}


def up_to(side):
    return hexagonal(side, 100.0 * side, 1e-3 * min(side, 1.0))


def practical(family, cap=5.0, **without):
    """The rules of the theory of limits, section 4, with all radii and zp up to `cap`."""
    rules = limits(2.0, 2.5) | {
        "joint_height": {"max": 0.3, "of": "radius"},
        "zs_fraction": {"min": 0.15, "max": 0.85},
        "joint_spacing": {"min": 0.1, "of": "radius"},
        "leg_clearance": {"min": 0.05, "of": "zp"},
        "leg_length": {"min": 0.2, "of": "zp"},
    }
    variables = symmetric()["variables"] | {f"{t}_radius": [0.05, cap] for t in TRIPLES}
    variables |= {"zp": [0.05, cap], "zs": [0.05, cap]}
    if family == "symmetric_nonplanar":
        variables |= {f"{t}_height": [-4.0 * cap, 4.0 * cap] for t in TRIPLES}
    constraints = {name: rule for name, rule in rules.items() if without.get(name, True)}
    return {"design": {"family": family}, "variables": variables, "constraints": constraints}


# name: (study, best value known, half a unit of its last digit)
KNOWN = {
    "sides up to 1": (up_to(1.0), 5.7523, 5e-5),
    "sides up to sqrt 10": (up_to(math.sqrt(10.0)), 4.1026, 5e-5),
    "sides up to 10": (up_to(10.0), 3.2241, 5e-5),
    "sides up to 100": (up_to(100.0), 2.67555, 5e-6),
    "sides up to 1000": (up_to(1000.0), 2.56324, 5e-6),
    "base at most twice": (hexagonal(constraints=limits(2.0)), 3.762659, 5e-7),
    "and the twist free": (hexagonal(constraints=limits(2.0), **TWIST), 3.749827, 5e-7),
    "base side of the paper": (hexagonal(a1=[0.0, 5.8124], a2=[0.0, 5.8124]), 3.5503, 5e-5),
    "planar, ratio 2, legs 3": (symmetric(2.0, 3.0), 2.3430924, 5e-8),
    "planar, ratio 3, legs 3": (symmetric(3.0, 3.0), 2.3171776, 5e-8),
    "planar, legs 3": (symmetric(None, 3.0), 2.3171776, 5e-8),
    "planar, ratio 2, legs 2": (symmetric(2.0, 2.0), 3.1462644, 5e-8),
    "planar, ratio 2, legs 2.5": (symmetric(2.0, 2.5), 2.6413377369, 5e-11),
    "planar, practical": (practical("symmetric"), 2.6413377369, 5e-11),
    "non-planar, practical": (practical("symmetric_nonplanar"), 1.4020429319, 5e-11),
    "non-planar, practical, any height": (practical("symmetric_nonplanar", joint_height=False), 1.0762812643, 5e-11),
}
EVERY = pytest.mark.parametrize("name", KNOWN)


@functools.cache
def solved(name):
    return nd.optimize(nd.Study.from_dict(KNOWN[name][0]))


@EVERY
def test_reached_or_beaten(name):
    result, (_, least, digit) = solved(name), KNOWN[name]
    assert result.status == "optimal"
    assert result.condition_number <= least * (1.0 + 1e-6) + digit
    assert result.objective == pytest.approx(result.condition_number, rel=1e-12)
    if name.startswith("sides up to"):  # or the value would not be that of the sides alone
        assert max(result.variables[n] for n in SIDES) == pytest.approx(KNOWN[name][0]["variables"]["a1"][1], rel=1e-9)
        assert not set(HEIGHTS) & set(result.active)


@EVERY
def test_study_reports_its_own_checks(name):
    """Condition number through J' and LAPACK, margins from the joints; bounds; the least value at this |s - p|."""
    data = KNOWN[name][0]
    v = solved(name).variables
    oracle, x = Oracle(data), np.array(list(v.values()))
    found = oracle.evaluate(list(v), x)
    assert solved(name).condition_number == pytest.approx(found["objective"], rel=1e-8)
    assert min(oracle.margins(list(v), x).values(), default=0.0) >= -1e-8
    assert 0.0 < v["zs"] < v["zp"]
    for variable, bound in data["variables"].items():
        low, high = bound if isinstance(bound, list) else (bound, bound)
        assert low <= v[variable] <= high
    if v["zp"] - v["zs"] >= 0.51:  # where the bound holds
        assert solved(name).condition_number >= least_by_height(v["zp"] - v["zs"]) * (1.0 - 1e-8)
    assert solved(name).optimality_residual <= 1e-6


def test_no_better_than_proved():
    """Certified by branch and bound for the paper's study; sup and inf of the hexagons, theory of limits, section 6."""
    assert solved("base at most twice").condition_number == pytest.approx(3.762659078596047, rel=1e-12)
    limit = 2.535842022911541667
    falling = [solved(f"sides up to {u}").condition_number for u in (1, 10, 100, 1000)]
    falling.append(nd.optimize(nd.Study.from_dict(up_to(1e5))).condition_number)
    assert falling == sorted(falling, reverse=True)
    assert falling[-1] > limit
    assert falling[-1] == pytest.approx(2.53645, abs=5e-6)


@pytest.mark.parametrize(
    ("name", "legs"), [("planar, ratio 2, legs 2", 2.0), ("planar, ratio 2, legs 2.5", 2.5), ("planar, legs 3", 3.0)]
)
def test_planar_designs_reach_the_proved_bound(name, legs):
    """Theory of limits, section 3: kappa >= sqrt(1 + 8/L^2) + 2 sqrt 2 / L, attained."""
    bound = math.sqrt(1.0 + 8.0 / legs**2) + 2.0 * math.sqrt(2.0) / legs
    assert bound * (1.0 - 1e-8) <= solved(name).condition_number <= bound * (1.0 + 1e-6)


def test_doubled_inactive_bounds_change_nothing():
    wide = hexagonal(120.0, 160.0, constraints=limits(2.0))
    assert nd.optimize(nd.Study.from_dict(wide)).condition_number == pytest.approx(3.762659078596047, rel=1e-10)


# --- Starts -----------------------------------------------------------------------------------------------------------


PUBLISHED = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.4432, "theta_z": 0.0}


def test_started_at_the_published_optimum():
    """Coupled triangles, O at its best height: one run, from there and no other."""
    study = nd.Study.from_dict(hexagonal(constraints=limits(2.0)))
    assert study.evaluate(PUBLISHED).condition_number == pytest.approx(3.9070664, abs=5e-7)
    assert nd.trace(study, PUBLISHED).end.condition_number == pytest.approx(3.762659078596047, rel=1e-9)
    result = nd.optimize(study, starts=1, warm=PUBLISHED)
    assert result.status == "optimal"
    assert result.condition_number == pytest.approx(3.762659078596047, rel=1e-12)


@pytest.mark.parametrize("name", ["base at most twice", "planar, ratio 2, legs 3", "non-planar, practical"])
def test_a_start_at_the_optimum_stays_there(name):
    best = solved(name)
    again = nd.optimize(best.study, starts=1, warm=best.best)
    assert again.status == "optimal"
    assert again.objective == pytest.approx(best.objective, rel=1e-8)


# --- Statuses ---------------------------------------------------------------------------------------------------------


def test_planar_triples_without_a_size_are_unbounded():
    """Theory of limits, section 1: the infimum of planar designs is 1, with ever larger robots."""
    data = symmetric()
    data["variables"] |= {f"{t}_radius": [0.05, INF] for t in TRIPLES} | {key: [0.05, INF] for key in HEIGHTS}
    assert nd.optimize(nd.Study.from_dict(data), starts=size(24, 64)).status == "unbounded"


def test_poses_that_cannot_be_reached_within_the_stroke():
    """A lift of half a unit straight up needs legs of more than a hundredth."""
    data = hexagonal(6.0, 8.0, constraints=limits(2.0) | {"stroke": {"max": 0.01}})
    data["objective"] = {"poses": [{}, {"position": [0.0, 0.0, 0.5]}]}
    data["variables"] |= {"zp": [2.0, 8.0]}
    result = nd.optimize(nd.Study.from_dict(data))
    assert result.status == "infeasible"
    assert "stroke" in result.causes
