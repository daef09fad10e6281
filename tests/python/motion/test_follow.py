"""Motion along a trajectory, against numpy's finite differences and the legs' own definition."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.motion.rotations import from_euler, from_quaternions, from_vectors, to_quaternions, vectors_between

HOME = nd.Configuration.neutral(3.9828, 2.4432)


def test_rotations_agree_with_scipy():
    rng = np.random.default_rng(2)
    r = Rotation.random(200, random_state=3)
    q = to_quaternions(r.as_matrix())
    assert from_quaternions(q) == pytest.approx(r.as_matrix(), abs=1e-14)
    assert (np.sum(q[1:] * q[:-1], axis=1) >= 0.0).all()
    assert from_vectors(r.as_rotvec()) == pytest.approx(r.as_matrix(), abs=1e-14)
    a = rng.uniform(-1.5, 1.5, (200, 3))
    assert from_euler(*a.T) == pytest.approx(Rotation.from_euler("ZYX", a).as_matrix(), abs=1e-14)
    between = vectors_between(q[:-1], q[1:])
    assert between == pytest.approx((r[1:] * r[:-1].inv()).as_rotvec(), abs=1e-12)


def test_the_best_path_on_a_circle_closes(published):
    circle = nd.Trajectory.circle(HOME, 0.8, points=41)
    result = nd.follow(published, circle, HOME, "best")
    assert circle.closed
    assert result.condition_number[0] == result.condition_number[-1]
    assert (result.configurations.internal_point[0] == result.configurations.internal_point[-1]).all()
    assert result.leg_rates[0] == pytest.approx(result.leg_rates[-1], abs=2e-3)
    carried = nd.follow(published, circle, HOME)
    assert result.condition_number.max() < carried.condition_number.max()
    assert result.tracking_error < 1e-9
    assert result.idle_legs == ()


def test_idle_legs_are_named(published):
    line = nd.Trajectory.line(HOME, (0.3, 0.1, 0.2), points=21)
    assert nd.follow(published, line, HOME, "held").idle_legs == ("r1", "r2", "r3")
    assert nd.follow(published, line, HOME, "carried").idle_legs == ("q1", "q2", "q3")
    assert nd.follow(published, line, HOME, 0.5).idle_legs == ()


def test_limits_break_when_the_length_passes_them(published):
    line = nd.Trajectory.line(HOME, (0.0, 0.0, 1.0), duration=4.0, points=401)
    lengths = nd.follow(published, line, HOME).leg_lengths[:, 0]
    high = float(np.interp(1.2345, line.time, lengths))
    result = nd.follow(published, line, HOME, limits=(0.0, [high] * 3 + [9.0] * 6))
    assert [b.limit for b in result.breaks] == ["l1 high", "l2 high", "l3 high"]
    for stretch in result.breaks:
        assert stretch.begin == pytest.approx(1.2345, abs=1e-9)
        assert stretch.end == 4.0
        assert stretch.worst == pytest.approx(lengths[-1])
        assert stretch.at == 4.0
    assert result.leg_margins.min() == pytest.approx(1.0 - lengths[-1] / high)


def test_shapes_start_where_they_should():
    spiral = nd.Trajectory.spiral(HOME, 0.5, 0.4, duration=3.0)
    assert (spiral.position[0] == HOME.position).all()
    assert spiral.position[-1] == pytest.approx([0.5, 0.0, 4.3828])
    assert not spiral.closed
    circle = nd.Trajectory.circle(HOME, 0.5, points=100)
    assert np.linalg.norm(circle.position - HOME.position, axis=1) == pytest.approx(0.5)
