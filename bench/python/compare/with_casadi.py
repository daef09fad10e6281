"""CasADi: J' of one pose as an expression, as generated C code where there is a compiler, mapped over the poses.

CasADi has no singular values. Compared are J' by CasADi with the singular values of numpy, and, in CasADi alone, the
condition number in the Frobenius norm, |J'| |J'^+| with |J'^+|^2 = trace((J'J'^T)^-1), beside ours in the same norm.
"""

import shutil

import casadi
import numpy as np

BLOCK = 4096


def rows(vectors):
    return casadi.vertcat(*(v.T for v in vectors))


def unit(v):
    return v / casadi.sqrt(casadi.dot(v, v))


def jacobian(robot, x):
    """J' as an expression of the 15 numbers of a pose."""
    p, q, s = x[:3], casadi.reshape(x[3:12], 3, 3).T, x[12:]
    u, u_tilde = ([casadi.mtimes(q, joint) for joint in triple] for triple in robot[2:4])
    a = [unit(p + u[i] - robot.base_external[i]) for i in range(3)]
    c = [unit(s - p - u_tilde[i]) for i in range(3)]
    b = [unit(s - robot.base_internal[i]) for i in range(3)]
    turning = [casadi.cross(u[i], a[i]) / robot.length for i in range(3)]
    turning += [casadi.cross(u_tilde[i], c[i]) / robot.length for i in range(3)]
    f = casadi.horzcat(rows(turning), rows(a + c))
    g = casadi.SX.zeros(6, 9)
    g[:3, :3] = casadi.SX.eye(3)
    g[3:, 3:6] = -casadi.SX.eye(3)
    g[3:, 6:] = casadi.mtimes(rows(c), casadi.inv(rows(b)))
    return casadi.solve(f, g)


def over_blocks(robot, poses, expression, finish):
    x = casadi.SX.sym("x", 15)
    options = {}
    if shutil.which("gcc"):
        options = {"jit": True, "compiler": "shell", "jit_options": {"flags": ["-O3", "-fno-math-errno"]}}
    one = casadi.Function("condition", [x], [expression(jacobian(robot, x))], {"cse": True} | options)
    count = len(poses.position)
    columns = np.concatenate([a.reshape(count, -1) for a in poses], axis=1).T
    blocks = [casadi.DM(columns[:, k : k + BLOCK]) for k in range(0, count, BLOCK)]
    mapped = {block.shape[1]: one.map(block.shape[1]) for block in blocks}
    return lambda: np.concatenate([finish(np.asarray(mapped[block.shape[1]](block))) for block in blocks])


def prepare(robot, poses):
    def finish(columns):
        sigma = np.linalg.svd(columns.T.reshape(-1, 9, 6), compute_uv=False)  # columns first: the transpose of J'
        return sigma[:, 0] / sigma[:, -1]

    return over_blocks(robot, poses, casadi.vec, finish)


def prepare_frobenius(robot, poses):
    def condition(j):
        product = casadi.mtimes(j, j.T)
        return casadi.sqrt(casadi.trace(product) * casadi.trace(casadi.solve(product, casadi.SX.eye(6))))

    return over_blocks(robot, poses, condition, lambda row: row.ravel())
