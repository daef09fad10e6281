"""The workspaces of a study that has every limit of the table at once."""

import pytest

import ninedof as nd
from ninedof.design.limits import ROWS
from ninedof.workspace.study_question import design_question

LOOSE = {"radius_ratio": 100.0, "leg_ratio": 100.0, "zs_fraction": 0.99, "fault_tolerant": 1e3, "stroke_ratio": 100.0}
PLATES = {"base_external_radius": 2.0, "base_internal_radius": 1.8, "platform_external_radius": 0.9}
DUTY = {"loads": {"wrenches": [[0, 0, 0, 0, 0, -1.0]]}, "speeds": {"linear": 1.0, "angular": 1.0}}
BOX = ([-0.6, -0.6, 2.2], [0.6, 0.6, 3.0])


def of(limits):
    variables = PLATES | {"platform_internal_radius": 0.8, "zp": 2.5, "zs": 1.2, "platform_internal_angle": 0.3}
    variables |= {"base_internal_angle": 0.7, "platform_external_angle": 0.9}
    return nd.optimize(
        nd.Study(family="symmetric", variables=variables, constraints=limits, characteristic_length=1, **DUTY)
    )


def limit_of(row):
    if "max" in row.sides:
        return {"max": 3.0 if row.is_angle else LOOSE.get(row.name, 1e3)}
    return {} if row.kind == "sign" else {"min": 1e-3}


def proved(run):
    """The proof that `ninedof workspace RUN --certify` makes."""
    question, _ = design_question(run)
    return nd.certified_workspace(run.geometry, **(question | {"box": BOX}), gap=0.3)


def test_all_limits_at_once_leave_what_the_sharp_one_leaves():
    every = {name: limit_of(row) for name, row in ROWS.items()} | {"external_length": {"max": 3.1}}
    sharp = {name: every[name] for name in ("external_length", "leg_clearance", "singularity_free")}
    both = [nd.workspace(of(limits), BOX, tolerance=0.03, resolution=8, points=2000) for limits in (every, sharp)]
    assert both[0].volume == pytest.approx(both[1].volume, rel=1e-9)
    assert 0.1 < both[0].volume < 0.9  # of the box of 1.152
    # Bounds of forces over boxes take long. Without them there still are more than 64 numbers with a limit.
    soon = {name: limit for name, limit in every.items() if not ROWS[name].needs and name != "fault_tolerant"}
    bounds = [proved(of(limits)).bounds for limits in (soon, sharp)]
    assert bounds[0] == pytest.approx(bounds[1], rel=1e-9)
    assert 0.0 < bounds[0][0] < both[0].volume < bounds[0][1]
