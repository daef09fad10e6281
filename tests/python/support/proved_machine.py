"""A machine and regions for proofs, and the numbers of poses and machines that they are held against."""

import numpy as np
import numpy_model as model
from region_poses import drawn
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.proof.machine import certify

VARIABLES = {
    "base_external_radius": 500.0,
    "base_internal_radius": 230.0,
    "base_internal_angle": 0.4,
    "platform_external_radius": 150.0,
    "platform_external_angle": 0.9,
    "platform_internal_radius": 90.0,
    "platform_internal_angle": -0.3,
    "zp": 360.0,
    "zs": 260.0,
}
LIMITS = {
    "leg_length": (100.0, 700.0),
    "base_cone": {"max_deg": 60.0},
    "platform_cone": {"max_deg": 60.0, "axis": (0.0, 0.3, -1.0)},
    "leg_clearance": {"min": 10.0},
    "stroke_ratio": (None, 1.7),
    "stroke": (None, 300.0),
    "leg_ratio": (None, 8.0),
    "radius_ratio": (None, 4.0),
    "footprint": (None, 510.0),
    "joint_spacing": (5.0, None),
}
REGIONS = {
    "box": nd.Region(box=(30.0, 40.0, 20.0), tilt=0.12),
    "ball": nd.Region(ball=25.0, internal_point="held"),
    "cylinder": nd.Region(cylinder=(0.1, 0.05), tilt=0.1, unit="zp"),
    "path": nd.Region(path=((0.0, 0.0, 0.0), (40.0, 0.0, 10.0), (40.0, -40.0, 10.0)), yaw=0.2),
}


def study(region, **changes):
    return nd.Study(
        family="symmetric",
        variables={name: (value, value) for name, value in VARIABLES.items()},
        constraints=LIMITS | changes,
        characteristic_length=150.0,
        objective=nd.Objective(region=region),
    )


def proved(region, constraints=None, **options):
    asked = study(region, **(constraints or {}))
    problem = asked.problem()
    geometry = problem.geometry(list(VARIABLES.values()))
    neutral = nd.Configuration.neutral([VARIABLES["zp"]], [VARIABLES["zs"]])
    return geometry, neutral, certify(asked, geometry, neutral, 150.0, **options)


def sampled(region, geometry, neutral, rng, count):
    """Poses of a region, drawn from its definition; a good part on its boundary."""
    shift, tilt, yaw = drawn(region, VARIABLES["zp"], rng, count)
    yaw = np.column_stack([np.zeros((count, 2)), yaw])
    turn = Rotation.from_rotvec(tilt) * Rotation.from_rotvec(yaw)
    q = (turn * Rotation.from_matrix(neutral.rotation[0])).as_matrix()
    s = neutral.internal_point + (0.0 if region.internal_point == "held" else shift)
    s = np.broadcast_to(s, shift.shape)
    return model.robot(geometry, nd.Configuration(neutral.position + shift, q, s))


def apart(m, rng):
    """Distances of random points of the external legs from random points of all others."""
    v = np.concatenate(model.legs(m)[:3], axis=-2)
    s = np.broadcast_to(m.s[:, None, :], (len(v), 3, 3))
    ends = np.concatenate([np.broadcast_to(m.r, s.shape) + v[:, :3], s, s], axis=1)
    t = np.clip(1.4 * rng.random((len(v), 9, 1)) - 0.2, 0.0, 1.0)
    at = ends - t * v
    gaps = np.linalg.norm(at[:, :3, None] - at[:, None], axis=-1)
    gaps[:, range(3), range(3)] = np.inf
    return gaps


def at_pose(met, geometry, neutral):
    turn = Rotation.from_rotvec(met.tilt) * Rotation.from_rotvec((0.0, 0.0, met.yaw))
    shift = np.array(met.shift)
    q = (turn * Rotation.from_matrix(neutral.rotation[0])).as_matrix()
    return model.robot(geometry, nd.Configuration(neutral.position[0] + shift, q, neutral.internal_point[0] + shift))
