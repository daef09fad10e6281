"""Fronts over tolerances: the price of accuracy. Oracles: each tolerance solved alone, and chords of the front."""

import math
from dataclasses import replace

import pytest

import ninedof as nd
from ninedof.optimize.pareto import solving
from ninedof.optimize.pareto.front import front_table
from ninedof.optimize.pareto.limits import tightest_first, unit_of, with_limit
from ninedof.records.record import write_run

SIDES = {"a1": (0.0, 6.0), "a2": (3.0, 6.0), "b1": (1.0, 4.0), "b2": (0.0, 4.0)}
STUDY = nd.Study(
    variables={**SIDES, "zp": (2.0, 8.0), "zs": (1.0, 6.0)},
    constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 1.8)},
    objective={"poses": [{"position": [0.3, 0.0, 0.0]}]},
    unit="mm",
    characteristic_length=1.0,
    starts=2,
)
VALUES = (0.0, 0.0095, 0.0105, 0.5)


@pytest.fixture(scope="module")
def front():
    return nd.pareto(STUDY, "tolerance", values=VALUES)


def test_the_largest_tolerance_is_the_first(front):
    assert front.limits == (0.5, 0.0105, 0.0095, 0.0)
    assert front.unit == "mm"
    costs = front.objectives[1:]
    assert costs[0] > costs[1] > costs[2]
    assert [result.study.tolerances.joints for result in front] == list(front.limits)
    assert [result.reserve is not None and result.reserve.proved for result in front] == [False, True, True, False]
    assert not any(front.dominated[1:])


def test_each_tolerance_is_as_good_as_solved_alone(front):
    alone = nd.optimize(replace(STUDY, tolerances=nd.Tolerances(0.0095, 0.0095)))
    assert front.objectives[2] == pytest.approx(alone.objective, rel=1e-5)
    assert front.objectives[3] == pytest.approx(nd.optimize(STUDY).objective, rel=1e-9)


def test_a_tolerance_too_large_names_the_limits(front):
    row = front.table()[0]
    assert (row["status"], row["objective"], row["price"]) == ("infeasible", None, None)
    assert "the greatest leg ratio" in row["reason"]
    assert front_table(front).rows[0][-1] == "infeasible, see below"
    assert front_table(front).notes[0].startswith("no. 1 infeasible: not proved of every machine")


def test_prices_are_the_slope(front):
    """Per cent for 1 % less tolerance, beside the chord between two tolerances."""
    (_, b, a, _), objectives = front.limits, front.objectives
    chord = math.log(objectives[1] / objectives[2]) / math.log(b / a)
    assert math.sqrt(front.prices[1] * front.prices[2]) == pytest.approx(chord, rel=0.1)
    assert front.prices[3] == 0.0
    assert "without effect" not in front_table(front).rows[3][-1]


@pytest.mark.slow
def test_a_front_of_tolerances_is_read_back(front, tmp_path):
    write_run(front, tmp_path)
    again = nd.load(tmp_path)
    assert (again.against, again.limits, again.unit) == (front.against, front.limits, front.unit)
    assert again.prices == front.prices
    assert [result.study for result in again] == [result.study for result in front]
    page = nd.report(tmp_path).read_text(encoding="utf-8")
    assert "2 of 4 limits: proved of every machine within the tolerances." in page
    assert "--against tolerance --value 0.5 --value 0.0105" in page


def test_the_ratio_of_joints_and_legs_is_kept():
    study = replace(STUDY, tolerances=nd.Tolerances(joints=0.2, legs=0.05))
    assert with_limit(study, "tolerance", 0.4).tolerances == nd.Tolerances(0.4, 0.1)
    assert with_limit(study, "tolerance", None).tolerances == nd.Tolerances()
    assert with_limit(STUDY, "tolerance", 0.4).tolerances == nd.Tolerances(0.4, 0.4)
    assert unit_of(study, "tolerance") == "mm"
    assert tightest_first("tolerance", (0.0, 2.0, 1.0)) == [2.0, 1.0, 0.0]
    assert tightest_first("height", (2.0, 1.0)) == [1.0, 2.0]


def test_tolerances_that_are_found_end_where_no_design_is_left():
    found = nd.pareto(STUDY, "tolerance", points=3)
    statuses = [row["status"] for row in found.table()]
    assert statuses == ["infeasible", "optimal", "optimal", "optimal"]
    edge, largest, middle, drawn = found.limits
    assert largest < edge < 1.25 * largest
    assert middle == pytest.approx(0.5 * largest)
    assert drawn == 0.0


def test_the_largest_tolerance_is_found_from_above_too(monkeypatch):
    below = nd.pareto(STUDY, "tolerance", points=2).limits[1]
    monkeypatch.setattr(solving, "FIRST", 0.02)  # of the height: no design keeps to that
    assert nd.pareto(STUDY, "tolerance", points=2).limits[1] == pytest.approx(below, rel=0.1)


def test_prices_of_least_values_count(monkeypatch):
    study = replace(STUDY, constraints={"radius_ratio": (None, 2.0), "leg_length": (2.5, 6.0)})
    found = nd.pareto(study, "tolerance", values=[0.0095, 0.0105])
    assert set(found.results[0].reserve.shares) == {"radius_ratio max", "leg_length min"}
    chord = math.log(found.objectives[0] / found.objectives[1]) / math.log(found.limits[0] / found.limits[1])
    assert math.sqrt(found.prices[0] * found.prices[1]) == pytest.approx(chord, rel=0.1)


def test_a_study_without_a_design_has_one_row():
    none = replace(STUDY, constraints={"leg_ratio": (None, 0.5)})
    found = nd.pareto(none, "tolerance")
    assert [(row["limit"], row["status"]) for row in found.table()] == [(0.0, "infeasible")]
