"""Workspaces compared with known volumes and with a fine Monte Carlo sample in plain numpy."""

import numpy as np
import numpy_model as model
import pytest
import workspace_oracle as oracle
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

BOX = ([-4.0, -4.0, 0.0], [4.0, 4.0, 8.0])
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)
TILTED = Rotation.from_rotvec([0.15, -0.1, 0.2]).as_matrix()


def sampled(rng, count, low=BOX[0], high=BOX[1]):
    return np.asarray(low) + rng.uniform(size=(count, 3)) * np.subtract(high, low)


def agrees(found, allowed, points):
    """Check that the volume is that of the sample, and that no point contradicts a cell inside or outside."""
    volume = np.prod(found.high - found.low)
    share = allowed.mean()
    standard_error = volume * np.sqrt(share * (1.0 - share) / len(points))
    assert abs(found.volume - share * volume) <= 4.0 * standard_error + found.error
    state = oracle.states_at(found.cells, found.low, points)
    wrong = np.sum((state == 2) & ~allowed) + np.sum((state == 0) & allowed)
    assert wrong * volume / len(points) <= 5.0 * found.unseen + 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("rotation", [np.eye(3), TILTED])
def test_leg_limits_give_balls(published, rotation):
    """With O fixed in the platform six legs depend on p, each limited to a ball: an exact volume."""
    low, high = np.full(9, 2.5), np.full(9, 6.5)
    o = np.array([0.1, -0.2, -2.4])
    high[3:6], low[3:6] = np.inf, 0.0  # lengths that the platform fixes
    tolerance = size(4e-3, 1e-3)
    found = nd.workspace(
        published,
        BOX,
        rotation=rotation,
        criteria={"leg_limits": (low, high)},
        internal_point={"platform": o},
        tolerance=tolerance,
    )
    centres = [
        *(published.base_external - published.platform_external @ rotation.T),
        *(published.base_internal - rotation @ o),
    ]
    exact = oracle.volume_of_balls([(c, 6.5) for c in centres], [(c, 2.5) for c in centres], *BOX, size(200, 600))
    assert found.status == "converged"
    assert found.error < tolerance * found.volume
    assert abs(found.volume - exact) <= found.error
    assert found.unseen < 1e-3 * found.volume


def test_all_criteria_against_numpy(published):
    rng = np.random.default_rng(1)
    criteria = {
        "leg_limits": (2.0, 6.8),
        "base_cone": 0.35,
        "platform_cone": {"max": 1.1, "axis": [0.1, 0.0, -1.0]},
        "leg_clearance": 1.7,
        "condition_number": 7.0,
    }
    asked = {"home": HOME, "rotation": TILTED, "tolerance": size(4e-3, 1e-3)}
    found = nd.workspace(published, BOX, criteria=criteria, **asked)
    p = sampled(rng, size(10_000, 25_000))
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
        more = nd.workspace(published, BOX, criteria=rest, **asked)
        assert more.volume > found.volume + found.error


def test_indices_against_numpy(published):
    rng = np.random.default_rng(2)
    found = nd.workspace(published, BOX, criteria={"leg_limits": (2.5, 6.5), "condition_number": 5.0})
    p = sampled(
        rng,
        size(60_000, 400_000),
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


# --- Connected with home ----------------------------------------------------------------------------------------------


def test_singularity_free_keeps_the_signs_and_the_piece_of_home(published):
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


def test_a_home_outside_names_the_limit(published):
    criteria = {"leg_limits": (2.5, 6.5), "singularity_free": True}
    high = nd.workspace(published, BOX, criteria=criteria, home=nd.Configuration.neutral(zp=7.9, zs=3.0))
    assert (high.status, high.volume, high.home_allowed) == ("empty", 0.0, False)
    assert high.home_limit in ("l1 high", "l2 high", "l3 high")
    beyond = nd.workspace(published, BOX, criteria=criteria, home=nd.Configuration.neutral(zp=9.0, zs=3.0))
    assert beyond.home_limit == "box"


@pytest.mark.parametrize("method", ["octree", "grid"])
def test_nothing_is_connected_with_a_home_just_outside(published, method):
    """The cell around it is on the boundary and has allowed corners."""
    home = nd.Configuration.neutral(zp=5.4, zs=2.7)
    longest = float(nd.leg_lengths(published, home).max())
    criteria = {"leg_limits": (2.5, longest * (1.0 - 1e-4)), "singularity_free": True}
    found = nd.workspace(published, BOX, criteria=criteria, home=home, tolerance=0.05, method=method)
    assert (found.status, found.volume, found.home_allowed) == ("empty", 0.0, False)


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
    count = 400_000
    q = Rotation.random(count, random_state=rng)
    seen = q * Rotation.from_matrix(TILTED).inv()
    matrix = seen.as_matrix()
    if "angle" in region:
        inside = seen.magnitude() <= 0.9
    else:
        tilt = np.arccos(matrix[:, 2, 2])
        towards = np.arctan2(matrix[:, 1, 2], matrix[:, 0, 2])
        near = np.flatnonzero(tilt <= 0.8)
        tilts = Rotation.from_euler("ZYZ", np.stack([towards, tilt, -towards], axis=1)[near])
        torsion = (tilts.inv() * seen[near]).as_rotvec()[:, 2]  # about z: its length is the angle
        inside = np.zeros(count, dtype=bool)
        inside[near] = (torsion >= -0.6) & (torsion <= 0.9)
    matrix = q.as_matrix()[inside]
    p = np.broadcast_to(at, (len(matrix), 3))
    m = oracle.robots(published, p, matrix, oracle.half_way(published, p, matrix))
    share = oracle.legs_allowed(m, 2.6, 6.2).sum() / count
    whole = 8.0 * np.pi**2
    assert_allclose(found.chart_volume, inside.mean() * whole, rtol=0.02)
    scatter = whole * np.sqrt(share * (1.0 - share) / count)
    assert abs(found.volume - share * whole) <= 4.0 * scatter + found.error
    assert found.error < 1e-3 * found.volume


@pytest.mark.slow
def test_reachable_and_inclusive_against_numpy(published):
    rng = np.random.default_rng(6)
    q = Rotation.from_rotvec(0.25 * rng.normal(size=(5, 3))).as_matrix()
    asked = {"criteria": {"leg_limits": (2.4, 6.6), "condition_number": 7.0}, "tolerance": size(1e-2, 1e-3)}
    p = sampled(rng, size(10_000, 30_000))
    each = []
    for one in q:
        m = oracle.robots(published, p, one, oracle.half_way(published, p, one))
        each.append(oracle.legs_allowed(m, 2.4, 6.6) & (model.condition_number(m) <= 7.0))
    for archetype, allowed in (("reachable", np.any(each, axis=0)), ("inclusive", np.all(each, axis=0))):
        found = nd.workspace(published, BOX, archetype=archetype, orientations=q, **asked)
        agrees(found, allowed, p)
    one = nd.workspace(published, BOX, rotation=q[2], **asked)
    for archetype in ("reachable", "inclusive"):
        same = nd.workspace(published, BOX, archetype=archetype, orientations=q[2:3], **asked)
        assert abs(same.volume - one.volume) <= same.error + one.error


@pytest.mark.slow
def test_dexterous_is_inclusive_of_spread_rotations(published):
    criteria = {"leg_limits": (0.5, 9.5)}
    options = {"criteria": criteria, "tolerance": 0.02, "resolution": 8, "points": 500}
    dexterous = nd.workspace(published, BOX, archetype="dexterous", orientations=24, **options)
    inclusive = nd.workspace(published, BOX, archetype="inclusive", orientations=nd.spread_rotations(24), **options)
    assert dexterous.volume == inclusive.volume > 0.0
    p = dexterous.ball_centre + np.zeros((24, 3))
    q = nd.spread_rotations(24)
    assert oracle.legs_allowed(oracle.robots(published, p, q, oracle.half_way(published, p, q)), 0.5, 9.5).all()
