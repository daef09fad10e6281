"""The design problem of the paper and its relatives: known least values, checked optimality, reproducibility.

Oracles: values of the theory notes, found there by other programs and partly proved; a simplex search; numpy's
condition number. What is checked about candidates in general is in test_optimality.py.
"""

import math

import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_allclose
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


def bits(result):
    """Everything a result holds but the time it took, floats to the last bit."""

    def of(c):
        numbers = [c.condition_number, *c.variables.values(), c.optimality_residual, c.constraint_violation]
        return [x.hex() for x in numbers], list(c.variables), c.geometry, repr(c.configuration), c.active, c.reached

    return (
        [of(c) for c in result.candidates],
        result.status,
        result.reason,
        result.causes,
        result.evaluations,
        result.starts_done,
    )


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


def test_published_optimum_is_not_a_minimum():
    """Base side and height of the paper kept: 3.7866, below its printed 3.9110 and below 3.9071, the best zs can do."""
    study = nd.Study(variables={"a1": 0.0, "a2": 5.8124, "zp": 3.9828})
    result = nd.optimize(study)
    assert result.condition_number == pytest.approx(3.7866, abs=5e-5)
    assert result.variables["b1"] == pytest.approx(2.3434, abs=5e-5)
    assert result.variables["zs"] == pytest.approx(2.5766, abs=5e-5)
    only_zs = nd.optimize(
        nd.Study(variables=dict.fromkeys(("a1", "b2"), 0.0) | {"a2": 5.8124, "b1": 2.9062, "zp": 3.9828})
    )
    assert only_zs.condition_number == pytest.approx(3.9070664186, abs=5e-7)
    assert only_zs.active == ()
    assert result.condition_number < only_zs.condition_number < 3.9110


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


@pytest.mark.parametrize("limit", [1.0, 1.5, 2.0, 3.0])
def test_leg_ratio_obeys_the_proved_bound_of_planar_designs(limit):
    """Theory of limits, section 3: kappa >= c + sqrt(1 + c^2), c = 2 sqrt 2 / L; hexagons reach it at L = 1."""
    result = nd.optimize(nd.Study(constraints={"leg_ratio": (None, limit)}))
    c = 2.0 * math.sqrt(2.0) / limit
    bound = c + math.hypot(1.0, c)
    assert result.status == "optimal"
    assert result.condition_number >= bound * (1.0 - 1e-8)
    legs = nd.leg_lengths(result.geometry, result.configuration)
    assert legs.max() / legs.min() <= limit * (1.0 + 1e-8)
    if limit == 1.0:
        assert result.condition_number == pytest.approx(3.0 + 2.0 * math.sqrt(2.0), rel=1e-8)


@pytest.mark.parametrize("centre", [0.3, 1.6, 2.6, -2.9])
def test_twist_is_an_angle(centre):
    """Any interval of theta_z, and the same one a turn further on either side, allows the same machines."""
    turn = 2.0 * math.pi
    least = []
    for shift in (0.0, turn, -turn, 2.0 * turn):
        bounds = (centre - 0.2 + shift, centre + 0.2 + shift)
        result = nd.optimize(nd.Study(variables={"theta_z": bounds}, constraints={"radius_ratio": (None, 2.0)}))
        assert result.status == "optimal"
        assert bounds[0] <= result.variables["theta_z"] <= bounds[1]
        least.append(result.condition_number)
    assert_allclose(least, least[0], rtol=1e-9)


def test_wider_twist_is_no_worse():
    def least(twist):
        return nd.optimize(
            nd.Study(variables={"theta_z": twist}, constraints={"radius_ratio": (None, 2.0)})
        ).condition_number

    assert least((3.0, 4.0)) <= least(4.0) * (1.0 + 1e-9)
    assert least((0.0, 6.0)) <= least(5.5) * (1.0 + 1e-9)
    assert least((-math.inf, math.inf)) <= least((0.0, 7.0)) * (1.0 + 1e-9)


# --- Reproducibility --------------------------------------------------------------------------------------------------


def test_starts_and_seed_of_the_study_hold_unless_given():
    study = nd.Study(constraints={"radius_ratio": (None, 2.0)}, starts=5, seed=3)
    assert nd.optimize(study).starts_done == 5
    assert nd.optimize(study, starts=7).starts_done == 7
    again = nd.optimize(study, seed=4).study
    assert (again.starts, again.seed, again.constraints) == (5, 4, study.constraints)
    assert bits(nd.optimize(study)) == bits(nd.optimize(nd.Study.paper(), starts=5, seed=3))


def test_condition_number_agrees_with_numpy(paper):
    m = model.robot(paper.geometry, paper.configuration)
    assert model.condition_number(m) == pytest.approx(paper.condition_number, rel=1e-13)
