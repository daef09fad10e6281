"""Studies at singular designs and poses: an infinite objective, and margins that stay meaningful."""

import math

import numpy as np
import pytest
from design_oracle import is_angle

import ninedof as nd

WIDE = {
    "radius_ratio": {"max": 2.0},
    "leg_ratio": {"max": 3.0},
    "leg_clearance": {"min": 0.1},
    "singularity_free": {},
    "base_cone": {"max_deg": 50.0},
}
SINGULAR = {
    "similar hexagons": (1.0, 2.0, 0.5, 1.0, 3.0, 1.0, 0.0),
    "regular hexagons": (1.0, 1.0, 0.5, 0.5, 3.0, 1.0, 0.0),
    "O in the base": (0.0, 2.0, 1.0, 0.0, 3.0, 0.0, 0.0),
    "O in the platform": (0.0, 2.0, 1.0, 0.0, 3.0, 3.0, 0.0),
    "plates in one another": (0.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0),
    "legs of no length": (1.0, 2.0, 1.0, 2.0, 0.0, 0.0, 0.0),
}


def singular_study(values, objective):
    names = ("a1", "a2", "b1", "b2", "zp", "zs", "theta_z")
    variables = {n: [-7.0, 7.0] if is_angle(n) else [0.0, 9.0] for n in names}
    data = {"design": {"family": "hexagonal"}, "variables": variables, "constraints": WIDE, "objective": objective}
    return nd.Study.from_dict(data), dict(zip(names, values, strict=True))


@pytest.mark.parametrize("index", ["condition_number", "frobenius"])
@pytest.mark.parametrize("values", SINGULAR.values(), ids=SINGULAR.keys())
def test_a_singular_design_is_infinite(values, index):
    study, design = singular_study(values, {"index": index})
    point = study.evaluate(design)
    assert point.objective == point.condition_number == math.inf
    assert np.isnan(list(point.gradient.values())).all()
    assert not np.isnan(list(point.margins.values())).any()
    assert point.margins["singularity_free"] < 0.0


def test_speed_is_finite_where_the_platform_is_singular():
    """1/sigma_min(J') stays finite where J' has an infinite singular value: hence the bound on the condition number."""
    study, design = singular_study(SINGULAR["O in the platform"], {"index": "speed"})
    point = study.evaluate(design)
    assert point.condition_number == math.inf
    assert not math.isnan(point.objective)


@pytest.mark.parametrize("aggregate", ["worst", "weighted"])
def test_one_singular_pose_makes_the_worst_infinite(aggregate):
    """O carried down into the base by one of the poses."""
    poses = [{}, {"internal_point": [0.0, 0.0, -1.0]}, {"position": [0.1, 0.0, 0.0]}]
    study, design = singular_study((0.0, 2.0, 1.0, 0.0, 3.0, 1.0, 0.0), {"aggregate": aggregate, "poses": poses})
    point = study.evaluate(design)
    assert point.objective == math.inf
    assert [math.isinf(kappa) for kappa in point.conditions] == [False, True, False]
    assert point.condition_number == math.inf
    assert math.isfinite(point.neutral_condition_number)
    assert point.margins["singularity_free"] < 0.0


def test_the_mean_of_the_inverse_stays_finite_with_one_singular_pose():
    """1 / infinity is 0: the other poses still count."""
    poses = [{}, {"internal_point": [0.0, 0.0, -1.0]}]
    design = (0.0, 2.0, 1.0, 0.0, 3.0, 1.0, 0.0)
    study, values = singular_study(design, {"aggregate": "mean_inverse", "poses": poses})
    point = study.evaluate(values)
    assert point.objective == pytest.approx(2.0 * point.neutral_condition_number, rel=1e-12)
    assert point.conditions[1] == math.inf
