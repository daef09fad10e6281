"""Figures of a run show the study that was solved."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.records.figures import _curves, _over_poses, _pose_name, figures_of

STUDY = nd.Study.load(Path(__file__).parents[3] / "examples" / "02_twist_and_legs.toml")


def test_curves_pass_through_the_design_at_its_own_characteristic_length():
    best = nd.optimize(STUDY, starts=8).best
    length = STUDY.characteristic_length
    curves = _curves(nd.Tool(), ("it", best.geometry, best.configuration, best.condition_number, length))
    zs, theta_z, kappa = curves.point
    assert kappa == best.condition_number
    assert np.interp(zs, curves.zs, curves.along_zs) == pytest.approx(kappa, rel=1e-3)
    assert np.interp(theta_z, curves.theta_z, curves.along_theta_z) == pytest.approx(kappa, rel=1e-3)


@pytest.mark.slow(sanitized=True)
def test_the_convergence_is_drawn_only_where_asked(monkeypatch):
    """It follows starts for longer than the optimization takes."""
    monkeypatch.setattr("ninedof.records.figures._traces", lambda result, form: [(4.0, 3.9)])
    result = nd.optimize(STUDY, starts=4)
    assert [name for name, _ in figures_of(result)()] == ["mechanism", "drawing", "condition"]
    asked = figures_of(result, convergence=True)()
    assert [name for name, _ in asked] == ["mechanism", "drawing", "condition", "convergence"]


def test_poses_are_named_by_their_shifts():
    poses = (nd.Pose(), nd.Pose((0.1, 0.0, -0.2), unit="zp"), nd.Pose(rotation=(0.0, np.radians(10), 0.0)))
    assert [_pose_name(pose) for pose in poses] == ["neutral", "x +0.1 zp, z \N{MINUS SIGN}0.2 zp", "θy +10°"]


def test_poses_have_the_numbers_of_the_sheet():
    study = replace(nd.Study.paper(), objective={"poses": nd.poses.box((0.1, 0.0, 0.2))})
    result = nd.optimize(study, starts=2)
    names, sheet = [_pose_name(pose) for pose in result.solved.objective.poses], nd.sheet(result)
    assert len(names) == len(sheet.configurations) - 1 == 9
    for k, name in enumerate(names, start=1):  # 0 is the neutral pose
        shift = sheet.configurations[k].position - sheet.configurations[0].position
        said = [f"{axis} {x:+.3g}" for axis, x in zip("xyz", shift, strict=True) if abs(x) > 1e-12]
        assert name == (", ".join(said).replace("-", "\N{MINUS SIGN}") or "neutral")


@pytest.mark.slow(sanitized=True)
def test_a_region_study_is_drawn_over_its_region():
    """Curves, the map and the caption are of what the study asks for, not of the neutral pose alone."""
    region = {"box": [0.3, 0.3, 0.2], "tilt_deg": 8}
    limits = {"radius_ratio": (None, 2.0), "stroke_ratio": (None, 1.4)}
    result = nd.optimize(nd.Study("symmetric", constraints=limits, objective={"region": region}, starts=2))
    made = dict(figures_of(result)())
    assert list(made) == ["mechanism", "drawing", "condition", "region"]
    worst = f"{result.objective:.4f}"
    count = len(result.region.poses)
    words = [text.get_text() for text in made["condition"].legends[0].get_texts()]
    assert words[0] == f"worst condition number over the {count} poses that ruled the region: {worst}"
    assert words[1] == "at the neutral pose"
    assert any(
        text.get_text().startswith(f"worst condition number over the region {worst};")
        for text in made["mechanism"].texts
    )
    (curves,) = _over_poses(result)
    zs, theta_z, objective = curves.point
    assert objective == result.best.objective > result.best.neutral_condition_number
    assert np.interp(zs, curves.zs, curves.along_zs) == pytest.approx(objective, rel=1e-3)
    assert np.interp(theta_z, curves.theta_z, curves.along_theta_z) == pytest.approx(objective, rel=1e-3)
    assert np.interp(zs, curves.zs, curves.neutral[0]) == pytest.approx(result.best.neutral_condition_number, rel=1e-3)
    turned = curves.theta_z[100]  # the same machine with its platform's frame turned
    twisted = nd.Configuration.neutral(*result.best.configuration.position[2:], zs, turned)
    kappa = nd.condition_number(result.best.geometry, twisted)
    assert curves.neutral[1][100] == pytest.approx(float(kappa), rel=1e-9)


def test_no_figures_without_an_optimum():
    """An interrupted run must end at once, and a study without a least value has no design to draw."""
    result = nd.optimize(STUDY, starts=4)
    for other in (replace(result, interrupted=True), replace(result, status=nd.Status.UNBOUNDED)):
        assert figures_of(other) is None


def test_curves_of_a_design_with_a_tool_pass_through_it():
    tool = nd.Tool((0.3, 0.2, -1.0), (0.1, 0.2, 0.3))
    best = nd.optimize(nd.Study(tool=tool, characteristic_length=1.5), starts=2).best
    curves = _curves(tool, ("it", best.geometry, best.configuration, best.condition_number, 1.5))
    assert curves.point[0] == pytest.approx(best.variables["zs"], rel=1e-12)
    at = [np.interp(curves.point[0], curves.zs, curves.along_zs)]
    at.append(np.interp(curves.point[1], curves.theta_z, curves.along_theta_z))
    assert at == pytest.approx([best.condition_number] * 2, rel=1e-3)


def test_the_ground_of_limits_ends_at_the_limits():
    """The optimum is on a limit: beside it, on one side of the marker, no design is shown as allowed."""
    region = {"box": [0.3, 0.3, 0.2], "tilt_deg": 8}
    limits = {"stroke_ratio": (None, 1.25), "base_cone": {"max_deg": 40, "axis": [0.0, 0.0, 1.0]}}
    result = nd.optimize(nd.Study("symmetric", constraints=limits, objective={"region": region}, starts=2))
    (curves,) = _over_poses(result)
    solved, best, edges = result.solved, result.variables, 0
    for own, places, name, violated in zip(
        curves.point[:2], (curves.zs, curves.theta_z), ("zs", ""), curves.violated, strict=True
    ):
        assert not violated[np.abs(places - own).argmin()]
        step = np.diff(places).max()
        for k in np.flatnonzero(np.diff(violated)):
            assert places[k + 1] - places[k] < 1e-6 * step
            edges += 1
            if name:
                least = [min(solved.evaluate(best | {name: z}).margins.values()) for z in places[k : k + 2]]
                assert sorted(margin < -1e-6 for margin in least) == [False, True]
    assert edges
