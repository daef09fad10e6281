"""The robot once more, in plain numpy: the oracle of the other tests.

Shares with the package only the paper. Every matrix is assembled from its defining equation and inverted by LAPACK, all
configurations at once; the package works one configuration at a time, in closed form and with its own singular value
decomposition. Arrays carry leading dimensions throughout.
"""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

import ninedof as nd


class Robot(NamedTuple):
    """Joint triples (..., 3, 3) and a configuration (..., 3), (..., 3, 3), (..., 3)."""

    r: np.ndarray
    rh: np.ndarray
    u: np.ndarray
    ut: np.ndarray
    p: np.ndarray
    Q: np.ndarray
    s: np.ndarray

    def geometry(self):
        return nd.Geometry(self.r, self.rh, self.u, self.ut)

    def configuration(self):
        return nd.Configuration(self.p, self.Q, self.s)

    def at(self, k):
        return Robot(*(a[k] for a in self))


def robot(g, c):
    return Robot(
        g.base_external,
        g.base_internal,
        g.platform_external,
        g.platform_internal,
        c.position,
        c.rotation,
        c.internal_point,
    )


def legs(m):
    """Leg vectors, eqs. (11)-(13), and the platform joints seen from p, in base axes."""
    u, ut = m.u @ np.swapaxes(m.Q, -1, -2), m.ut @ np.swapaxes(m.Q, -1, -2)
    p, s = m.p[..., None, :], m.s[..., None, :]
    return p + u - m.r, s - p - ut, s - m.rh, u, ut


def lengths(m):
    return np.concatenate([np.linalg.norm(x, axis=-1) for x in legs(m)[:3]], axis=-1)


def matrices(m, lc=1.0):
    """A, B, C, D of eqs. (30)-(33)."""
    x, y, z, u, ut = legs(m)
    e, et, eh = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (x, y, z))
    return np.concatenate([np.cross(u, e) / lc, e], axis=-1), eh, et, np.cross(ut, et) / lc


def jacobian(m, lc=1.0):
    """J' = F^-1 G by a general solver, eqs. (34)-(36)."""
    A, B, C, D = matrices(m, lc)
    F = np.concatenate([A, np.concatenate([D, C], axis=-1)], axis=-2)
    one = np.broadcast_to(np.eye(3), B.shape)
    zero = np.zeros_like(one)
    upper = np.concatenate([one, zero, zero], axis=-1)
    lower = np.concatenate([zero, -one, C @ np.linalg.inv(B)], axis=-1)
    return np.linalg.solve(F, np.concatenate([upper, lower], axis=-2))


def singular_values(m, lc=1.0):
    return np.linalg.svd(jacobian(m, lc), compute_uv=False)


def condition_number(m, lc=1.0):
    sigma = singular_values(m, lc)
    return sigma[..., 0] / sigma[..., -1]


def random_rotations(rng, count):
    return Rotation.from_quat(rng.normal(size=(count, 4))).as_matrix()


def random_robots(rng, count, tilt=0.6):
    """General joint triples in general position, O between the plates: far from any singularity for the most part."""
    base, platform = rng.normal(size=(2, count, 2, 3, 3))
    return Robot(
        2.0 * base[:, 0],
        2.0 * base[:, 1],
        platform[:, 0],
        platform[:, 1],
        np.array([0.0, 0.0, 4.0]) + rng.normal(size=(count, 3)),
        Rotation.from_rotvec(tilt * rng.normal(size=(count, 3))).as_matrix(),
        np.array([0.0, 0.0, 2.0]) + rng.normal(size=(count, 3)),
    )


def orbit(radius, angle, height):
    """Three joints at -120 degrees from each other, typed from the definition of a C3 orbit."""
    angles = np.asarray(angle)[..., None] - 2.0 * np.pi / 3.0 * np.arange(3)
    xy = np.asarray(radius)[..., None, None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    return np.concatenate([xy, np.broadcast_to(np.asarray(height)[..., None, None], (*xy.shape[:-1], 1))], axis=-1)


def random_symmetric_robots(rng, count, planar=0.3):
    """C3 designs on their axis; a share of them planar, the rest with joint heights."""
    radius = np.exp(rng.uniform(-1.5, 1.5, size=(4, count)))
    angle = rng.uniform(-np.pi, np.pi, size=(4, count))
    height = rng.normal(size=(4, count)) * (rng.uniform(size=count) > planar)
    twist = rng.uniform(-np.pi, np.pi, size=count)
    zp = rng.uniform(0.5, 6.0, size=count)
    zero = np.zeros(count)
    return Robot(
        *(orbit(radius[k], angle[k], height[k]) for k in range(4)),
        np.stack([zero, zero, zp], axis=-1),
        Rotation.from_rotvec(np.stack([zero, zero, twist], axis=-1)).as_matrix(),
        np.stack([zero, zero, zp * rng.uniform(0.05, 0.95, size=count)], axis=-1),
    )
