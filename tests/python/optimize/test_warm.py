"""Warm starts: the result of one study starts another."""

import dataclasses

import numpy as np
import pytest

import ninedof as nd
from ninedof import poses
from ninedof.optimize.pieces import warm_starts

POSES = nd.Objective(poses=poses.box((0.1, 0.0, 0.0), unit="zp"))
STUDY = nd.Study(constraints={"radius_ratio": (None, 2.0)}, objective=POSES, starts=8)


@pytest.fixture(scope="module")
def result():
    return nd.optimize(STUDY)


def test_warm_starts_are_full_vectors(result):
    rows = warm_starts(STUDY, result)
    assert rows.shape[1] == len(STUDY.problem().names)
    assert 1 <= len(rows) <= 4
    assert rows[0].tolist() == list(result.best.variables.values())
    assert warm_starts(STUDY, [result.best, result.best.variables]).shape == (2, 7)
    assert warm_starts(STUDY, None) is None
    assert warm_starts(STUDY, []) is None
    assert warm_starts(STUDY, dataclasses.replace(result, candidates=())) is None


def test_warm_starts_of_another_study(result):
    fixed = dataclasses.replace(STUDY, variables={"zp": 1.25})
    assert dict(zip(fixed.variables, warm_starts(fixed, result)[0], strict=True))["zp"] == 1.25
    freer = dataclasses.replace(
        STUDY, characteristic_length="optimal", objective={"poses": [{"internal_point": "best"}]}
    )
    row = warm_starts(freer, result)[0]
    assert row.shape == (8,)  # at the neutral place O is placed by zs, which is a variable already
    assert np.isfinite(row).all()
    back = dict(zip(freer.problem().names, row.tolist(), strict=True))
    assert warm_starts(STUDY, back)[0].tolist() == row[:7].tolist()


def test_a_warm_start_is_tried(result):
    again = nd.optimize(STUDY, starts=1, warm=result)
    assert again.objective <= result.objective * (1.0 + 1e-9)


def test_a_warm_start_next_to_an_optimum_goes_straight_there(result):
    """By Newton's method on the rows that carry weight: SLSQP would take dozens of evaluations."""
    best = result.best.variables
    near = {name: value * (1.0 + 1e-7) for name, value in best.items()}
    solved = nd.optimize(STUDY, starts=1, warm=near)
    assert solved.evaluations == nd.optimize(STUDY, starts=1).evaluations
    assert solved.objective == pytest.approx(result.objective, rel=1e-12)
