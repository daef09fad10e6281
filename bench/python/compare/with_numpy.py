"""Vectorized numpy, as a careful person writes it from eqs. (30)-(36).

Blocks of poses small enough for the caches, J' assembled in place, F and its nine right sides in one batched call of a
solver, singular values without vectors.
"""

import numpy as np

BLOCK = 4096


def unit(v):
    return v / np.sqrt(np.einsum("...k,...k->...", v, v))[..., None]


def cross(a, b):
    """np.cross in a third of its time."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[..., j], b[..., k], out=out[..., i])
        out[..., i] -= a[..., k] * b[..., j]
    return out


def jacobian(robot, poses):
    """J', eq. (36): shape (n, 6, 9)."""
    n = len(poses.position)
    turn = poses.rotation.swapaxes(-1, -2)
    p, s = poses.position[:, None, :], poses.internal_point[:, None, :]
    u, u_tilde = robot.platform_external @ turn, robot.platform_internal @ turn
    external, upper, lower = unit(p + u - robot.base_external), unit(s - p - u_tilde), unit(s - robot.base_internal)
    f, g = np.empty((n, 6, 6)), np.zeros((n, 6, 9))
    f[:, :3, :3] = cross(u, external) / robot.length
    f[:, :3, 3:] = external
    f[:, 3:, :3] = cross(u_tilde, upper) / robot.length
    f[:, 3:, 3:] = upper
    diagonal = np.arange(3)
    g[:, diagonal, diagonal] = 1.0
    g[:, 3 + diagonal, 3 + diagonal] = -1.0
    # C B^-1 from the columns of B's inverse: cross products of its rows over their triple product.
    a, b, c = lower[:, 0], lower[:, 1], lower[:, 2]
    inverse = np.stack([cross(b, c), cross(c, a), cross(a, b)], axis=-1)
    inverse /= np.einsum("nk,nk->n", a, inverse[..., 0])[:, None, None]
    g[:, 3:, 6:] = upper @ inverse
    return np.linalg.solve(f, g)


def by_singular_values(j):
    sigma = np.linalg.svd(j, compute_uv=False)
    return sigma[:, 0] / sigma[:, -1]


def by_eigenvalues(j):
    """Of J'J'^T: half the time, and rounding weighs kappa^2 instead of kappa."""
    eigenvalues = np.linalg.eigvalsh(j @ j.swapaxes(-1, -2))
    return np.sqrt(eigenvalues[:, -1] / eigenvalues[:, 0])


def prepare(robot, poses, condition=by_singular_values):
    out = np.empty(len(poses.position))

    def run():
        for k in range(0, len(out), BLOCK):
            block = slice(k, k + BLOCK)
            out[block] = condition(jacobian(robot, type(poses)(*(a[block] for a in poses))))
        return out

    return run


def prepare_eigenvalues(robot, poses):
    return prepare(robot, poses, by_eigenvalues)
