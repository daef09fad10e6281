"""For which rows of actuators designs exist, held against designs drawn at random and evaluated in numpy."""

from dataclasses import replace

import numpy as np
import pytest
from interrupts import InterruptedPhase, interrupted_on_entry
from limit_oracle import limits_of, margins, robot_of
from region_oracle import random_poses

import ninedof as nd
from ninedof.design.domains.region_poses import posed

STUDY = nd.Study(
    variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": 3.0},
    constraints={"base_cone": {"max_deg": 60, "axis": (0, 0, 1)}},
    objective={"region": {"box": (0.4, 0.4, 0.3), "tilt": 0.12}},
    actuators=[nd.Actuator("short", 1.6, 3.0), nd.Actuator("middle", 3.0, 4.5), nd.Actuator("long", 4.6, 7.0)],
)
VARY = ("a2", "b1")


@pytest.fixture(scope="module")
def found():
    return nd.admissible_actuators(STUDY, VARY, resolution=0.02)


def least_margin(row, design, count, rng):
    study = STUDY.with_actuators({row.kind: row.row})
    poses = random_poses(STUDY.objective.region, count, rng)
    there = posed(study, poses)
    robot = robot_of(there, {"a1": 0.0, "b2": 0.0, "zp": 5.0, "zs": 3.0, "theta_z": 0.0} | design)
    return min(margins(limit, robot).min() for limit in limits_of(there))


def test_every_row_of_every_kind_has_an_answer_of_both_sorts(found):
    assert [(one.kind, one.row.name) for one in found.rows] == [
        (kind, row.name) for kind in ("external", "upper", "lower") for row in STUDY.actuators
    ]
    assert {one.state for one in found.rows} == {"exists", "none"}
    assert found.of == "a2 from 2 to 10, b1 from 1 to 5, at zp = 5, zs = 3"
    assert not found.interrupted


def test_a_design_that_exists_keeps_the_limits_of_its_row(found):
    rng = np.random.default_rng(1)
    for one in found.rows:
        if one.state == "exists":
            assert least_margin(one, one.design, 2000, rng) > 0.0, one


@pytest.mark.slow(sanitized=True)
def test_where_none_exists_no_design_drawn_at_random_keeps_the_limits(found):
    rng = np.random.default_rng(2)
    for one in found.rows:
        if one.state == "none":
            assert one.design is None
            for a2, b1 in zip(rng.uniform(2.0, 10.0, 30), rng.uniform(1.0, 5.0, 30), strict=True):
                assert least_margin(one, {"a2": a2, "b1": b1}, 300, rng) < 1e-3, (one, a2, b1)


def test_one_row_for_all_legs():
    study = replace(STUDY, actuators_for="all", actuators=[nd.Actuator("any", 0.1, 50.0), nd.Actuator("no", 0.1, 0.5)])
    rows = nd.admissible_actuators(study, VARY).rows
    assert [(one.kind, one.state) for one in rows] == [("all", "exists"), ("all", "none")]


def test_without_time_all_is_undecided_and_ctrl_c_keeps_what_was_found():
    assert {one.state for one in nd.admissible_actuators(STUDY, VARY, time_limit=0.0).rows} == {"undecided"}
    with interrupted_on_entry("any_admissible"):
        found = nd.admissible_actuators(STUDY, VARY)
    assert found.interrupted
    assert len(found.rows) == 9
    assert found.rows[-1].state == "undecided"


def test_ctrl_c_between_rows_keeps_those_before(found):
    """Beside the core it was raised, and what had been found was lost."""
    ended = nd.admissible_actuators(STUDY, VARY, progress=InterruptedPhase("long for external legs"))
    assert ended.interrupted
    assert [one.state for one in ended.rows[:2]] == [one.state for one in found.rows[:2]]
    assert [one.state for one in ended.rows[2:]] == ["undecided"] * 7
