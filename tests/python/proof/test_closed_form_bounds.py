"""The closed form over intervals against balls of 400 bits, which know nothing of the symmetry.

The oracle of hexagonal designs has its joints from eqs. (37)-(38) with the square root of 3 as a ball; the general one
turns the first joint of each orbit by 120 degrees in balls.
"""

import numpy as np
import pytest
from exact_robot import ExactRobot
from flint import arb, ctx
from numpy.testing import assert_array_equal
from sizes import size

import ninedof as nd

COUNT = size(300, 10_000)


class ExactHexagonal(ExactRobot):
    """The neutral configuration of a hexagonal design, from its six numbers."""

    def __init__(self, a1, a2, b1, b2, zp, zs):
        ctx.prec = 400
        a1, a2, b1, b2, zp, zs = (arb(float(x)) for x in (a1, a2, b1, b2, zp, zs))
        k, zero = arb(3).sqrt() / 6, arb(0)

        def joints(s, t):
            return [[s / 2, -k * (s + 2 * t), zero], [-(s + t) / 2, -k * (s - t), zero], [t / 2, k * (2 * s + t), zero]]

        def mirrored(three):
            return [[-three[i][0], three[i][1], three[i][2]] for i in (0, 2, 1)]

        base, platform = joints(a1, a2), joints(b1, b2)
        self.set(base, mirrored(base), platform, mirrored(platform), zp, zs)

    def set(self, r, rh, u, ut, zp, zs):
        self.y, self.u, self.ut = [arb(0), arb(0), zs - zp], u, ut
        self.external = [[v[0] - b[0], v[1] - b[1], v[2] + zp - b[2]] for v, b in zip(u, r, strict=True)]
        self.upper = [[-v[0], -v[1], zs - zp - v[2]] for v in ut]
        self.lower = [[-b[0], -b[1], zs - b[2]] for b in rh]


class ExactOrbits(ExactHexagonal):
    """The first joints of four orbits and the heights of p and s."""

    def __init__(self, g, c):
        ctx.prec = 400
        half, root = arb(-1) / 2, arb(3).sqrt() / 2

        def orbit(x, y, z):
            # R by -120 degrees, twice.
            return [
                [x, y, z],
                [half * x + root * y, -root * x + half * y, z],
                [half * x - root * y, root * x + half * y, z],
            ]

        def first(joint):
            return orbit(*(arb(float(v)) for v in joint[0]))

        def turned(joint):
            q = [[arb(float(v)) for v in row] for row in c.rotation]
            v = [arb(float(x)) for x in joint[0]]
            return orbit(*(sum((a * b for a, b in zip(row, v, strict=True)), arb(0)) for row in q))

        zp, zs = arb(float(c.position[2])), arb(float(c.internal_point[2]))
        external, internal = turned(g.platform_external), turned(g.platform_internal)
        self.set(first(g.base_external), first(g.base_internal), external, internal, zp, zs)


def outside(lower, exact, upper):
    return exact < float(lower) or (upper != np.inf and exact > float(upper))


def designs(rng, count):
    """Regular designs, coupled joints, and designs near a singular one, where a1 b2 = a2 b1."""
    x = rng.uniform(0.3, 6.0, size=(6, count))
    x[5] = x[4] * rng.uniform(0.1, 0.9, size=count)
    kind = rng.integers(5, size=count)
    x[0, kind == 0] = 0.0
    x[3, kind == 0] = 0.0
    near = kind == 1
    x[3, near] = x[2, near] * x[1, near] / x[0, near] * (1.0 + 10.0 ** rng.uniform(-15, -3, size=near.sum()))
    x[5, kind == 2] = x[4, kind == 2] * rng.uniform(1.1, 2.0, size=(kind == 2).sum())  # O above the platform
    unit = np.where(kind == 3, 10.0 ** rng.uniform(-40, 40, size=count), 1.0)
    return x * unit


def test_hexagonal_designs_are_enclosed_however_near_a_singular_one():
    x = designs(np.random.default_rng(37), COUNT)
    lower, upper = nd.hexagonal_condition_number_bounds(*x)
    exact = [ExactHexagonal(*one).condition_number() for one in x.T.tolist()]
    assert not any(outside(*one) for one in zip(lower, exact, upper, strict=True))
    relative = (upper - lower) / lower
    assert np.median(relative) < 1.1e-14
    assert relative.max() < 1e-13  # O above the platform: sides cancel in zs u + (zp - zs) r
    assert max(float(value) for value in exact) > 1e12


def test_the_optimum_of_the_paper_to_fourteen_digits():
    """Its value to 28 digits is that of a 50-digit solution of the optimality conditions."""
    base, platform, zp, zs = 6.007939847065024575, 3.003969923532512288, 4.975249623427800545, 3.168075896437499051
    lower, upper = nd.hexagonal_condition_number_bounds(0.0, base, platform, 0.0, zp, zs)
    assert lower <= 3.7626590785960471961291633148 <= upper
    assert (upper - lower) / lower < 1.2e-14


def test_general_orbits_are_enclosed():
    rng = np.random.default_rng(39)
    for _ in range(COUNT // 2):
        radius, angle, height = rng.uniform(0.3, 3.0, 4), rng.uniform(-3, 3, 4), rng.normal(size=4)
        orbits = [tuple(map(float, o)) for o in zip(radius, angle, height, strict=True)]
        g = nd.Geometry.symmetric(*orbits)
        zp = rng.uniform(1.0, 5.0)
        c = nd.Configuration.neutral(zp, zp * rng.uniform(0.1, 0.9), rng.uniform(-1.0, 1.0))
        lc = 10.0 ** rng.uniform(-1, 1)
        lower, upper = nd.axis_condition_number_bounds(g, c, lc)
        assert not outside(lower, ExactOrbits(g, c).condition_number(lc), upper)
        assert (upper - lower) / lower < 2e-12


def test_singular_and_missing_designs():
    lower, upper = nd.hexagonal_condition_number_bounds(
        [1.0, 0.0, np.nan], 2.0, [0.5, 2.0, 2.0], [1.0, 0.0, 0.0], 3.0, 1.0
    )
    assert_array_equal(np.isinf(upper), [True, False, False])
    assert lower[0] > 1e12
    assert np.isnan(lower[2])
    assert np.isnan(upper[2])
    assert nd.hexagonal_condition_number_bounds(0.0, 1.0, [], 0.0, 2.0, 1.0).lower.shape == (0,)
    with pytest.raises(ValueError, match="zp: got an infinite number"):
        nd.hexagonal_condition_number_bounds(0.0, 1.0, 1.0, 0.0, np.inf, 1.0)
    tilted = nd.Configuration([0, 0, 3.0], [[1, 0, 0], [0, 0, -1], [0, 1, 0]], [0, 0, 1.0])
    with pytest.raises(ValueError, match="rotation: got a tilted platform"):
        nd.axis_condition_number_bounds(nd.Geometry.hexagonal(0.0, 2.0, 1.0, 0.0), tilted)
