"""JAX: one pose written once, mapped by vmap, compiled by jit for the processor in double precision."""

import jax
import jax.numpy as jnp
import numpy as np

BLOCK = 4096

jax.config.update("jax_enable_x64", True)
jax.config.update("jax_platforms", "cpu")


def condition(robot, position, rotation, internal_point):
    def unit(v):
        return v / jnp.linalg.norm(v, axis=-1, keepdims=True)

    u, u_tilde = robot.platform_external @ rotation.T, robot.platform_internal @ rotation.T
    a = unit(position + u - robot.base_external)
    c = unit(internal_point - position - u_tilde)
    b = unit(internal_point - robot.base_internal)
    f = jnp.block([[jnp.cross(u, a) / robot.length, a], [jnp.cross(u_tilde, c) / robot.length, c]])
    one, zero = jnp.eye(3), jnp.zeros((3, 3))
    # C B^-1 = (B^-T C^T)^T
    g = jnp.block([[one, zero, zero], [zero, -one, jnp.linalg.solve(b.T, c.T).T]])
    sigma = jnp.linalg.svd(jnp.linalg.solve(f, g), compute_uv=False)
    return sigma[0] / sigma[-1]


def prepare(robot, poses):
    run_block = jax.jit(jax.vmap(lambda *pose: condition(robot, *pose)))
    count = len(poses.position)
    blocks = [[jnp.asarray(a[k : k + BLOCK]) for a in poses] for k in range(0, count, BLOCK)]

    def run():
        return np.concatenate([run_block(*block) for block in blocks])

    run()  # compiles
    return run
