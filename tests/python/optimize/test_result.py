"""Properties and summary of a result."""

import dataclasses
import math

import numpy as np
import pytest

import ninedof as nd
from ninedof import poses
from ninedof.design.domains.poses import rule_words
from ninedof.optimize.tables import least_share, price_words
from ninedof.redundancy.rules import WORDS

POSES = nd.Objective(poses=poses.box((0.1, 0.0, 0.0), unit="zp"))
STUDY = nd.Study(constraints={"radius_ratio": (None, 2.0)}, objective=POSES, starts=8)


@pytest.fixture(scope="module")
def result():
    return nd.optimize(STUDY)


def test_properties_of_a_result_are_those_of_the_best_candidate(result):
    best = result.best
    assert (result.objective, result.prices, result.conditions) == (best.objective, best.prices, best.conditions)
    assert len(best.conditions) == 3
    assert best.objective == pytest.approx(max(best.conditions))
    assert best.configurations.shape == (4,)
    assert best.configuration == best.configurations[0]
    assert best.neutral_condition_number == pytest.approx(nd.condition_number(best.geometry, best.configuration))
    assert best.condition_number == result.condition_number == max(best.conditions)
    assert result.neutral_condition_number == best.neutral_condition_number
    assert best.conditions == pytest.approx(nd.condition_number(best.geometry, best.configurations)[1:])
    assert result.confidence == min(1.0, best.reached / result.starts_done)


@pytest.mark.parametrize(
    ("counts", "words"),
    [
        ((8, 8, 56), "8 starts were followed to the end, all of them to this optimum; 56 others were given up"),
        ((10, 3, 0), "10 starts were followed to the end, 3 of them to this optimum. A better optimum to which 26 %"),
        ((8, 0, 1), "8 starts were followed to the end, none of them to this optimum; 1 other was given up"),
        ((1, 1, 0), "1 start was followed to the end, to this optimum. A better optimum to which 95 % of starts lead"),
        ((0, 0, 3), "no start was followed to its end"),
    ],
)
def test_agreement_says_what_the_starts_show(result, counts, words):
    completed, reached, abandoned = counts
    best = dataclasses.replace(result.best, reached=reached)
    asked = dataclasses.replace(
        result, candidates=(best,), runs_completed=completed, runs_abandoned=abandoned, status=nd.Status.OPTIMAL
    )
    assert asked.agreement.startswith(words)
    assert all(line in asked.summary() for line in asked.agreement.split(". "))
    stopped = dataclasses.replace(asked, status=nd.Status.STOPPED)
    assert "optimum" not in stopped.agreement


def test_starts_with_a_share_are_met_as_often_as_agreement_says():
    """Draws of n starts, each of which reaches a better optimum with the stated share: about 5 % miss it."""
    rng = np.random.default_rng(3)
    for n in (1, 8, 64):
        missed = (rng.random((20_000, n)) >= least_share(n)).all(axis=1).mean()
        assert missed == pytest.approx(0.05, abs=0.006)


def test_warm_starts_are_no_evidence():
    study = nd.Study.paper()
    best = nd.optimize(study, starts=4)
    again = nd.optimize(study, starts=2, seed=3, warm=[best.best] * 3)
    assert again.runs_completed <= again.starts_done - 3
    assert again.best.reached <= again.runs_completed
    assert 0.0 <= again.confidence <= 1.0


def test_without_a_candidate_there_is_no_confidence(result):
    nothing = dataclasses.replace(result, candidates=(), status=nd.Status.INFEASIBLE)
    assert nothing.confidence == 0.0
    of_best = ("prices", "conditions", "configurations", "constraint_violation", "optimality_residual")
    for name in ("best", "objective", "condition_number", "variables", "geometry", "configuration", "active", *of_best):
        assert getattr(nothing, name) is None
    assert nothing.summary() == f"infeasible: {result.reason}"


def test_summary_names_status_objective_and_active_limits(result):
    text = result.summary()
    assert text.startswith(f"{result.status}: {result.reason}")
    for part in (f"{result.objective:.6f}", f"{result.condition_number:.6f}", "over 3 poses", "radius_ratio", "starts"):
        assert part in text


@pytest.mark.parametrize(
    ("constraint", "words"),
    [
        ((None, 2.0), "more radius_ratio"),
        ((1.0, None), "less radius_ratio"),
        ((1.0, 2.0), "wider radius_ratio"),
    ],
)
def test_prices_state_the_direction_that_relaxes_a_limit(result, constraint, words):
    study = dataclasses.replace(STUDY, constraints={"radius_ratio": constraint})
    best = dataclasses.replace(result.best, prices={"radius_ratio": 0.1234, "a1": 1e-9})
    first, last = price_words(study, best.variables, best.prices)
    assert first == f"1 % {words} gains 0.123 %"
    assert last.endswith("a1 gains less than 0.0005 %")  # a limit that is reached is never left out


@pytest.mark.parametrize(
    ("price", "words"),
    [(9.9, "1 % more a2 (0.06 mm) gains 9.9 %"), (102.152, "0.01 % more a2 (0.0006 mm) gains 1.02 %")],
)
def test_a_steep_price_is_named_for_a_smaller_step(result, price, words):
    study = dataclasses.replace(STUDY, variables={"a2": (1.0, 6.0)}, unit="mm", characteristic_length=1.0)
    variables = result.best.variables | {"a2": 6.0}
    assert price_words(study, variables, {"a2": price}) == [words]


def test_prices_of_bounds_state_which_bound(result):
    study = dataclasses.replace(STUDY, variables={"a2": (1.0, 6.0), "zp": (2.0, math.inf)})
    best = dataclasses.replace(
        result.best, prices={"a2": 0.5, "zp": 0.25}, variables=result.best.variables | {"a2": 6.0, "zp": 2.0}
    )
    assert price_words(study, best.variables, best.prices) == ["1 % more a2 gains 0.5 %", "1 % less zp gains 0.25 %"]


@pytest.mark.parametrize(("rule", "idle"), [("shifted", "q1, q2, q3"), ("held", "r1, r2, r3"), ("best", "")])
def test_the_summary_says_where_o_is_and_which_legs_never_move(rule, idle):
    """Without rotations one triple of internal legs stands still; O placed by the search is never worse."""
    poses = nd.poses.box((0.4, 0.4, 0.0), points=2, internal_point=rule)
    result = nd.optimize(dataclasses.replace(nd.Study.paper(), objective=nd.Objective(poses=poses)), starts=1)
    said = result.internal_points
    assert said in result.summary()
    assert said.startswith(f"O is {WORDS[rule]}")
    assert (f"{idle} never move" in said) if idle else "never" not in said
    if idle:
        assert float(said.split("would have ")[1].split()[0]) < result.objective


def test_o_by_the_rule_of_each_pose():
    shift = (0.1, 0.2, 0.3)
    assert nd.Pose(shift, internal_point=shift) == nd.Pose(shift) == nd.Pose(shift, internal_point="shifted")
    assert nd.Pose(shift, internal_point=(0, 0, 0)) == nd.Pose(shift, internal_point="held") != nd.Pose(shift)
    assert nd.Pose(internal_point="held") == nd.Pose()
    assert tuple(nd.Pose(shift).for_core().internal) == shift
    assert rule_words([nd.Pose(shift), nd.Pose(shift, internal_point="held"), nd.Pose()]) == (
        "O is shifted with p at 2 poses, held in the base at 1 pose"
    )


@pytest.mark.parametrize(("tilt", "never"), [(0.2, False), (0.0, True)])
def test_a_leg_of_one_length_at_the_poses_that_ruled_moves_where_the_region_turns_it(tilt, never):
    study = dataclasses.replace(nd.Study.paper(), objective={"region": {"box": (0.3, 0.3, 0.1), "tilt": tilt}})
    result = nd.optimize(study, starts=1)
    home = result.best.configurations
    ruled = home[np.zeros(len(home), dtype=int)]  # the same lengths of all legs
    said = dataclasses.replace(result, candidates=(dataclasses.replace(result.best, configurations=ruled),))
    assert ("q1, q2, q3 never move" in said.internal_points) == never
    assert "l1" not in said.internal_points
