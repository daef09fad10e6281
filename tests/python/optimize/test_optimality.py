"""Checks of optimality that share nothing with the solver.

For each of several studies: what a candidate claims is recomputed by the general path, which the optimizer never calls;
random feasible neighbours must not be better; no candidate may beat the lower bound by the height of O, whose
polynomial is typed in height_bound. None of these uses a gradient.
"""

import math

import numpy as np
import pytest
from height_bound import least_by_height
from sizes import size

import ninedof as nd

TWICE = {"radius_ratio": (None, 2.0)}
SMALL = dict.fromkeys(("a1", "a2", "b1", "b2"), (0.0, 3.1623)) | dict.fromkeys(("zp", "zs"), (0.001, 31.623))
STUDIES = {
    "paper": nd.Study.paper(),
    "twist": nd.Study(variables={"theta_z": (-math.pi, math.pi)}, constraints=TWICE),
    "legs": nd.Study(constraints=TWICE | {"leg_ratio": (None, 1.5)}),
    "long legs": nd.Study(constraints=TWICE | {"leg_ratio": (4.0, None)}, starts=200),  # some starts end badly here
    "small sides": nd.Study(variables=SMALL),
    "other length": nd.Study(constraints=TWICE, characteristic_length=0.3),
    "fraction": nd.Study(constraints=TWICE | {"zs_fraction": (0.7, 0.8)}),
}


@pytest.fixture(scope="module", params=STUDIES.values(), ids=STUDIES.keys())
def result(request):
    return nd.optimize(request.param)


def test_every_candidate_agrees_with_independent_computations(result):
    study, lc = result.study, result.study.characteristic_length
    assert result.status == "optimal"
    kappas = [c.condition_number for c in result.candidates]
    assert kappas == sorted(kappas)
    for c in result.candidates:
        assert nd.condition_number(c.geometry, c.configuration, lc) == pytest.approx(c.condition_number, rel=1e-9)
        v = c.variables
        if (v["zp"] - v["zs"]) / lc >= 0.51:  # where the bound holds
            assert c.condition_number >= least_by_height((v["zp"] - v["zs"]) / lc)
        assert c.optimality_residual <= 1e-6
        assert c.constraint_violation <= 1e-8
        assert 0.0 < v["zs"] < v["zp"]
        for name, bound in study.variables.items():
            low, high = bound if isinstance(bound, tuple) else (bound, bound)
            assert low <= v[name] <= high
            if name in c.active:
                assert v[name] == pytest.approx(low, abs=1e-9) or v[name] == pytest.approx(high, rel=1e-9)
        for name, margin in study.evaluate(v).margins.items():
            assert margin >= -1e-8, name
            if name in c.active:
                assert margin == pytest.approx(0.0, abs=1e-5)


def neighbour(study, base, size, rng):
    """A random step from a design, kept inside the bounds and drawn back into the radius ratio; None if not allowed."""
    x = dict(base)
    for name, bound in study.variables.items():
        if isinstance(bound, tuple):
            step = size * rng.normal() * (1.0 if name == "theta_z" else base["zp"])
            x[name] = min(max(x[name] + step, bound[0]), bound[1])
    scale = math.sqrt(1.0 + max(0.0, -study.evaluate(x).margins.get("radius_ratio", 0.0)))
    x |= {"a1": x["a1"] / scale, "a2": x["a2"] / scale}
    x |= {n: min(x[n] * scale, study.variables[n][1]) for n in ("b1", "b2")}
    point = study.evaluate(x)
    return point if x["zs"] < x["zp"] and min(point.margins.values(), default=0.0) >= 0.0 else None


def test_no_feasible_neighbour_is_better(result):
    """Random steps of every size from the best design; small ones from every other local optimum."""
    rng, study = np.random.default_rng(0), result.study
    for k, candidate in enumerate(result.candidates):
        every, small = 10.0 ** np.arange(-8.0, 0.0), [1e-7, 1e-6, 1e-5, 1e-4]
        sizes = np.repeat(every, size(30, 250)) if k == 0 else np.repeat(small, size(10, 50))
        points = [neighbour(study, candidate.variables, step, rng) for step in sizes]
        points = [p for p in points if p is not None]
        assert len(points) > 0.15 * len(sizes)
        kappa = [nd.condition_number(p.geometry, p.configuration, study.characteristic_length) for p in points]
        assert min(kappa) >= candidate.condition_number * (1.0 - 1e-9)


def test_end_points_that_fail_the_checks_are_not_candidates():
    """In a narrow room runs have stopped where the condition number could still fall: none of those may be shown."""
    room = {"radius_ratio": (1.0, 1.1), "leg_ratio": (2.0, 2.1), "zs_fraction": (0.3, 0.35)}
    found = nd.optimize(nd.Study(variables={"theta_z": (-7.0, 7.0)}, constraints=room, starts=200))
    assert found.status == "optimal"
    assert max(c.optimality_residual for c in found.candidates) <= 1e-6
    assert max(c.constraint_violation for c in found.candidates) <= 1e-8


def test_other_local_optima_are_kept():
    """Small sides: next to 4.1026 there is a second design that no small step improves."""
    best, second = nd.optimize(STUDIES["small sides"]).candidates
    assert best.condition_number == pytest.approx(4.1026148, abs=5e-7)
    assert second.condition_number == pytest.approx(4.1555214, abs=5e-7)
    assert abs(best.variables["zp"] - second.variables["zp"]) > 0.1
    assert best.reached + second.reached <= 64
