"""The robot as a MuJoCo model with legs as tendons, and what the engine says of the model that is exported.

Shares with the package the twelve joints, the pose and the order of the legs, nothing else: no leg vector, length or
matrix of the package. The text says what hangs on what; lengths, rates, forces and motion are the engine's.

O is a small body on three slides and the platform a free body, so that the first ten coordinates of a
state are s, p and the quaternion (w, x, y, z) of Q; the first nine velocities are sdot and pdot in the axes of the base
and omega in the axes of the platform.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

LEGS = [f"{kind}{i}" for kind in "lqr" for i in (1, 2, 3)]  # the order of eq. (35b)


def numbers(values: Iterable[float]) -> str:
    """Attribute text that reads back to the same doubles."""
    return " ".join(repr(float(value)) for value in values)


def quaternion(rotation) -> str:
    x, y, z, w = Rotation.from_matrix(rotation).as_quat()
    return numbers((w, x, y, z))


class Leg(NamedTuple):
    """One leg: the points it starts from and ends at, as sites of bodies."""

    name: str
    root_site: str
    tip_site: str


def legs() -> Iterator[Leg]:
    """External legs go from base to platform; both kinds of internal legs end in O (paper, Section 3)."""
    for i in (1, 2, 3):
        yield Leg(f"l{i}", f"base_external{i}", f"platform_external{i}")
    for i in (1, 2, 3):
        yield Leg(f"q{i}", f"platform_internal{i}", "O")
    for i in (1, 2, 3):
        yield Leg(f"r{i}", f"base_internal{i}", "O")


def joints(g) -> dict[str, np.ndarray]:
    """Coordinates of the twelve joints by site name, each in the frame of the body it is on."""
    triples = ("base_external", "base_internal", "platform_external", "platform_internal")
    return {f"{name}{i}": point for name in triples for i, point in enumerate(getattr(g, name), start=1)}


def sites(g, body: str) -> str:
    return "".join(f'<site name="{n}" pos="{numbers(at)}"/>' for n, at in joints(g).items() if n.startswith(body))


def world(g, c) -> str:
    """Base, platform and O with their joints as sites."""
    slides = "".join(
        f'<joint name="s{axis}" type="slide" axis="{direction}" ref="{float(at)!r}"/>'
        for axis, direction, at in zip("xyz", ("1 0 0", "0 1 0", "0 0 1"), c.internal_point, strict=True)
    )
    return f"""
      <worldbody>
        <body name="O" pos="{numbers(c.internal_point)}">
          {slides}
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          <site name="O"/>
        </body>
        <body name="platform" pos="{numbers(c.position)}" quat="{quaternion(c.rotation)}">
          <freejoint name="platform"/>
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          {sites(g, "platform")}
        </body>
        {sites(g, "base")}
      </worldbody>"""


def actuators(kind: str, kp: float, kv: float) -> str:
    lines = (f'<position name="{leg}" {kind}="{leg}" kp="{kp}" kv="{kv}"/>' for leg in LEGS)
    return f"<actuator>{''.join(lines)}</actuator>"


def tendon_model(g, c, kp: float = 1e4, kv: float = 400.0, timestep: float = 1e-3) -> str:
    """No loops: each leg is a straight tendon between two sites, driven as a spring of commanded length.

    Tendon lengths and moment arms are exact; there is no constraint to be violated.
    """
    tendons = "".join(
        f'<spatial name="{leg.name}"><site site="{leg.root_site}"/><site site="{leg.tip_site}"/></spatial>'
        for leg in legs()
    )
    return f"""
    <mujoco model="ninedof, legs as tendons">
      <compiler angle="radian"/>
      <option timestep="{timestep}" integrator="implicitfast" gravity="0 0 0"/>
      {world(g, c)}
      <tendon>{tendons}</tendon>
      {actuators("tendon", kp, kv)}
    </mujoco>"""


def slides(engine) -> tuple[list[int], list[int]]:
    """Indices of the nine slides among coordinates and among velocities, in the order of the legs."""
    each = [engine.joint(leg) for leg in LEGS]
    return [j.qposadr[0] for j in each], [j.dofadr[0] for j in each]


def settle(engine, data, lengths, seconds: float, at_rest: float) -> bool:
    """Command nine leg lengths and wait until all velocities are below `at_rest`; whether they are."""
    import mujoco

    data.ctrl[:] = lengths
    every = 100
    for _ in range(int(seconds / engine.opt.timestep / every)):
        mujoco.mj_step(engine, data, every)
        if np.abs(data.qvel).max() < at_rest:
            return True
    return False


def slide_to_twist(engine, data, lc: float = 1.0, independent: float = 1e-2) -> np.ndarray:
    """(lc omega, pdot) for nine slide rates: all velocities that the 27 constraints allow, sorted by what they do."""
    constraints = data.efc_J.reshape(data.nefc, engine.nv)
    assert constraints.shape == (27, 45)
    _, sigma, rows = np.linalg.svd(constraints)
    assert sigma[-1] > independent * sigma[0]
    allowed = rows[27:].T  # 18 motions: the nine of the robot and nine spins, which neither slide nor turn the platform
    at, rotation = engine.joint("platform").dofadr[0], data.body("platform").xmat.reshape(3, 3)
    twist = np.concatenate([lc * rotation @ allowed[at + 3 : at + 6], allowed[at : at + 3]])
    rates = allowed[slides(engine)[1]]
    jacobian = twist @ np.linalg.pinv(rates, rcond=1e-9)
    np.testing.assert_allclose(jacobian @ rates, twist, rtol=0.0, atol=1e-12)  # the slides determine the twist
    return jacobian


def leg_forces(engine, c, velocity, acceleration, load=(0.0,) * 6) -> np.ndarray:
    """Forces of the nine slides in a motion at a pose, by the inverse dynamics of the engine, without its damping.

    M qacc + bias = slides + load + J^T lambda, with the mass matrix, bias and Jacobian of the engine. Velocities of the
    45 coordinates are those that the 27 constraints leave for the motion (omega, pdot, sdot) of platform and O while
    no leg turns about itself; J qacc + Jdot qvel = 0 with Jdot qvel by differences of the Jacobian along the motion.
    """
    import mujoco

    data = mujoco.MjData(engine)
    o, platform = (engine.jnt_dofadr[engine.body(name).jntadr[0]] for name in ("O", "platform"))
    own = [*range(o, o + 3), *range(platform, platform + 6)]
    spins = engine.jnt_dofadr[engine.jnt_type == mujoco.mjtJoint.mjJNT_BALL] + 2
    legs = np.setdiff1d(np.arange(engine.nv), [*own, *spins])

    def jacobian(qpos):
        data.qpos[:], data.qvel[:] = qpos, 0.0
        mujoco.mj_forward(engine, data)
        assert data.ne == 27
        return data.efc_J.reshape(data.nefc, engine.nv)[:27].copy()

    at = engine.qpos0.copy()
    at_o, at_platform = (engine.jnt_qposadr[engine.body(name).jntadr[0]] for name in ("O", "platform"))
    x, y, z, w = Rotation.from_matrix(c.rotation).as_quat()
    at[at_o : at_o + 3], at[at_platform : at_platform + 7] = c.internal_point, [*c.position, w, x, y, z]
    step = np.zeros(engine.nv)
    for _ in range(12):  # close the loops
        j = jacobian(at)
        step[legs] = np.linalg.solve(j[:, legs], -data.efc_pos[:27])
        mujoco.mj_integratePos(engine, at, step, 1.0)
    j = jacobian(at)
    assert np.abs(data.efc_pos[:27]).max() < 1e-12 * np.abs(c.position).max()

    def whole(motion, drift):
        """Return what platform, O and legs do in a motion of the first two."""
        omega, pdot, sdot = np.reshape(motion, (3, 3))
        out = np.zeros(engine.nv)
        out[own] = [*sdot, *pdot, *(c.rotation.T @ omega)]  # omega in axes of the platform
        out[legs] = np.linalg.solve(j[:, legs], -drift - j[:, own] @ out[own])
        return out

    qvel = whole(velocity, np.zeros(27))
    h, moved, sides = 1e-3, np.empty(engine.nq), []
    for k in (-3, -2, -1, 1, 2, 3):
        moved[:] = at
        mujoco.mj_integratePos(engine, moved, qvel, k * h)
        sides.append(jacobian(moved) @ qvel)
    qacc = whole(acceleration, np.array([-1, 9, -45, 45, -9, 1]) @ sides / (60.0 * h))
    data.qpos[:], data.qvel[:] = at, qvel
    mujoco.mj_forward(engine, data)
    wanted = np.empty(engine.nv)
    mujoco.mj_mulM(engine, data, wanted, qacc)
    wanted += data.qfrc_bias
    wanted[own[3:]] -= [*load[3:], *(c.rotation.T @ load[:3])]
    pushes = np.zeros((engine.nv, 9))
    pushes[slides(engine)[1], range(9)] = 1.0
    return np.linalg.lstsq(np.hstack([pushes, j.T]), wanted, rcond=1e-12)[0][:9]
