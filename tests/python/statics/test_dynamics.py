"""Inverse dynamics: held against MuJoCo's mass matrix, against energies written in numpy, and against statics."""

from dataclasses import asdict
from types import SimpleNamespace

import mujoco_models as models
import numpy as np
import pytest
import robots
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import ninedof as nd

GRAVITY = np.array([1.5, -2.0, -9.0])


def some_masses(rng):
    """Masses with different bodies in every leg."""
    root = rng.normal(size=(3, 3))
    legs = {
        name: rng.uniform(low, high, size=9)
        for name, low, high in (
            ("cylinder", 0.5, 2.0),
            ("rod", 0.2, 1.0),
            ("cylinder_centre", 0.2, 0.9),
            ("rod_centre", -0.2, 0.6),
            ("cylinder_inertia", 0.05, 0.2),
            ("rod_inertia", 0.02, 0.1),
        )
    }
    spread = root @ root.T
    inertia = six(np.trace(spread) * np.eye(3) - spread)
    return SimpleNamespace(platform=5.0, centre=rng.normal(size=3), inertia=inertia, internal_point=0.7, **legs)


def six(matrix):
    return matrix[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]


def matrix_of(masses):
    xx, yy, zz, xy, xz, yz = masses.inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def of_legs(masses):
    """The numbers of the legs' bodies, nine each."""
    names = (f"{part}{of}" for part in ("cylinder", "rod") for of in ("", "_centre", "_inertia"))
    return {name: np.broadcast_to(getattr(masses, name), 9) for name in names}


def at_time(m, rng):
    """Polynomials of time for p, a rotation vector and s about the pose of a robot."""
    terms = 0.3 * rng.normal(size=(3, 3, 3))

    def configuration(t):
        shift, turn, o = (terms[:, 0] * t + terms[:, 1] * t**2 + terms[:, 2] * t**3).reshape(3, 3)
        return nd.Configuration(m.p + shift, Rotation.from_rotvec(turn).as_matrix() @ m.Q, m.s + o)

    return configuration


def derivatives(path, t, h=2e-3):
    """Velocity and acceleration of (rotation, p, s) at a time by central differences of sixth order."""
    here = path(t)
    steps = np.arange(-3, 4)
    d = np.stack([tangent(here, path(t + k * h)) for k in steps])
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60.0 * h)
    second = np.array([2, -27, 270, -490, 270, -27, 2]) / (180.0 * h * h)
    return first @ d, second @ d


def tangent(here, there):
    turn = Rotation.from_matrix(there.rotation @ here.rotation.T).as_rotvec()
    return np.concatenate([turn, there.position - here.position, there.internal_point - here.internal_point])


# --- energy -----------------------------------------------------------------------------------------------------------


def bodies(g, c, masses):
    """Mass and centre of every body, transverse inertia and direction of those of legs; plain numpy."""
    external, internal = (c.position + triple @ c.rotation.T for triple in (g.platform_external, g.platform_internal))
    ends = [*zip(g.base_external, external, strict=True)]
    ends += [(start, c.internal_point) for start in (*internal, *g.base_internal)]
    nine, out = of_legs(masses), []
    for k, (start, end) in enumerate(ends):
        e = (end - start) / np.linalg.norm(end - start)
        out.append((nine["cylinder"][k], start + nine["cylinder_centre"][k] * e, nine["cylinder_inertia"][k], e))
        out.append((nine["rod"][k], end - nine["rod_centre"][k] * e, nine["rod_inertia"][k], e))
    out.append((masses.platform, c.position + c.rotation @ masses.centre, 0.0, np.zeros(3)))
    out.append((masses.internal_point, c.internal_point, 0.0, np.zeros(3)))
    return out


def energy(g, path, t, masses, h=1e-3):
    """Kinetic and potential energy; velocities of the bodies by differences of their places."""
    sides = [bodies(g, path(t + k * h), masses) for k in (-2, -1, 1, 2)]
    weights = np.array([1, -8, 8, -1]) / (12.0 * h)
    kinetic = potential = 0.0
    for k, (mass, centre, inertia, _) in enumerate(bodies(g, path(t), masses)):
        v, turn = (sum(w * side[k][which] for w, side in zip(weights, sides, strict=True)) for which in (1, 3))
        kinetic += 0.5 * mass * v @ v + 0.5 * inertia * turn @ turn
        potential -= mass * GRAVITY @ centre
    here = path(t)
    omega = derivatives(path, t)[0][:3] @ here.rotation
    return kinetic + 0.5 * omega @ matrix_of(masses) @ omega + potential


@pytest.mark.parametrize("seed", range(8))
def test_powers_of_the_actuators_are_the_rate_of_the_energy(seed):
    m, rng = robots.regular(seed)
    masses, path, load, t, h = some_masses(rng), at_time(m, rng), rng.normal(size=6), 0.1, 4e-3
    g = m.geometry()
    velocity, acceleration = derivatives(path, t)
    motion = nd.inverse_dynamics(g, path(t), (velocity, acceleration), masses, GRAVITY, load)
    values = [energy(g, path, t + k * h, masses) for k in (-2, -1, 1, 2)]
    expected = np.array([1, -8, 8, -1]) @ values / (12.0 * h) - load @ velocity[:6]
    scale = np.abs(motion.power).sum()
    assert motion.power.sum() == pytest.approx(expected, abs=1e-7 * scale)
    assert_allclose(motion.rates, nd.inverse_velocity(g, path(t), *velocity.reshape(3, 3)))
    assert_allclose(motion.power, motion.forces * motion.rates)


# --- MuJoCo -----------------------------------------------------------------------------------------------------------


def mujoco_text(g, c, masses):
    """The struts of mujoco_models with given masses; legs are thin: MuJoCo takes no inertia below 1e-15."""
    text = models.closed_loop_model(g, c)
    nine = of_legs(masses)

    def with_inertia(body, at, mass, inertia):
        begin = text.index("<inertial", text.index(f'<body name="{body}"'))
        end = text.index("/>", begin) + 2
        return f'{text[:begin]}<inertial pos="{models.numbers(at)}" mass="{float(mass)!r}" {inertia}/>{text[end:]}'

    for k, leg in enumerate(models.LEGS):
        for part, sign in (("cylinder", 1.0), ("rod", -1.0)):
            across = nine[f"{part}_inertia"][k]
            inertia = f'diaginertia="{models.numbers([across, across, 1e-14])}"'
            text = with_inertia(f"{part} {leg}", [0, 0, sign * nine[f"{part}_centre"][k]], nine[part][k], inertia)
    text = with_inertia("O", np.zeros(3), masses.internal_point, 'diaginertia="1 1 1"')
    tensor = f'fullinertia="{models.numbers(masses.inertia)}"'
    return with_inertia("platform", masses.centre, masses.platform, tensor)


@pytest.mark.parametrize("seed", range(6))
def test_forces_are_those_of_mujoco(seed):
    mujoco = pytest.importorskip("mujoco")
    m, rng = robots.regular(seed)
    g, c, masses, load = m.geometry(), m.configuration(), some_masses(rng), rng.normal(size=6)
    velocity, acceleration = rng.normal(size=(2, 9))
    engine = mujoco.MjModel.from_xml_string(mujoco_text(g, c, masses))
    engine.opt.gravity[:] = GRAVITY
    expected = models.leg_forces(engine, c, velocity, acceleration, load)
    motion = nd.inverse_dynamics(g, c, (velocity, acceleration), masses, GRAVITY, load)
    assert_allclose(motion.forces, expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())


# --- statics, units, arguments ----------------------------------------------------------------------------------------


def test_at_rest_the_forces_balance_the_weights(published, neutral):
    masses = nd.Masses(platform=3.0, centre=[0.1, 0.2, 0.3], internal_point=2.0)
    arm = neutral.rotation @ masses.centre
    weight = 3.0 * GRAVITY
    expected = nd.leg_forces(published, neutral, np.cross(arm, weight), weight, 2.0 * GRAVITY).forces
    assert_allclose(nd.inverse_dynamics(published, neutral, masses=masses, gravity=GRAVITY).forces, expected)
    nothing = nd.inverse_dynamics(published, neutral, load=[1, 2, 3, 4, 5, 6])
    assert_allclose(nothing.forces, nd.leg_forces(published, neutral, [1, 2, 3], [4, 5, 6]).forces)


@pytest.mark.parametrize("unit", ["mm", "cm", "in", "m"])
def test_a_machine_in_another_unit_has_the_same_forces(unit):
    """The same machine in metres: newtons and watts do not depend on the unit of length."""
    m, rng = robots.regular(3)
    size = 1.0 / {"mm": 1e-3, "cm": 1e-2, "in": 0.0254, "m": 1.0}[unit]
    masses, load = some_masses(rng), rng.normal(size=6)
    velocity, acceleration = rng.normal(size=(2, 9))
    by = np.array([1.0] * 3 + [size] * 6)
    larger = robots.scaled(m, size)
    own = {name: np.multiply(getattr(masses, name), size) for name in ("centre", "cylinder_centre", "rod_centre")}
    own |= {
        name: np.multiply(getattr(masses, name), size**2) for name in ("inertia", "cylinder_inertia", "rod_inertia")
    }
    same = SimpleNamespace(platform=5.0, cylinder=masses.cylinder, rod=masses.rod, internal_point=0.7, **own)
    wrench = load * ([size] * 3 + [1.0] * 3)
    one = nd.inverse_dynamics(
        m.geometry(), m.configuration(), (velocity, acceleration), masses, GRAVITY, load, unit="m"
    )
    g, c = larger.geometry(), larger.configuration()
    other = nd.inverse_dynamics(g, c, (by * velocity, by * acceleration), same, GRAVITY, wrench, unit=unit)
    assert_allclose(other.forces, one.forces, rtol=1e-9, atol=1e-9 * np.abs(one.forces).max())
    assert_allclose(other.power, one.power, rtol=1e-9, atol=1e-9 * np.abs(one.power).max())


def test_bad_masses_are_named(published, neutral):
    for masses in (3.0, {"platform": 3.0}):
        with pytest.raises(ValueError, match="masses: got"):
            nd.inverse_dynamics(published, neutral, masses=masses)
    negative = SimpleNamespace(**(asdict(nd.Masses()) | {"rod": -1.0}))
    with pytest.raises(ValueError, match="rod: got -1"):
        nd.inverse_dynamics(published, neutral, masses=negative)
    with pytest.raises(ValueError, match="gravity: got"):
        nd.inverse_dynamics(published, neutral, gravity=[0.0, np.inf, 0.0])
