"""Workspaces against volumes known another way, and against a fine Monte Carlo in plain numpy."""

import numpy as np
import numpy_model as model
import pytest
import workspace_oracle as oracle
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation

import ninedof as nd

BOX = ([-4.0, -4.0, 0.0], [4.0, 4.0, 8.0])
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)
TILTED = Rotation.from_rotvec([0.15, -0.1, 0.2]).as_matrix()


def sampled(rng, count, low=BOX[0], high=BOX[1]):
    return np.asarray(low) + rng.uniform(size=(count, 3)) * np.subtract(high, low)


def agrees(found, allowed, points):
    """The map's volume is that of the sample, and no cell that was decided holds a point that says otherwise."""
    volume = np.prod(found.high - found.low)
    share = allowed.mean()
    standard_error = volume * np.sqrt(share * (1.0 - share) / len(points))
    assert abs(found.volume - share * volume) <= 4.0 * standard_error + found.error
    c = found.cells
    wrong = 0
    for state, expected in ((2, True), (0, False)):
        low, high = (c.centre[c.state == state] + k * c.size[c.state == state] for k in (-0.5, 0.5))
        against = points[allowed != expected]
        for at in against:
            wrong += bool(((at >= low) & (at <= high)).all(axis=1).any())
    assert wrong * volume / len(points) <= 5.0 * found.unseen + 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("rotation", [np.eye(3), TILTED])
def test_leg_limits_are_balls(published, rotation):
    """With O in the platform's frame only six legs depend on p, each by a ball: an exact volume."""
    low, high = np.full(9, 2.5), np.full(9, 6.5)
    o = np.array([0.1, -0.2, -2.4])
    high[3:6], low[3:6] = np.inf, 0.0  # lengths that the platform fixes
    found = nd.workspace(
        published, BOX, rotation=rotation, criteria={"leg_limits": (low, high)}, internal_point={"platform": o}
    )
    centres = [
        *(published.base_external - published.platform_external @ rotation.T),
        *(published.base_internal - rotation @ o),
    ]
    exact = oracle.volume_of_balls([(c, 6.5) for c in centres], [(c, 2.5) for c in centres], *BOX)
    assert found.status == "converged"
    assert found.error < 1e-3 * found.volume
    assert abs(found.volume - exact) <= found.error
    assert found.unseen < 1e-3 * found.volume


def test_internal_legs_half_way_are_balls_of_twice_the_radius(published):
    found = nd.workspace(published, BOX, criteria={"leg_limits": ([0.0] * 6 + [3.4] * 3, [np.inf] * 6 + [4.4] * 3)})
    middle = published.platform_internal.mean(axis=0)
    centres = [2.0 * r - middle - published.base_internal.mean(axis=0) for r in published.base_internal]
    exact = oracle.volume_of_balls([(c, 8.8) for c in centres], [(c, 6.8) for c in centres], *BOX)
    assert abs(found.volume - exact) <= found.error < 1e-3 * found.volume


def test_the_error_is_what_it_says(published):
    criteria = {"leg_limits": (2.5, 6.5), "condition_number": 5.0, "singularity_free": True}
    best = nd.workspace(published, BOX, criteria=criteria, home=HOME, tolerance=1e-4, resolution=20)
    for tolerance in (3e-2, 1e-2, 1e-3):
        found = nd.workspace(published, BOX, criteria=criteria, home=HOME, tolerance=tolerance)
        assert found.error <= tolerance * found.volume
        assert abs(found.volume - best.volume) <= found.error + best.error


def test_all_criteria_against_numpy(published):
    rng = np.random.default_rng(1)
    criteria = {
        "leg_limits": (2.0, 6.8),
        "base_cone": 0.35,
        "platform_cone": {"max": 1.1, "axis": [0.1, 0.0, -1.0]},
        "leg_clearance": 1.7,
        "condition_number": 7.0,
    }
    found = nd.workspace(published, BOX, criteria=criteria, home=HOME, rotation=TILTED)
    p = sampled(rng, 25_000)
    m = oracle.robots(published, p, TILTED, oracle.half_way(published, p, TILTED))
    home = model.robot(published, HOME)
    near = oracle.legs_allowed(m, 2.0, 6.8)
    each = {
        "leg_limits": near,
        "base_cone": oracle.angles(m, False, home=home).max(axis=-1) <= 0.35,
        "platform_cone": oracle.angles(m, True, axis=np.array([0.1, 0.0, -1.0])).max(axis=-1) <= 1.1,
        "condition_number": model.condition_number(m) <= 7.0,
    }
    allowed = np.logical_and.reduce(list(each.values()))
    candidates = np.flatnonzero(allowed)
    close = oracle.clearance(oracle.robots(published, p[candidates], TILTED, m.s[candidates])) < 1.7
    allowed[candidates[close]] = False
    assert 0 < close.sum() < len(candidates)
    agrees(found, allowed, p)
    # Each limit ends the workspace somewhere, and one that is dropped makes it larger.
    assert set(found.limits(grouped=True)) <= set(criteria)
    for name in ("leg_clearance", "base_cone"):
        assert found.limits(grouped=True)[name] > 0.01
        rest = {k: v for k, v in criteria.items() if k != name}
        more = nd.workspace(published, BOX, criteria=rest, home=HOME, rotation=TILTED)
        assert more.volume > found.volume + found.error


def test_indices_against_numpy(published):
    rng = np.random.default_rng(2)
    found = nd.workspace(published, BOX, criteria={"leg_limits": (2.5, 6.5), "condition_number": 5.0})
    p = sampled(
        rng,
        400_000,
        found.cells.centre[found.cells.state > 0].min(axis=0),
        found.cells.centre[found.cells.state > 0].max(axis=0),
    )
    m = oracle.robots(published, p, np.eye(3), oracle.half_way(published, p, np.eye(3)))
    m = m.at(oracle.legs_allowed(m, 2.5, 6.5))
    kappa = model.condition_number(m)
    kappa = kappa[kappa <= 5.0]
    index = np.mean(1.0 / kappa)
    scatter = np.std(1.0 / kappa) / np.sqrt(kappa.size)
    assert abs(found.conditioning_index - index) <= 4.0 * scatter + found.conditioning_index_error
    assert found.conditioning_index_error < 2e-3
    assert_allclose(found.percentiles[[5, 25, 50, 75, 95]], np.percentile(kappa, [5, 25, 50, 75, 95]), rtol=0.015)
    assert 4.99 < found.worst_condition_number <= 5.0
    worst = nd.Configuration(found.worst_at, None, 0.5 * found.worst_at)
    assert_allclose(nd.condition_number(published, worst), found.worst_condition_number, rtol=1e-12)


def test_ball_and_box_are_inside_and_not_by_much(published):
    rng = np.random.default_rng(3)
    found = nd.workspace(published, BOX, criteria={"leg_limits": (2.5, 6.5), "condition_number": 5.0})

    def share(p):
        m = oracle.robots(published, p, np.eye(3), oracle.half_way(published, p, np.eye(3)))
        return np.mean(oracle.legs_allowed(m, 2.5, 6.5) & (model.condition_number(m) <= 5.0))

    u = rng.normal(size=(4000, 3))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    assert share(found.ball_centre + 0.998 * found.ball_radius * u) == 1.0
    assert share(found.ball_centre + 1.02 * found.ball_radius * u) < 1.0
    inside = sampled(rng, 20_000, found.box_low, found.box_high)
    assert share(inside) > 0.9995
    side = found.box_high - found.box_low
    assert share(sampled(rng, 20_000, found.box_low - 0.03 * side, found.box_high + 0.03 * side)) < 1.0
    assert np.prod(side) > np.prod(2.0 * found.ball_radius / np.sqrt(3.0) * np.ones(3))


# --- Connected with home ----------------------------------------------------------------------------------------------


def test_singularity_free_keeps_signs_and_piece(published):
    rng = np.random.default_rng(4)
    criteria = {"leg_limits": (0.8, 7.0), "singularity_free": True}
    box = ([-4.0, -4.0, -8.0], [4.0, 4.0, 8.0])
    found = nd.workspace(published, box, criteria=criteria, home=HOME)
    p = sampled(rng, 60_000, *box)
    m = oracle.robots(published, p, np.eye(3), oracle.half_way(published, p, np.eye(3)))
    at_home = oracle.signs(oracle.robots(published, HOME.position[None], np.eye(3), HOME.internal_point))
    signed = oracle.legs_allowed(m, 0.8, 7.0) & (oracle.signs(m) == at_home).all(axis=-1)
    share = signed.mean() * np.prod(np.subtract(*box[::-1]))
    # All pieces together are the set by signs; the one of home comes first and is the volume.
    assert_allclose(found.pieces.sum(), share, rtol=0.05)
    assert found.pieces[0] == pytest.approx(found.volume)
    c = found.cells
    assert (c.piece[c.state == 0] == -1).all()
    home_cell = np.argmin(np.linalg.norm(c.centre - HOME.position, axis=1))
    assert c.piece[home_cell] == 0


def test_pieces_below_and_above_the_base(published):
    """Legs cannot tell above from below, where the robot is its own mirror image: two pieces of one volume."""
    criteria = {"leg_limits": (3.0, 6.5)}
    box = ([-4.0, -4.0, -8.0], [4.0, 4.0, 8.0])
    both = nd.workspace(published, box, criteria=criteria)
    assert_allclose(both.pieces[0], both.pieces[1], rtol=1e-3)
    assert_allclose(both.pieces[:2].sum(), both.volume, rtol=1e-3)
    home = nd.Configuration.neutral(zp=5.4, zs=2.7)
    above = nd.workspace(published, box, criteria=criteria | {"singularity_free": True}, home=home)
    assert above.volume <= both.pieces[0] + both.error + above.error
    assert above.cells.centre[above.cells.piece == 0][:, 2].min() > 0.0


def test_home_outside_says_why(published):
    criteria = {"leg_limits": (2.5, 6.5), "singularity_free": True}
    high = nd.workspace(published, BOX, criteria=criteria, home=nd.Configuration.neutral(zp=7.9, zs=3.0))
    assert (high.status, high.volume, high.home_allowed) == ("empty", 0.0, False)
    assert high.home_limit in ("l1 high", "l2 high", "l3 high")
    beyond = nd.workspace(published, BOX, criteria=criteria, home=nd.Configuration.neutral(zp=9.0, zs=3.0))
    assert beyond.home_limit == "box"


# --- Other archetypes -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("region", [{"angle": 0.9}, {"tilt": 0.8, "torsion": (-0.6, 0.9)}])
def test_orientations_against_numpy(published, region):
    rng = np.random.default_rng(5)
    at = np.array([0.2, -0.1, 4.7])
    found = nd.workspace(
        published,
        archetype="orientation",
        position=at,
        region=region,
        rotation=TILTED,
        criteria={"leg_limits": (2.6, 6.2)},
    )
    # Uniform over all of SO(3) by quaternions, then those of the region by angles that scipy has.
    q = Rotation.random(400_000, random_state=rng)
    seen = q * Rotation.from_matrix(TILTED).inv()
    matrix = seen.as_matrix()
    if "angle" in region:
        inside = seen.magnitude() <= 0.9
    else:
        tilt = np.arccos(matrix[:, 2, 2])
        towards = np.arctan2(matrix[:, 1, 2], matrix[:, 0, 2])
        torsion = (Rotation.from_euler("ZYZ", np.stack([towards, tilt, -towards], axis=1)).inv() * seen).magnitude()
        sense = (Rotation.from_euler("ZYZ", np.stack([towards, tilt, -towards], axis=1)).inv() * seen).as_rotvec()[:, 2]
        inside = (tilt <= 0.8) & (np.copysign(torsion, sense) >= -0.6) & (np.copysign(torsion, sense) <= 0.9)
    matrix = q.as_matrix()[inside]
    p = np.broadcast_to(at, (len(matrix), 3))
    m = oracle.robots(published, p, matrix, oracle.half_way(published, p, matrix))
    share = oracle.legs_allowed(m, 2.6, 6.2).sum() / 400_000
    whole = 8.0 * np.pi**2
    assert_allclose(found.chart_volume, inside.mean() * whole, rtol=0.02)
    scatter = whole * np.sqrt(share * (1.0 - share) / 400_000)
    assert abs(found.volume - share * whole) <= 4.0 * scatter + found.error
    assert found.error < 1e-3 * found.volume


@pytest.mark.slow
def test_reachable_and_inclusive_against_numpy(published):
    rng = np.random.default_rng(6)
    q = Rotation.from_rotvec(0.25 * rng.normal(size=(5, 3))).as_matrix()
    criteria = {"leg_limits": (2.4, 6.6), "condition_number": 7.0}
    p = sampled(rng, 30_000)
    each = []
    for one in q:
        m = oracle.robots(published, p, one, oracle.half_way(published, p, one))
        each.append(oracle.legs_allowed(m, 2.4, 6.6) & (model.condition_number(m) <= 7.0))
    for archetype, allowed in (("reachable", np.any(each, axis=0)), ("inclusive", np.all(each, axis=0))):
        found = nd.workspace(published, BOX, archetype=archetype, orientations=q, criteria=criteria)
        agrees(found, allowed, p)
    one = nd.workspace(published, BOX, rotation=q[2], criteria=criteria)
    for archetype in ("reachable", "inclusive"):
        same = nd.workspace(published, BOX, archetype=archetype, orientations=q[2:3], criteria=criteria)
        assert abs(same.volume - one.volume) <= same.error + one.error


def test_dexterous_is_inclusive_of_spread_rotations(published):
    criteria = {"leg_limits": (0.5, 9.5)}
    options = {"criteria": criteria, "tolerance": 0.02, "resolution": 8, "points": 500}
    dexterous = nd.workspace(published, BOX, archetype="dexterous", orientations=24, **options)
    inclusive = nd.workspace(published, BOX, archetype="inclusive", orientations=nd.spread_rotations(24), **options)
    assert dexterous.volume == inclusive.volume > 0.0
    p = dexterous.ball_centre + np.zeros((24, 3))
    q = nd.spread_rotations(24)
    assert oracle.legs_allowed(oracle.robots(published, p, q, oracle.half_way(published, p, q)), 0.5, 9.5).all()


# --- O ----------------------------------------------------------------------------------------------------------------


def test_the_best_o_allows_what_any_rule_allows(published):
    box = ([-2.0, -2.0, 3.5], [2.0, 2.0, 6.0])
    criteria = {"leg_limits": (2.5, 6.5), "condition_number": 5.0}
    options = {"criteria": criteria, "resolution": 6, "tolerance": 0.05}
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


@pytest.mark.parametrize("case", SOUGHT)
def test_o_continued_from_neighbours_is_as_good_as_searched(published, case):
    options = SOUGHT[case] | {"criteria": {"leg_limits": (2.5, 6.5), "condition_number": 6.0}, "internal_point": "best"}
    one, two = (nd.workspace(published, resolution=5, tolerance=0.2, points=100, threads=n, **options) for n in (1, 3))
    assert one.volume == two.volume
    assert_array_equal(one.cells.condition_number, two.cells.condition_number)
    assert one.internal_point_audit == two.internal_point_audit
    assert one.internal_point_audit.poses > 32
    c = one.cells
    x, kappa = c.centre[::9], c.condition_number[::9]
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
    assert (kappa[known] >= searched[known] * (1.0 - 1e-4)).mean() > 0.95, "the search misses few that we have"


def test_methods_agree_on_the_best_o(published):
    options = {
        "box": ([-2.0, -2.0, 3.5], [2.0, 2.0, 6.0]),
        "criteria": {"leg_limits": (2.0, 7.0), "condition_number": 5.0},
        "internal_point": "best",
    }
    tree = nd.workspace(published, resolution=6, tolerance=0.02, points=200, **options)
    grid = nd.workspace(published, method="grid", resolution=12, **options)
    sample = nd.workspace(published, method="sample", points=64, shifts=8, **options)
    assert grid.internal_point_audit.poses >= 32
    assert sample.internal_point_audit.poses == 0, "each is searched"
    assert abs(grid.volume - tree.volume) <= 3.0 * grid.error + tree.error
    assert abs(sample.volume - tree.volume) <= 4.0 * sample.error + tree.error


# --- Other methods ----------------------------------------------------------------------------------------------------


def test_three_methods_agree(published):
    criteria = {"leg_limits": (2.5, 6.5), "condition_number": 6.0}
    tree = nd.workspace(published, BOX, criteria=criteria, tolerance=1e-4)
    grid = nd.workspace(published, BOX, criteria=criteria, method="grid", resolution=48)
    sample = nd.workspace(published, BOX, criteria=criteria, method="sample", points=4096)
    assert abs(grid.volume - tree.volume) <= 3.0 * grid.error
    assert abs(sample.volume - tree.volume) <= 3.5 * sample.error
    assert tree.error < 0.1 * min(grid.error, sample.error)
    for other in (grid, sample):
        assert_allclose(other.conditioning_index, tree.conditioning_index, rtol=0.01)
        assert_allclose(other.percentiles[50], tree.percentiles[50], rtol=0.01)
    assert_allclose(grid.ball_radius, tree.ball_radius, rtol=0.15)


def test_standard_error_of_a_sample_is_the_scatter_of_samples(published):
    runs = [
        nd.workspace(published, BOX, criteria={"leg_limits": (2.5, 6.5)}, method="sample", points=512, seed=seed)
        for seed in range(24)
    ]
    scatter = np.std([r.volume for r in runs], ddof=1)
    assert 0.5 < np.mean([r.error for r in runs]) / scatter < 2.0


def test_error_falls_with_the_surface(published):
    """Work grows with the boundary's area: the error falls about as one over the poses looked at."""
    found = nd.workspace(published, BOX, criteria={"leg_limits": (2.5, 6.5)}, tolerance=2e-5)
    _, evaluations, _, error = found.levels[2:].T
    slope = np.polyfit(np.log(evaluations - 25_000), np.log(error), 1)[0]
    assert slope < -0.8


def test_threads_and_units_change_nothing(published):
    criteria = {"leg_limits": (2.5, 6.5), "condition_number": 6.0, "leg_clearance": 0.1}
    one, two = (nd.workspace(published, BOX, criteria=criteria, threads=n) for n in (1, 2))
    assert one.volume == two.volume
    assert_array_equal(one.cells.limit, two.cells.limit)
    big = nd.Geometry.hexagonal(a1=0.0, a2=58.124, b1=29.062, b2=0.0)
    scaled = nd.workspace(
        big,
        np.multiply(10.0, BOX),
        criteria={"leg_limits": (25.0, 65.0), "condition_number": 6.0, "leg_clearance": 1.0},
        characteristic_length=10.0,
    )
    assert_allclose(scaled.volume, 1000.0 * one.volume, rtol=1e-6)
    assert_allclose(scaled.conditioning_index, one.conditioning_index, rtol=1e-9)


def test_an_audit_finds_what_corners_do_not(published):
    """A ball smaller than the first cells, and off their corners and centres."""
    high = np.full(9, np.inf)
    high[0] = 0.2
    centre = published.base_external[0] - published.platform_external[0]
    shifted = (centre - 4.0 + 0.11, centre + 4.0 + 0.11)
    # A length proves: nothing is missed however small. A condition number proves nothing: it takes the audit.
    found = nd.workspace(published, shifted, criteria={"leg_limits": (0.0, high)})
    assert_allclose(found.volume, 4.0 / 3.0 * np.pi * 0.2**3, rtol=2e-3)
    kappa = nd.condition_number(published, HOME)
    narrow = {"condition_number": float(kappa) * 1.003}
    box = ([-8.0, -8.0, -1.1], [8.0, 8.0, 14.9])
    blind = nd.workspace(published, box, criteria=narrow, resolution=8, points=1)
    audited = nd.workspace(published, box, criteria=narrow, resolution=8, points=60_000)
    assert audited.volume >= blind.volume - blind.error - blind.unseen
    assert audited.unseen < blind.unseen
