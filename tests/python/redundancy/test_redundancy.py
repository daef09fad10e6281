"""The best internal point of a pose, compared with a search of the whole neighbourhood in plain numpy."""

import numpy as np
import numpy_model
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

CRITERIA = ("condition_number", "singularity", "leg_centring")
LIMITS = (1.0, 6.0)


def random_case(rng, hexagonal):
    if hexagonal:
        g = nd.Geometry.hexagonal(*rng.uniform(0.3, 3.0, size=4))
    else:
        g = numpy_model.random_robots(rng, 1).at(0).geometry()
    p = np.array([0.0, 0.0, 3.5]) + 0.4 * rng.normal(size=3)
    return g, p, Rotation.from_rotvec(0.2 * rng.normal(size=3)).as_matrix()


def test_leg_centring_keeps_the_clearance_and_names_it(published):
    best = nd.best_internal_point(published, [0.0, 0.0, 4.0], criterion="leg_centring", limits=(1.0, 8.0))
    assert best.status == "found"
    assert "det B" in best.active
    assert abs(np.linalg.det(nd.velocity_matrices(published, best.configuration).B)) > 0.009


def test_limits_hold_and_are_named(published):
    free = nd.best_internal_point(published, [0.5, 0.0, 3.98])
    lengths = nd.leg_lengths(published, free.configuration)
    high = np.full(9, np.inf)
    high[3] = lengths[3] - 0.05
    bound = nd.best_internal_point(published, [0.5, 0.0, 3.98], limits=(0.0, high))
    assert bound.status == "found"
    assert bound.active == ("q1 high",)
    assert bound.value > free.value
    assert_allclose(nd.leg_lengths(published, bound.configuration)[3], high[3], rtol=1e-7)


def test_more_valleys_than_are_examined_are_said():
    """Far off to the side of a robot in general position, condition numbers of 50: many shallow valleys."""
    rng = np.random.default_rng(5)
    for _ in range(28):
        g = numpy_model.random_robots(rng, 1).at(0).geometry()
        q = Rotation.from_rotvec(0.3 * rng.normal(size=3)).as_matrix()
        z = rng.uniform(2.0, 5.0)
    p = np.array([[-1.0, -0.2, z], [1.0, 0.4, z], [0.0, 0.0, z]])
    best = nd.best_internal_point(g, p, q)
    assert best.status[0] == "local"
    assert best.status[2] == "found"
    assert np.isfinite(best.configuration.internal_point).all()
    line = nd.best_internal_map(g, p, q)
    assert (line.value <= best.value * (1.0 + 1e-6)).all()


@pytest.mark.parametrize("criterion", CRITERIA)
def test_scale_stacks_and_threads(published, criterion):
    rng = np.random.default_rng(8)
    p = np.array([0.0, 0.0, 3.98]) + 0.3 * rng.uniform(-1.0, 1.0, size=(2, 3, 3))
    p[1, 2] = np.nan
    one, two = (nd.best_internal_point(published, p, criterion=criterion, limits=LIMITS, threads=n) for n in (1, 2))
    assert one.value.shape == one.status.shape == one.active.shape == (2, 3)
    assert one.status[1, 2] == "missing"
    assert_array_equal(one.configuration.internal_point, two.configuration.internal_point)
    alone = nd.best_internal_point(published, p[0, 1], criterion=criterion, limits=LIMITS)
    assert_array_equal(alone.configuration.internal_point, one.configuration.internal_point[0, 1])
    for unit in (1e-3, 1e3):
        big = nd.Geometry.hexagonal(a1=0.0, a2=5.8124 * unit, b1=2.9062 * unit, b2=0.0)
        there = nd.best_internal_point(
            big,
            unit * p[0, 1],
            criterion=criterion,
            limits=(LIMITS[0] * unit, LIMITS[1] * unit),
            characteristic_length=unit,
        )
        assert_allclose(there.value, alone.value, rtol=1e-7)


# --- Found on random robots -------------------------------------------------------------------------------------------


def test_the_singularity_value_is_the_least_margin():
    """One definition of the determinants in the criterion and in the report; O keeps off the external joints."""
    rng, compared = np.random.default_rng(9), 0
    for k in range(size(30, 300)):
        g, p, q = random_case(rng, k % 2 == 0)
        best = nd.best_internal_point(g, p, q, criterion="singularity")
        if best.status != "found":
            assert set(best.active) <= {f"{leg} low" for leg in ("q1", "q2", "q3", "r1", "r2", "r3")}
            continue
        compared += 1
        margins = nd.singularity_margins(g, best.configuration)
        assert_allclose(best.value, np.min(np.abs(margins)), rtol=1e-12)
        external = np.concatenate([g.base_external, p + g.platform_external @ q.T])
        joints = np.concatenate([external, g.base_internal, p + g.platform_internal @ q.T])
        away = np.linalg.norm(external - best.configuration.internal_point, axis=1).min()
        robot = np.linalg.norm(joints - joints.mean(axis=0), axis=1).max()
        assert away > 0.05 * robot * (1.0 - 1e-6)
    assert compared >= size(25, 250)


def test_a_maximum_just_beside_a_joint_is_found():
    """It was passed on the way into the joint, and the answer was "unbounded", without a point."""
    g = nd.Geometry(
        [[0.395, 2.326, -0.586], [-0.277, -2.117, -0.483], [1.063, -0.293, 0.008]],
        [[-0.036, 1.268, -0.04], [-0.216, -0.898, -0.587], [-0.323, -1.422, -0.522]],
        [[-1.497, 1.078, 0.003], [-1.192, -1.017, 0.275], [-0.324, -1.502, 0.013]],
        [[0.349, 0.731, 0.316], [-0.094, -1.023, 0.619], [1.4, -0.605, -0.094]],
    )
    p, q = np.array([0.664, 0.616, 2.274]), Rotation.from_rotvec([-0.219, 0.219, -0.11]).as_matrix()
    best = nd.best_internal_point(g, p, q, criterion="singularity")
    assert best.status == "found"
    s, joint = best.configuration.internal_point, g.base_internal[1]
    directions = np.random.default_rng(0).normal(size=(20_000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    sides = np.sign(nd.singularity_margins(g, best.configuration))
    for middle, radius in ((joint, 1e-6), (s, 0.02), (s, 1e-4)):
        around = nd.Configuration(p, q, middle + radius * directions)
        margins = np.stack(nd.singularity_margins(g, around), axis=-1)
        inside = (np.sign(margins) == sides).all(axis=-1)
        assert inside.any()
        assert np.abs(margins[inside]).min(axis=-1).max() < best.value


def test_a_start_within_the_clearance_is_not_singular(published):
    p, middle = np.array([0.3, 0.2, 3.9]), nd.best_internal_point(published, [0.3, 0.2, 3.9])
    free = nd.best_internal_point(published, p, criterion="leg_centring", limits=LIMITS)
    for height in (1e-3, 1e-6):  # of O over the lower plane
        s = middle.configuration.internal_point * [1.0, 1.0, 0.0] + [0.0, 0.0, height]
        assert 0.0 < abs(nd.singularity_margins(published, nd.Configuration(p, None, s))[1]) < 0.01
        best = nd.best_internal_point(published, p, criterion="leg_centring", limits=LIMITS, start=s)
        assert best.status == "found"
        assert_allclose(best.value, free.value, rtol=1e-6)


def test_no_point_of_a_grid_is_better_with_limits():
    """Grids of the box of the limits; points that a straight line from O reaches without a singularity."""
    rng = np.random.default_rng(12)
    compared = 0
    for k in range(size(30, 600)):
        g, p, q = random_case(rng, k % 4 == 0)
        middle = nd.leg_lengths(g, nd.Configuration(p, q, 0.5 * p))
        low, high = np.zeros(9), np.full(9, np.inf)
        low[3:], high[3:] = 0.3 * middle[3:].min(), 1.7 * middle[3:].max()
        best = nd.best_internal_point(g, p, q, criterion="leg_centring", limits=(low, high))
        if best.status != "found":
            continue
        o = best.configuration.internal_point
        s = o + rng.uniform(-1.0, 1.0, size=(20000, 3)) * rng.choice([0.3, 1.0, 3.0], size=(20000, 1))
        c = nd.Configuration(p, q, s)
        lengths = nd.leg_lengths(g, c)[:, 3:]
        value = np.sum(((lengths - 0.5 * (low[3:] + high[3:])) / (0.5 * (high[3:] - low[3:]))) ** 2, axis=-1)
        value[(lengths < low[3:]).any(axis=1) | (lengths > high[3:]).any(axis=1)] = np.inf
        margins = np.stack(nd.singularity_margins(g, c), axis=-1)
        sides = np.sign(np.stack(nd.singularity_margins(g, best.configuration), axis=-1))
        value[(sides * margins <= 0.01).any(axis=1)] = np.inf
        for j in np.argsort(value)[:20]:
            if value[j] >= best.value * (1.0 - 1e-6):
                break
            way = o + np.linspace(0.0, 1.0, 400)[:, None] * (s[j] - o)
            assert not (
                np.sign(np.stack(nd.singularity_margins(g, nd.Configuration(p, q, way)), axis=-1)) == sides
            ).all()
        compared += 1
    assert compared > size(15, 300)


def test_a_symmetric_machine_does_not_flicker_along_z():
    """At its lower internal joints the condition number is below the minimum on the axis, in a few directions only."""

    def orbit(radius, angle):
        around = angle + np.arange(3) * 2.0 * np.pi / 3.0
        return np.stack([radius * np.cos(around), radius * np.sin(around), np.zeros(3)], axis=1)

    g = nd.Geometry(
        base_external=orbit(2.665658961190107, np.pi / 3.0),
        base_internal=orbit(0.5091945701359243, 0.0),
        platform_external=orbit(0.347009814847422, 1.2308666508204802),
        platform_internal=orbit(3.0964985258001736, 2.6155275162807006),
    )
    z = np.linspace(0.8, 1.7, 41)
    result = nd.best_internal_point(g, z[:, None] * [0.0, 0.0, 1.0], characteristic_length=7.747692520080963)
    lost = np.asarray(result.status) == "unbounded"
    assert lost.any()
    assert not lost.all()
    assert np.count_nonzero(lost[1:] != lost[:-1]) <= 2
