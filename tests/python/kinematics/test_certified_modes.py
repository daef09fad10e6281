"""The number of assembly modes with its proof: against the methods without one, against 50 digits, at double modes.

The reference solves the nine lengths in decimal arithmetic and shares no code with the package.
"""

import json
from decimal import Decimal, getcontext

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from reference_cases import REFERENCE, of_case, rotation
from robots import any_pose, flat
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

getcontext().prec = 60
CASES = json.loads((REFERENCE / "forward.json").read_text(encoding="utf-8"))["cases"]


def certified(g, lengths):
    modes = nd.forward_position(g, lengths, certify=True)
    return modes, modes.certificate


def error(c, p, q, s, unit):
    """As ModesCertificate.radius measures it."""
    turned, moved, shifted = (
        abs(exact(a) - b).max()
        for a, b in ((c.rotation, exact(q)), (c.position, exact(p)), (c.internal_point, exact(s)))
    )
    return float(max(turned, max(moved, shifted) / Decimal(unit)))


def exact(values):
    return np.vectorize(Decimal, otypes=[object])(values)


# --- 50 digits --------------------------------------------------------------------------------------------------------


def turn(z):
    """The rotation of a quaternion that need not have length 1."""
    w, v = z[0], z[1:]
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]], dtype=object)
    return ((w * w - v @ v) * np.eye(3, dtype=int) + 2 * np.outer(v, v) + 2 * w * cross) / (z @ z)


def in_digits(g, lengths, c):
    """p, Q and s near a mode, to 50 digits: Newton's method with a derivative in doubles."""
    r, rh, u, ut = (exact(t) for t in (g.base_external, g.base_internal, g.platform_external, g.platform_internal))
    target = exact(lengths)

    def residual(x):
        p, z, s = x[:3], x[3:7], x[7:]
        q = turn(z)
        legs = np.concatenate([p + u @ q.T - r, p + ut @ q.T - s, s - rh])
        return np.append((legs * legs).sum(axis=1) - target * target, z @ z - 1)

    wxyz = np.roll(Rotation.from_matrix(c.rotation).as_quat(), 1)
    x, step = exact(np.concatenate([c.position, wxyz, c.internal_point])), Decimal(10) ** -25
    at = residual(x)
    slopes = np.array([(residual(x + step * row) - at) / step for row in np.eye(10, dtype=int)], dtype=float).T
    for _ in range(40):
        change = np.linalg.solve(slopes, np.array(at, dtype=float))
        x = x - exact(change)
        at = residual(x)
        if max(abs(at)) < Decimal(10) ** -50:
            return x[:3], turn(x[3:7]), x[7:]
    raise AssertionError("no convergence")


@pytest.mark.parametrize("hexagonal", [True, False])
def test_every_enclosure_holds_the_mode_in_fifty_digits(hexagonal):
    rng = np.random.default_rng(31)
    looked_at = 0
    for _ in range(size(6, 60)):
        g, c = any_pose(rng, hexagonal)
        lengths = nd.leg_lengths(g, c)
        modes, proof = certified(g, lengths)
        for k in range(modes.count):
            p, q, s = in_digits(g, lengths, modes[k])
            off = error(modes[k], p, q, s, lengths.max())
            assert off <= proof.radius[k] < 1e-7
            looked_at += 1
    assert looked_at > 20


# --- The number -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("case", CASES, ids=lambda c: f"{c['id']}-{'-'.join(c['tags'])}".replace(" ", "_"))
def test_reference_cases(case):
    g, lengths = of_case(case)
    modes, proof = certified(g, lengths)
    if "degenerate" in case["tags"]:
        assert not proof.complete
        assert (proof.proved, proof.undecided > 0) == (0, True)
        return
    assert proof.complete
    assert proof.proved == modes.count == case["count"]
    assert proof.boxes > proof.proved or not proof.proved
    assert repr(modes).startswith(f"<{case['count']} assembly modes: {modes.status}, proved")
    for k in range(modes.count):
        errors = [
            error(modes[k], np.array(x["p"]), rotation(x["quat"]), np.array(x["s"]), lengths.max())
            for x in case["solutions"]
        ]
        assert min(errors) < proof.radius[k] + case["tol"]


# --- Where nothing can be decided -------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["lower plane", "upper plane", "leg through O"])
def test_singular_to_the_last_bit(kind):
    m = flat(kind)
    g, c = nd.Geometry(m.r, m.rh, m.u, m.ut), nd.Configuration(m.p, m.Q, m.s)
    _, proof = certified(g, nd.leg_lengths(g, c))
    assert not proof.complete
    near = [error(proof.places[k], m.p, m.Q, m.s, 5.0) for k in range(proof.undecided)]
    inside = [off <= 1.01 * radius + 1e-7 for off, radius in zip(near, proof.place_radius, strict=True)]
    assert any(inside)


@pytest.mark.parametrize("axis", range(3))
def test_a_hair_beside_a_double_mode_is_decided_or_not_but_never_wrong(axis):
    """The generating pose is a mode of nearly these lengths: a complete proof near it has two modes there, or none."""
    g = nd.Geometry.hexagonal(0.0, 4.0, 0.0, 3.0)
    for power in range(-9, -2):
        turned = nd.Configuration.neutral(3.0, 2.0).moved(10.0**power * np.eye(9)[axis])
        modes, proof = certified(g, nd.leg_lengths(g, turned))
        assert proof.proved % 2 == 0
        if proof.complete and power > -7:
            off = [
                error(modes[k], turned.position, turned.rotation, turned.internal_point, 5.0) for k in range(len(modes))
            ]
            assert min(off) < 1e-6


# --- Stacks and arguments ---------------------------------------------------------------------------------------------


def test_a_stack_has_the_certificates_of_its_rows(published):
    rng = np.random.default_rng(2)
    home = nd.Configuration.neutral(3.9828, 2.4)
    lengths = nd.leg_lengths(published, home.moved(0.3 * rng.normal(size=(2, 3, 9))))
    lengths[1, 1, 4] = np.nan
    lengths[0, 2, 6:] *= 0.1
    g = nd.Geometry.hexagonal(0.0, 4.0, 0.0, 3.0)
    lengths[1, 2] = nd.leg_lengths(g, nd.Configuration.neutral(3.0, 2.0))
    stack, proof = certified(g, lengths)
    assert stack.shape == proof.radius.shape
    assert proof.places.shape == proof.place_radius.shape == (2, 3, proof.undecided.max())
    for k in np.ndindex(2, 3):
        if k == (1, 1):
            assert (proof.complete[k], proof.proved[k], proof.undecided[k]) == (False, 0, 0)
            continue
        alone, one = certified(g, lengths[k])
        n, left = alone.count, one.undecided
        values = (stack.count[k], proof.complete[k], proof.proved[k], proof.undecided[k], proof.boxes[k])
        assert values == (n, one.complete, one.proved, left, one.boxes)
        assert_array_equal(stack.position[k][:n], alone.position)
        assert_array_equal(proof.radius[k][:n], one.radius)
        assert np.isnan(proof.radius[k][n:]).all()
        assert_array_equal(proof.places.position[k][:left], one.places.position)
    assert not proof.complete[1, 2]


def test_without_certify_there_is_no_certificate(published, neutral):
    lengths = nd.leg_lengths(published, neutral)
    assert nd.forward_position(published, lengths).certificate is None
    with pytest.raises(ValueError, match="certify: got 1, expected True or False"):
        nd.forward_position(published, lengths, certify=1)
    none = nd.forward_position(published, np.zeros((0, 9)), certify=True)
    assert none.certificate.complete.shape == (0,)
