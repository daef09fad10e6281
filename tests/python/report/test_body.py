"""The workspace in the page of an optimization, against limits written out anew."""

from dataclasses import replace

import numpy as np
import pytest
from body_volume import body_volume

from ninedof.report import scene as quick
from ninedof.report.scene import quick_body


def test_the_body_has_the_volume_where_the_limits_of_the_study_hold(result):
    """Base cones of 45 degrees, by hand: O is carried with the platform, which does not turn."""
    made, said = quick_body(result)
    assert "base cone 45 degrees about each leg's direction at home" in said
    assert "orientation of the neutral pose" in said
    assert "O is shifted with p." in said
    assert "Not among them" not in said
    g, home = result.geometry, result.best.configuration
    vertices = np.array(made["vertices"])
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    p = np.random.default_rng(1).uniform(low, high, (40_000, 3))
    inside = np.ones(len(p), dtype=bool)
    for k in range(3):
        ends = (
            (g.platform_external[k] @ home.rotation.T, g.base_external[k]),
            (home.internal_point - home.position, g.base_internal[k]),
        )
        for end, base in ends:
            leg, first = p + end - base, home.position + end - base
            cosine = leg @ first / np.linalg.norm(leg, axis=1) / np.linalg.norm(first)
            inside &= cosine >= np.cos(np.pi / 4)
    volume = inside.mean() * np.prod(high - low)
    assert body_volume(made) == pytest.approx(volume, rel=0.05)


def without_body(result, study):
    made, said = quick_body(replace(result, study=study))
    assert made is None
    return said


def test_the_page_says_in_a_line_why_there_is_no_body(result, monkeypatch):
    study = result.study
    best = replace(study.objective, region=replace(study.objective.region, internal_point="best"))
    assert "O placed anew at every position takes minutes" in without_body(result, replace(study, objective=best))
    none = replace(study, constraints={"radius_ratio": (None, 2.0)})
    assert "No limit of the study ends a workspace" in without_body(result, none)
    monkeypatch.setattr(quick, "SECONDS", 0.0)
    assert "takes longer than a report may: ninedof workspace RUN" in without_body(result, study)


def test_a_limit_that_the_home_pose_passes_leaves_no_body(result):
    tight = replace(result.study, constraints={"leg_length": (0.0, 0.01)})
    assert "No position was found" in without_body(result, tight)


def test_limits_that_compare_poses_leave_ranges_about_the_lengths_at_its_poses(result):
    posed = replace(result.study.objective, region=None, poses=())
    study = replace(result.study, constraints={"leg_length": (None, 9.0), "stroke": (None, 2.0)}, objective=posed)
    _, said = quick_body(replace(result, study=study, region=None))
    assert "within external legs 3.81305 to 5.81305" in said  # a stroke of 2 about the length at home
    assert "Not among them" not in said
