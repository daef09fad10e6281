"""Internal points along a path of the platform."""

import numpy as np
import pytest

import ninedof as nd


def loop(n=61):
    t = np.linspace(0.0, 2.0 * np.pi, n)
    return np.stack([1.2 * np.sin(t), 0.8 * np.cos(t), 4.0 + 0.05 * t], axis=-1)


def cost(path, p, smoothness, size):
    s = path.configuration.internal_point
    return np.log(path.value).mean() + smoothness * (len(p) - 1) * np.sum(np.diff(s, axis=0) ** 2) / size**2


@pytest.mark.slow
def test_a_path_is_optimal_for_its_smoothness(published):
    p = loop()
    weights = (1e-3, 0.05, 1.0)
    paths = [nd.best_internal_path(published, p, smoothness=w) for w in weights]
    # The robot's size: the farthest joint from the middle of all twelve, at the first pose.
    on_base = [published.base_external, published.base_internal]
    on_platform = [p[0] + published.platform_external, p[0] + published.platform_internal]
    joints = np.concatenate(on_base + on_platform)
    size = np.linalg.norm(joints - joints.mean(axis=0), axis=1).max()
    for w, path in zip(weights, paths, strict=True):
        assert set(path.status) == {"found"}
        for other in paths:
            assert cost(path, p, w, size) <= cost(other, p, w, size) + 1e-6
    longest = [np.linalg.norm(np.diff(x.configuration.internal_point, axis=0), axis=1).sum() for x in paths]
    assert longest[0] > longest[1] > longest[2]


def test_poses_without_a_point_divide_the_path(published):
    p = loop(21)
    p[8] = np.nan
    p[12, 2] = 40.0
    path = nd.best_internal_path(published, p, limits=(0.0, 9.0))
    assert path.status[8] == "missing"
    assert path.status[12] == "infeasible"
    assert "l1 high" in path.active[12]
    assert sum(path.status == "found") == 19


def test_after_a_gap_o_may_be_in_another_chamber(published):
    heights = [4.0, 3.9, 3.8, np.nan, -3.8, -3.9]
    path = nd.best_internal_path(published, [[0.1, 0.0, z] for z in heights])
    assert [str(s) for s in path.status] == ["found"] * 3 + ["missing"] + ["found"] * 2
    assert path.configuration.internal_point[0, 2] > 0.0 > path.configuration.internal_point[-1, 2]


def test_limits_on_a_path(published):
    p = loop(31)
    free = nd.best_internal_path(published, p)
    high = np.full(9, np.inf)
    high[6:] = np.quantile(nd.leg_lengths(published, free.configuration)[:, 6:], 0.9)
    path = nd.best_internal_path(published, p, limits=(0.0, high))
    assert (nd.leg_lengths(published, path.configuration) <= high * (1.0 + 1e-9)).all()
    assert any(path.active)
