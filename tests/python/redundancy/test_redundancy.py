"""The best internal point of a pose, compared with a search of the whole neighbourhood in plain numpy."""

import numpy as np
import numpy_model
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

CRITERIA = ("condition_number", "singularity", "leg_centring")
LIMITS = (1.0, 6.0)


def random_case(rng, hexagonal):
    if hexagonal:
        g = nd.Geometry.hexagonal(*rng.uniform(0.3, 3.0, size=4))
    else:
        g = numpy_model.random_robots(rng, 1).at(0).geometry()
    p = np.array([0.0, 0.0, 3.5]) + 0.4 * rng.normal(size=3)
    return g, p, Rotation.from_rotvec(0.2 * rng.normal(size=3)).as_matrix()


def signs_and_values(g, p, q, s):
    """Signs of det B, det C and det N, and the condition number, by plain numpy for points s, shape (n, 3)."""
    n = len(s)
    m = numpy_model.Robot(
        *(
            np.broadcast_to(t, (n, 3, 3))
            for t in (g.base_external, g.base_internal, g.platform_external, g.platform_internal)
        ),
        np.broadcast_to(p, (n, 3)),
        np.broadcast_to(q, (n, 3, 3)),
        s,
    )
    _, b, c, _ = numpy_model.matrices(m)
    x, _, _, u, _ = numpy_model.legs(m)
    w = u + (m.p - m.s)[:, None]
    d = w - x
    signs = [np.sign(np.linalg.det(a)) for a in (b, c, np.cross(d, w))]
    with np.errstate(all="ignore"):
        return np.stack(signs, axis=-1), numpy_model.condition_number(m)


def penalised(x, g, p, q, signs):
    """Return the condition number, infinite in other chambers."""
    sign, value = signs_and_values(g, p, q, x[None])
    return value[0] if (sign[0] == signs).all() else np.inf


@pytest.mark.slow
@pytest.mark.parametrize("hexagonal", [True, False])
def test_no_better_point_in_the_chamber(hexagonal):
    rng = np.random.default_rng(5)
    compared = 0
    for _ in range(size(4, 12)):
        g, p, q = random_case(rng, hexagonal)
        best = nd.best_internal_point(g, p, q)
        if best.status == "unbounded":
            continue
        assert best.status == "found"
        s = best.configuration.internal_point
        assert_allclose(best.value, nd.condition_number(g, best.configuration), rtol=1e-12)
        around = np.concatenate([s + 3.0 * rng.normal(size=(4000, 3)), s + 0.3 * rng.normal(size=(4000, 3)), s[None]])
        signs, values = signs_and_values(g, p, q, around)
        inside = (signs == signs[-1]).all(axis=-1)
        near = size(1e-5, 1e-7)
        for k in np.argsort(np.where(inside, values, np.inf))[: size(2, 3)]:
            end = minimize(
                penalised, around[k], (g, p, q, signs[-1]), "Nelder-Mead", options={"xatol": near, "fatol": 0.01 * near}
            )
            way = s + np.linspace(0.0, 1.0, 400)[:, None] * (end.x - s)
            if (signs_and_values(g, p, q, way)[0] == signs[-1]).all():  # else: the same signs, another chamber
                compared += 1
                assert end.fun >= best.value * (1.0 - 1e-6)
    assert compared >= size(4, 16)


def test_o_moves_while_the_platform_stays(published):
    """External legs and pose are the same, the condition number is less."""
    rng = np.random.default_rng(6)
    p = np.array([0.0, 0.0, 3.98]) + 0.5 * rng.uniform(-1.0, 1.0, size=(60, 3))
    q = Rotation.from_rotvec(0.2 * rng.normal(size=(60, 3)))
    best = nd.best_internal_point(published, p, q)
    middle = nd.Configuration(p, q, 0.5 * p)
    assert set(best.status) == {"found"}
    assert_array_equal(best.configuration.position, p)
    assert_allclose(nd.leg_lengths(published, best.configuration)[:, :3], nd.leg_lengths(published, middle)[:, :3])
    gain = nd.condition_number(published, middle) / best.value
    assert gain.min() >= 1.0 - 1e-9
    assert np.median(gain) > 1.03


def test_leg_centring_minimises_the_sum_of_squares(published):
    best = nd.best_internal_point(published, [0.3, 0.2, 3.9], criterion="leg_centring", limits=LIMITS)
    lengths = nd.leg_lengths(published, best.configuration)[3:]
    assert_allclose(best.value, np.sum(((lengths - 3.5) / 2.5) ** 2), rtol=1e-12)
    rng = np.random.default_rng(7)
    near = nd.Configuration([0.3, 0.2, 3.9], None, best.configuration.internal_point + 1e-3 * rng.normal(size=(200, 3)))
    there = np.sum(((nd.leg_lengths(published, near)[:, 3:] - 3.5) / 2.5) ** 2, axis=-1)
    assert there.min() > best.value


def test_leg_centring_keeps_the_clearance_and_names_it(published):
    best = nd.best_internal_point(published, [0.0, 0.0, 4.0], criterion="leg_centring", limits=(1.0, 8.0))
    assert best.status == "found"
    assert "det B" in best.active
    assert abs(np.linalg.det(nd.velocity_matrices(published, best.configuration).B)) > 0.009


def test_singularity_maximises_the_least_determinant(published):
    best = nd.best_internal_point(published, [0.3, 0.2, 3.9], criterion="singularity")
    middle = nd.Configuration([0.3, 0.2, 3.9], None, [0.15, 0.1, 1.95])
    assert best.status == "found"
    assert 0.0 < best.value <= 1.0
    least = [abs(np.linalg.det(m)) for m in nd.velocity_matrices(published, best.configuration)[1:3]]
    assert best.value <= min(least) + 1e-12
    assert nd.condition_number(published, best.configuration) < 3.0 * nd.condition_number(published, middle)


def test_limits_hold_and_are_named(published):
    free = nd.best_internal_point(published, [0.5, 0.0, 3.98])
    lengths = nd.leg_lengths(published, free.configuration)
    high = np.full(9, np.inf)
    high[3] = lengths[3] - 0.05
    bound = nd.best_internal_point(published, [0.5, 0.0, 3.98], limits=(0.0, high))
    assert bound.status == "found"
    assert bound.active == ("q1 high",)
    assert bound.value > free.value
    assert_allclose(nd.leg_lengths(published, bound.configuration)[3], high[3], rtol=1e-7)


def test_statuses_without_a_point(published):
    legs = nd.best_internal_point(published, [0.0, 0.0, 3.98], limits=(0.0, 4.0))
    assert (legs.status, legs.active) == ("infeasible", ("l1 high", "l2 high", "l3 high"))
    internal = nd.best_internal_point(published, [0.0, 0.0, 9.0], limits=(0.0, [20, 20, 20, 2, 2, 2, 2, 2, 2]))
    assert internal.status == "infeasible"
    assert internal.active
    assert np.isnan(internal.configuration.internal_point).all()
    assert np.isnan(internal.value)
    flat = nd.best_internal_point(published, [0.0, 0.0, 3.98], start=[0.1, 0.2, 0.0])
    assert flat.status == "singular"


def test_the_start_selects_the_chamber(published):
    above = nd.best_internal_point(published, [0.1, 0.0, 3.98], start=[0.0, 0.0, 6.0])
    assert above.status in ("found", "unbounded")
    if above.status == "found":
        assert above.configuration.internal_point[2] > 3.9


@pytest.mark.parametrize("criterion", CRITERIA)
def test_scale_stacks_and_threads(published, criterion):
    rng = np.random.default_rng(8)
    p = np.array([0.0, 0.0, 3.98]) + 0.3 * rng.uniform(-1.0, 1.0, size=(2, 3, 3))
    p[1, 2] = np.nan
    one, two = (nd.best_internal_point(published, p, criterion=criterion, limits=LIMITS, threads=n) for n in (1, 2))
    assert one.value.shape == one.status.shape == one.active.shape == (2, 3)
    assert one.status[1, 2] == "missing"
    assert_array_equal(one.configuration.internal_point, two.configuration.internal_point)
    alone = nd.best_internal_point(published, p[0, 1], criterion=criterion, limits=LIMITS)
    assert_array_equal(alone.configuration.internal_point, one.configuration.internal_point[0, 1])
    for unit in (1e-3, 1e3):
        big = nd.Geometry.hexagonal(a1=0.0, a2=5.8124 * unit, b1=2.9062 * unit, b2=0.0)
        there = nd.best_internal_point(
            big,
            unit * p[0, 1],
            criterion=criterion,
            limits=(LIMITS[0] * unit, LIMITS[1] * unit),
            characteristic_length=unit,
        )
        assert_allclose(there.value, alone.value, rtol=1e-7)


# --- Arguments --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("criterion", {"criterion": "best"}),
        ("limits", {"limits": 3.0}),
        (r"limits \(low\)", {"limits": (np.ones(4), 2.0)}),
        ("limits of l1", {"limits": (3.0, 2.0)}),
        ("limits of q1", {"criterion": "leg_centring"}),
        ("characteristic_length", {"characteristic_length": 0.0}),
        ("characteristic_length", {"characteristic_length": [1.0, 2.0]}),
        ("criterion", {"criterion": None}),
        ("clearance", {"clearance": 0.0}),
        ("start", {"start": [1.0, 2.0]}),
        ("threads", {"threads": 0}),
        ("rotation", {"rotation": 2.0 * np.eye(3)}),
    ],
)
def test_wrong_arguments_are_named(published, name, wrong):
    with pytest.raises(ValueError, match=rf"^{name}: got "):
        nd.best_internal_point(published, [0.0, 0.0, 3.98], **wrong)
