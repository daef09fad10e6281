"""Leg speeds, accelerations, weight and nearest singularity of a sheet, against differences and random directions."""

import numpy as np
import pytest
from robots import robots_at_poses
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd
from ninedof import _core
from ninedof.sheet.request import Motion, question_of


def moved(c, internal, twist, rate, t):
    """The pose at a small time: constant angular acceleration to second order, O by its rule."""
    turn = Rotation.from_rotvec(twist[:3] * t + 0.5 * rate[:3] * t * t).as_matrix()
    shift = twist[3:] * t + 0.5 * rate[3:] * t * t
    arm = c.internal_point - c.position
    s = {"held": c.internal_point, "shifted": c.internal_point + shift, "carried": c.position + shift + turn @ arm}
    return nd.Configuration(c.position + shift, turn @ c.rotation, s[internal])


@pytest.mark.parametrize("seed", range(size(3, 50)))
@pytest.mark.parametrize("internal", ["held", "shifted", "carried"])
def test_a_given_twist_against_differences_of_lengths(seed, internal):
    g, c, rng = robots_at_poses(seed, poses=3)
    twist, rate = rng.normal(size=(2, 6))
    found = nd.sheet(g, c, internal=internal, twist=twist, twist_rate=rate)
    h = 1e-4
    around = [[nd.leg_lengths(g, moved(c[k], internal, twist, rate, t)) for t in (-h, 0.0, h)] for k in range(3)]
    before, now, after = np.moveaxis(around, 1, 0)
    speed, acceleration = (after - before) / (2.0 * h), (after - 2.0 * now + before) / h**2
    for k, leg in enumerate(found.legs):
        assert leg.twist_speed == pytest.approx((speed[:, k].min(), speed[:, k].max()), abs=1e-6)
        assert leg.twist_acceleration == pytest.approx((acceleration[:, k].min(), acceleration[:, k].max()), abs=2e-6)
    assert found.to_dict()["legs"][0]["twist_speed_max"] == found.legs[0].twist_speed[1]


@pytest.mark.parametrize("internal", ["least", "held", "shifted", "carried"])
@pytest.mark.parametrize("seed", range(size(2, 30)))
def test_no_direction_accelerates_a_leg_more(seed, internal):
    g, c, rng = robots_at_poses(seed, poses=1)
    both = nd.sheet(g, c, internal=internal, linear_speed=1.3, angular_speed=0.7)
    still = nd.sheet(g, c, internal=internal, linear_speed=1.3)
    ways = rng.normal(size=(400, 2, 3))
    ways /= np.linalg.norm(ways, axis=-1, keepdims=True)
    worst = np.zeros((2, 9))
    for turn, shift in ways:
        for k, w in enumerate((0.7, 0.0)):
            motion = Motion(1.0, 0.0, internal, (*(w * turn).tolist(), *(1.3 * shift).tolist()))
            question = question_of(g, c[0], nd.Study(), motion)
            worst[k] = np.maximum(worst[k], np.abs(_core.sheet_numbers(question, c)["twist_acceleration"][0]))
    assert (worst[0] <= np.array([leg.acceleration for leg in both.legs]) + 1e-9).all()
    exact = np.array([leg.acceleration for leg in still.legs])
    assert (worst[1] <= exact + 1e-9).all()
    assert (worst[1] >= 0.9 * exact - 1e-9).all()  # 400 directions come near the largest
    assert np.array([leg.acceleration for leg in nd.sheet(g, c, linear_speed=0.0).legs]).max() == 0.0


@pytest.mark.parametrize("seed", range(size(4, 50)))
def test_the_weight_does_the_work_of_its_centre(seed):
    """Virtual work by differences: the legs' forces and the fall of the centre of mass, O moving by itself."""
    g, c, rng = robots_at_poses(seed, poses=2)
    mass, centre, gravity = 3.0, rng.normal(size=3), rng.normal(size=3)
    found = nd.sheet(g, c, mass=mass, centre=centre, gravity=gravity)
    loaded = nd.sheet(g, c, loads=[[0, 0, 0, 1, 0, 0]] * 2, mass=mass, centre=centre, gravity=gravity)
    alone = nd.sheet(g, c, loads=[0, 0, 0, 1, 0, 0])
    assert len(found.legs[0].forces) == 1
    for k in range(2):
        forces = np.array(
            [leg.forces[0] for leg in nd.sheet(g, c[k : k + 1], mass=mass, centre=centre, gravity=gravity).legs]
        )[:, 0]
        assert all(
            leg.forces[0][0] <= f + 1e-12 and f <= leg.forces[0][1] + 1e-12
            for leg, f in zip(found.legs, forces, strict=True)
        )
        for way in np.eye(9):
            ends = [c[k].moved(x * 1e-5 * way) for x in (-1.0, 1.0)]
            fall = [mass * gravity @ (e.position + e.rotation @ centre) for e in ends]
            work = forces @ (nd.leg_lengths(g, ends[1]) - nd.leg_lengths(g, ends[0])) + fall[1] - fall[0]
            assert abs(work) < 1e-7 * 2e-5 * (1.0 + np.abs(forces).max()) * 100
    ends = nd.leg_forces(g, c, [0, 0, 0], [1, 0, 0]).forces
    at_poses = (
        np.array(
            [
                [leg.forces[0] for leg in nd.sheet(g, c[k : k + 1], mass=mass, centre=centre, gravity=gravity).legs]
                for k in range(2)
            ]
        )[..., 0]
        + ends
    )
    for k, leg in enumerate(loaded.legs):
        assert leg.forces[1] == leg.forces[0] == pytest.approx((at_poses[:, k].min(), at_poses[:, k].max()), abs=1e-9)
    assert alone.weight is None
    assert nd.sheet(g, c, mass=mass).weight.gravity == (0.0, 0.0, -9.81)
