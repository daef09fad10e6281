"""What is proved of a workspace: its volume, and where poses are allowed or not.

Oracle: every criterion in numpy from its definition, at random poses; volumes of closed form. None of it shares code
with the proof.
"""

import numpy as np
import numpy_model as model
import pytest
import workspace_oracle as oracle
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

BOX = ([-3.5, -3.5, 2.0], [3.5, 3.5, 8.0])
WIDE = ([-9.0, -9.0, -9.0], [9.0, 9.0, 9.0])
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)
LEGS = {"leg_limits": (2.5, 6.5)}
FREE = np.full(9, np.inf)


def margins(g, m, criteria, home):
    """The least margin of all criteria at each pose, each of the size of 1: negative where a pose is not allowed."""
    low, high = (np.broadcast_to(end, 9) for end in criteria.get("leg_limits", (0.0, np.inf)))
    length = model.lengths(m)
    least = np.minimum(length - low, high - length).min(axis=1)
    for platform, name in enumerate(("base_cone", "platform_cone")):
        if name in criteria:
            limit = criteria[name]
            angle, axis = (limit["max"], limit["axis"]) if isinstance(limit, dict) else (limit, None)
            reached = oracle.angles(m, bool(platform), axis, model.robot(g, home))
            least = np.minimum(least, (angle - reached).min(axis=1))
    if "condition_number" in criteria:
        with np.errstate(all="ignore"):
            least = np.minimum(least, criteria["condition_number"] / model.condition_number(m) - 1.0)
    if criteria.get("singularity_free"):
        sides = oracle.signs(m) * oracle.signs(model.robot(g, nd.Configuration(*(x[None] for x in home_parts(home)))))
        least = np.where((sides > 0.0).all(axis=1), least, -1.0)
    if "leg_clearance" in criteria:  # sampled: too large by at most 2e-2 here
        apart = oracle.clearance(m) - criteria["leg_clearance"]
        least = np.minimum(least, np.where(apart < 0.0, apart, np.maximum(apart, 0.0)))
    return least


def home_parts(home):
    return home.position, home.rotation, home.internal_point


def sampled(proved, rng, count):
    """Positions in the box asked for: anywhere, near faces of boxes, and in open boxes."""
    low, high = proved.box_low, proved.box_high
    anywhere = low + rng.random((count, 3)) * (high - low)
    if not len(proved.open_low):
        return anywhere
    box = rng.integers(len(proved.open_low), size=count)
    side = proved.open_high[box] - proved.open_low[box]
    return np.concatenate([anywhere, proved.open_low[box] + rng.random((count, 3)) * side])


QUESTIONS = {
    "legs": LEGS,
    "condition": LEGS | {"condition_number": 5.0},
    "signs": {"leg_limits": (1.5, 7.0), "singularity_free": True},
    "cones": {"base_cone": 0.5, "platform_cone": {"max": 1.2, "axis": (0.1, 0.0, -1.0)}},
    "clearance": {"leg_limits": (1.5, 7.0), "leg_clearance": 0.35},
    "all": {
        "leg_limits": (2.0, 6.8),
        "condition_number": 8.0,
        "singularity_free": True,
        "base_cone": 0.7,
        "platform_cone": 0.7,
        "leg_clearance": 0.1,
    },
}
RULES = {"between": 0.45, "fixed": (0.1, -0.2, 2.2), "platform": {"platform": (0.1, 0.0, -2.4)}}


def placed(rule, g, p, q):
    if rule == "fixed":
        return np.broadcast_to(RULES["fixed"], p.shape)
    if rule == "platform":
        return p + q @ np.array(RULES["platform"]["platform"])
    lower, upper = g.base_internal.mean(axis=0), p + q @ g.platform_internal.mean(axis=0)
    return lower + 0.45 * (upper - lower)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("rule", RULES)
def test_what_is_proved_of_poses_is_so(published, question, rule):
    rng = np.random.default_rng(11)
    criteria = QUESTIONS[question]
    begin = (list(QUESTIONS).index(question) + list(RULES).index(rule)) % 2  # every question, and every rule, has both
    for trial in range(begin, begin + size(1, 40)):
        g = published if trial == 0 else oracle.some_robot(rng)
        q = np.eye(3) if trial == 0 else Rotation.from_rotvec(0.2 * rng.normal(size=3)).as_matrix()
        home = nd.Configuration([0.1, 0.0, 4.6], q, placed(rule, g, np.array([0.1, 0.0, 4.6]), q))
        gap = size(0.5, 0.4) if question == "all" else size(0.3, 0.2)
        proved = nd.certified_workspace(
            g, BOX, criteria=criteria, internal_point=RULES[rule], rotation=q, home=home, gap=gap, time_limit=20.0
        )
        p = sampled(proved, rng, size(1_500, 7_000))
        least = margins(g, oracle.robots(g, p, q, placed(rule, g, p, q)), criteria, home)
        state = proved.state(p)
        assert (least[state == 1] > -1e-9).all()
        room = 2e-2 if "leg_clearance" in criteria else 1e-9
        assert (least[state == -1] < room).all()
        inner = (
            ((p[:, None] >= proved.inner_low[:500]) & (p[:, None] <= proved.inner_high[:500])).all(axis=2).any(axis=1)
        )
        assert (least[inner] > -1e-9).all()
        share = (least[: len(p) // 2 if len(proved.open_low) else None] > 0.0).mean()
        scatter = 5.0 * np.sqrt(max(share, 1e-3) / 1_500.0) + (0.02 if "leg_clearance" in criteria else 0.0)
        box = np.prod(proved.box_high - proved.box_low)
        assert proved.volume[0] / box <= share + scatter
        assert proved.volume[1] / box >= share - scatter


@pytest.mark.parametrize(("low", "high"), [(0.0, 3.0), (2.0, 3.0), (2.9, 3.0), (2.999, 3.0)])
def test_the_volume_of_a_shell(published, low, high):
    """One leg alone has limits: its length is a distance from a point."""
    legs = np.zeros(9), FREE.copy()
    legs[0][1], legs[1][1] = low, high
    exact = 4.0 / 3.0 * np.pi * (high**3 - low**3)
    for gap in (0.3, size(0.02, 0.002)):
        proved = nd.certified_workspace(
            published, WIDE, criteria={"leg_limits": legs}, gap=gap, most_boxes=size(60_000, 600_000)
        )
        assert proved.volume[0] < exact < proved.volume[1]
        assert proved.beyond == "nothing"
        assert proved.gap <= gap or proved.end == "boxes"
    assert proved.end == "gap" or low > 2.5


def test_a_tiny_forbidden_ball_is_never_proved_to_be_allowed(published):
    """O may not be nearer than 1e-4 to a joint of the base: where it is, nothing else is violated."""
    low = np.zeros(9)
    low[6] = 1e-4
    joint, fraction = published.base_internal[0], 0.5
    lower, upper = published.base_internal.mean(axis=0), published.platform_internal.mean(axis=0)
    centre = lower + (joint - lower) / fraction - upper
    box = (centre - np.array([0.31, 0.43, 0.57]), centre + np.array([0.41, 0.29, 0.37]))
    proved = nd.certified_workspace(published, box, criteria={"leg_limits": (low, FREE)}, gap=1e-4)
    way = np.random.default_rng(5).normal(size=(2_000, 3))
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    assert not (proved.state(centre + 2e-4 * (1.0 - 1e-9) * np.linspace(0.0, 1.0, 2_000)[:, None] * way) == 1).any()
    assert (proved.state(centre + 0.05 * way) == 1).all()
    whole = np.prod(np.subtract(*box[::-1]))
    assert proved.volume[0] < whole - 4.0 / 3.0 * np.pi * 2e-4**3 < proved.volume[1]


def test_a_tiny_allowed_set_is_not_proved_to_be_empty(published):
    """Three thin shells meet in a parallelepiped with sides of about 0.01."""
    criteria = {"leg_limits": ([5.0] * 3 + [0.0] * 6, [5.01] * 3 + [np.inf] * 6)}
    proved = nd.certified_workspace(published, BOX, criteria=criteria, gap=0.1, most_boxes=size(40_000, 400_000))
    estimate = nd.workspace(published, BOX, criteria=criteria)
    assert proved.volume[0] <= estimate.volume + estimate.error
    assert proved.volume[1] >= estimate.volume - estimate.error
    few = nd.certified_workspace(published, BOX, criteria=criteria, most_boxes=50)
    assert few.end == "boxes"
    assert few.volume[1] >= estimate.volume - estimate.error


def test_nothing_is_allowed(published):
    for criteria in ({"condition_number": 1.01}, LEGS | {"leg_clearance": 20.0}, {"leg_limits": (0.01, 0.02)}):
        proved = nd.certified_workspace(published, BOX, criteria=criteria)
        assert proved.volume == (0.0, 0.0)
        assert proved.end == "gap"
        assert not len(proved.inner_low)
        assert not len(proved.open_low)
        assert proved.gap == 0.0
        assert "Proved: no pose" in str(proved)
        assert (proved.state([[0.0, 0.0, 4.8]]) == -1).all()


def test_everything_is_allowed(published):
    box = ([-0.1, -0.2, 4.7], [0.2, 0.1, 5.0])
    proved = nd.certified_workspace(published, box, criteria={"leg_limits": (0.1, 50.0), "condition_number": 20.0})
    assert proved.volume[0] <= 0.3**3 * (1.0 + 1e-15)
    assert proved.volume[1] >= 0.3**3 * (1.0 - 1e-15)
    assert proved.gap < 1e-12
    assert proved.beyond == "something"
    assert "goes on beyond the box" in str(proved)


def test_what_lies_beyond_the_box(published):
    assert nd.certified_workspace(published, WIDE, criteria=LEGS).beyond == "nothing"
    assert nd.certified_workspace(published, ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0]), criteria=LEGS).beyond == "something"
    unbounded = nd.certified_workspace(published, BOX, criteria={"condition_number": 5.0}, most_boxes=2_000)
    assert unbounded.beyond == "unknown"
    assert "within the box searched" in str(unbounded)
    assert "nothing is known" in str(unbounded)


def test_only_what_is_connected_with_home_counts(published):
    """Above and below the base there are two pieces; det N, det B and det C have one sign in one of them only."""
    criteria = {"leg_limits": (1.5, 6.5), "singularity_free": True}
    box = ([-6.0, -6.0, -8.0], [6.0, 6.0, 8.0])
    proved = nd.certified_workspace(published, box, criteria=criteria, home=HOME, gap=0.1)
    estimate = nd.workspace(published, box, criteria=criteria, home=HOME)
    assert proved.connected
    assert proved.home == "allowed"
    assert proved.bounds == proved.home_volume
    assert 0.0 < proved.home_volume[0] <= estimate.volume + estimate.error
    assert proved.home_volume[1] >= estimate.volume - estimate.error
    assert proved.home_volume[1] <= proved.volume[1]
    assert proved.gap <= 0.1


def test_a_piece_apart_is_not_counted(published):
    """Without signs there are poses above and below the base, far apart."""
    criteria = LEGS | {"condition_number": 5.0}
    proved = nd.certified_workspace(published, WIDE, criteria=criteria, home=HOME, gap=0.15)
    estimate = nd.workspace(published, WIDE, criteria=criteria, home=HOME)
    assert len(estimate.pieces) == 2
    assert proved.volume[0] <= estimate.volume <= proved.volume[1]
    assert proved.home == "allowed"
    assert proved.home_volume[0] <= estimate.pieces[0] <= proved.home_volume[1]
    assert proved.home_volume[1] < 0.6 * proved.volume[1]


def test_a_home_that_is_not_allowed(published):
    home = nd.Configuration.neutral(zp=1.0, zs=0.5)
    proved = nd.certified_workspace(published, WIDE, criteria=LEGS | {"singularity_free": True}, home=home)
    assert (proved.home, proved.home_volume) == ("forbidden", (0.0, 0.0))
    assert "home pose is not allowed" in str(proved)


FULL = {"leg_clearance": 0.05, "condition_number": 8.0, "singularity_free": True}


@pytest.fixture(scope="module")
def unscaled(published):
    return nd.certified_workspace(published, BOX, criteria=LEGS | FULL, home=HOME, gap=0.3)


@pytest.mark.parametrize("scale", [2.0**-90, 1e-90, 1e90, 2.0**90])
def test_units_of_length_change_nothing(published, unscaled, scale):
    triples = (
        published.base_external,
        published.base_internal,
        published.platform_external,
        published.platform_internal,
    )
    box = tuple(np.multiply(BOX, scale))
    home = nd.Configuration(HOME.position * scale, HOME.rotation, HOME.internal_point * scale)
    other = nd.certified_workspace(
        nd.Geometry(*(scale * t for t in triples)),
        box,
        criteria=FULL | {"leg_limits": (2.5 * scale, 6.5 * scale), "leg_clearance": 0.05 * scale},
        home=home,
        characteristic_length=scale,
        gap=0.3,
    )
    exact = scale in (2.0**-90, 2.0**90)  # else joints are rounded, and where planes are tried is not continuous
    assert other.volume == pytest.approx(np.array(unscaled.volume) * scale**3, rel=1e-15 if exact else 0.05)
    assert other.home_volume == pytest.approx(np.array(unscaled.home_volume) * scale**3, rel=1e-15 if exact else 0.05)


@pytest.mark.slow
@pytest.mark.parametrize("archetype", ["inclusive", "reachable"])
def test_sets_of_rotations(published, archetype):
    rng = np.random.default_rng(2)
    set_of = nd.spread_rotations(7, 0.3)
    criteria = LEGS | {"condition_number": 6.0}
    proved = nd.certified_workspace(
        published, BOX, archetype=archetype, orientations=set_of, criteria=criteria, gap=0.25, time_limit=30.0
    )
    p = sampled(proved, rng, size(3_000, 50_000))
    least = np.stack(
        [
            margins(published, oracle.robots(published, p, q, oracle.half_way(published, p, q)), criteria, HOME)
            for q in set_of
        ]
    )
    allowed = least.min(axis=0) if archetype == "inclusive" else least.max(axis=0)
    assert "of the rotations of the set, not of others" in str(proved)
    state = proved.state(p)
    assert (allowed[state == 1] > -1e-9).all()
    assert (allowed[state == -1] < 1e-9).all()
    assert (state == 1).any()
    assert proved.end == "gap"
    estimate = nd.workspace(published, BOX, archetype=archetype, orientations=set_of, criteria=criteria, tolerance=0.02)
    assert proved.volume[0] <= estimate.volume + estimate.error
    assert proved.volume[1] >= estimate.volume - estimate.error


def test_threads_change_nothing(published):
    options = {"criteria": LEGS | {"condition_number": 5.0}, "gap": 0.2}
    one, two = (nd.certified_workspace(published, BOX, threads=threads, **options) for threads in (1, 3))
    assert one.volume == two.volume
    assert np.array_equal(one.open_low, two.open_low)
    assert np.array_equal(one.cuts, two.cuts)


def test_boxes_fill_no_more_than_the_box(published):
    proved = nd.certified_workspace(published, BOX, criteria=LEGS, gap=0.1)
    inner = np.prod(proved.inner_high - proved.inner_low, axis=1).sum()
    assert inner + proved.open_volume[:, 0].sum() == pytest.approx(proved.volume[0], rel=1e-12)
    assert inner + proved.open_volume[:, 1].sum() == pytest.approx(proved.volume[1], rel=1e-12)
    assert proved.first_cut[-1] == len(proved.cuts)
    assert len(proved.first_cut) == len(proved.open_low) + 1
    middle = 0.5 * (proved.inner_low + proved.inner_high)
    assert (proved.state(middle) == 1).all()


def test_no_time_is_a_wide_answer(published):
    proved = nd.certified_workspace(published, BOX, criteria=LEGS, time_limit=0.0)
    assert proved.end == "time"
    assert proved.volume[0] == 0.0
    assert proved.volume[1] > 10.0


def test_saved_and_loaded(published, tmp_path):
    proved = nd.certified_workspace(published, BOX, criteria=LEGS, gap=0.2, unit="mm").with_estimate(30.0, 0.1)
    again = nd.CertifiedWorkspace.load(proved.save(tmp_path / "proved"))
    assert str(again) == str(proved)
    assert again.to_dict() == proved.to_dict()
    percent = float(str(proved).split("(gap ")[1].split(" %")[0])
    assert 100.0 * proved.gap <= percent <= 105.0 * proved.gap
    assert np.array_equal(again.cuts, proved.cuts)
    assert "mm³" in str(again)
    with pytest.raises(ValueError, match="got no 'ninedof-certified-workspace-6' file"):
        nd.CertifiedWorkspace.load(nd.workspace(published, BOX, criteria=LEGS, tolerance=0.1).save(tmp_path / "map"))


@pytest.mark.parametrize("defect", [4e-10, -4e-10])
def test_a_rotation_of_few_digits_stands_for_the_rotation_next_to_it(published, defect):
    """Where the leg is at its limit by the matrix given or by that rotation, and in or out by the other."""
    exact = Rotation.from_rotvec([0.3, -0.2, 0.1]).as_matrix()
    matrix = (1.0 + defect) * exact
    legs = np.zeros(9), FREE.copy()
    legs[1][0] = 3.0
    arm, joint = exact @ published.platform_external[0], published.base_external[0]
    along = arm / np.linalg.norm(arm)
    between = joint - arm + (3.0 - 0.5 * defect * np.linalg.norm(arm)) * along
    box = (between - 1e-8, between + 1e-8)
    proved = nd.certified_workspace(
        published, box, criteria={"leg_limits": legs}, rotation=matrix, gap=1e-3, most_boxes=2_000
    )
    assert proved.state(between[None]) == [0]
    far = 1e-8 * np.array([[-0.9], [0.9]]) * along
    assert (proved.state(between + far) == [1, -1]).all()


def test_what_is_said_holds_where_home_lies_outside_the_box(published):
    criteria = {"leg_limits": (1.5, 7.0), "singularity_free": True}
    aside = nd.certified_workspace(published, ([-1, -1, 5.5], [1, 1, 6.0]), criteria=criteria, home=HOME)
    assert nd.certified_workspace(published, BOX, criteria=criteria, home=HOME).home == "allowed"
    assert aside.home == "forbidden"
    assert "not allowed or lies outside the box searched" in str(aside)


def test_what_is_connected_outside_the_box_is_not_counted_nor_said_to_be(published):
    """A shell, and a beam across it: its two ends are connected with each other outside the beam alone."""
    low = np.zeros(9)
    low[0], high = 4.0, np.concatenate([[4.2], FREE[1:]])
    centre = published.base_external[0] - published.platform_external[0]
    criteria = {"leg_limits": (low, high), "singularity_free": True}
    at = centre + np.array([np.sqrt(4.1**2 - 2.0**2), 0.0, 2.0])
    beam = (centre + np.array([-5.0, -0.1, 1.9]), centre + np.array([5.0, 0.1, 2.1]))
    home = nd.Configuration(at, np.eye(3), 0.5 * at)
    proved = nd.certified_workspace(published, beam, criteria=criteria, home=home)
    assert proved.home_volume[1] < 0.6 * proved.volume[0]
    words = str(proved).splitlines()
    assert "connected with home within the box searched has a volume" in words[0]
    assert words[1].endswith("within the box searched.")


def test_what_lies_beyond_takes_no_time_that_there_is_not(published):
    options = {"criteria": LEGS | {"condition_number": 5.0}, "archetype": "reachable", "orientations": 20}
    proved = nd.certified_workspace(published, BOX, time_limit=0.0, **options)
    assert (proved.end, proved.beyond) == ("time", "unknown")
