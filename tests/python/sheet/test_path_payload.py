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


def passed(machine, path, payload, centre=(0.0, 0.0, 0.0), gravity=None):
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
    motion = nd.follow(machine, path, masses=masses.seen_from(STUDY.tool), gravity=gravity)
    forces, powers = np.abs(motion.leg_forces), np.abs(motion.leg_forces * motion.leg_rates)
    shares = np.maximum(forces / 900.0, powers / 2e4).max(axis=(1, 2))
    return shares.max() - 1.0, int(shares.argmax())


@pytest.mark.parametrize(
    ("duration", "kind", "gravity"), [(0.6, "power", None), (60.0, "force", None), (60.0, "force", (0.0, 9.0, -30.0))]
)
def test_with_the_payload_every_drive_keeps_its_limits_and_with_more_one_does_not(machine, duration, kind, gravity):
    path = line(machine, duration)
    centre = (15.0, -10.0, 25.0)
    found = nd.payload_along(machine, nd.follow(machine, path, gravity=gravity), centre=centre)
    assert (found.fits, found.kind, found.force_unit) == (True, kind, "N")
    assert found.mass > 1.0
    assert passed(machine, path, found.mass, centre, gravity) == (pytest.approx(0.0, abs=1e-9), found.load)
    assert passed(machine, path, 1.001 * found.mass, centre, gravity)[0] > 1e-5
    assert passed(machine, path, 0.999 * found.mass, centre, gravity)[0] < -1e-5
    assert found.words.startswith(f"largest payload along the path {found.mass:.6g} kg: {found.leg} reaches its {kind}")


def test_given_limits_take_the_place_of_the_study(machine):
    motion = nd.follow(machine, line(machine))
    weak = nd.payload_along(machine, motion, power=1.0)
    assert (weak.mass, weak.fits, weak.kind) == (0.0, False, "power")
    assert "exceeds its power of 1 N mm/s at t = " in weak.words
    slow = nd.follow(machine, line(machine, 1e6))
    assert nd.payload_along(machine, slow, force=700.0).mass < nd.payload_along(machine, slow).mass
    both = nd.payload_along(machine, motion)
    assert both.kind == "power"
    assert nd.payload_along(machine, motion, force=900.0) == both  # the other limit is the study's still
    assert nd.payload_along(machine, motion, force=900.0, power=np.inf).mass > both.mass
    resting = nd.follow(nd.Design(machine.geometry, machine.configuration), line(machine, 1e3))
    idle = np.where(np.abs(resting.leg_rates).max(axis=0) < 1e-9, 1.0, np.inf)
    assert idle.min() == 1.0
    assert nd.payload_along(machine, resting, power=idle, force=np.inf).mass == np.inf
    with pytest.raises(ValueError, match="force, power: got none, expected one, or a design of a study that limits"):
        nd.payload_along(nd.Design(machine.geometry, machine.configuration), motion)
    with pytest.raises(ValueError, match="power: got -1, expected numbers >= 0"):
        nd.payload_along(machine, motion, power=-1)
    other = replace(STUDY, variables=STUDY.variables | {"a2": 790.0})
    with pytest.raises(ValueError, match="motion: got that of another robot"):
        nd.payload_along(nd.optimize(other, starts=1), motion)


def test_a_motion_without_masses_says_what_its_mass_goes_with(machine):
    bare = nd.Design(machine.geometry, machine.configuration)
    found = nd.payload_along(bare, nd.follow(bare, line(machine, 60.0)), force=500.0)
    assert found.force_unit == ""
    assert f"largest payload along the path {found.mass:.6g}, in kg where forces are in N" in found.words
    assert found.words.endswith(" s first")
    flat = nd.payload_along(bare, nd.follow(bare, line(machine, 60.0), internal_point=0.0), force=500.0)
    assert (flat.mass, flat.fits, flat.kind) == (0.0, False, "singular")
    assert flat.words.startswith("no payload along the path: singular at t = ")


def test_the_path_of_a_run_says_what_it_carries(machine, tmp_path, run):
    nd.save(machine, tmp_path / "run")
    trajectory = nd.Trajectory.line(machine.configuration, (60.0, 0.0, 20.0), unit="mm")
    for n, (option, gravity) in enumerate((("", None), ("--gravity 0 0 -30", (0.0, 0.0, -30.0)))):
        motion = nd.follow(machine, trajectory, gravity=gravity)
        where = f"--no-figures --no-report --out {tmp_path / str(n)}"
        _, out, _ = run(f"path {tmp_path / 'run'} --line 60 0 20 {option} {where}")
        assert nd.payload_along(machine, motion).words in " ".join(out.split())
