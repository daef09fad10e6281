"""The point of a front to look at first, on fronts written by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from ninedof.optimize.pareto.front import preferred

NAN, INF = float("nan"), float("inf")


def front(limits, objectives):
    best = np.fmin.accumulate([INF, *objectives])
    flat = [value >= least * (1.0 - 1e-9) for value, least in zip(objectives, best, strict=False)]
    return SimpleNamespace(limits=limits, objectives=objectives, dominated=flat)


@pytest.mark.parametrize(
    ("limits", "objectives", "number"),
    [
        ((1.0, 2.0, 3.0, 4.0), (9.0, 4.0, 3.5, 3.0), 2),
        ((1e3, 2e3, 3e3, 4e3), (9e-3, 4e-3, 3.5e-3, 3e-3), 2),  # in other units
        ((0.5, 1.0, 2.0, 3.0, 4.0), (NAN, 9.0, 4.0, 3.5, 3.0), 3),  # no design at the tightest limit
        ((1.0, 2.0, 3.0, 4.0, 9.0), (9.0, 7.0, 3.5, 3.0, 3.0), 3),  # the last limit is without effect
        ((1.0, 2.0, 3.0, 4.0, INF), (9.0, 4.0, 3.5, 3.0, 2.9), 2),
    ],
)
def test_the_knee(limits, objectives, number):
    found = preferred(front(limits, objectives))
    assert found.number == number
    assert found.words.startswith("the knee")


@pytest.mark.parametrize(
    ("limits", "objectives", "number"),
    [
        ((1.0,), (5.0,), 1),
        ((1.0, 2.0), (5.0, 4.0), 2),
        ((1.0, 2.0, 3.0), (5.0, 4.0, 3.0), 3),  # straight
        ((1.0, 2.0, 3.0), (5.0, 4.8, 3.0), 3),  # bulges the other way
        ((1.0, 2.0, 3.0), (5.0, 5.0, 5.0), 1),
    ],
)
def test_without_a_knee_it_is_the_tightest_limit_with_the_least_objective(limits, objectives, number):
    found = preferred(front(limits, objectives))
    assert found.number == number
    assert "no knee" in found.words


def test_nothing_without_a_design():
    assert preferred(front((1.0, 2.0), (NAN, NAN))) is None
