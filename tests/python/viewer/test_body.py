"""The workspace of the viewer: its surface, and its volume beside the search of the package."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd
from ninedof.viewer.body import body
from ninedof.viewer.body_job import BodyJob
from ninedof.viewer.state import State
from ninedof.viewer.subject import subject_of


def test_the_volume_is_that_of_the_workspace_search():
    state = State(subject_of())
    limits = np.full(9, 2.0), np.full(9, 5.6)
    question = state.body_question(condition_limit=6.0)
    question = replace(question, yardstick=replace(question.yardstick, leg_low=limits[0], leg_high=limits[1]))
    shown = body(question)
    home = state.home
    held = {"platform": home.internal_point - home.position}
    criteria = {"leg_limits": limits, "condition_number": 6.0, "singularity_free": True}
    reach = 0.75 * state.subject.size
    searched = nd.workspace(
        state.geometry,
        (home.position - reach, home.position + reach),
        criteria=criteria,
        internal_point=held,
        home=home,
        tolerance=0.01,
    )
    assert not shown.open
    sides = np.concatenate([shown.faces[:, [0, 1]], shown.faces[:, [1, 2]], shown.faces[:, [2, 0]]])
    there, back = ({tuple(pair) for pair in way} for way in (sides.tolist(), sides[:, ::-1].tolist()))
    assert there == back  # closed: each side once in either direction
    assert len(there) == len(sides)
    assert shown.volume == pytest.approx(searched.volume, rel=0.05)


def test_a_search_is_given_up():
    assert body(State(subject_of()).body_question(5.0), lambda: True) is None


def test_only_the_newest_of_many_searches_counts(monkeypatch):
    running, found = [], []

    def until_given_up(question, stopped):
        running.append(question)
        while not stopped():
            time.sleep(0.001)

    monkeypatch.setattr("ninedof.viewer.body_job.body", until_given_up)
    job = BodyJob(lambda *answer: found.append(answer), lambda *why: found.append(why))
    with ThreadPoolExecutor(8) as pool:  # as clicks come
        for k in range(40):
            pool.submit(job.begin, k)
    assert [job.counts(k) for k in range(1, 41)] == [False] * 39 + [True]
    threads = [t for t in threading.enumerate() if t.name == "ninedof-viewer-workspace"]
    assert set(job._threads) >= set(threads)  # each is known, so that closing waits for it
    job.close()
    assert not any(t.is_alive() for t in threads)
    job.begin("late")
    assert len(running) == 40
    assert found == []


def test_the_spread_of_a_study_bounds_the_body():
    """Every position inside keeps the stroke ratio, which the poses of the study already use up."""
    study = nd.Study(constraints={"stroke_ratio": (None, 1.3)}, objective={"poses": nd.poses.box((0.3, 0.3, 0.3))})
    result = nd.optimize(study, starts=2)
    state = State(subject_of(result))
    shown = body(state.body_question())
    assert shown.volume > 0.0
    lengths = nd.leg_lengths(result.geometry, result.configurations)
    for vertex in shown.vertices[::40]:
        p = state.home.position + 0.98 * (vertex - state.home.position)
        at = nd.Configuration(p, state.home.rotation, p + state.home.internal_point - state.home.position)
        legs = np.vstack([lengths, nd.leg_lengths(result.geometry, at)])
        assert (legs.max(axis=0) / legs.min(axis=0)).max() < 1.3 * 1.02
