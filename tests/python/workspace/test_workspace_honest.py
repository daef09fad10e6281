"""What a workspace map says of sets that cells and corners easily miss: its error must cover the truth."""

import itertools

import numpy as np
import numpy_model as model
import pytest
import workspace_oracle as oracle
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)
LEGS = {"leg_limits": (2.5, 6.5)}


def shell(published, width):
    """Limits of l1 alone, and the volume between two spheres about a fixed point, by numpy."""
    low, high = np.zeros(9), np.full(9, np.inf)
    low[0], high[0] = 4.9, 4.9 + width
    joint = published.base_external[0] - published.platform_external[0]
    # Along z the shell is cut exactly; over x and y a midpoint rule.
    n = size(400, 1000)
    x = -2.5 + 5.0 * (np.arange(n) + 0.5) / n
    across = ((x - joint[0]) ** 2)[:, None] + ((x - joint[1]) ** 2)[None, :]

    def height(radius):
        return np.clip(joint[2] + np.sqrt(np.maximum(radius**2 - across, 0.0)), 3.0, 7.0)

    return {"leg_limits": (low, high)}, (height(4.9 + width) - height(4.9)).sum() * (5.0 / n) ** 2


@pytest.mark.slow
@pytest.mark.parametrize("width", [1e-1, 1e-2, 3e-3, 1e-3])
def test_thin_shells(published, width):
    criteria, truth = shell(published, width)
    found = nd.workspace(published, BOX, criteria=criteria, most_evaluations=size(500_000, 2_000_000))
    assert abs(found.volume - truth) <= found.error


def test_two_extrapolations_that_agree_by_chance(published):
    """From the second to the third level the extrapolated volume moves by 4e-4 only, 0.08 from the truth."""
    found = nd.workspace(
        published,
        archetype="orientation",
        position=[0.2, -0.1, 4.5],
        region={"angle": np.pi},
        criteria={"leg_limits": (1.5, 6.5), "leg_clearance": 0.1},
        most_evaluations=130_000,
    )
    assert abs(np.diff(found.levels[:, 2])[-1]) < 1e-3
    assert abs(found.volume - 13.170) <= found.error


def test_a_set_much_thinner_than_the_first_cells(published):
    """Three shells of the width 0.01 meet: a parallelepiped with curved sides."""
    criteria = {"leg_limits": ([5.0] * 3 + [0.0] * 6, [5.01] * 3 + [np.inf] * 6)}
    centres = published.base_external - published.platform_external
    at = least_squares(lambda p: np.linalg.norm(p - centres, axis=1) - 5.005, [0.0, 0.0, 5.0], xtol=1e-15).x
    exact = 0.01**3 / abs(np.linalg.det((at - centres) / 5.005))
    found = nd.workspace(published, BOX, criteria=criteria)
    assert found.status == "converged"
    assert abs(found.volume - exact) <= found.error + 1e-4 * exact  # the sides are curved
    few = nd.workspace(published, BOX, criteria=criteria, most_evaluations=25_550)
    assert (few.status, few.volume) == ("empty", 0.0)
    assert few.error >= exact


def pose_of(kind, rng):
    """The set of poses of a map, and p and Q at its coordinates."""
    if kind == "positions":
        q = Rotation.from_rotvec(0.3 * rng.normal(size=3)).as_matrix()
        return {"box": BOX, "rotation": q}, lambda x: (x, np.broadcast_to(q, (len(x), 3, 3)))
    at = np.array([0.2, -0.1, 4.6])
    region = {"angle": 1.3} if kind == "vectors" else {"tilt": 0.9, "torsion": 1.1}

    def pose(x):
        turn = Rotation.from_rotvec(x)
        if kind == "tilts":
            zero = np.zeros(len(x))
            turn = Rotation.from_rotvec(np.stack([-x[:, 1], x[:, 0], zero], axis=1))
            turn *= Rotation.from_rotvec(np.stack([zero, zero, x[:, 2]], axis=1))
        return np.broadcast_to(at, x.shape), turn.as_matrix()

    return {"archetype": "orientation", "position": at, "region": region}, pose


def inside_region(kind, x):
    if kind == "positions":
        return ((x >= BOX[0]) & (x <= BOX[1])).all(axis=1)
    return np.linalg.norm(x if kind == "vectors" else x[:, :2], axis=1) <= (1.3 if kind == "vectors" else 0.9)


@pytest.mark.parametrize("kind", ["positions", "vectors", "tilts"])
def test_cells_are_proved_where_legs_alone_limit(kind):
    rng = np.random.default_rng(1)
    for _ in range(size(2, 30)):
        g = oracle.some_robot(rng)
        options, pose = pose_of(kind, rng)
        low, high = rng.uniform(0.5, 2.5, 9), rng.uniform(4.0, 6.5, 9)
        found = nd.workspace(g, criteria={"leg_limits": (low, high)}, resolution=8, tolerance=0.05, **options)
        x = found.low + rng.uniform(size=(size(10_000, 100_000), 3)) * (found.high - found.low)
        p, q = pose(x)
        m = oracle.robots(g, p, q, oracle.half_way(g, p, q))
        allowed = oracle.legs_allowed(m, low, high) & inside_region(kind, x)
        state = oracle.states_at(found.cells, found.low, x)
        assert allowed[state == 2].all()
        assert not allowed[state == 0].any()
        share = allowed.mean() * np.prod(found.high - found.low)
        if kind == "positions":
            scatter = np.prod(found.high - found.low) / np.sqrt(4.0 * len(x))
            assert abs(found.volume - share) <= found.error + 4.0 * scatter


@pytest.mark.parametrize("kind", ["positions", "vectors", "tilts"])
def test_the_largest_ball_and_box_are_inside(published, kind):
    rng = np.random.default_rng(2)
    for n in range(size(2, 30)):
        g = published if n == 0 else oracle.some_robot(rng)
        options, pose = pose_of(kind, rng)
        kappa = 1.7 * float(nd.condition_number(g, HOME))
        criteria = {"leg_limits": (2.0, 6.7)} | ({"condition_number": kappa} if n % 2 == 0 else {})
        found = nd.workspace(g, criteria=criteria, tolerance=0.03, home=HOME, **options)
        way = rng.normal(size=(500, 3))
        ball = found.ball_centre + found.ball_radius * way / np.linalg.norm(way, axis=1, keepdims=True)
        middle, half = 0.5 * (found.box_low + found.box_high), 0.5 * (found.box_high - found.box_low)
        box = middle + half * way / np.abs(way).max(axis=1, keepdims=True)
        for body in (ball, box):
            x = body + 1e-9 * (middle - body)
            p, q = pose(x)
            m = oracle.robots(g, p, q, oracle.half_way(g, p, q))
            allowed = oracle.legs_allowed(m, 2.0, 6.7) & inside_region(kind, x)
            assert allowed.all()
            assert n % 2 == 1 or (model.condition_number(m) <= kappa).all()


@pytest.fixture(scope="module")
def expected(published):
    return nd.workspace(published, ([-10] * 3, [10] * 3), criteria=LEGS, home=HOME, tolerance=size(4e-3, 1e-3))


@pytest.mark.slow
@pytest.mark.parametrize("half", [30.0, 100.0, 160.0, 1000.0])
def test_boxes_much_larger_than_the_workspace(published, expected, half):
    box = ([-half] * 3, [half] * 3)
    found = nd.workspace(published, box, criteria=LEGS, home=HOME, tolerance=size(1e-2, 1e-3))
    assert found.home_allowed
    assert found.status == nd.WorkspaceStatus.CONVERGED or half > 500.0
    assert abs(found.volume - expected.volume) <= found.error + expected.error


@pytest.mark.slow
@pytest.mark.parametrize(("method", "few"), [("grid", {"resolution": 8}), ("sample", {"points": 200})])
def test_nothing_found_is_not_nothing(published, method, few):
    criteria = {"condition_number": 4.003}
    found = nd.workspace(published, BOX, criteria=criteria, method=method, **few)
    assert found.status == nd.WorkspaceStatus.EMPTY
    assert found.unseen > 0.0
    assert found.error >= nd.workspace(published, BOX, criteria=criteria, home=HOME, tolerance=0.05).volume


@pytest.mark.parametrize(("method", "few"), [("grid", {"resolution": 8}), ("sample", {"points": 64, "shifts": 4})])
def test_everything_found_is_not_everything(published, method, few):
    """One corner of the box is forbidden, where no point lies."""
    low, high = np.array([-0.3, -0.3, 4.5]), np.array([0.3, 0.3, 5.1])
    corners = np.array(list(itertools.product(*zip(low, high, strict=True))))
    o = 0.5 * (corners + published.platform_internal.mean(axis=0))
    longest = nd.leg_lengths(published, nd.Configuration(corners, None, o)).max()
    criteria = {"leg_limits": (0.0, longest * 0.993)}
    found = nd.workspace(published, (low, high), criteria=criteria, method=method, **few)
    proved = nd.certified_workspace(published, (low, high), criteria=criteria, gap=1e-5)
    assert found.volume == pytest.approx(0.6**3)
    assert proved.volume[1] < 0.6**3 - 1e-9
    assert found.volume - proved.volume[1] <= found.error <= found.unseen * (1.0 + 1e-12)


@pytest.mark.slow
def test_a_grid_errs_by_less_than_it_says(published):
    reference = nd.workspace(published, BOX, criteria=LEGS, tolerance=size(5e-4, 2e-4))
    for resolution in (16, 32, 48):
        found = nd.workspace(published, BOX, criteria=LEGS, method="grid", resolution=resolution)
        assert abs(found.volume - reference.volume) <= found.error


def test_every_pixel_of_a_slice_is_its_cell(published):
    found = nd.workspace(published, BOX, criteria=LEGS | {"condition_number": 5.0}, tolerance=0.02)
    c = found.cells
    for pixels in (50, 240, 241):
        s = found.slice("z", 4.81, pixels)
        x = -2.5 + 5.0 * (np.arange(pixels) + 0.5) / pixels
        at = np.array([[a, b, 4.81] for b in x[:: pixels // 25] for a in x[:: pixels // 25]])
        seen = s.state[:: pixels // 25, :: pixels // 25].ravel()
        for point, state in zip(at, seen, strict=True):
            away = np.abs(point - c.centre) - 0.5 * c.size
            around = (away <= 1e-9).all(axis=1)  # several on a face
            assert around.any()
            assert state in c.state[around], point
