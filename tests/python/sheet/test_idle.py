"""A leg that never moves: one definition, whatever asks, in any unit; against lengths in extended precision."""

import numpy as np
import pytest
from sizes import size

import ninedof as nd
from ninedof.robot.geometry import LEGS
from ninedof.robot.idle import IDLE, idle_legs


def lengths(g, c):
    """Leg lengths of a stack in extended precision, shape (n, 9)."""
    x = np.longdouble
    p, q, s = x(c.position)[:, None], x(c.rotation), x(c.internal_point)[:, None]
    moved, upper = (p + x(u) @ np.swapaxes(q, 1, 2) for u in (g.platform_external, g.platform_internal))
    legs = np.concatenate([moved - x(g.base_external), s - upper, s - x(g.base_internal)], axis=1)
    return np.sqrt((legs**2).sum(axis=-1))


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("unit", [1e-6, 1.0, 350.0, 1e9])
def test_every_place_names_the_same_legs(unit):
    """Strokes from 1e-13 to 1e-7 of the longest leg, of legs of very different lengths."""
    rng = np.random.default_rng(8)
    seen = {True: 0, False: 0}
    for _ in range(size(25, 1_000)):
        sizes = unit * np.exp(rng.uniform(-2.0, 1.0, size=4))
        g = nd.Geometry(*(a * rng.normal(size=(3, 3)) for a in sizes))
        home = nd.Configuration(
            unit * np.array([0.1, 0.2, 4.0]), None, unit * np.array([0.0, 0.1, rng.uniform(0.2, 3.8)])
        )
        shift = unit * 10.0 ** rng.uniform(-13.0, -6.0) * rng.normal(size=3)
        moving = nd.Trajectory.line(home, shift, points=5)
        found = nd.follow(g, moving, home, "held")
        exact = lengths(g, found.configurations)
        share = np.ptp(exact, axis=0) / exact.max()
        if (abs(share / 1e-9 - 1.0) < 1e-3).any():  # too near to tell in double precision
            continue
        expected = tuple(leg for leg, s in zip(LEGS, share, strict=True) if s <= 1e-9)
        assert found.idle_legs == expected
        assert nd.sheet(g, found.configurations).idle == expected
        assert tuple(np.array(LEGS)[idle_legs(found.leg_lengths)]) == expected
        for s in share[:6]:
            seen[bool(s <= IDLE)] += 1
    assert min(seen.values()) > size(25, 1_000)


def test_at_a_single_pose_nothing_is_idle():
    assert not idle_legs(np.ones((1, 9))).any()
    assert idle_legs(np.ones((2, 9))).all()
