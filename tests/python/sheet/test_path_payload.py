"""The largest payload along a motion: what the drives do with it and with a little more, by motions of those masses."""

from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd

STUDY = nd.Study(
    variables={"a1": 0.0, "a2": 800.0, "b1": 290.0, "b2": 0.0, "zp": 480.0, "zs": 320.0, "theta_z": 0.0},
    unit="mm",
    characteristic_length=150.0,
    tool={"position": (0.0, 0.0, -60.0)},
    masses={"platform": 3.0, "cylinder": 0.4, "cylinder_centre": 90.0},
    loads={"wrenches": [[0.0, 0.0, 0.0, 30.0, 0.0, -40.0], [0.0, 0.0, 0.0, 0.0, -50.0, 20.0]]},
    speeds={"linear": 1.0},
    constraints={"force": (None, 900.0), "power": (None, 2e4)},
)


@pytest.fixture(scope="module")
def machine():
    return nd.optimize(STUDY, starts=1)


def line(machine, duration=0.6):
    return nd.Trajectory.line(machine.configuration, (60.0, 40.0, 70.0), duration, points=201, unit="mm")


def passed(machine, path, payload, centre=(0.0, 0.0, 0.0)):
    """Return by how much the worst leg passes a limit of STUDY with the payload on the platform."""
    own = STUDY.masses
    mass = own.platform + payload
    arm = (np.array(centre) - own.centre) * np.sqrt(own.platform * payload) / mass
    x, y, z = arm.tolist()
    masses = replace(
        own,
        platform=mass,
        centre=tuple((payload * np.array(centre) + own.platform * np.array(own.centre)) / mass),
        inertia=tuple(mass * np.array([y * y + z * z, x * x + z * z, x * x + y * y, -x * y, -x * z, -y * z])),
    )
    motion = nd.follow(machine, path, masses=masses.seen_from(STUDY.tool))
    forces, powers = np.abs(motion.leg_forces), np.abs(motion.leg_forces * motion.leg_rates)
    return max((forces / 900.0).max(), (powers / 2e4).max()) - 1.0


@pytest.mark.parametrize(("duration", "kind"), [(0.6, "power"), (60.0, "force")])
def test_with_the_payload_every_drive_keeps_its_limits_and_with_more_one_does_not(machine, duration, kind):
    path = line(machine, duration)
    centre = (15.0, -10.0, 25.0)
    found = nd.payload_along(machine, nd.follow(machine, path), centre=centre)
    assert (found.fits, found.kind, found.unit) == (True, kind, "kg")
    assert found.mass > 1.0
    assert passed(machine, path, found.mass, centre) == pytest.approx(0.0, abs=1e-9)
    assert passed(machine, path, 1.001 * found.mass, centre) > 1e-5
    assert passed(machine, path, 0.999 * found.mass, centre) < -1e-5
    assert found.words.startswith(f"largest payload along the path {found.mass:.6g} kg: {found.leg} reaches its {kind}")


def test_given_limits_take_the_place_of_the_study(machine):
    motion = nd.follow(machine, line(machine))
    weak = nd.payload_along(machine, motion, power=1.0)
    assert (weak.mass, weak.fits, weak.kind) == (0.0, False, "power")
    assert "exceeds its power at t = " in weak.words
    slow = nd.follow(machine, line(machine, 1e6))
    assert nd.payload_along(machine, slow, force=700.0).mass < nd.payload_along(machine, slow).mass
    resting = nd.follow(nd.Design(machine.geometry, machine.configuration), line(machine, 1e3))
    idle = np.where(np.abs(resting.leg_rates).max(axis=0) < 1e-9, 1.0, np.inf)
    assert idle.min() == 1.0
    assert nd.payload_along(machine, resting, power=idle).mass == np.inf
    with pytest.raises(ValueError, match="force, power: got none, expected one, or a design of a study that limits"):
        nd.payload_along(nd.Design(machine.geometry, machine.configuration), motion)
    with pytest.raises(ValueError, match="power: got -1, expected numbers > 0"):
        nd.payload_along(machine, motion, power=-1)


def test_the_path_of_a_run_says_what_it_carries(machine, tmp_path, run):
    nd.save(machine, tmp_path / "run")
    motion = nd.follow(machine, nd.Trajectory.line(machine.configuration, (60.0, 0.0, 20.0), unit="mm"))
    _, out, _ = run(f"path {tmp_path / 'run'} --line 60 0 20 --no-figures --no-report --out {tmp_path / 'path'}")
    assert nd.payload_along(machine, motion).words in " ".join(out.split())
