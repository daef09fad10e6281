"""Tracking: the certified mode against the list of all modes, and the ways to lose it."""

import json
import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from reference_cases import REFERENCE, of_case, rotation
from robots import any_pose
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

SEEDED = [c for c in json.loads((REFERENCE / "forward.json").read_text(encoding="utf-8"))["cases"] if "seed" in c]


@pytest.fixture
def home():
    return nd.Configuration.neutral(3.9828, 2.4435)


@pytest.mark.parametrize("case", SEEDED, ids=lambda c: f"{c['id']}-{c['tags'][0]}")
def test_reference_seeds_lead_to_their_mode(case):
    g, lengths = of_case(case)
    seed, target = case["seed"], case["solutions"][case["seed"]["target"]]
    start = nd.Configuration(seed["p"], rotation(seed["quat"]), seed["s"])
    there = nd.track(g, lengths, start)
    assert there.status == "tracked"
    assert there.steps == 1
    assert abs(there.rotation - rotation(target["quat"])).max() <= case["tol"]
    assert abs(there.position - target["p"]).max() <= case["tol"] * lengths.max()
    assert_allclose(there.separation, target["sigma_rot"], rtol=1e-6)


def test_the_reference_has_seeds():
    assert len(SEEDED) > 10


def test_certificate_is_kantorovichs_number(published, home):
    """Sqrt(3) beta eta, from its definition by finite differences on the sphere of rotations."""
    target = home.moved(0.03 * np.arange(-4.0, 5.0))
    lengths = nd.leg_lengths(published, target)
    there = nd.track(published, lengths, home)
    s, o = there.internal_point, there.rotation.T @ (there.internal_point - there.position)
    d, w = published.base_external - s, published.platform_external - o
    dn, wn = np.linalg.norm(d, axis=1), np.linalg.norm(w, axis=1)
    d, w, c = d / dn[:, None], w / wn[:, None], (dn**2 + wn**2 - lengths[:3] ** 2) / (2.0 * dn * wn)

    def f(x):
        return np.einsum("ij,jk,ik->i", d, Rotation.from_rotvec(x).as_matrix() @ home.rotation, w) - c

    step = 1e-6
    j = np.stack([(f(step * e) - f(-step * e)) / (2.0 * step) for e in np.eye(3)], axis=1)
    beta = 1.0 / np.linalg.svd(j, compute_uv=False)[-1]
    eta = np.linalg.norm(np.linalg.solve(j, f(np.zeros(3))))
    assert_allclose(there.certificate, np.sqrt(3.0) * beta * eta, rtol=1e-8)
    h = there.certificate
    assert_allclose(there.alone_within, (1.0 + np.sqrt(1.0 - 2.0 * h)) / (np.sqrt(3.0) * beta), rtol=1e-8)


def lines(rng, count):
    """Robots, configurations and the ends of straight lines of lengths, short and long, with and without a fold."""
    while count > 0:
        g, c = any_pose(rng, rng.random() < 0.5)
        move = np.exp(rng.uniform(np.log(0.02), np.log(2.0))) * rng.normal(size=9)
        end = nd.leg_lengths(g, c.moved(move)) if rng.random() < 0.5 else nd.leg_lengths(g, c) + move
        if end.min() > 0.01:
            count -= 1
            yield g, c, end


def modes(g, lengths):
    result = nd.forward_position(g, lengths)
    return len(result.position)


@pytest.mark.slow
def test_a_mode_is_lost_where_the_list_of_all_modes_gets_shorter():
    """Against `forward_position`: at a fold two modes end; just before it they are there, and just beyond they are not.

    Lines that pass near a singularity were lost, where the same lines divided otherwise were not.
    """
    rng = np.random.default_rng(3)
    counts = dict.fromkeys(nd.TrackStatus, 0)
    for g, c, end in lines(rng, size(6_000, 200_000)):
        there, start = nd.track(g, end, c), nd.leg_lengths(g, c)
        counts[there.status] += 1
        if there.status in ("tracked", "infeasible"):
            continue
        assert there.status == "lost"
        near = np.clip(there.reached + np.array([-1e-7, 1e-7]), 0.0, 1.0)
        before, after = (modes(g, start + t * (end - start)) for t in near)
        assert after < before
    assert min(counts["tracked"], counts["lost"], counts["infeasible"]) > size(1_000, 30_000)


def test_a_trajectory_is_its_steps(published, home):
    t = np.linspace(0.0, 2.0 * np.pi, 60)[:, None]
    a, b, c, ramp = np.sin(t), np.sin(2.0 * t), np.cos(t) - 1.0, t / 6.0
    moves = (0.2 * a, 0.1 * c, 0.2 * b, 0.4 * a, 0.3 * ramp, 0.2 * b, 0.1 * ramp, 0.2 * a, 0.2 * b)
    path = home.moved(np.hstack(moves))
    lengths = nd.leg_lengths(published, path)
    there = nd.track(published, lengths, home)
    assert there.shape == (60,)
    assert set(there.status) == {"tracked"}
    assert_allclose(there.position, path.position, atol=1e-11)
    assert_allclose(there.rotation, path.rotation, atol=1e-11)
    assert there.certificate.max() <= 0.5
    at = home
    for k in range(60):
        at = nd.track(published, lengths[k], at)
        assert_array_equal(at.rotation, there.rotation[k])
        assert at.certificate == there.certificate[k]


def test_shapes(published, home):
    lengths = nd.leg_lengths(published, home)
    stack = home.moved(0.01 * np.random.default_rng(0).normal(size=(4, 9)))
    assert nd.track(published, lengths, home).shape == ()
    assert nd.track(published, lengths, stack).shape == (4,)
    assert nd.track(published, np.tile(lengths, (4, 1)), stack).shape == (4,)
    assert nd.track(published, np.tile(lengths, (4, 6, 1)), stack).shape == (4, 6)
    assert nd.track(published, np.tile(lengths, (6, 1)), home).shape == (6,)
    assert nd.track(published, np.tile(lengths, (1, 6, 1)), stack).shape == (4, 6)
    one, two = (nd.track(published, lengths, stack, threads=n) for n in (1, 2))
    assert_array_equal(one.rotation, two.rotation)
    assert_array_equal(one.rotation[2], nd.track(published, lengths, stack[2]).rotation)
    with pytest.raises(ValueError, match="leading dimensions"):
        nd.track(published, np.ones((3, 9)), stack)


def test_missing_rows(published, home):
    lengths = np.tile(nd.leg_lengths(published, home), (4, 1))
    lengths[2, 0] = np.nan
    assert list(nd.track(published, lengths, home).status) == ["tracked", "tracked", "unproved", "unproved"]
    stack = nd.Configuration(np.tile(home.position, (4, 1)), home.rotation, home.internal_point)
    assert list(nd.track(published, lengths, stack).status) == ["tracked", "tracked", "unproved", "tracked"]


def test_an_end_in_a_plane_is_lost(published, home):
    end = nd.Configuration(home.position, home.rotation, [0.0, 0.0, 0.0])
    assert nd.track(published, nd.leg_lengths(published, end), home).status == "lost"


def test_a_start_in_a_plane_has_no_side(published):
    start = nd.Configuration([0.0, 0.0, 3.0], None, [0.1, 0.2, 0.0])
    there = nd.track(published, nd.leg_lengths(published, start), start)
    assert (there.status, there.steps) == ("lost", 0)


def test_what_comes_back(published, home):
    there = nd.track(published, nd.leg_lengths(published, home), home)
    assert isinstance(there, nd.Configuration)
    assert repr(there).startswith("<tracked: Configuration(position=")
    assert there.certificate < 1e-12
    again = pickle.loads(pickle.dumps(there))
    assert again == there
    assert (again.status, again.certificate) == (there.status, there.certificate)


@pytest.mark.parametrize("plate", [1, 3], ids=["base", "platform"])
@pytest.mark.parametrize(("width", "status"), [(1e-4, "tracked"), (1e-13, "unproved"), (1e-15, "unproved")])
def test_a_plate_too_small_to_place_o_proves_nothing(plate, width, status):
    """Three internal legs from nearly one point: O moves freely about it, and the condition number is infinite."""
    rng = np.random.default_rng(1)
    for _ in range(20):
        triples = rng.normal(size=(4, 3, 3))
        # In the plane x + y + z = 0 of the middle, so that rounding leaves a triangle.
        triples[plate] = width * np.array([[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [-1.0, 0.0, 1.0]])
        _, start = any_pose(rng, hexagonal=False)
        g = nd.Geometry(*triples)
        there = nd.track(g, nd.leg_lengths(g, start), start)
        assert there.status == status
        assert (nd.condition_number(g, start) > 1e12) == (status == "unproved")


@pytest.mark.parametrize("digits", [9.5, 11.0, 13.0, 15.0])
def test_a_start_whose_rotation_is_orthogonal_to_fewer_digits(digits):
    """Such as one from a file: accepted to 1e-9. The first row of its own lengths is tracked too."""
    rng = np.random.default_rng(17)
    for _ in range(20):
        g, c = any_pose(rng, hexagonal=True)
        off = 10.0**-digits * rng.uniform(-0.4, 0.4, size=(3, 3))
        start = nd.Configuration(c.position, c.rotation + off, c.internal_point)
        modes = nd.track(g, [nd.leg_lengths(g, start)] * 2, start)
        assert (modes.status == "tracked").all()
        assert np.abs(modes.rotation - c.rotation).max() < 1e-5
