"""Architecture singularities: the proof by computer algebra, the classes in exact arithmetic, distances by search."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof import _core

flint = pytest.importorskip("flint")

LINE = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.5], [3.0, 6.0, 1.5]]
INTERNAL = [[2.0, 0.0, 0.0], [-1.0, 2.0, 0.0], [-1.0, -2.0, 0.5]]
TURNED = ((2, -10, 11), (14, 5, 2), (-5, 10, 10))  # over 15: an exact rotation in no special position


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b, strict=True))


def minus(a, b):
    return [p - q for p, q in zip(a, b, strict=True)]


def times(k, a):
    return [k * q for q in a]


def numerator(x, y, base, platform):
    """det[d_i x w_i] with d_i = base_i - x, w_i = platform_i - y."""
    rows = [cross(minus(r, x), minus(v, y)) for r, v in zip(base, platform, strict=True)]
    return dot(rows[0], cross(rows[1], rows[2]))


# --- The proof of docs/theory/singularity.md, as identities of polynomials with rational coefficients -----------------


def symbols():
    names = [f"{letter}{axis}" for letter in ("x", "y", "rho2_", "rho3_", "nu2_", "nu3_") for axis in "xyz"]
    context = flint.fmpq_mpoly_ctx.get((*names, "tau"), "lex")
    *all_of_them, tau = context.gens()
    return context, [list(all_of_them[k : k + 3]) for k in range(0, 18, 3)], tau


def part(context, polynomial, degree):
    """Its terms of a degree in x and y."""
    return context.from_dict({powers: c for powers, c in polynomial.to_dict().items() if sum(powers[:6]) == degree})


def test_the_highest_terms_factor_as_the_proof_says():
    context, (x, y, rho2, rho3, nu2, nu3), _ = symbols()
    zero = times(0, x)
    p, m = numerator(x, y, [zero, rho2, rho3], [zero, nu2, nu3]), cross(x, y)
    fourth = dot(rho2, m) * dot(nu3, m) - dot(rho3, m) * dot(nu2, m)
    assert max(sum(powers[:6]) for powers in p.to_dict()) == 4
    assert part(context, p, 4) == fourth


def test_triples_on_lines_divided_alike_leave_terms_of_third_degree():
    context, (x, y, rho, _, nu, _), tau = symbols()
    zero = times(0, x)
    p, m, k = numerator(x, y, [zero, rho, times(tau, rho)], [zero, nu, times(tau, nu)]), cross(x, y), cross(rho, nu)
    third = (tau * tau - tau) * (dot(rho, m) * dot(k, y) - dot(nu, m) * dot(k, x))
    assert part(context, p, 4) == 0
    assert part(context, p, 3) == third
    assert third != 0


def test_each_class_makes_the_determinant_the_zero_polynomial():
    _, (x, y, rho2, rho3, nu2, nu3), tau = symbols()
    zero = times(0, x)
    for base, platform in (
        ([zero, zero, zero], [zero, nu2, nu3]),
        ([zero, rho2, rho3], [zero, zero, zero]),
        ([zero, zero, rho3], [zero, zero, nu3]),
        ([zero, rho2, zero], [zero, nu2, zero]),
        ([zero, rho2, rho2], [zero, nu2, nu2]),
        ([zero, times(tau, nu2), times(tau, nu3)], [zero, nu2, nu3]),  # similar and parallel, at this orientation
    ):
        assert numerator(x, y, base, platform) == 0


# --- The classes in exact arithmetic, beside what the core refuses ----------------------------------------------------


def exact_designs(number):
    """Pairs of triples of small whole numbers, most of them degenerate in some way."""
    rng = np.random.default_rng(11)
    for _ in range(number):
        size = rng.integers(2, 4)
        yield tuple(rng.integers(0, size, (2, 3, 3)) * rng.integers(0, 2, (2, 1, 3)))


def exact_poses(count=3):
    rng = np.random.default_rng(12)
    for _ in range(count):
        yield [[Fraction(int(k), 97) for k in row] for row in rng.integers(-400, 400, (2, 3))]


def vanishes(base, platform, rotation):
    """Whether det N is 0 at some positions of an orientation, none of them special."""
    turned = [[dot(row, joint) for row in rotation] for joint in platform]
    return all(numerator(x, y, base, turned) == 0 for x, y in exact_poses())


def refusal(base, platform):
    """The message of the error for external joints, None if there is none."""
    try:
        nd.Geometry(base.astype(float), INTERNAL, platform.astype(float), INTERNAL)
    except ValueError as error:
        return str(error)
    return None


def test_a_geometry_is_refused_exactly_if_det_n_is_0_at_all_poses():
    rotation = [[Fraction(k, 15) for k in row] for row in TURNED]
    counts = {True: 0, False: 0, "on a line": 0}
    for base, platform in exact_designs(600):
        lost = vanishes(base.tolist(), platform.tolist(), rotation)
        error = refusal(base, platform)
        assert (error is not None) == lost
        assert error is None or "det N is 0 at every pose" in error
        counts["on a line"] += not lost and np.linalg.matrix_rank(base[1:] - base[0]) < 2
        counts[lost] += 1
    assert min(counts.values()) > 50


def test_det_n_is_0_at_all_positions_of_an_orientation_exactly_if_the_triangles_are_similar_and_parallel():
    seen = {True: 0, False: 0}
    here = np.eye(3)
    for base, platform in itertools.islice(exact_designs(1500), 1500):
        platform = base * -2 + 1 if seen[True] < seen[False] else platform
        if refusal(base, platform) is not None:
            continue
        g = nd.Geometry(base.astype(float), INTERNAL, platform.astype(float), INTERNAL)
        lost = vanishes(base.tolist(), platform.tolist(), here.astype(int).tolist())
        assert (_core.homothety_residual(g, nd.Configuration([0, 0, 1], here, [0, 0, 0.5])) < 1e-12) == lost
        seen[lost] += 1
    assert min(seen.values()) > 100


def test_what_is_refused_within_rounding_says_so():
    with pytest.raises(ValueError, match=r"det B is 0 at every pose, to 1e-9 of the size, expected"):
        nd.Geometry(INTERNAL, [[0, 0, 0], [1, 1e-10, 0], [2, 0, 0]], INTERNAL, INTERNAL)
    turned = [INTERNAL[0], INTERNAL[1], np.negative(INTERNAL[2])]
    with pytest.raises(ValueError, match=r"with the same joints: det N is 0 at every pose, to 1e-9 of the size"):
        nd.Geometry(
            [INTERNAL[0], np.add(INTERNAL[0], 1e-10), INTERNAL[2]],
            INTERNAL,
            [INTERNAL[0], INTERNAL[0], turned[2]],
            INTERNAL,
        )


def test_external_joints_on_a_line_make_a_machine():
    """Finite condition number, and the position problem finds the pose from its leg lengths."""
    g = nd.Geometry(LINE, INTERNAL, np.array(INTERNAL)[::-1] * [1.0, 0.5, 1.0], INTERNAL)
    c = nd.Configuration([0.2, 0.1, 4.0], Rotation.from_rotvec([0.1, 0.2, 0.3]).as_matrix(), [0.3, 0.2, 2.0])
    assert nd.condition_number(g, c) < 100.0
    modes = nd.forward_position(g, nd.leg_lengths(g, c))
    assert modes.certain
    assert np.abs(modes.position - c.position).max(axis=1).min() < 1e-9


# --- How near -------------------------------------------------------------------------------------------------------


def to_a_line(joints):
    """The least largest distance of three joints from a line, searched over lines."""

    def largest(v):
        direction = np.array([math.sin(v[0]) * math.cos(v[1]), math.sin(v[0]) * math.sin(v[1]), math.cos(v[0])])
        return np.linalg.norm(np.cross(joints - v[2:], direction), axis=1).max()

    return searched(largest, 5, joints)


def to_a_point(joints):
    return searched(lambda v: np.linalg.norm(joints - v, axis=1).max(), 3, joints)


def searched(function, n, joints):
    rng = np.random.default_rng(5)
    options = {"xatol": 1e-9, "fatol": 1e-9, "maxiter": 4000}
    starts = [np.concatenate([rng.normal(size=n - 3), joints.mean(axis=0)]) for _ in range(8)]
    return min(minimize(function, x, method="Nelder-Mead", options=options).fun for x in starts)


@pytest.mark.parametrize("kind", list(nd.ArchitectureClass))
def test_the_distance_is_the_least_largest_move_of_a_joint(kind):
    rng = np.random.default_rng(list(nd.ArchitectureClass).index(kind))
    r, rh, u, ut = rng.normal(size=(4, 3, 3)) * 10.0
    small = np.linalg.qr(rng.normal(size=(3, 3)))[0] * [1.0, 1.0, 0.02]
    legs = ()
    if kind == "lower_on_line":
        rh = np.array([[0, 0, 0], [9, 0.1, 0], [4, 0, 0.3]]) @ small
        expected = to_a_line(rh)
    elif kind == "upper_on_line":
        ut = np.array([[0, 0, 0], [9, 0.2, 0], [10, 0, 0.1]]) @ small
        expected = to_a_line(ut)
    elif kind == "base_in_point":
        r = 0.1 * r
        expected = to_a_point(r)
    elif kind == "platform_in_point":
        u = 3.0 + 0.05 * u
        expected = to_a_point(u)
    else:
        legs = (1, 3)
        r[2], u[2] = r[0] + [0.01, 0.02, 0.0], u[0] + [0.0, 0.0, 0.03]
        expected = 0.015
    nearest = nd.architecture_singularity(nd.Geometry(r, rh, u, ut))
    assert (nearest.kind, nearest.legs) == (kind, legs)
    assert nearest.distance * (1.0 - 1e-9) <= expected <= nearest.distance * 1.01  # a search ends above the least
    longest = max(np.linalg.norm(t[i] - t[j]) for t in (r, rh, u, ut) for i in range(3) for j in range(i))
    assert nearest.relative == pytest.approx(nearest.distance / longest)


def test_the_dissimilarity_is_the_least_residual_of_all_orientations():
    rng = np.random.default_rng(8)
    g = nd.Geometry(*rng.normal(size=(4, 3, 3)))

    def residual(v):
        rotation = Rotation.from_rotvec(v).as_matrix()
        return _core.homothety_residual(g, nd.Configuration([0, 0, 1], rotation, [0, 0, 0.5]))

    least = min(minimize(residual, v, method="Nelder-Mead").fun for v in rng.normal(size=(6, 3)))
    assert nd.architecture_singularity(g).dissimilarity == pytest.approx(least, abs=1e-6)
