"""One name for each rule for O: a study, a trajectory, the viewer and a command place it at the same point."""

import dataclasses

import numpy as np
import pytest

import ninedof as nd
from ninedof.cli.posed import Chosen, PoseOptions, named_design
from ninedof.redundancy.rules import MEANING, RULES, STUDY_RULES, WORDS, where_o
from ninedof.viewer.machine import machine_of
from ninedof.viewer.state import State

SHIFT, TURN_DEG = (0.3, -0.2, 0.1), (4.0, -7.0, 12.0)


@pytest.fixture(scope="module")
def choice() -> Chosen:
    return named_design(None)


def expected(rule, home, q):
    """O by its definition, at the pose away from home."""
    arm = home.internal_point - home.position
    turned = q @ home.rotation.T
    return {
        "carried": home.position + SHIFT + turned @ arm,
        "shifted": home.internal_point + SHIFT,
        "held": home.internal_point,
    }[rule]


def test_a_rule_places_o_at_the_same_point_everywhere(choice):
    home, g = choice.configuration, choice.geometry
    q = home.moved([*np.radians(TURN_DEG), 0, 0, 0, 0, 0, 0]).rotation
    pose = home.position + SHIFT
    for rule in ("carried", "shifted", "held"):
        o = expected(rule, home, q)
        trajectory = nd.Trajectory([0.0, 1.0, 2.0], [home.position, pose, pose], [home.rotation, q, q])
        along = nd.follow(g, trajectory, home, internal_point=rule)
        np.testing.assert_allclose(along.configurations.internal_point[1], o, atol=1e-12)
        state = State(machine_of())
        state.set_rule(rule)
        state.set_pose(pose - home.position + state.variant.home.position, TURN_DEG)
        np.testing.assert_allclose(
            state.configuration.internal_point,
            expected(rule, state.variant.home, state.configuration.rotation),
            atol=1e-12,
        )
        at = PoseOptions(design="", position=tuple(pose), rotation_deg=TURN_DEG, internal_point=rule).poses(choice)
        np.testing.assert_allclose(at.internal_point[0], o, atol=1e-12)
        if rule in STUDY_RULES:
            study = dataclasses.replace(
                nd.Study.paper(), objective=nd.Objective(poses=[nd.Pose(SHIFT, np.radians(TURN_DEG), rule)])
            )
            posed = study.evaluate({"a1": 0.0, "a2": 5.0, "b1": 3.0, "b2": 0.0, "zp": 4.0, "zs": 2.0}).configurations
            start, away = posed[0], posed[1]
            np.testing.assert_allclose(away.internal_point, expected(rule, start, away.rotation), atol=1e-12)


def test_every_rule_has_its_words():
    assert set(WORDS) == set(MEANING) == set(RULES) > set(STUDY_RULES)
    assert len(set(WORDS.values())) == len(RULES)
    assert [where_o(rule) for rule in RULES] == list(WORDS.values())
    assert where_o(0.5) == "at 0.5 of the way from the lower to the upper internal joints"
    assert where_o({"platform": [0.0, 0.0, -150.0]}, "mm") == (
        "carried as a point of the platform, at (0, 0, -150) mm of its frame"
    )
    assert where_o([0.0, -0.0, 2.0]) == "held in the base, at (0, 0, 2)"


def test_a_study_refuses_a_rule_that_turns_with_the_platform():
    for make in (nd.Pose, nd.Region):
        with pytest.raises(ValueError, match=r"^internal_point: got 'carried', expected one of shifted, held, best"):
            make(internal_point="carried")
