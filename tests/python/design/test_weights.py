"""Weights of poses in a mean.

Oracle: the definition, from the condition numbers of the poses.
"""

import dataclasses

import numpy as np
import pytest

import ninedof as nd

VALUES = {"a1": 0.2, "a2": 5.0, "b1": 2.5, "b2": 0.3, "zp": 4.0, "zs": 2.0, "theta_z": 0.0}
PLACES = [(0.1, 0.0, 0.0), (0.3, 0.2, 0.1), (-0.2, 0.4, 0.0), (0.0, 0.0, 0.6)]


def study(weights, aggregate="mean_inverse", **options):
    poses = [nd.Pose(p, weight=w) for p, w in zip(PLACES, weights, strict=True)]
    return nd.Study(objective=nd.Objective(aggregate=aggregate, poses=poses, **options))


@pytest.mark.parametrize("weights", [(1, 1, 1, 1), (0.5, 0, 2, 1), (0, 0, 3, 0)])
def test_a_mean_by_its_definition(weights):
    point = study(weights).evaluate(VALUES)
    kappa = np.array(point.conditions)
    mean = sum(weights) / np.sum(weights / kappa)
    assert point.objective == pytest.approx(mean, rel=1e-13)
    both = study(weights, "weighted", weight=0.3).evaluate(VALUES)
    assert both.objective == pytest.approx(kappa.max() ** 0.3 * mean**0.7, rel=1e-13)
    assert study(weights, "worst").evaluate(VALUES).objective == pytest.approx(kappa.max(), rel=1e-13)


@pytest.mark.parametrize("aggregate", ["mean_inverse", "weighted"])
def test_gradients_with_weights(aggregate):
    chosen = study((0.5, 0, 2, 1), aggregate)
    problem = chosen.problem()
    x = np.array([VALUES[name] for name in problem.names])
    gradient = problem.evaluate(x).gradient
    for k in range(len(x)):
        step = 1e-5 * np.eye(len(x))[k]
        ahead, behind = (problem.evaluate(x + s * step).log_objective for s in (1.0, -1.0))
        assert gradient[k] == pytest.approx((ahead - behind) / 2e-5, rel=1e-6, abs=1e-8)


def test_poses_without_weight_hold_limits():
    """The optimum of a mean over one pose, with limits at four."""
    weights = (1.0, 0.0, 0.0, 0.0)
    limited = dataclasses.replace(study(weights), constraints={"radius_ratio": (None, 2), "leg_ratio": (None, 1.6)})
    result = nd.optimize(limited, starts=4)
    assert result.objective == pytest.approx(result.conditions[0], rel=1e-12)
    lengths = nd.leg_lengths(result.geometry, result.configurations[1:])
    assert lengths.max() / lengths.min() == pytest.approx(1.6, rel=1e-8)
    assert nd.check(result, perturbations=200).passed


def test_a_mean_needs_a_weight():
    pose = nd.Pose((0.1, 0, 0), weight=0.25)
    assert nd.Pose.from_dict(pose.to_dict()) == pose != nd.Pose((0.1, 0, 0))
    with pytest.raises(ValueError, match="no weight above 0"):
        study((0, 0, 0, 0))
