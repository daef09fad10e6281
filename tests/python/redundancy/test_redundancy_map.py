"""Maps of best internal points: compared with single searches and all O in plain numpy; symmetry and the audit."""

import numpy as np
import numpy_model
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation
from sizes import size
from workspace_oracle import robots as robots_at

import ninedof as nd

LIMITS = (np.r_[np.full(3, 1.0), np.full(6, 2.2)], np.r_[np.full(3, 9.0), np.full(6, 4.4)])


def plane(n, reach=1.6, height=3.9828):
    x = np.linspace(-reach, reach, n)
    return np.stack([*np.meshgrid(x, x, indexing="ij"), np.full((n, n), height)], axis=-1)


def robots(g, c, s=None):
    """Return the numpy model of a stack of configurations, with another O if given."""
    return robots_at(g, c.position, c.rotation, c.internal_point if s is None else s)


def gain(criterion, map_value, value):
    """The gain of `value`, relative to the better value; at least 0."""
    a, b = (value, map_value) if criterion == "singularity" else (map_value, value)
    return np.maximum(a / b - 1.0, 0.0)


# --- Values -----------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_general_robots_and_axes_of_orientation():
    rng = np.random.default_rng(2)
    for _ in range(size(1, 3)):
        g = numpy_model.random_robots(rng, 1).at(0).geometry()
        tilt = np.stack(np.meshgrid(*2 * [np.linspace(-0.3, 0.3, 12)], [0.1], indexing="ij"), axis=-1)[:, :, 0]
        q = Rotation.from_rotvec(tilt.reshape(-1, 3)).as_matrix().reshape(12, 12, 1, 3, 3)
        p = np.array([[0.1, 0.2, z] for z in np.linspace(3.0, 3.6, 6)])
        best = nd.best_internal_map(g, p, q, seed_every=64)
        assert best.value.shape == best.configuration.shape == (12, 12, 6)
        some = rng.choice(864, size=40, replace=False)
        c = best.configuration
        single = nd.best_internal_point(g, c.position.reshape(-1, 3)[some], c.rotation.reshape(-1, 3, 3)[some])
        both = (best.status.ravel()[some] == "found") & (single.status == "found")
        assert both.mean() > 0.3
        lost = gain("condition_number", best.value.ravel()[some][both], single.value[both])
        assert (lost > 1e-6).sum() <= 1 + 0.1 * best.audit.missed * len(some) / best.audit.poses


# --- Branches and the audit -------------------------------------------------------------------------------------------


def scattered(n=200):
    """A list whose neighbours are far apart: branches are lost."""
    rng = np.random.default_rng(11)
    m = numpy_model.random_robots(rng, 1).at(0)
    p = m.p + rng.uniform(-1.5, 1.5, size=(n, 3)) * [1.0, 1.0, 0.5]
    return m.geometry(), p, Rotation.from_rotvec(0.5 * rng.normal(size=(n, 3)))


@pytest.mark.slow
def test_the_audit_counts_misses_and_corrects_them():
    g, p, q = scattered()
    single = nd.best_internal_point(g, p, q)
    whole = nd.best_internal_map(g, p, q, seed_every=200, audit_every=1)
    both = (whole.status == "found") & (single.status == "found")
    assert both.sum() > 100
    assert whole.searched == 200
    assert (whole.value[both] <= single.value[both] * (1.0 + 1e-6)).all()
    assert 0 < whole.audit.missed < whole.audit.poses
    assert whole.audit.largest > 1e-2
    # A small audit corrects some of the misses that the audit of all poses counts.
    outcomes = set()
    for seed in range(size(3, 4)):
        part = nd.best_internal_map(g, p, q, seed_every=200, audit_every=100, audit_seed=seed)
        assert part.audit.poses == 32
        lost = gain("condition_number", part.value[both], single.value[both])
        left = (~(lost <= 1e-6)).sum()
        assert left + part.audit.missed <= whole.audit.missed
        assert not (lost > whole.audit.largest * (1.0 + 1e-6)).any()
        outcomes.add((left, part.audit.missed))
    assert len(outcomes) > 1  # other seeds draw other poses
    assert max(missed for _, missed in outcomes) > 0  # else nothing was corrected, and the test says nothing


def test_searching_every_pose_is_best_internal_point(published):
    grid = plane(6)
    best = nd.best_internal_map(published, grid, seed_every=1)
    single = nd.best_internal_point(published, grid)
    assert (best.value <= single.value).all()
    assert_allclose(best.value, single.value, rtol=1e-7)
    assert best.searched == 36
    assert best.audit.poses == 0


# --- Limits and poses without a point ---------------------------------------------------------------------------------


def test_limits_hold_and_are_named(published):
    high = np.r_[np.full(3, 6.2), np.full(6, 5.0)]
    best = nd.best_internal_map(published, plane(30, 2.5), limits=(LIMITS[0], high))
    c = nd.Configuration(
        best.configuration.position.reshape(-1, 3), None, best.configuration.internal_point.reshape(-1, 3)
    )
    with_o = (best.status == "found").ravel()
    with np.errstate(invalid="ignore"):
        lengths = numpy_model.lengths(robots(published, c))
    assert 0.2 < with_o.mean() < 0.95
    assert (lengths[with_o] <= high + 1e-8).all()
    assert (lengths[with_o] >= LIMITS[0] - 1e-8).all()
    names = np.array(["l1", "l2", "l3", "q1", "q2", "q3", "r1", "r2", "r3"], dtype=object)
    touched = 0
    for length, active in zip(lengths[with_o], best.active.ravel()[with_o], strict=True):
        for room, words in ((high - length, names + " high"), (length - LIMITS[0], names + " low")):
            assert set(words[room < 1e-7]) <= set(active)
            assert not set(words[room > 1e-6]) & set(active)
        touched += bool(active)
    assert touched > 50
    external = numpy_model.lengths(robots(published, c, np.zeros_like(c.position)))[:, :3]
    out = (external > high[:3] + 1e-8).any(axis=1)
    assert out.any()
    assert (best.status.ravel()[out] == "infeasible").all()
    assert np.isnan(c.internal_point[~with_o]).all()
    assert np.isnan(best.value.ravel()[~with_o]).all()


@pytest.mark.slow
def test_a_pose_with_nan_does_not_affect_others(published):
    grid = plane(20)
    whole = nd.best_internal_map(published, grid)
    grid[3, 4, 0] = np.nan
    grid[10, :, 2] = np.nan  # cuts the grid in two
    holed = nd.best_internal_map(published, grid)
    missing = np.isnan(grid).any(axis=-1)
    assert_array_equal(holed.status == "missing", missing)
    assert_allclose(holed.value[~missing], whole.value[~missing], rtol=1e-7)
    assert np.isnan(holed.value[missing]).all()


def test_islands_without_a_seed_are_reached(published):
    grid = plane(20)
    island = np.zeros((20, 20), dtype=bool)
    island[1, 1] = island[12:14, 17] = True
    grid[~island] = np.nan
    best = nd.best_internal_map(published, grid)
    assert (best.status[island] == "found").all()
    assert_allclose(best.value[island], nd.best_internal_point(published, grid[island]).value, rtol=1e-6)


def test_other_chambers_and_singular_starts(published):
    grid = plane(8, 0.4)
    above = nd.best_internal_map(published, grid, start=[0.0, 0.0, 6.0])
    single = nd.best_internal_point(published, grid, start=[0.0, 0.0, 6.0])
    assert_array_equal(above.status, single.status)
    starts = np.broadcast_to([0.1, 0.2, 2.0], grid.shape).copy()
    starts[2, 2] = [0.1, 0.2, 0.0]
    best = nd.best_internal_map(published, grid, start=starts)
    assert best.status[2, 2] == "singular"
    assert (best.status == "found").sum() == 63


def test_a_grid_of_one_pose_and_an_empty_grid(published):
    one = nd.best_internal_map(published, [0.3, 0.1, 3.9])
    single = nd.best_internal_point(published, [0.3, 0.1, 3.9])
    assert (one.value, one.status, one.active) == (single.value, "found", ())
    none = nd.best_internal_map(published, np.empty((0, 4, 3)))
    assert none.value.shape == none.status.shape == (0, 4)
    assert none.audit == nd.MapAudit(0, 0, 0.0)
