"""Single runs from chosen starts: the minimax form converges from each. Oracle: the proved least value."""

import math

import pytest

import ninedof as nd

LEAST = 3.762659078596047
STUDY = nd.Study.paper()
START = {"a1": 1.0, "a2": 2.0, "b1": 3.0, "b2": 1.0, "zp": 3.0, "zs": 1.0}


def test_the_first_design_is_the_start():
    t = nd.trace(STUDY, START | {"a2": 4.0})
    assert t.best[0] == pytest.approx(STUDY.evaluate(START | {"a2": 4.0}).condition_number, rel=1e-12)


def test_start_that_breaks_a_constraint_counts_as_infinite():
    t = nd.trace(STUDY, START | {"a2": 50.0})
    assert t.best[0] == math.inf
    assert t.end.condition_number == pytest.approx(LEAST, rel=1e-9)


@pytest.mark.parametrize(
    "changes",
    [
        {"a1": -5.0, "a2": 1e9},
        {"zs": 10.0},
        {"a1": 0.0, "a2": 0.0},
        {"a1": 1.0, "a2": 2.0, "b1": 1.0, "b2": 2.0},
        {"zp": 1.0, "zs": 1.0},
    ],
    ids=["outside", "zs above zp", "no base", "singular", "O in the platform"],
)
def test_awkward_starts(changes):
    assert nd.trace(STUDY, START | changes).end.condition_number == pytest.approx(LEAST, rel=1e-9)
