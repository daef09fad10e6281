"""The part of a path that is free of singularities.

Oracle: the three determinants by numpy along the path written out with scipy rotations, sampled densely and their first
change of sign solved by Brent's method; where the answer is known, geometry.
"""

import numpy as np
import numpy_model as model
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from singular_robots import unit_rows

import ninedof as nd

MOST = 3.0
KINDS = pytest.mark.parametrize("kind", ["screw", "turn", "shift", "mostly turn"])


def direction(rng, kind):
    t = rng.normal(size=9)
    if kind == "turn":
        t[3:] = 0.0
    if kind == "shift":
        t[:3] = 0.0
    if kind == "mostly turn":
        t[3:] *= 0.05
    return t


def along(m, tangent, t):
    """The robot at the times t of the path, as a stack."""
    t = np.atleast_1d(t)[:, None]
    turn = Rotation.from_rotvec(t * tangent[:3]).as_matrix()
    return m._replace(p=m.p + t * tangent[3:6], Q=turn @ m.Q, s=m.s + t * tangent[6:])


def determinants(m, tangent, t):
    return np.linalg.det(np.stack(unit_rows(along(m, tangent, t))))


def first_crossings(m, tangent, most, samples=4001):
    times = np.linspace(0.0, most, samples)
    out = []
    for k, values in enumerate(determinants(m, tangent, times)):
        crossing = np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))
        if not len(crossing):
            out.append(np.inf)
            continue
        bracket = times[crossing[0]], times[crossing[0] + 1]
        out.append(brentq(lambda t, k=k: determinants(m, tangent, t)[k, 0], *bracket, xtol=1e-15, rtol=1e-14))
    return np.array(out)


@KINDS
def test_against_dense_sampling_and_root_finding(kind):
    rng = np.random.default_rng(11)
    robots = model.random_robots(rng, 30, tilt=1.5)
    found_some = np.zeros(3, dtype=int)
    for n in range(30):
        m, tangent = robots.at(n), direction(rng, kind)
        expected = first_crossings(m, tangent, MOST)
        result = nd.distance_to_singularity(m.geometry(), m.configuration(), tangent, most=MOST)
        assert result.resolved
        assert result.distance == result.each.min()
        if np.isfinite(result.distance):
            assert result.mechanism == "nbc"[int(np.argmin(result.each))]
            assert_allclose(
                nd.singularity_margins(m.geometry(), m.configuration().moved(result.distance * tangent))[
                    "nbc".index(result.mechanism)
                ],
                0.0,
                atol=1e-11,
            )
        else:
            assert result.mechanism is nd.Mechanism.NONE
        for k in range(3):
            # Sampling may miss a pair of crossings; what it finds must be found, and nothing else but such a pair.
            assert result.each[k] <= expected[k] + 1e-11
            if result.each[k] < expected[k] - 1e-11:
                close = result.each[k] + np.linspace(0.0, MOST / 4000, 2001)
                values = determinants(m, tangent, close)[k]
                assert values.min() <= 1e-12
                assert values.max() >= -1e-12
            found_some[k] += np.isfinite(result.each[k])
    # A plane of O's is met in about half of the moves; a turn of the platform is nothing to the lower legs.
    assert (found_some[[0, 2]] >= 8).all()
    assert found_some[1] >= 8 or kind in ("turn", "mostly turn")
    assert kind != "turn" or found_some[1] == 0


@pytest.mark.parametrize("gap", [1e-1, 1e-3, 1e-5, 1e-7])
def test_a_short_excursion_through_a_singularity_is_not_stepped_over(gap):
    """Two external legs point at O at times a gap apart: det N changes sign for no longer than that."""
    rng = np.random.default_rng(12)
    crossings = 0
    for _ in range(30):
        m, tangent = model.random_robots(rng, 1).at(0), direction(rng, "screw")
        base = m.r.copy()
        for i, t in enumerate((0.5, 0.5 + gap)):
            then = along(m, tangent, t)
            head, o = then.p[0] + then.Q[0] @ m.u[i], then.s[0]
            base[i] = o - rng.uniform(0.5, 1.5) * (head - o)
        m = m._replace(r=base)
        before, between, after = determinants(m, tangent, [0.5 - gap, 0.5 + gap / 2, 0.5 + 2 * gap])[0]
        if not (before * after > 0.0 > before * between):
            continue  # a third zero close by
        result = nd.distance_to_singularity(m.geometry(), m.configuration(), tangent).each[0]
        assert result <= 0.5 + 1e-10
        if result > 0.5 - gap:
            assert_allclose(result, 0.5, rtol=0.0, atol=1e-13 / gap)
            crossings += 1
    assert crossings >= 10
