"""Indices over a workspace against the core's own global conditioning index, direct sums, and the limits of legs."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.design.indices import computed

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
LIMITS = {"leg_limits": (1.5, 6.5), "condition_number": 8.0}
BOX = {"box": ([-4, -4, 0], [4, 4, 8])}
TURNED = {"archetype": "orientation", "position": [0.1, 0.2, 4.0]}
POSES = {
    "positions": BOX,
    "rotation vectors": TURNED | {"region": {"angle": 0.8}, "rotation": Rotation.from_rotvec([0.1, -0.2, 0.3])},
    "tilt and torsion": TURNED
    | {"region": {"tilt": 0.6, "torsion": 0.5}, "rotation": Rotation.from_rotvec([0.1, -0.2, 0.3])},
}
RULES = {"between": 0.4, "fixed": [0.1, 0.0, 2.0], "platform": {"platform": [0.0, 0.1, -1.5]}}


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("poses", POSES)
@pytest.mark.parametrize("method", ["grid", "sample"])
def test_mean_and_worst_are_the_cores_own(poses, rule, method):
    """The core makes the poses, their measure and O by other code: its sums over the same points are the same."""
    index = ["reciprocal_condition_number", "condition_number"]
    size = {"resolution": 16} if method == "grid" else {"points": 512}
    found = nd.workspace(
        G, criteria=LIMITS, internal_point=RULES[rule], method=method, index=index, **size, **POSES[poses]
    )
    assert found.volume > 0.0
    inverse, kappa = (found.indices[name] for name in index)
    assert inverse.mean == pytest.approx(found.conditioning_index, rel=1e-11)
    assert kappa.greatest == pytest.approx(found.worst_condition_number, rel=1e-11)
    assert kappa.greatest_at == pytest.approx(found.worst_at.tolist(), abs=1e-12)
    assert 1.0 / kappa.least == pytest.approx(inverse.greatest)
    assert kappa.least_at == inverse.greatest_at


def test_octree_mean_within_the_cores_error():
    found = nd.workspace(G, criteria=LIMITS, index="reciprocal_condition_number", **BOX)
    over = found.indices["reciprocal_condition_number"]
    assert over.mean == pytest.approx(found.conditioning_index, abs=found.conditioning_index_error)
    assert over.greatest == pytest.approx(1.0 / found.percentiles[0], rel=1e-2)


def test_every_index_of_the_table_and_functions():
    def height(geometry, configuration, length):
        return configuration.position[..., 2]

    found = nd.workspace(G, criteria=LIMITS, method="grid", resolution=16, index=[*computed(), height], **BOX)
    assert set(found.indices) == {*computed(), "height"}
    inside = found.cells.fraction > 0.0
    z = found.cells.centre[inside, 2]
    assert found.indices["height"].mean == pytest.approx(np.average(z, weights=found.cells.fraction[inside]))
    assert found.indices["height"].greatest == found.indices["height"].greatest_at[2] == z.max()
    legs = found.indices["leg_lengths"]
    assert len(legs.mean) == len(legs.greatest_at) == 9
    assert 1.5 <= min(legs.least) <= min(legs.mean) <= max(legs.mean) <= max(legs.greatest) <= 6.5


def test_only_the_piece_of_home_counts_where_singularities_divide():
    home = nd.Configuration([0.0, 0.0, 4.0], None, [0.0, 0.0, 2.0])
    worst = {}
    for free in (False, True):
        criteria = {"leg_limits": (2.5, 6.5), "singularity_free": free}
        found = nd.workspace(
            G, criteria=criteria, home=home, method="grid", resolution=24, index="condition_number", **BOX
        )
        assert len(found.pieces) == 4
        worst[free] = found.indices["condition_number"].greatest
        assert worst[free] == pytest.approx(found.worst_condition_number, rel=1e-11)
    assert worst[True] < 0.98 * worst[False]


def test_no_allowed_pose_gives_nan_without_a_call():
    def never(geometry, configuration, length):
        raise AssertionError

    criteria = {"leg_limits": (100.0, 101.0)}
    found = nd.workspace(G, criteria=criteria, method="grid", resolution=8, index=["leg_lengths", never], **BOX)
    over, legs = found.indices["never"], found.indices["leg_lengths"]
    assert np.isnan([over.mean, over.least, over.greatest, *over.least_at]).all()
    assert np.isnan(legs.mean).all()
    assert len(legs.mean) == 9


def test_interrupted_in_an_index_keeps_the_map():
    def interrupted(geometry, configuration, length):
        raise KeyboardInterrupt

    found = nd.workspace(G, criteria=LIMITS, method="grid", resolution=8, index=interrupted, **BOX)
    assert found.interrupted
    assert found.indices == {}
    assert found.volume == nd.workspace(G, criteria=LIMITS, method="grid", resolution=8, **BOX).volume


def test_at_the_terminal(run, tmp_path):
    line = "workspace --legs 1.5 6.5 --method grid --resolution 12 --no-figures --index manipulability"
    status, printed, _ = run(f"{line} --index leg_lengths --out {tmp_path / 'run'}")
    assert status == 0
    assert "manipulability: mean, least, greatest" in printed
    assert "r3: mean, least, greatest" in printed


def test_extremes_of_singularity_margins_are_those_of_the_modulus():
    found = nd.workspace(G, criteria=LIMITS, method="grid", resolution=16, index="singularity_margins", **BOX)
    inner = found.cells.fraction >= 0.5
    p = found.cells.centre[inner]
    at = nd.Configuration(p, None, 0.5 * p)
    over = found.indices["singularity_margins"]
    for k, values in enumerate(nd.singularity_margins(G, at)):
        assert abs(over.least[k]) == pytest.approx(np.abs(values).min(), abs=1e-12)
        assert abs(over.greatest[k]) == pytest.approx(np.abs(values).max(), abs=1e-12)
