"""Designs that the tests of exports write: a machine in millimetres, and twelve joints in general position."""

import functools

import numpy as np
import numpy_model as model
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

LEGS = [f"{kind}{i}" for kind in "lqr" for i in (1, 2, 3)]


@functools.cache
def machine():
    """An optimum over the corners of a box, O shifted with the platform's origin; lengths in millimetres."""
    study = nd.Study(
        variables={"a1": 60.0, "a2": 500.0, "b1": 250.0, "b2": 30.0, "zp": 400.0, "zs": (100.0, 300.0)},
        objective={"poses": nd.poses.box(half=(40.0, 40.0, 40.0), tilt_deg=(5, 5, 0), internal_point="shifted")},
        characteristic_length=150.0,
        unit="mm",
    )
    return nd.optimize(study, starts=1)


@functools.cache
def general():
    """Twelve joints in general position, any rotation of the platform, no unit, no study: the best of 100."""
    robots = model.random_robots(np.random.default_rng(3), 100)
    m = robots.at(int(np.argmin(model.condition_number(robots))))
    return nd.Design(m.geometry(), m.configuration(), "optimal")


def path(design, radius):
    """Poses around a circle, with tilts, O carried with the platform."""
    c = design.configuration
    count = size(2, 6)
    t = 0.7 + 2.0 * np.pi * np.arange(count) / count
    shift = radius * np.stack([np.cos(t), np.sin(t), 0.5 * np.sin(2.0 * t)], axis=-1)
    turn = Rotation.from_rotvec(0.06 * np.stack([np.sin(t), np.cos(t), 0.0 * t], axis=-1)).as_matrix()
    arm = turn @ (c.internal_point - c.position)
    return nd.Configuration(c.position + shift, turn @ c.rotation, c.position + shift + arm)
