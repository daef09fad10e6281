"""Robots for tests of statics, accuracy and ellipsoids: regular ones, and singular ones of each kind.

H is put together from numpy_model, which shares only the paper with the package.
"""

import numpy as np
import numpy_model as model
from scipy.spatial.transform import Rotation

import ninedof as nd

SINGULAR = ("lower plane", "upper plane", "leg through O")
"""det B = 0, det C = 0, det N = 0."""
NONPLANAR = {
    "base_external_radius": (2.0, 6.0),
    "base_internal_radius": (1.0, 5.0),
    "base_internal_angle": 0.9,
    "platform_external_radius": (1.0, 4.0),
    "platform_external_angle": 0.5,
    "platform_internal_radius": 2.0,
    "platform_internal_angle": -0.4,
    "zp": (3.0, 7.0),
    "zs": 2.6,
    "base_external_height": 0.1,
    "base_internal_height": (-0.5, 0.5),
    "platform_external_height": 0.0,
    "platform_internal_height": 0.2,
}
"""Variables of a study of the family "symmetric_nonplanar", some of them free."""


def regular(seed):
    """One general robot, the best conditioned of eight, as numpy model; and the generator that drew it."""
    rng = np.random.default_rng(seed)
    robots = model.random_robots(rng, 8)
    return robots.at(int(np.argmin(model.condition_number(robots)))), rng


def singular(kind, seed):
    """A general robot with O where the configuration is singular."""
    m, rng = regular(seed)
    a, b = rng.uniform(0.2, 0.5, size=2)

    def in_plane(t):
        return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0])

    if kind == "lower plane":
        return m._replace(s=in_plane(m.rh)), rng
    if kind == "upper plane":
        return m._replace(s=m.p + m.Q @ in_plane(m.ut)), rng
    foot, head = m.r[1], m.p + m.Q @ m.u[1]
    return m._replace(s=foot + (0.3 + a) * (head - foot)), rng


def flat(kind):
    """The same kinds on flat hexagons, singular to the last bit."""
    g = nd.Geometry.hexagonal(a1=0.5, a2=4.0, b1=2.5, b2=0.25)
    s = {"lower plane": [0.25, 0.5, 0.0], "upper plane": [0.25, 0.5, 3.0]}
    if kind in s:
        return model.robot(g, nd.Configuration([0.125, -0.25, 3.0], np.eye(3), s[kind]))
    base = np.array([[0.5, -2.0, 0.0], [-2.0, 1.5, 0.0], [2.5, 0.75, 0.0]])
    platform = np.array([[-0.25, 1.5, 0.5], [1.25, -1.0, 0.25], [-1.5, -0.5, 0.0]])
    g = nd.Geometry(base, base[::-1] + np.array([0.5, 0.25, 0.0]), platform, 0.5 * platform)
    return model.robot(g, nd.Configuration([0.0, 0.0, 3.0], np.eye(3), 0.5 * (base[0] + platform[0] + [0.0, 0.0, 3.0])))


def rates(m, lc=1.0):
    """H, 9x9: leg rates for (l_c omega, pdot, sdot)."""
    A, B, C, D = model.matrices(m, lc)
    zero = np.zeros((3, 3))
    return np.block([[A, zero], [-D, -C, C], [zero, zero, B]])


def radius(m):
    """Largest distance of a platform joint from the platform origin."""
    return max(np.linalg.norm(m.u, axis=-1).max(), np.linalg.norm(m.ut, axis=-1).max())


def scaled(m, unit):
    return model.Robot(*(x if name == "Q" else x * unit for name, x in m._asdict().items()))


def any_pose(rng, hexagonal):
    """A random geometry and configuration, the geometry hexagonal or general."""
    if hexagonal:
        g = nd.Geometry.hexagonal(*rng.uniform(0.1, 2.0, size=4))
    else:
        g = nd.Geometry(*(scale * rng.normal(size=(3, 3)) for scale in (1.5, 1.5, 1.0, 1.0)))
    q = rng.normal(size=4)
    p, s = np.array([0.0, 0.0, 1.8]) + 0.5 * rng.normal(size=3), np.array([0.0, 0.0, 0.9]) + 0.4 * rng.normal(size=3)
    return g, nd.Configuration(p, Rotation.from_quat(q), s)


def robots_at_poses(seed, poses=5):
    """A random geometry, the first pose of its robot and others near it, and the generator."""
    m, rng = regular(seed)
    turns = Rotation.from_rotvec(np.vstack([np.zeros(3), 0.1 * rng.normal(size=(poses - 1, 3))])).as_matrix()
    shift = np.vstack([np.zeros(6), 0.1 * rng.normal(size=(poses - 1, 6))])
    return m.geometry(), nd.Configuration(m.p + shift[:, :3], turns @ m.Q, m.s + shift[:, 3:]), rng


def singular_robots(kind):
    """A flat one and forty general ones of a kind."""
    return [flat(kind), *(singular(kind, seed)[0] for seed in range(40))]
