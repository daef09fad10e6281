"""Rows of the three determinants, and robots that are singular by construction."""

import numpy as np
import numpy_model as model


def from_o(m):
    """d_i = r_i - s and w_i = Q u_i + p - s."""
    s = m.s[..., None, :]
    return m.r - s, m.u @ np.swapaxes(m.Q, -1, -2) + m.p[..., None, :] - s


def size(v):
    return np.linalg.norm(v, axis=-1)


def unit_rows(m):
    """The rows of the three mechanisms, unit directions."""
    (_, y, z, *_), (d, w) = model.legs(m), from_o(m)
    y, z, d, w = (v / size(v)[..., None] for v in (y, z, d, w))
    return np.cross(d, w), z, y


def lost(rng, mechanism):
    """A robot at which one mechanism is lost, by construction."""
    m = model.random_robots(rng, 1).at(0)
    mix = rng.uniform(-1.0, 1.0, size=2)
    if mechanism == "b":
        return m._replace(s=m.rh[0] + mix @ (m.rh[1:] - m.rh[0]))
    if mechanism == "c":
        return m._replace(s=m.p + m.Q @ (m.ut[0] + mix @ (m.ut[1:] - m.ut[0])))
    line, along, across = rng.normal(size=3), rng.normal(size=(3, 1)), rng.normal(size=(3, 1))
    return m._replace(r=m.s + along * from_o(m)[1] + across * line)
