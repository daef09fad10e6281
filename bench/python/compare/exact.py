"""Condition numbers in extended precision: J' from eqs. (30)-(36) and one-sided Jacobi rotations.

Nothing of the package is used.
"""

import numpy as np

Real = np.longdouble


def eliminate(a, b):
    """A^-1 B by Gauss-Jordan elimination with partial pivoting, one matrix."""
    work = np.concatenate([a, b], axis=1)
    n = len(a)
    for k in range(n):
        pivot = k + int(np.argmax(np.abs(work[k:, k])))
        work[[k, pivot]] = work[[pivot, k]]
        work[k] /= work[k, k]
        for i in range(n):
            if i != k:
                work[i] -= work[i, k] * work[k]
    return work[:, n:]


def jacobian(robot, position, rotation, internal_point):
    r, rh, u, ut = (np.asarray(t, Real) for t in robot[:4])
    p, q, s = (np.asarray(x, Real) for x in (position, rotation, internal_point))
    u, ut, lc = u @ q.T, ut @ q.T, Real(robot.length)

    def unit(v):
        return v / np.sqrt((v * v).sum(axis=1))[:, None]

    a, c, b = unit(p + u - r), unit(s - p - ut), unit(s - rh)
    f = np.block([[np.cross(u, a) / lc, a], [np.cross(ut, c) / lc, c]])
    one, zero = np.eye(3, dtype=Real), np.zeros((3, 3), Real)
    g = np.block([[one, zero, zero], [zero, -one, c @ eliminate(b, one)]])
    return eliminate(f, g)


def singular_values(rows):
    """One-sided Jacobi: turns pairs of rows until all are orthogonal; their lengths are the singular values."""
    rows = rows.copy()
    for _ in range(60):
        turned = False
        for i in range(len(rows) - 1):
            for j in range(i + 1, len(rows)):
                x, y, z = rows[i] @ rows[i], rows[j] @ rows[j], rows[i] @ rows[j]
                if abs(z) <= 8 * np.finfo(Real).eps * np.sqrt(x * y):
                    continue
                turned = True
                cot = (y - x) / (2 * z)
                t = (1 if cot >= 0 else -1) / (abs(cot) + np.sqrt(1 + cot * cot))
                cos = 1 / np.sqrt(1 + t * t)
                rows[i], rows[j] = cos * (rows[i] - t * rows[j]), cos * (rows[j] + t * rows[i])
        if not turned:
            break
    return np.sqrt((rows * rows).sum(axis=1))


def condition_numbers(robot, poses):
    sigma = [singular_values(jacobian(robot, *pose)) for pose in zip(*poses, strict=True)]
    return np.array([values.max() / values.min() for values in sigma])


def worst_error(robot, poses, ours):
    """The largest relative error of ours over max(1, kappa / 1000)."""
    exact = condition_numbers(robot, poses)
    return float((np.abs(ours / exact - 1) / np.maximum(1, exact / 1000)).max())


def digits():
    return np.finfo(Real).precision
