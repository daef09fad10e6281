"""The design problem of the paper and its relatives: known least values, checked optimality, reproducibility.

Oracles: values of the theory notes, found there by other programs and partly proved; a simplex search. All known values
are in bench/python/values.py. What is checked about candidates in general is in test_optimality.py.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize

import ninedof as nd

LEAST = 3.762659078596047  # base at most twice the platform; proved in the theory of certificates
SIDES, HEIGHTS = ("a1", "a2", "b1", "b2"), ("zp", "zs")


@pytest.fixture(scope="module")
def paper():
    return nd.optimize(nd.Study.paper())


def kappa_of(x, lc=1.0):
    return nd.condition_number(nd.Geometry.hexagonal(*x[:4]), nd.Configuration.neutral(*x[4:]), lc)


def sided(limit):
    """All sides up to `limit`, heights up to ten times that."""
    bounds = dict.fromkeys(SIDES, (0.0, limit)) | dict.fromkeys(HEIGHTS, (min(0.05, 1e-3 * limit), 10.0 * limit))
    return nd.Study(variables=bounds)


# --- The paper's study ------------------------------------------------------------------------------------------------


def test_least_condition_number_of_the_paper(paper):
    assert paper.status == "optimal"
    assert paper.status is nd.Status.OPTIMAL
    assert paper.condition_number == pytest.approx(LEAST, rel=1e-12)
    expected = {"a1": 0.0, "a2": 6.0079, "b1": 3.0040, "b2": 0.0, "zp": 4.9752, "zs": 3.1681, "theta_z": 0.0}
    assert paper.variables == pytest.approx(expected, abs=1e-4)
    assert set(paper.active) == {"a1", "b2", "radius_ratio"}
    assert paper.variables["a2"] / paper.variables["b1"] == pytest.approx(2.0, rel=1e-9)
    assert (paper.variables["a1"], paper.variables["b2"]) == (0.0, 0.0)
    assert paper.optimality_residual <= 1e-6
    assert 0.0 <= paper.constraint_violation <= 1e-8


def test_fields_of_a_result_are_consistent(paper):
    best = paper.best
    assert best is paper.candidates[0]
    assert best.geometry == nd.Geometry.hexagonal(*(best.variables[name] for name in SIDES))
    assert best.configuration == nd.Configuration.neutral(*(best.variables[n] for n in (*HEIGHTS, "theta_z")))
    assert (paper.geometry, paper.configuration, paper.variables) == (best.geometry, best.configuration, best.variables)
    assert list(best.variables) == list(paper.study.variables)
    assert paper.study == nd.Study.paper()
    assert paper.starts_done == 64
    assert 0 < sum(c.reached for c in paper.candidates) <= 64
    assert paper.evaluations > 64
    assert paper.seconds > 0.0
    assert paper.causes == ()
    assert paper.reason


@pytest.mark.parametrize("limit", [0.3, 0.1, 0.03, 0.01])
def test_small_robots(limit):
    """Sides of centimetres at a characteristic length of one metre: as good a study as any.

    Oracle: a simplex search over the two heights of the coupled design that fills its bounds.
    """

    def kappa(log_heights):
        zp, fraction = np.exp(log_heights[0]), 1.0 / (1.0 + np.exp(log_heights[1]))
        return math.log(kappa_of([0.0, limit, limit, 0.0, zp, zp * fraction]))

    found = minimize(kappa, [math.log(0.5 * limit), 0.0], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-13})
    result = nd.optimize(sided(limit))
    assert result.status == "optimal"
    assert result.condition_number == pytest.approx(math.exp(found.fun), rel=1e-7)


# --- Reproducibility --------------------------------------------------------------------------------------------------


def test_starts_and_seed_of_the_study_hold_unless_given():
    study = nd.Study(constraints={"radius_ratio": (None, 2.0)}, starts=5, seed=3)
    assert nd.optimize(study).starts_done == 5
    assert nd.optimize(study, starts=7).starts_done == 7
    again = nd.optimize(study, seed=4).study
    assert (again.starts, again.seed, again.constraints) == (5, 4, study.constraints)
    same = nd.optimize(nd.Study.paper(), starts=5, seed=3)
    assert replace(same, seconds=0.0) == replace(nd.optimize(study), seconds=0.0)
