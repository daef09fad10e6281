"""The largest payload: closed at a pose, against a bisection with leg_forces; over a region against a dense sample."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.sheet import payload as payloads

HEXAGONS = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
HOME = nd.Configuration.neutral(3.9828, 2.4432)
DUTY = {
    "loads": {"wrenches": [[0.0, 0.0, 0.0, 12.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, 9.0, -5.0]]},
    "masses": {"platform": 1.0, "centre": [0.1, 0.0, 0.2], "cylinder": 0.3, "cylinder_centre": 0.6, "rod": 0.1},
}


def machine_over(region):
    variables = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": (2.3, 2.5)}
    study = nd.Study(variables=variables, objective={"region": region}, characteristic_length=1.0, **DUTY)
    return nd.optimize(study, starts=1)


@pytest.fixture(scope="module")
def machine():
    return machine_over({"box": [0.3, 0.3, 0.3], "tilt_deg": 5.0})


@pytest.fixture(scope="module")
def level():
    return machine_over({"box": [0.3, 0.3, 0.3]})


def potential(design, c, mass):
    """Of all weights, from heights alone; configurations of shape (n,)."""
    g, masses = design.geometry, design.study.masses
    on = [c.position[:, None] + u @ np.swapaxes(c.rotation, 1, 2) for u in (g.platform_external, g.platform_internal)]
    o = np.repeat(c.internal_point[:, None], 3, axis=1)
    base = [np.broadcast_to(r, o.shape) for r in (g.base_external, g.base_internal)]
    start, end = np.concatenate([base[0], on[1], base[1]], axis=1), np.concatenate([on[0], o, o], axis=1)
    along = (end - start) / np.linalg.norm(end - start, axis=2, keepdims=True)
    heights = masses.cylinder * (start + masses.cylinder_centre * along) + masses.rod * end
    platform = (masses.platform * (c.position + c.rotation @ masses.centre) + mass * c.position)[:, 2]
    return 9.81 * (heights[..., 2].sum(axis=1) + platform)


def forces_under(design, c, mass, wrench):
    """Leg forces for weights as slopes of the potential, by differences over the nine coordinates, and a load."""
    h, steps = 1e-4, np.eye(9)
    ends = [potential(design, c.moved(sign * h * steps), mass) for sign in (1.0, -1.0)]
    load = np.concatenate([wrench, np.zeros(3)]) - (ends[0] - ends[1]) / (2.0 * h)
    return nd.leg_forces(design.geometry, c, load[:3], load[3:6], load[6:]).forces


def test_at_a_pose_it_is_the_mass_of_a_bisection():
    """No leg of the weightless machine passes 100 up to the payload, one does beyond."""
    payload = nd.largest_payload(nd.Design(HEXAGONS, HOME), force=100.0)
    f = nd.leg_forces(HEXAGONS, HOME, [0, 0, 0], [0, 0, -9.81]).forces
    assert payload.mass == pytest.approx(100.0 / f.max(), rel=1e-12)
    assert (payload.side, payload.region, payload.fits) == ("push", None, True)
    assert payload.forces.max() == pytest.approx(100.0, rel=1e-12)


def test_limits_of_each_leg_and_side():
    f = nd.leg_forces(HEXAGONS, HOME, [0, -9.81, 0], [0, 0, -9.81]).forces  # one metre beside the axis
    push, pull = np.linspace(50.0, 90.0, 9), np.linspace(30.0, 70.0, 9)
    payload = nd.largest_payload(nd.Design(HEXAGONS, HOME), push, pull, centre=(-1.0, 0.0, 0.0))
    ratios = np.where(f > 0.0, push / np.maximum(f, 1e-300), pull / np.maximum(-f, 1e-300))
    assert payload.mass == pytest.approx(ratios.min(), rel=1e-9)
    assert payload.leg == "l1 l2 l3 q1 q2 q3 r1 r2 r3".split()[int(np.argmin(ratios))]


@pytest.mark.slow(sanitized=True)
def test_no_pose_of_a_region_is_worse(machine):
    limit = 60.0
    payload = nd.largest_payload(machine, limit)
    c = payload.configuration
    own = forces_under(machine, c, payload.mass, np.array(machine.study.loads.wrenches[payload.load]))
    assert_allclose(payload.forces, own, atol=1e-5)
    assert np.abs(payload.forces).max() == pytest.approx(limit, rel=1e-9)
    rng = np.random.default_rng(4)
    home, worst = machine.configuration, 0.0
    for _ in range(400):
        shift, tilt = rng.uniform(-0.3, 0.3, size=3), np.radians(5.0) * np.array([*rng.normal(size=2), 0.0])
        tilt /= max(1.0, np.linalg.norm(tilt) / np.radians(5.0))
        at = home.moved([*tilt, *shift, *shift])
        for wrench in machine.study.loads.wrenches:
            worst = max(worst, np.abs(forces_under(machine, at, payload.mass, np.array(wrench))).max())
    assert worst <= limit * (1.0 + 1e-6)


def test_one_search_has_the_payload_with_and_without_the_loads(level, monkeypatch):
    searches, search = [], payloads.look_over
    monkeypatch.setattr(payloads, "look_over", lambda *given: searches.append(given) or search(*given))
    both = nd.largest_payload(level, 60.0, samples=500)
    assert len(searches) == 1
    alone = nd.largest_payload(level, 60.0, loads=[np.zeros(6)], samples=500)
    assert both.without_loads == pytest.approx(alone.mass, rel=1e-9)
    assert alone.without_loads == alone.mass != both.mass


@pytest.mark.slow(sanitized=True)
def test_each_kind_of_legs_keeps_its_own_limit_of_the_study(machine):
    limits = {"force": (None, 500.0), "upper_force": (None, 90.0), "lower_force": (None, 400.0)}
    limited = replace(machine, study=replace(machine.study, constraints=limits))
    payload = nd.largest_payload(limited)
    assert_allclose(payload.limits, [np.repeat([500.0, 90.0, 400.0], 3)] * 2)
    assert payload.mass == nd.largest_payload(machine, np.repeat([500.0, 90.0, 400.0], 3)).mass
    assert payload.leg[0] == "q"
    alone = replace(machine, study=replace(machine.study, constraints={"external_force": (None, 200.0)}))
    assert_allclose(nd.largest_payload(alone).limits[0], np.repeat([200.0, np.inf, np.inf], 3))
    level = nd.largest_payload(nd.Design(HEXAGONS, HOME), np.repeat([200.0, np.inf, np.inf], 3))
    assert (level.mass, level.leg) == (np.inf, "")  # the external legs carry no weight there


def test_a_machine_that_holds_nothing_and_one_that_holds_all(level):
    none = nd.largest_payload(level, 1.0, samples=500)
    assert (none.mass, none.fits) == (0.0, False)
    assert np.abs(none.forces).max() > 1.0
    assert none.leg == "l1 l2 l3 q1 q2 q3 r1 r2 r3".split()[int(np.argmax(np.abs(none.forces)))]
    everything = nd.largest_payload(nd.Design(HEXAGONS, HOME), np.inf)
    assert (everything.mass, everything.leg, everything.fits) == (np.inf, "", True)
    for bad in (-1.0, np.nan, [1.0, 2.0], "x"):
        with pytest.raises(ValueError, match="force: got"):
            nd.largest_payload(level, bad)


@pytest.mark.slow(sanitized=True)
def test_the_sheet_has_the_drives(machine):
    """Forces include the weights of the legs; power is force times speed at one pose."""
    one = machine.sheet()
    assert "masses" in one.stated
    ends = one.forces()
    c = one.configurations
    for k, wrench in enumerate(machine.study.loads.wrenches):
        f = np.array([forces_under(machine, c[n], 0.0, np.array(wrench)) for n in range(len(c))])
        assert_allclose(ends[k], [f.min(axis=0), f.max(axis=0)], atol=1e-5)
    for leg, (low, high) in zip(one.legs, zip(*np.abs(ends).max(axis=0), strict=True), strict=True):
        assert 0.0 <= leg.power <= max(low, high) * leg.speed * (1.0 + 1e-12)
