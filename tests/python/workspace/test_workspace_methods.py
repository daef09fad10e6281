"""Workspaces with the best O, by the three methods, and their audit."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

BOX = ([-4.0, -4.0, 0.0], [4.0, 4.0, 8.0])
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)
TILTED = Rotation.from_rotvec([0.15, -0.1, 0.2]).as_matrix()


# --- O ----------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_best_o_allows_all_poses_that_a_rule_allows(published):
    box = ([-2.0, -2.0, 3.5], [2.0, 2.0, 6.0])
    criteria = {"leg_limits": (2.5, 6.5), "condition_number": 5.0}
    options = {"criteria": criteria, "resolution": size(4, 6), "tolerance": 0.05}
    best = nd.workspace(published, box, internal_point="best", points=100, **options)
    for rule in (0.5, 0.6, [0.0, 0.0, 2.4]):
        other = nd.workspace(published, box, internal_point=rule, **options)
        assert other.volume - other.error <= best.volume + best.error
    inside = best.cells.centre[best.cells.state == 2][:40]
    there = nd.best_internal_point(published, inside, limits=(2.5, 6.5))
    assert (there.value <= 5.0 * (1.0 + 1e-6)).all()


SOUGHT = {
    "positions": {"box": ([-2.0, -2.0, 3.5], [2.0, 2.0, 6.0])},
    "orientations": {"archetype": "orientation", "position": [0.0, 0.0, 4.5], "region": {"angle": 0.8}},
    "a set": {
        "box": ([-1.0, -1.0, 4.0], [1.0, 1.0, 5.0]),
        "archetype": "inclusive",
        "orientations": np.stack([np.eye(3), TILTED]),
    },
}


@pytest.mark.slow
@pytest.mark.parametrize("case", SOUGHT)
def test_continuation_of_o_is_as_good_as_a_search(published, case):
    options = SOUGHT[case] | {"criteria": {"leg_limits": (2.5, 6.5), "condition_number": 6.0}, "internal_point": "best"}
    fine = {"resolution": size(4 if case == "positions" else 3, 5), "tolerance": 0.2, "points": 100}
    one, two = (nd.workspace(published, threads=n, **fine, **options) for n in (1, 3))
    assert one.volume == two.volume
    assert_array_equal(one.cells.condition_number, two.cells.condition_number)
    assert one.internal_point_audit == two.internal_point_audit
    assert one.internal_point_audit.poses > 32
    c = one.cells
    every = size(5, 9)
    x, kappa = c.centre[::every], c.condition_number[::every]
    if case == "orientations":
        searched = nd.best_internal_point(
            published, [0.0, 0.0, 4.5], Rotation.from_rotvec(x).as_matrix(), limits=(2.5, 6.5)
        ).value
    else:
        q = SOUGHT[case].get("orientations", np.eye(3)[None])
        searched = np.max([nd.best_internal_point(published, x, one_q, limits=(2.5, 6.5)).value for one_q in q], axis=0)
    known = np.isfinite(searched) & np.isfinite(kappa)
    assert known.sum() > 10
    worse = kappa[known] > searched[known] * (1.0 + 1e-6)
    assert worse.mean() <= 0.01
    assert (kappa[known] >= searched[known] * (1.0 - 1e-4)).mean() > 0.95, "the search rarely misses an optimum"


@pytest.mark.slow
def test_methods_agree_on_the_best_o(published):
    options = {
        "box": ([-2.0, -2.0, 3.5], [2.0, 2.0, 6.0]),
        "criteria": {"leg_limits": (2.0, 7.0), "condition_number": 5.0},
        "internal_point": "best",
    }
    tree = nd.workspace(published, resolution=size(5, 6), tolerance=0.02, points=size(100, 200), **options)
    grid = nd.workspace(published, method="grid", resolution=size(8, 12), **options)
    sample = nd.workspace(published, method="sample", points=64, shifts=8, **options)
    assert grid.internal_point_audit.poses >= 32
    assert sample.internal_point_audit.poses == 0, "each is searched"
    assert abs(grid.volume - tree.volume) <= 3.0 * grid.error + tree.error
    assert abs(sample.volume - tree.volume) <= 4.0 * sample.error + tree.error


# --- Other methods ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_three_methods_agree(published):
    criteria = {"leg_limits": (2.5, 6.5), "condition_number": 6.0}
    tree = nd.workspace(published, BOX, criteria=criteria, tolerance=size(1e-3, 1e-4))
    grid = nd.workspace(published, BOX, criteria=criteria, method="grid", resolution=48)
    sample = nd.workspace(published, BOX, criteria=criteria, method="sample", points=4096)
    assert abs(grid.volume - tree.volume) <= 3.0 * grid.error
    assert abs(sample.volume - tree.volume) <= 3.5 * sample.error
    assert tree.error < 0.1 * min(grid.error, sample.error)
    for other in (grid, sample):
        assert_allclose(other.conditioning_index, tree.conditioning_index, rtol=0.01)
        assert_allclose(other.percentiles[50], tree.percentiles[50], rtol=0.01)
    assert_allclose(grid.ball_radius, tree.ball_radius, rtol=0.15)


@pytest.mark.slow
def test_standard_error_of_a_sample_agrees_with_the_scatter_of_samples(published):
    runs = [
        nd.workspace(published, BOX, criteria={"leg_limits": (2.5, 6.5)}, method="sample", points=512, seed=seed)
        for seed in range(24)
    ]
    scatter = np.std([r.volume for r in runs], ddof=1)
    assert 0.5 < np.mean([r.error for r in runs]) / scatter < 2.0


@pytest.mark.slow
def test_error_is_inverse_to_the_number_of_poses(published):
    """The work grows with the area of the boundary."""
    found = nd.workspace(published, BOX, criteria={"leg_limits": (2.5, 6.5)}, tolerance=size(5e-4, 2e-5))
    _, evaluations, _, error = found.levels[2:].T
    slope = np.polyfit(np.log(evaluations - 25_000), np.log(error), 1)[0]
    assert slope < -0.8


@pytest.mark.slow
def test_units_do_not_change_the_result(published):
    criteria = {"leg_limits": (2.5, 6.5), "condition_number": 6.0, "leg_clearance": 0.1}
    tolerance = size(5e-3, 1e-3)
    one = nd.workspace(published, BOX, criteria=criteria, tolerance=tolerance)
    big = nd.Geometry.hexagonal(a1=0.0, a2=58.124, b1=29.062, b2=0.0)
    scaled = nd.workspace(
        big,
        np.multiply(10.0, BOX),
        criteria={"leg_limits": (25.0, 65.0), "condition_number": 6.0, "leg_clearance": 1.0},
        characteristic_length=10.0,
        tolerance=tolerance,
    )
    assert_allclose(scaled.volume, 1000.0 * one.volume, rtol=1e-6)
    assert_allclose(scaled.conditioning_index, one.conditioning_index, rtol=1e-9)


@pytest.mark.slow
def test_an_audit_finds_a_workspace_that_corners_miss(published):
    """A ball smaller than the first cells that contains none of their corners and centres."""
    high = np.full(9, np.inf)
    high[0] = 0.2
    centre = published.base_external[0] - published.platform_external[0]
    shifted = (centre - 4.0 + 0.11, centre + 4.0 + 0.11)
    # Leg lengths give proofs, so that nothing is missed. The condition number does not, and needs the audit.
    found = nd.workspace(published, shifted, criteria={"leg_limits": (0.0, high)})
    assert_allclose(found.volume, 4.0 / 3.0 * np.pi * 0.2**3, rtol=2e-3)
    kappa = nd.condition_number(published, HOME)
    narrow = {"condition_number": float(kappa) * 1.003}
    box = ([-8.0, -8.0, -1.1], [8.0, 8.0, 14.9])
    near = nd.workspace(published, ([-1.0, -1.0, 3.8], [1.0, 1.0, 5.8]), criteria=narrow)
    assert not near.box_limits
    for points in (1, 60_000):
        found = nd.workspace(published, box, criteria=narrow, resolution=8, points=points, most_evaluations=300_000)
        assert found.volume + found.error >= near.volume - near.error


def test_the_poses_announced_are_about_those_evaluated(published):
    """The error of the first level is a bound: taken for an estimate it announced ten times as many poses."""
    totals = []
    result = nd.workspace(
        published,
        ([-4, -4, 0], [4, 4, 8]),
        criteria={"leg_limits": (1.5, 6.5), "condition_number": 5.0},
        progress=lambda done, total, volume: totals.append(total),
    )
    assert result.status == "converged"
    assert max(totals) < 1.5 * result.evaluations
