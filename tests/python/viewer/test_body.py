"""The workspace of the viewer: that of `workspace`, within the limits of the study, and its surface."""

import math
import threading
import time

import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.viewer.body import Body, BodySearch, body_of, leg_limits, question_of
from ninedof.viewer.machine import machine_of
from ninedof.viewer.state import State
from ninedof.workspace.study_question import study_criteria


def body(state, condition_limit=math.inf):
    question = question_of(state.variant, state.configuration, state.rule, state.machine.size, condition_limit)
    return body_of(state.variant, question, state.machine.unit)


def volume(body):
    vertices, faces = body.mesh
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


@pytest.mark.parametrize("rule", ["carried", "held"])
def test_the_body_is_closed_and_has_the_volume_of_the_workspace(rule):
    state = State(machine_of())
    state.set_rule(rule)
    c, reach = state.configuration, 0.75 * state.machine.size
    searched = nd.workspace(
        state.variant.geometry,
        (c.position - reach, c.position + reach),
        criteria={"condition_number": 5.0, "singularity_free": True},
        internal_point={"carried": {"platform": c.internal_point - c.position}, "held": c.internal_point}[rule],
        home=c,
    )
    shown = body(state, 5.0)
    assert f"Volume about {searched.volume:.3g}" in shown.words or f"{searched.volume:.2g}" in shown.words
    assert volume(shown) == pytest.approx(searched.volume, rel=0.03)
    faces = shown.mesh[1]
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    there, back = ({tuple(pair) for pair in way} for way in (sides.tolist(), sides[:, ::-1].tolist()))
    assert there == back  # each side once in either direction
    assert len(there) == len(sides)


def test_a_pose_beyond_a_limit_has_no_workspace_and_is_told():
    state = State(machine_of())
    shown = body(state, 2.0)
    assert shown.mesh is None
    assert shown.words == (
        "No position that keeps all limits is connected with the pose shown, which violates condition_number."
    )


def test_only_the_newest_of_many_searches_counts():
    shown, begun = [], []
    search = BodySearch(lambda number, body: shown.append((number, body.words)))

    def until_given_up(progress):
        begun.append(len(begun))
        while True:
            progress()
            time.sleep(0.001)

    for _ in range(10):  # as clicks come
        search.begin(until_given_up)
    search.begin(lambda progress: Body("newest"))
    search.close()
    assert shown in ([], [(11, "newest")])
    assert not search.counts(11)
    assert not [t for t in threading.enumerate() if t.name.startswith("ninedof-viewer-workspace")]


@pytest.mark.parametrize(
    "constraint", [{"stroke_ratio": (None, 1.3)}, {"leg_ratio": (None, 3.0)}, {"stroke": (None, 2.0)}]
)
def test_the_spread_of_a_study_bounds_the_body(constraint):
    """Every position inside keeps it together with the poses of the study."""
    study = nd.Study(constraints=constraint, objective={"poses": nd.poses.box((0.3, 0.3, 0.3))})
    result = nd.optimize(study, starts=2)
    ((name, (_, most)),) = constraint.items()
    state = State(machine_of(result))
    vertices, _ = body(state).mesh
    assert len(vertices) > 100
    lengths = nd.leg_lengths(result.geometry, result.configurations)
    home = state.variant.home
    for vertex in vertices[::40]:
        p = home.position + 0.98 * (vertex - home.position)
        at = nd.Configuration(p, home.rotation, p + home.internal_point - home.position)
        legs = np.vstack([lengths, nd.leg_lengths(result.geometry, at)])
        long, short = legs.max(axis=0), legs.min(axis=0)
        spread = {"stroke": long - short, "stroke_ratio": long / short, "leg_ratio": long.max() / short.min()}[name]
        assert np.max(spread) < most * 1.02


@pytest.mark.parametrize(
    "constraint", [{"stroke_ratio": (None, 1.3)}, {"leg_ratio": (None, 3.0)}, {"stroke": (None, 2.0)}, {}]
)
@pytest.mark.parametrize("objective", [{"poses": nd.poses.box((0.3, 0.3, 0.3))}, {"region": {"box": [0.2, 0.2, 0.1]}}])
def test_legs_have_the_ranges_of_the_command(constraint, objective):
    limits = constraint | {"upper_length": (0.2, 9.0)}
    result = nd.optimize(nd.Study(constraints=limits, objective=objective), starts=2)
    typed = study_criteria(result).criteria["leg_limits"]
    for own, other in zip(leg_limits(State(machine_of(result)).variant), typed, strict=True):
        assert_allclose(own, other, rtol=1e-6)
