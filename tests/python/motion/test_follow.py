"""Motion along a trajectory, against numpy's finite differences and the legs' own definition."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd
from ninedof.motion.rotations import from_euler, from_quaternions, from_vectors, to_quaternions, vectors_between

HOME = nd.Configuration.neutral(3.9828, 2.4432)


def smooth(time, seed, reach=0.3, turn=0.25):
    """A random smooth path about the neutral pose: three waves for each coordinate."""
    rng = np.random.default_rng(seed)
    waves = rng.normal(size=(6, 3)), rng.uniform(0.0, 6.0, (6, 3))
    x = np.sum(waves[0] * np.sin(np.outer(time, [1.0, 2.0, 3.0])[:, None] + waves[1]), axis=2)
    x *= np.array([reach] * 3 + [turn] * 3) / 3.0
    return HOME.position + x[:, :3], Rotation.from_rotvec(x[:, 3:])


def uneven(n, seed, end=2.0):
    steps = np.random.default_rng(seed).uniform(0.7, 1.3, n - 1)
    return end * np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()


@pytest.mark.parametrize("rule", ["carried", "held", 0.4])
@pytest.mark.parametrize("seed", range(size(3, 60)))
def test_rates_are_those_of_the_lengths(published, rule, seed):
    time = uneven(2001, seed)
    result = nd.follow(published, nd.Trajectory(time, *smooth(time, seed)), HOME, rule)
    rates = np.gradient(result.leg_lengths, time, axis=0, edge_order=2)
    accelerations = np.gradient(rates, time, axis=0, edge_order=2)
    assert np.abs(result.leg_rates - rates).max() < 3e-5
    assert np.abs(result.leg_accelerations - accelerations)[5:-5].max() < 5e-3
    spline = CubicSpline(time, result.leg_lengths)
    assert np.abs(result.leg_rates - spline(time, 1))[5:-5].max() < 1e-6
    assert result.tracked
    assert result.tracking_error < 1e-9
    assert result.tracked_until == time[-1]


def test_angular_velocity_of_a_constant_spin(published):
    time, spin = np.linspace(0.0, 20.0, 2001), np.array([0.3, -0.5, 0.8])
    turning = Rotation.from_rotvec(np.outer(time, spin))
    result = nd.follow(published, nd.Trajectory(time, np.tile(HOME.position, (2001, 1)), turning), HOME)
    assert result.velocity[:, :3] == pytest.approx(np.tile(spin, (2001, 1)), abs=1e-10)
    assert np.abs(result.acceleration[:, :3]).max() < 1e-8


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


def test_a_limit_that_breaks_twice_has_two_stretches(published):
    time = np.linspace(0.0, 2.0, 201)
    z = HOME.position + np.outer(np.sin(2.0 * np.pi * time), [0.0, 0.0, 0.5])
    low = float(nd.leg_lengths(published, HOME)[0])
    result = nd.follow(published, nd.Trajectory(time, z), HOME, limits=([low] + [0.0] * 8, 99.0))
    assert [(b.limit, round(b.begin, 6), round(b.end, 6)) for b in result.breaks] == [
        ("l1 low", 0.5, 1.0),
        ("l1 low", 1.5, 2.0),
    ]


def test_a_singularity_on_the_way_is_reported(published):
    time = np.linspace(0.0, 1.0, 101)
    down = HOME.position - np.outer(time, [0.0, 0.0, 3.0])
    result = nd.follow(published, nd.Trajectory(time, down), HOME, "held")
    crossing = (3.9828 - 2.4432) / 3.0  # the platform reaches the height of O
    assert any(b.limit == "det C" and abs(b.begin - crossing) < 1e-2 for b in result.breaks)
    assert not result.tracked
    assert result.tracked_until < crossing
    assert result.tracking_error > 1e-3  # the mode of these lengths that track follows stays on its side


def test_forces_balance_the_load(published):
    line = nd.Trajectory.line(HOME, (0.3, 0.1, 0.2), points=21)
    result = nd.follow(published, line, HOME, load=([1.0, 2.0, -9.0], [0.1, 0.2, 0.3]))
    power = np.sum(result.leg_forces * result.leg_rates, axis=1) + result.velocity[:, 3:6] @ [1.0, 2.0, -9.0]
    assert np.abs(power).max() < 1e-10
    assert nd.follow(published, line, HOME).leg_forces is None


def test_shapes_start_where_they_should():
    spiral = nd.Trajectory.spiral(HOME, 0.5, 0.4, duration=3.0)
    assert (spiral.position[0] == HOME.position).all()
    assert spiral.position[-1] == pytest.approx([0.5, 0.0, 4.3828])
    assert not spiral.closed
    circle = nd.Trajectory.circle(HOME, 0.5, points=100)
    assert np.linalg.norm(circle.position - HOME.position, axis=1) == pytest.approx(0.5)


def test_the_best_o_is_interpolated_between_the_poses_searched(published):
    circle = nd.Trajectory.circle(HOME, 0.8, points=601)  # every third is searched, 201
    result = nd.follow(published, circle, HOME, "best")
    searched = nd.best_internal_path(published, circle.position[::3])
    assert result.condition_number[::3] == pytest.approx(searched.value, rel=1e-9)
    assert result.condition_number[0] == result.condition_number[-1]
    assert result.leg_accelerations[0] == pytest.approx(result.leg_accelerations[-1], abs=0.1)
