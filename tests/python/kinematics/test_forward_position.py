"""Direct position analysis against cases solved with 80 digits, the lengths it must reproduce, and at its edges.

The reference was found in multiple precision, confirmed by a brute-force search, and shares no code. Lengths are
checked by plain numpy.
"""

import json
import pickle

import numpy as np
import numpy_model
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from reference_cases import REFERENCE, of_case, rotation
from robots import rates
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

CASES = json.loads((REFERENCE / "forward.json").read_text(encoding="utf-8"))["cases"]
OCTAHEDRON = {"a1": 0.0, "a2": np.sqrt(2.0), "b1": np.sqrt(2.0), "b2": 0.0}


def errors(modes, p, q, s, unit):
    """Of every mode against one configuration: entries of Q, and lengths over the unit."""
    return np.maximum(
        abs(modes.rotation - q).max(axis=(-1, -2)),
        np.maximum(abs(modes.position - p).max(axis=-1), abs(modes.internal_point - s).max(axis=-1)) / unit,
    )


def length_errors(g, modes, lengths):
    result = numpy_model.lengths(numpy_model.robot(g, modes))
    return abs(result - lengths).max(axis=-1) / lengths.max()


@pytest.fixture(params=CASES, ids=lambda c: f"{c['id']}-{'-'.join(c['tags'])}".replace(" ", "_"))
def case(request):
    return request.param


# --- Reference --------------------------------------------------------------------------------------------------------


def test_the_file_is_whole():
    tags = {t for c in CASES for t in c["tags"]}
    assert len(CASES) == 21
    assert {"hexagon", "general", "maximal", "infeasible", "near-double", "self-motion", "multiplicity 8"} <= tags


def test_reference_modes(case):
    g, lengths = of_case(case)
    modes = nd.forward_position(g, lengths)
    if case["count"] is None:
        assert (modes.status, len(modes), modes.certain) == ("self_motion", 0, False)
        return
    assert len(modes) == modes.count == case["count"]
    side = {0: 1, 1: -1}
    matches = set()
    for solution in case["solutions"]:
        error = errors(modes, solution["p"], rotation(solution["quat"]), solution["s"], lengths.max())
        k = int(np.argmin(error))
        matches.add(k)
        assert error[k] <= case["tol"]
        if modes.base_side[k] != 0:
            assert modes.base_side[k] == side[solution["branch"][0]]
        assert modes.platform_side[k] == side[solution["branch"][1]]
        if solution["sigma_rot"] > 1e-6:
            assert_allclose(modes.separation[k], solution["sigma_rot"], rtol=1e-6, atol=1e-9)
    assert len(matches) == case["count"], "one mode stands for two"
    if case["count"]:
        assert length_errors(g, modes, lengths).max() < 1e-13


STATUS = {"tangent base spheres": "tangent", "multiplicity 8": "tangent", "infeasible": "infeasible"}


def test_reference_status(case):
    expected = next((word for tag, word in STATUS.items() if tag in case["tags"]), "found")
    if case["count"] is None:
        expected = "self_motion"
    g, lengths = of_case(case)
    modes = nd.forward_position(g, lengths)
    assert modes.status == expected
    assert bool(modes.reason) == (expected == "infeasible")
    assert modes.certain or expected != "found"
    assert "tangent base spheres" not in case["tags"] or not modes.base_side.any()


# --- Robots of very different sizes -----------------------------------------------------------------------------------

SLENDER = [
    # The directions to the joints are nearly parallel: equations that nearly agree are no self-motion.
    (
        [
            [[0.00705, 0.0782, 0.0], [-0.00639, 0.109, 0.0], [-0.00127, -0.00549, 0.0]],
            [[3.1, 47.3, 0.0], [-7.24, -104.0, 0.0], [-4.49, -74.4, 0.0]],
            [[1.04e-06, -2.89e-07, 0.0], [1.74e-06, -6.38e-06, 0.0], [-2.76e-07, 3.87e-06, 0.0]],
            [[0.00826, 0.097, 0.0], [0.000912, 0.179, 0.0], [0.0023, -0.087, 0.0]],
        ],
        ([104.0, -21.2, 61.8], [-1.18, -0.398, -2.1], [-51.2, 48.5, -35.3]),
    ),
    # The modes are far apart although their separations are 4e-9: none of them is a double one.
    (
        [
            [[2.19e-05, -3.25e-06, -6.69e-06], [1.94e-05, 5.8e-06, 5.87e-06], [3.23e-05, 2.42e-06, -5.07e-06]],
            [[-0.0202, -0.00314, -0.0263], [0.426, -0.0987, -0.00603], [-0.158, 0.00798, 0.0312]],
            [[-12.8, -0.629, -0.0251], [2.38, -1.01, -0.0518], [117.0, 1.09, -0.0291]],
            [[-31.6, 2.05, -0.00105], [-133.0, 0.818, -0.00189], [59.0, -1.2, 0.0314]],
        ],
        ([-66.2, 18.0, 140.0], [-1.96, 0.933, -0.273], [239.0, -136.0, 398.0]),
    ),
]


@pytest.mark.parametrize("slender", SLENDER)
def test_nearly_parallel_directions_are_neither_self_motion_nor_tangent(slender):
    joints, (p, turn, s) = slender
    rng = np.random.default_rng(21)
    g = nd.Geometry(*joints)
    result = 0
    for _ in range(40):
        c = nd.Configuration(p, Rotation.from_rotvec(turn + 0.1 * rng.normal(size=3)), s)
        lengths = nd.leg_lengths(g, c)
        modes = nd.forward_position(g, lengths)
        error = errors(modes, c.position, c.rotation, c.internal_point, lengths.max())
        assert error.min() < 1e-5
        assert length_errors(g, modes, lengths).max() < 1e-12
        assert modes.status == "found" or not modes.certain
        result += modes.status == "found"
    assert result >= 30


def anisotropic_robot(rng, far):
    """Plates with coordinates of 1e-2 to 1e2 on each axis; `far`: external joints close together, O far from them."""
    while True:
        plates = rng.normal(size=(2, 6, 3)) * 10.0 ** rng.uniform(-2.0, 2.0, size=(2, 1, 3))
        if rng.random() < 0.5:
            plates[:, :, 2] = 0.0
        joints = [plates[0, :3], plates[0, 3:], plates[1, :3], plates[1, 3:]]
        if far:
            joints[0] *= 10.0 ** rng.uniform(-4.0, 0.0)
            joints[2] *= 10.0 ** rng.uniform(-4.0, 0.0)
        unit = abs(plates).max() * 10.0 ** rng.uniform(-1.0, 1.0)
        p, s = unit * rng.normal(size=(2, 3))
        try:
            return nd.Geometry(*joints), nd.Configuration(p, Rotation.random(rng=rng), s)
        except ValueError:
            continue


def possible_error(g, c):
    """Of Q, and of points over the longest leg, when the squared lengths have rounding errors."""
    m = numpy_model.robot(g, c)
    lengths = numpy_model.lengths(m)
    unit = max(lengths.max(), *(abs(t).max() for t in (m.r, m.rh, m.u, m.ut)))
    return (abs(np.linalg.inv(rates(m, unit))) @ (np.spacing(1.0) * unit**2 / lengths)).max()


@pytest.mark.parametrize("far", [False, True])
def test_anisotropic_robots(far):
    """The generating pose is found to the accuracy of its condition, and a confirmed count misses none."""
    rng = np.random.default_rng(22)
    for _ in range(size(150, 20000)):
        g, c = anisotropic_robot(rng, far)
        expected = possible_error(g, c)
        if expected > 1e-6:
            continue
        lengths = nd.leg_lengths(g, c)
        modes = nd.forward_position(g, lengths)
        assert modes.status in ("found", "tangent")
        assert errors(modes, c.position, c.rotation, c.internal_point, lengths.max()).min() < 1e3 * expected + 1e-9


def test_mixed_scales_are_not_certain_to_be_infeasible():
    """Triples from 1e-98 to 1e98, with a configuration that has the lengths."""
    rng = np.random.default_rng(24)
    for _ in range(size(300, 6000)):
        sizes = 10.0 ** rng.uniform(-98.0, 98.0, size=4)
        if rng.random() < 0.5:
            sizes = np.clip(sizes[0] * 10.0 ** rng.uniform(-20.0, 20.0, size=4), 1e-98, 1e98)
        g = nd.Geometry(*(rng.normal(size=(4, 3, 3)) * sizes[:, None, None]))
        p, s = rng.normal(size=(2, 3)) * rng.choice(sizes, size=(2, 1))
        modes = nd.forward_position(g, nd.leg_lengths(g, nd.Configuration(p, np.eye(3), s)))
        assert modes.count > 0 or not modes.certain


def near_degenerate_robot(rng, kind):
    """O near an external joint, legs nearly through O, nearly equal legs, nearly parallel base directions."""
    while True:
        q = Rotation.random(rng=rng).as_matrix()
        s, p = rng.normal(size=(2, 3))
        d, w, lower, upper = rng.normal(size=(4, 3, 3))
        near = 10.0 ** rng.uniform(-12.0, -1.0)
        if kind == "joint":
            d[0] = near * rng.normal(size=3)
        if kind == "through":
            w[:2] = -(d[:2] @ q) + near * rng.normal(size=(2, 3))
        if kind == "equal":
            d[1], w[1] = 1.4 * d[0] + near * rng.normal(size=3), 0.7 * w[0] + near * rng.normal(size=3)
        if kind == "parallel":
            d = d[0] + near * rng.normal(size=(3, 3))
        try:
            return nd.Geometry(d + s, lower, w + q.T @ (s - p), upper), nd.Configuration(p, q, s)
        except ValueError:
            continue


@pytest.mark.parametrize("kind", ["joint", "through", "equal", "parallel"])
def test_a_confirmed_count_near_degenerate_data_misses_no_mode(kind):
    """The generating pose is among them, and lengths within rounding have the same count wherever it is confirmed."""
    rng = np.random.default_rng(25)
    certain = 0
    for _ in range(size(80, 4000)):
        g, c = near_degenerate_robot(rng, kind)
        lengths = nd.leg_lengths(g, c)
        modes = nd.forward_position(g, lengths)
        if not modes.certain:
            continue
        certain += 1
        error = errors(modes, c.position, c.rotation, c.internal_point, lengths.max())
        assert error.min() < 1e3 * possible_error(g, c) + 1e-9
        around = nd.forward_position(g, lengths * (1.0 + 4e-16 * rng.choice([-1.0, 1.0], size=(4, 9))))
        assert (around.count == modes.count)[around.certain].all()
    assert certain > 5


# --- Degenerate data has its own status -------------------------------------------------------------------------------


@pytest.mark.parametrize("joint", [0, 1, 2])
def test_o_on_an_external_joint_is_self_motion(joint):
    rng = np.random.default_rng(3)
    g = nd.Geometry(*rng.normal(size=(4, 3, 3)))
    c = nd.Configuration([0.1, 0.2, 3.0], Rotation.random(rng=rng), g.base_external[joint])
    lengths = nd.leg_lengths(g, c)
    assert nd.forward_position(g, lengths).status == "self_motion"
    # The leg without direction must have the right length too, and so must the other two.
    longer = np.eye(9)[joint]
    without = nd.forward_position(g, lengths + 0.01 * longer)
    assert without.status != "self_motion"
    other = np.eye(9)[(joint + 1) % 3]
    assert nd.forward_position(g, lengths + 20.0 * other).status != "self_motion"


@pytest.mark.parametrize("side", ["base_internal", "platform_internal"])
def test_o_on_an_internal_joint_is_never_infeasible(published, side):
    rng = np.random.default_rng(4)
    for k in range(60):
        q = Rotation.random(rng=rng).as_matrix()
        p = np.array([0.3, 0.1, 4.0]) + 0.2 * rng.normal(size=3)
        s = published.base_internal[k % 3] if side == "base_internal" else p + q @ published.platform_internal[k % 3]
        modes = nd.forward_position(published, nd.leg_lengths(published, nd.Configuration(p, q, s)))
        assert modes.status in ("tangent", "self_motion", "found")


@pytest.mark.parametrize(
    ("legs", "factor", "word"),
    [
        ((6, 7, 8), 0.3, "lower internal legs"),
        ((6,), 9.0, "lower internal legs"),
        ((3, 4, 5), 0.3, "upper internal legs"),
        ((0,), 5.0, "leg l1"),
        ((1,), 5.0, "leg l2"),
        ((2,), 1e-3, "leg l3"),
    ],
)
def test_infeasible_says_which_legs(published, neutral, legs, factor, word):
    lengths = nd.leg_lengths(published, neutral)
    lengths[list(legs)] *= factor
    modes = nd.forward_position(published, lengths)
    assert (modes.status, modes.shape, modes.count) == ("infeasible", (0,), 0)
    assert word in modes.reason


def test_each_leg_fits_but_not_all():
    g = nd.Geometry.hexagonal(**OCTAHEDRON)
    c = nd.Configuration.neutral(zp=2.0 / np.sqrt(3.0), zs=1.0 / np.sqrt(3.0))
    lengths = nd.leg_lengths(g, c)
    # Here all three c_i are the diagonal of a rotation, or minus that: with 0.99 and 0.9 the third is about 0.9.
    lengths[:3] = np.sqrt(2.0 * (1.0 - np.array([0.99, 0.9, 0.0])))
    modes = nd.forward_position(g, lengths)
    assert modes.count == 0
    assert "no rotation" in modes.reason


# --- Stacks and arguments ---------------------------------------------------------------------------------------------


def test_a_stack_is_its_rows(published):
    rng = np.random.default_rng(2)
    home = nd.Configuration.neutral(3.9828, 2.4)
    lengths = nd.leg_lengths(published, home.moved(0.3 * rng.normal(size=(2, 3, 9))))
    lengths[1, 1, 4] = np.nan
    lengths[0, 2, 6:] *= 0.1
    stack = nd.forward_position(published, lengths)
    assert stack.status.shape == stack.count.shape == (2, 3)
    assert stack.shape == (2, 3, stack.count.max())
    for k in np.ndindex(2, 3):
        if k == (1, 1):
            assert (stack.status[k], stack.count[k], stack.certain[k]) == ("no_data", 0, False)
            continue
        alone = nd.forward_position(published, lengths[k])
        n = alone.count
        assert (stack.status[k], stack.count[k], stack.reason[k], stack.certain[k]) == (
            alone.status,
            n,
            alone.reason,
            alone.certain,
        )
        assert_array_equal(stack.position[k][:n], alone.position)
        assert_array_equal(stack.rotation[k][:n], alone.rotation)
        assert_array_equal(stack.separation[k][:n], alone.separation)
        assert_array_equal(stack.base_side[k][:n], alone.base_side)
        assert np.isnan(stack.position[k][n:]).all()
    assert stack.status[0, 2] == "infeasible"


def test_threads_and_chunks_do_not_matter(published):
    rng = np.random.default_rng(7)
    lengths = nd.leg_lengths(published, nd.Configuration.neutral(3.9828, 2.4).moved(0.2 * rng.normal(size=(5000, 9))))
    one, two = (nd.forward_position(published, lengths, threads=n) for n in (1, 2))
    assert_array_equal(one.position, two.position)
    assert_array_equal(one.count, two.count)
    assert_array_equal(one.position[4500, : one.count[4500]], nd.forward_position(published, lengths[4500]).position)


def test_no_rows(published):
    modes = nd.forward_position(published, np.zeros((0, 9)))
    assert modes.shape == (0, 0)
    assert modes.count.shape == (0,)


def test_what_comes_back_is_a_configuration(published, neutral):
    lengths = nd.leg_lengths(published, neutral)
    modes = nd.forward_position(published, lengths)
    assert isinstance(modes, nd.Configuration)
    assert type(modes[0]) is nd.Configuration
    assert_allclose(nd.leg_lengths(published, modes), np.broadcast_to(lengths, (32, 9)), rtol=1e-13)
    again = pickle.loads(pickle.dumps(modes))
    assert again == modes
    assert (again.status, again.count) == (modes.status, modes.count)
    assert repr(modes) == "<32 assembly modes: found>"
    assert "lower internal" in repr(nd.forward_position(published, lengths * np.repeat([1.0, 0.1], [6, 3])))
