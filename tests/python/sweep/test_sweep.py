"""Sweeps against plain numpy at every point, and the labels that go with the numbers."""

import itertools
import math
from concurrent.futures import ThreadPoolExecutor

import design_oracle as designs
import numpy as np
import numpy_model as model
import pytest
from scipy.spatial.transform import Rotation
from sizes import size
from sweep_work import HOME, G

import ninedof as nd
from ninedof.design.indices import computed
from ninedof.sweep import points as placing
from ninedof.sweep.axis import Axis, axes_of
from ninedof.sweep.points import best_block

TURNED = nd.Configuration([0.3, -0.2, 4.1], Rotation.from_rotvec([0.1, -0.3, 0.4]), [0.1, 0.25, 2.2])
NAMES = ("theta_x", "theta_y", "theta_z", "x_p", "y_p", "z_p", "x_s", "y_s", "z_s")


def poses(home, over, relative=True, rule="held"):
    """Points of the grid one at a time, by SciPy's rotations."""
    p, q, s = [], [], []
    for point in itertools.product(*over.values()):
        at = dict(zip(over, point, strict=True))
        theta = np.array([at.get(n, 0.0) for n in NAMES[:3]])
        turn = Rotation.from_rotvec(theta).as_matrix()
        turned = any(n in at for n in NAMES[:3])
        own = home.rotation if relative or not turned else np.eye(3)
        base = np.concatenate([home.position, home.internal_point]) if relative else np.zeros(6)
        there = [
            base[k] + at[n] if n in at else np.concatenate([home.position, home.internal_point])[k]
            for k, n in enumerate(NAMES[3:])
        ]
        position, point_o = np.array(there[:3]), np.array(there[3:])
        if rule == "carried":
            shift = point_o - home.internal_point
            point_o = position + turn @ own @ home.rotation.T @ (home.internal_point - home.position) + shift
        if rule == "shifted":
            point_o = position + point_o - home.position
        p.append(position)
        q.append(turn @ own)
        s.append(point_o)
    shape = [len(v) for v in over.values()]
    return [np.reshape(a, (*shape, *np.shape(a[0]))) for a in (p, q, s)]


def robot(home, over, **options):
    p, q, s = poses(home, over, **options)
    return model.Robot(G.base_external, G.base_internal, G.platform_external, G.platform_internal, p, q, s)


def kappa(m):
    sigma = model.singular_values(m)
    return sigma[..., 0] / sigma[..., -1]


GRIDS = {
    "one": {"x_p": [-0.5, 0.0, 0.7]},
    "two": {"theta_z": [-0.3, 0.2], "y_s": [0.1, 0.2, -0.4]},
    "three": {"z_p": [-0.2, 0.4], "theta_x": [0.1, 0.5, -0.2], "theta_y": [0.0, 0.3]},
    "all of p and s": {"x_s": [0.1, -0.1], "y_p": [0.3], "z_s": [-0.4, 0.2, 0.6]},
}


@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize("rule", ["held", "carried", "shifted"])
def test_displacements(grid, rule):
    over = GRIDS[grid]
    result = nd.sweep(G, TURNED, over, internal_point=rule, chunk=2)
    assert result.dims["condition_number"] == tuple(over)
    np.testing.assert_allclose(result["condition_number"], kappa(robot(TURNED, over, rule=rule)), rtol=1e-9)
    for name, values in over.items():
        assert result[name].tolist() == values


@pytest.mark.parametrize("grid", GRIDS)
def test_absolute_coordinates(grid):
    """A swept theta replaces the rotation at home; without one that stays."""
    over = {n: [v + {"z_p": 4.0, "z_s": 2.0}.get(n, 0.0) for v in values] for n, values in GRIDS[grid].items()}
    result = nd.sweep(G, TURNED, over, relative=False)
    np.testing.assert_allclose(result["condition_number"], kappa(robot(TURNED, over, relative=False)), rtol=1e-9)
    moved = nd.sweep(G, TURNED, {"x_p": [0.3]}, relative=False)["condition_number"][0]
    assert moved == pytest.approx(nd.condition_number(G, TURNED), rel=1e-12)


def test_a_carried_o_follows_the_rotation_of_the_platform():
    over = {"theta_y": [0.2, -0.4], "x_p": [0.5]}
    result = nd.sweep(G, TURNED, over, relative=False, internal_point="carried")
    expected = kappa(robot(TURNED, over, relative=False, rule="carried"))
    np.testing.assert_allclose(result["condition_number"], expected, rtol=1e-9)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("rule", ["shifted", "held", "best"])
def test_o_follows_the_rule_of_the_region_of_a_result(rule):
    region = {"box": (0.2, 0.2, 0.1), "internal_point": rule}
    fixed = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.4435}
    optimum = nd.optimize(nd.Study(variables=fixed, objective={"region": region}))
    over = {"x_p": [-0.2, 0.2], "theta_y": [0.0, 0.1]}
    result = nd.sweep(optimum, over)
    assert result.attributes["internal_point"] == rule
    own = nd.sweep(optimum, over, internal_point=rule)["condition_number"]
    np.testing.assert_array_equal(result["condition_number"], own)
    assert nd.sweep(optimum, {"z_s": [0.0, 0.1]}).attributes["internal_point"] == "held"
    assert nd.sweep(optimum, over, internal_point="carried").attributes["internal_point"] == "carried"
    assert nd.sweep(optimum.geometry, optimum.configuration, over).attributes["internal_point"] == "held"
    assert nd.sweep(nd.optimize(nd.Study.paper(), starts=1), over).attributes["internal_point"] == "held"


def test_every_index():
    over = GRIDS["two"]
    m = robot(TURNED, over)
    sigma, lengths = model.singular_values(m, 1.7), model.lengths(m)
    J = model.jacobian(m, 1.7)
    JJ = J @ np.swapaxes(J, -1, -2)
    mean = np.trace(JJ, axis1=-2, axis2=-1)[..., None, None] / 6.0 * np.eye(6)
    expected = {
        "condition_number": sigma[..., 0] / sigma[..., -1],
        "condition_number_frobenius": np.sqrt((sigma**2).sum(-1) * (sigma**-2).sum(-1)),
        "reciprocal_condition_number": sigma[..., -1] / sigma[..., 0],
        "manipulability": sigma.prod(-1),
        "speed": 1.0 / sigma[..., -1],
        "isotropy_residual": np.linalg.norm(JJ - mean, axis=(-2, -1)) / np.linalg.norm(mean, axis=(-2, -1)),
        "singular_values": sigma,
        "leg_lengths": lengths,
        "leg_ratio": lengths.max(-1) / lengths.min(-1),
        "singularity_margins": margins(m),
    }
    assert set(expected) == set(computed())
    result = nd.sweep(G, TURNED, over, list(computed()), characteristic_length=1.7, chunk=4)
    assert list(result) == list(computed())
    for name, values in expected.items():
        np.testing.assert_allclose(result[name], values, rtol=1e-9, atol=1e-12, err_msg=name)
    assert result["leg"].tolist() == "l1 l2 l3 q1 q2 q3 r1 r2 r3".split()
    assert result.dims["singularity_margins"] == ("theta_z", "y_s", "mechanism")
    assert (result.units["leg_lengths"], result.units["theta_z"], result.units["y_s"]) == ("length", "rad", "length")


def margins(m):
    *_, u, ut = model.legs(m)
    p, s = m.p[..., None, :], m.s[..., None, :]
    unit = [v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (m.r - s, p + u - s, s - m.rh, s - p - ut)]
    det_n = np.linalg.det(np.cross(unit[0], unit[1]))
    return np.stack([det_n, np.linalg.det(unit[2]), np.linalg.det(unit[3])], axis=-1)


def test_a_length_kind_is_taken_at_each_pose():
    over = {"x_p": [0.0, 0.6], "theta_z": [0.0, 0.4]}
    result = nd.sweep(G, HOME, over, characteristic_length="optimal")["condition_number"]
    for k in np.ndindex(2, 2):
        c = HOME.moved([0, 0, over["theta_z"][k[1]], over["x_p"][k[0]], 0, 0, 0, 0, 0])
        assert result[k] == pytest.approx(
            float(nd.condition_number(G, c, nd.characteristic_length(G, c, "optimal"))), rel=1e-12
        )


def test_the_best_o_is_no_worse_than_a_held_one():
    over = {"x_p": (0.0, 1.2, 3), "theta_y": (0.0, 0.3, 2)}
    best, held = (nd.sweep(G, HOME, over, internal_point=rule)["condition_number"] for rule in ("best", "held"))
    assert (best <= held * (1.0 + 1e-9)).all()
    assert (best[1:] < 0.99 * held[1:]).all()
    with pytest.raises(ValueError, match=r'over: got x_p, z_s with internal_point="best", expected O'):
        nd.sweep(G, HOME, {"x_p": [0.0], "z_s": [0.0]}, internal_point="best")
    with pytest.raises(ValueError, match="characteristic_length: got 'optimal' with internal_point"):
        nd.sweep(G, HOME, {"x_p": [0.0]}, internal_point="best", characteristic_length="optimal")


def test_an_index_of_the_caller():
    def span(g, c, lc):
        return np.linalg.norm(c.position - c.internal_point, axis=-1) * lc

    result = nd.sweep(G, HOME, {"x_p": [0.0, 3.0]}, ["condition_number", span], characteristic_length=2.0)
    assert result["span"].tolist() == pytest.approx([2 * 1.5393, 2 * math.hypot(1.5393, 3.0)])


def test_singular_poses_are_infinite():
    result = nd.sweep(G, HOME, {"z_s": [-2.4435, 0.0]}, ["condition_number", "reciprocal_condition_number"])
    assert result["condition_number"].tolist()[0] == math.inf
    assert result["reciprocal_condition_number"].tolist()[0] == 0.0
    assert np.isfinite(result["condition_number"][1])


@pytest.mark.parametrize("chunk", [1, 7, 100, 4096])
@pytest.mark.parametrize(("threads", "rule"), [(None, "held"), (1, "held"), (3, "held"), (None, "carried")])
def test_chunks_and_threads_change_nothing(chunk, threads, rule):
    over = {"x_p": (-1.0, 1.0, 11), "theta_z": (-0.5, 0.5, 7), "z_s": (-0.3, 0.2, 5)}
    asked = {"index": ["condition_number", "leg_lengths"], "internal_point": rule}
    whole = nd.sweep(G, TURNED, over, **asked)
    result = nd.sweep(G, TURNED, over, **asked, chunk=chunk, threads=threads)
    for name in whole:
        assert result[name].tobytes() == whole[name].tobytes()


# Blocks of 18 rows of x_p, or two in a quick run: three of them, the last one short.
BLOCK, ACROSS = size((74, 11), (placing.BLOCK, 37))
MANY = {"x_p": (size(0.5, -1.2), 1.2, size(5, 41)), "theta_x": (-0.4, 0.4, 3), "y_p": (-1.0, 1.0, ACROSS)}


def with_the_best_o(**options):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(placing, "BLOCK", BLOCK)
        return nd.sweep(G, TURNED, MANY, internal_point="best", **options)


@pytest.fixture(scope="module")
def whole():
    result = with_the_best_o()
    assert result.attributes["block"] == [size(2, 18), 3, ACROSS]
    return result["condition_number"]


@pytest.mark.slow
def test_chunks_threads_and_executors_change_nothing_where_o_is_best(whole):
    for options in ({"chunk": 1}, {"chunk": 3000, "threads": 1}, {"chunk": 100_000, "threads": 3}):
        assert with_the_best_o(**options)["condition_number"].tobytes() == whole.tobytes()
    with ThreadPoolExecutor(2) as pool:
        assert with_the_best_o(executor=pool)["condition_number"].tobytes() == whole.tobytes()


@pytest.mark.slow
def test_a_sweep_with_the_best_o_is_no_worse_than_a_search_at_each_pose(whole):
    p, q, _ = poses(TURNED, {name: np.linspace(*ends).tolist() for name, ends in MANY.items()})
    some = np.unravel_index(np.arange(0, whole.size, size(5, 1)), whole.shape)
    each = nd.best_internal_point(G, p[some], q[some])
    assert (each.status == "found").all()
    assert (whole[some] <= each.value * (1.0 + 1e-6)).all()


@pytest.mark.parametrize(
    ("over", "size"),
    [
        ({"x_p": (0.0, 0.1, 5000)}, 2048),
        ({"x_p": [0.0, 0.1], "y_p": (0.0, 0.1, 3000)}, 2048),
        ({"x_p": (0.0, 0.1, 21), "theta_x": (0.0, 0.1, 3), "y_p": (0.0, 0.1, 37)}, 18 * 3 * 37),
    ],
)
def test_blocks_of_the_best_o_depend_on_the_grid_alone(over, size):
    """Longer rows are cut, shorter ones joined; the attributes name the block."""
    block = best_block(axes_of(over, NAMES).shape)
    assert math.prod(block) == size
    result = nd.sweep(G, HOME, {"x_p": (0.0, 0.1, 3), "y_p": (0.0, 0.1, 2)}, internal_point="best")
    assert result.attributes["block"] == [3, 2]
    assert "block" not in nd.sweep(G, HOME, {"x_p": [0.0]}).attributes


# --- Axes -------------------------------------------------------------------------------------------------------------


def test_ranges_meet_their_ends_and_their_middle():
    for low, high, count in ((-1.0, 1.0, 41), (0.1, 0.3, 3), (-0.7, 1e-9, 1000), (5.0, 5.0, 1), (1e300, -1e300, 5)):
        values = Axis("x_p", count, low, high).values()
        assert (values[0], values[-1], len(values)) == (low, high, count)
        np.testing.assert_allclose(values, np.linspace(low, high, count), rtol=1e-13, atol=1e-15 * abs(low))
    assert Axis("x_p", 41, -1.0, 1.0).values()[20] == 0.0


def _masked(g, c, length):
    return np.ma.masked_less(nd.condition_number(g, c, length), 0.0)


def _complex(g, c, length):
    return np.full(c.shape, 1j)


@pytest.mark.parametrize(
    "call",
    [
        lambda: nd.sweep(G, HOME, {"x_p": [0.0, 0.1]}, _complex),
        lambda: nd.sweep(G, HOME, {"x_p": [0.0, 0.1]}, _masked),
        lambda: nd.sweep_designs({"a1": 0.4, "b1": 2.9, "b2": 0.3, "zp": 4.0, "zs": 2.4}, {"a2": [5.0, 6.0]}, _masked),
        lambda: nd.workspace(
            G, criteria={"condition_number": 9.0}, box=((-1, -1, 3), (1, 1, 5)), home=HOME, resolution=4, index=_masked
        ),
    ],
)
def test_an_array_of_a_function_that_is_not_of_numbers_is_refused(call):
    with pytest.raises(ValueError, match=r"^index _(complex|masked): got .*, expected real numbers"):
        call()


# --- Designs ----------------------------------------------------------------------------------------------------------


def test_designs_of_the_hexagonal_family():
    held = {"a1": 0.4, "b2": 0.3, "zp": 4.0, "zs": 2.4, "theta_z": 0.2}
    a2, b1 = np.array([4.0, 5.0, 6.5]), np.array([2.0, 3.0])
    result = nd.sweep_designs(held, {"a2": a2, "b1": b1}, ["condition_number", "leg_lengths"], chunk=4)
    v = dict(zip(("a2", "b1"), np.meshgrid(a2, b1, indexing="ij"), strict=True)) | {
        n: np.full((3, 2), x) for n, x in held.items()
    }
    zero = np.zeros((3, 2))
    m = model.Robot(
        *designs.joints("hexagonal", v),
        np.stack([zero, zero, v["zp"]], -1),
        np.broadcast_to(Rotation.from_euler("z", 0.2).as_matrix(), (3, 2, 3, 3)),
        np.stack([zero, zero, v["zs"]], -1),
    )
    np.testing.assert_allclose(result["condition_number"], kappa(m), rtol=1e-9)
    np.testing.assert_allclose(result["leg_lengths"], model.lengths(m), rtol=1e-12)
    assert result.attributes["design"] == held


def test_the_closed_form_and_robots_agree_and_both_refuse_negative_sides():
    held, over = {"a2": 6.0, "b1": 3.0, "zp": 4.0, "zs": 2.4}, {"a1": (0.0, 3.0, 7), "b2": (0.0, 2.0, 5)}
    closed = nd.sweep_designs(held, over, characteristic_length=1.5)["condition_number"]

    def robots(g, c, lc):
        return nd.condition_number(g, c, lc)

    np.testing.assert_allclose(
        nd.sweep_designs(held, over, robots, characteristic_length=1.5)["robots"], closed, rtol=1e-9
    )
    with pytest.raises(ValueError, match=r"a1: got -0\.5, expected a side of 0 at least"):
        nd.sweep_designs(held, {"a1": [0.1, -0.5], "b2": [0.0]})
    twisted = nd.sweep_designs({**held, "b2": 0.0, "theta_z": 0.1}, {"a1": [0.0]})["condition_number"]
    g = nd.Geometry.hexagonal(0.0, 6.0, 3.0, 0.0)
    assert twisted[0] == pytest.approx(nd.condition_number(g, nd.Configuration.neutral(4.0, 2.4, 0.1)), rel=1e-12)


def test_designs_of_a_symmetric_family():
    held = {
        "base_external_radius": 3.0,
        "base_internal_radius": 2.5,
        "platform_external_radius": 1.5,
        "platform_external_angle": 1.0,
        "platform_internal_radius": 1.2,
        "platform_internal_angle": -0.5,
        "zp": 3.0,
        "zs": 1.8,
    }
    angles = [0.3, 0.9, 1.5]
    result = nd.sweep_designs(held, {"base_internal_angle": angles}, family="symmetric")
    assert result.units["base_internal_angle"] == "rad"
    for k, angle in enumerate(angles):
        g = nd.Geometry.symmetric((3.0, 0.0, 0.0), (2.5, angle, 0.0), (1.5, 1.0, 0.0), (1.2, -0.5, 0.0))
        assert result["condition_number"][k] == pytest.approx(
            float(nd.condition_number(g, nd.Configuration.neutral(3.0, 1.8))), rel=1e-12
        )


# --- Results ----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def labelled():
    return nd.sweep(G, HOME, {"theta_z": (-0.5, 0.5, 5), "x_p": [0.0, 0.3]}, ["leg_lengths", "condition_number"])


def same(one, other):
    assert list(one) == list(other)
    assert dict(one.dims) == dict(other.dims)
    assert dict(one.units) == dict(other.units)
    assert list(one.coords) == list(other.coords)
    for name in (*one, *one.coords):
        assert one[name].tobytes() == other[name].tobytes()
        assert one[name].dtype == other[name].dtype


def test_saved_and_read_back(labelled, tmp_path):
    path = labelled.save(tmp_path / "x.y")
    assert path == tmp_path / "x.y.npz"
    same(nd.SweepResult.load(path), labelled)
    assert nd.SweepResult.load(path).attributes["home"]["position"] == [0.0, 0.0, 3.9828]
    assert nd.SweepResult.load(path).attributes["ninedof"] == nd.__version__
    assert labelled.save(path) == path
    assert [p.name for p in tmp_path.iterdir()] == ["x.y.npz"]


def test_as_xarray(labelled):
    pytest.importorskip("xarray", reason="xarray is not installed: the extra `sweep`")
    result = labelled.to_xarray()
    assert result["leg_lengths"].dims == ("theta_z", "x_p", "leg")
    assert result["leg_lengths"].attrs["units"] == "length"
    assert result["theta_z"].attrs["units"] == "rad"
    one = result["leg_lengths"].sel(theta_z=0.25, x_p=0.3, leg="q2").item()
    assert one == labelled["leg_lengths"][3, 1, 4]
    assert result.attrs["ninedof"] == nd.__version__


def test_without_xarray_the_error_says_what_to_install(labelled, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match=r"needs xarray, .*pip install 'ninedof\[sweep\]'"):
        labelled.to_xarray()


def test_least_and_names(labelled):
    value, at = labelled.least("condition_number")
    array = labelled["condition_number"]
    assert value == array.min()
    where = np.unravel_index(array.argmin(), array.shape)
    assert at == {"theta_z": labelled["theta_z"][where[0]], "x_p": labelled["x_p"][where[1]]}
    assert labelled.least("leg_lengths")[1]["leg"][0] in "lqr"
    assert len(labelled) == 2
    assert repr(labelled).startswith("<SweepResult leg_lengths(theta_z: 5, x_p: 2, leg: 9), condition_number(")
    with pytest.raises(KeyError, match="expected one of leg_lengths, condition_number, theta_z, x_p, leg"):
        labelled["kappa"]
