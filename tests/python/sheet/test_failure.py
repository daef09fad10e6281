"""Failure of legs: against numpy's singular values of J' without columns, equilibria without a leg, random poses."""

import json
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from region_oracle import random_poses
from unsolved import unsolved

import ninedof as nd
from ninedof.design.domains.region_poses import posed
from ninedof.robot.geometry import LEGS
from ninedof.sheet.failure.failure import SETS
from ninedof.sheet.failure.tables import locked_table
from ninedof.sheet.tables import pose_of

DESIGN = Path(__file__).resolve().parents[3] / "examples" / "04_design.toml"
RNG = np.random.default_rng(14)


def columns_of(g, c, length):
    """J' by least squares of the leg rates, which needs no matrix of the paper."""
    rates = np.concatenate(
        [nd.inverse_velocity(g, c, *motion.reshape(3, 3))[None] for motion in np.eye(9)]
    ).T  # rates of omega, pdot, sdot
    return np.linalg.inv(rates)[:6] * np.array([length] * 3 + [1.0] * 3)[:, None]


@pytest.mark.parametrize("seed", range(6))
def test_each_set_of_legs_against_numpy(seed):
    g, c = robot(seed)
    j = columns_of(g, c[0], 1.3)
    one = nd.failure(g, c, characteristic_length=1.3)
    for case, legs in zip((*one.locked, *one.pairs), SETS, strict=True):
        left = np.delete(j, [k for k in legs if k >= 0], axis=1)
        sigma = np.linalg.svd(left, compute_uv=False)
        expected = sigma[0] / sigma[case.freedoms - 1]
        assert case.remaining == pytest.approx(expected, rel=1e-8)
        rank = np.linalg.matrix_rank(left, tol=1e-9 * sigma[0])
        assert (rank == 6) == case.controlled == (case.condition_number < np.inf)
        assert rank == case.freedoms


def robot(seed):
    rng = np.random.default_rng(seed)
    base, platform = rng.normal(size=(2, 3, 3)) * [3.0, 3.0, 0.3], rng.normal(size=(2, 3, 3)) * [2.0, 2.0, 0.3]
    g = nd.Geometry(*base, *platform)
    c = nd.Configuration.neutral([4.0], 2.0).moved(0.2 * rng.normal(size=9))
    return g, c


def test_motions_of_free_legs_are_sought_over_the_region():
    """They were those of the poses that something else was worst at: legs that are alike differed by 4 %."""
    limits = {"stroke_ratio": {"max": 1.6}}
    where = {"region": {"cylinder": [0.4, 0.3], "tilt": 0.15, "yaw": 0.2}}
    study = nd.Study(constraints=limits, objective=where, starts=2)
    result = nd.optimize(study)
    one = nd.failure(result, pairs=False)
    for first in (0, 3, 6):
        legs = one.free[first : first + 3]
        for end in ("least", "largest"):
            values = [getattr(leg, end).value for leg in legs]
            assert max(values) <= min(values) * (1.0 + 2e-3)
    rng = np.random.default_rng(5)
    turn, out, height = 2.0 * np.pi * rng.uniform(size=3000), rng.uniform(size=3000), rng.uniform(-1.0, 1.0, 3000)
    at = np.stack([0.4 * np.sqrt(out) * np.cos(turn), 0.4 * np.sqrt(out) * np.sin(turn), 0.3 * height], axis=1)
    home = result.configuration
    moved = nd.Configuration(home.position + at, home.rotation, home.internal_point + at)
    sizes = np.linalg.norm(nd.jacobian(result.geometry, moved, result.best.characteristic_length), axis=1)
    for k, leg in enumerate(one.free):
        assert leg.least.value <= sizes[:, k].min()
        assert leg.largest.value >= sizes[:, k].max()


@pytest.mark.parametrize("seed", range(6))
def test_relative_manipulability(seed):
    g, c = robot(seed)
    j = columns_of(g, c[0], 0.7)
    value = nd.failure(g, c, pairs=False).relative_manipulability[0]
    inverse = np.linalg.inv(j @ j.T)
    expected = np.sqrt(np.maximum(1.0 - np.einsum("ik,ij,jk->k", j, inverse, j), 0.0))
    assert value == pytest.approx(expected, abs=1e-5)
    assert (value**2).sum() == pytest.approx(3.0, abs=1e-12)  # nine rates, six freedoms
    left = [np.delete(j, pair, axis=1) for pair in combinations(range(9), 2)]
    shares = [np.linalg.det(m @ m.T) for m in left] / np.linalg.det(j @ j.T)
    assert shares.sum() == pytest.approx(3.0, rel=1e-6)  # (3 over 2)


@pytest.mark.parametrize("seed", range(3))
def test_the_motion_of_a_free_leg_moves_that_leg_alone(seed):
    g, c = robot(seed)
    for k, one in enumerate(nd.failure(g, c, pairs=False).free):
        rates = nd.inverse_velocity(g, c[0], one.twist[:3], one.twist[3:], one.internal_point)
        assert rates == pytest.approx(np.eye(9)[k], abs=1e-9)
        assert one.size == pytest.approx(np.linalg.norm(one.twist))


def test_loads_that_the_other_eight_legs_bear():
    g, c = robot(1)
    h = np.stack([nd.inverse_velocity(g, c[0], *m.reshape(3, 3)) for m in np.eye(9)], axis=1)
    forces = RNG.normal(size=9)
    forces[4] = 0.0  # in equilibrium with a force at O too, which is taken away by the internal legs
    forces[[6, 7, 8]] = np.linalg.solve(h[6:, 6:].T, -h[3:6, 6:].T @ forces[3:6])
    load = -(h.T @ forces)[:6]
    one = nd.failure(g, c, loads=[load, load + np.eye(6)[2]])
    borne = [[x.borne for x in free.loads] for free in one.free]
    assert borne == [[k == 4, False] for k in range(9)]
    assert one.free[4].loads[0].largest == pytest.approx(np.abs(forces).max())
    assert one.free[3].loads[0].carries == pytest.approx(abs(forces[3]))
    for k in range(9):  # without a leg: whether the other eight balance the load, by least squares
        rest = np.delete(h, k, axis=0).T
        x = np.linalg.lstsq(rest, -np.concatenate([load, np.zeros(3)]), rcond=None)[0]
        assert (np.abs(rest @ x + np.concatenate([load, np.zeros(3)])).max() < 1e-9) == (k == 4)


def region_result(region):
    return unsolved({"objective": {"region": nd.Region(**region)}}, (0.6, 0.9, 1.1))


@pytest.mark.slow(sanitized=True)
def test_a_region_no_random_pose_is_worse_and_shares():
    region = {"box": [0.5, 0.4, 0.3], "tilt": 0.15}
    design = region_result(region)
    one = nd.failure(design, samples=1000, condition_number=8.0)
    there = posed(design.study, random_poses(design.study.objective.region, 2000, RNG))
    c = there.evaluate(design.variables).configurations[1:]
    g = design.geometry
    j = nd.jacobian(g, c, 1.5)
    for case, legs in zip((*one.locked, *one.pairs), SETS, strict=True):
        sigma = np.linalg.svd(np.delete(j, [k for k in legs if k >= 0], axis=2), compute_uv=False)
        kappa = sigma[:, 0] / sigma[:, case.freedoms - 1]
        assert kappa.max() <= case.remaining * (1.0 + 1e-9)
        if case.controlled:
            assert case.share == pytest.approx((kappa <= 8.0).mean(), abs=0.05)
        else:
            assert not case.share or case.freedoms == 6
    for k, case in enumerate(one.locked[3:], start=3):  # the leg as long as at home, O on a sphere about its joint
        joint = c.position + c.rotation @ g.platform_internal[k - 3] if k < 6 else g.base_internal[k - 6]
        length = nd.leg_lengths(g, design.configuration)[k]
        arm = c.internal_point - joint
        o = joint + arm * (length / np.linalg.norm(arm, axis=1))[:, None]
        sigma = np.linalg.svd(
            np.delete(nd.jacobian(g, nd.Configuration(c.position, c.rotation, o), 1.5), k, axis=2), compute_uv=False
        )
        assert case.share_from_home == pytest.approx((sigma[:, 0] / sigma[:, 5] <= 8.0).mean(), abs=0.05)
    rows = {row[0]: row for group in locked_table(one, one.locked).texts() for row in group}
    assert [rows[leg][-2] for leg in ("l1", "l2", "l3")] == ["-"] * 3  # five freedoms have no such share
    assert "with six freedoms and" in one.summary()
    pose = pose_of(one, one.healthy.pose)
    assert f"Nine legs at work: worst condition number met {one.healthy.value:.6f}, at {pose}." in one.summary()


def test_control_is_lost_with_opposite_legs_of_a_region_locked():
    one = nd.failure(region_result({"box": [0.5, 0.4, 0.3], "tilt": 0.15}), pairs=False, samples=1000)
    assert [case.controlled for case in one.locked] == [False] * 3 + [True] * 6
    assert one.locked[0].condition_number == np.inf


def test_a_singular_pose_has_no_control():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    one = nd.failure(g, nd.Configuration.neutral([3.9828], 3.9828))  # O in the plane of the platform joints
    assert one.healthy.value == np.inf
    assert not any(case.controlled for case in (*one.locked, *one.pairs))
    assert "singular" in one.summary()


def test_what_is_said():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    one = nd.failure(g, nd.Configuration.neutral([3.9828], 2.3745), loads=[0, 0, 0, 0, 0, -10.0])
    text = one.summary()
    assert "Nine legs at work: worst condition number met " in text
    assert "l1 free: the platform turns about" in text
    assert "not borne" in text
    assert "<table" in one._repr_html_()
    assert one.worst.legs[0] in repr(one)
    data = one.to_dict()
    assert len(data["locked"]) == 9
    assert len(data["pairs"]) == 36
    assert [one["leg"] for one in data["free"]] == list(LEGS)
    with pytest.raises(ValueError, match=r"condition_number: got 0\.5, expected a finite number at least 1"):
        nd.failure(g, nd.Configuration.neutral([3.9828], 2.3745), condition_number=0.5)


def test_the_command(run):
    status, out, _ = run(f"failure {DESIGN} --condition 5 --load '0 0 0 0 0 -10' --no-pairs --json")
    data = json.loads(out)
    assert status == 0
    assert (data["bound"], data["pairs"], len(data["locked"])) == (5.0, [], 9)
    assert [free["loads"][0]["borne"] for free in data["free"]] == [True] * 3 + [False] * 6
    status, _, err = run(f"failure {DESIGN} --condition 0.5")
    assert status != 0
    assert "--condition: got 0.5" in err


def test_loads_and_weights_of_the_study_are_taken():
    duty = {
        "loads": {"wrenches": [[0, 0, 0, 5.0, 0, 0], [0, 0, 0, 0, 0, -7.0]], "gravity": [0, 0, 9.81]},
        "masses": {"platform": 2.0, "centre": [0.1, 0, 0], "rod": 0.3},
    }
    variables = {"a1": 0.0, "a2": 5.8124, "b1": 2.9062, "b2": 0.0, "zp": 3.9828, "zs": 2.4}
    result = nd.optimize(nd.Study(variables=variables, tool={"position": [0, 0, -0.5]}, **duty))
    masses = result.study.masses.seen_from(result.study.tool)
    for load, k in ((None, 0), (None, 1), ([0, 0, 0, 0, 3.0, 0], 0)):
        one = nd.failure(result, loads=load, pairs=False)
        row = duty["loads"]["wrenches"][k] if load is None else load
        expected = nd.inverse_dynamics(
            result.geometry, result.configuration, masses=masses, gravity=(0, 0, 9.81), load=row
        )
        carried = [free.loads[k].carries for free in one.free]
        assert carried == pytest.approx(np.abs(expected.forces).tolist(), rel=1e-9)
    assert "each with the weights of the masses of the study" in one.summary()
    study = nd.Study(variables=variables)
    assert not len(nd.failure(nd.optimize(study), pairs=False).loads)


@pytest.mark.slow(sanitized=True)
def test_forces_over_a_region_are_those_of_the_sheet():
    """A load along the axis of a symmetric machine: three legs of a kind carry the same, at poses of their own."""
    study = nd.Study(
        "symmetric",
        constraints={"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)},
        objective={"region": {"cylinder": [0.2, 0.1], "tilt_deg": 6, "unit": "zp"}},
        loads={"wrenches": [[0, 0, 0, 0, 0, -100.0]]},
        starts=2,
    )
    result = nd.optimize(study)
    carried = [one.loads[0].carries for one in nd.failure(result, pairs=False).free]
    of_sheet = [max(abs(end) for end in leg.forces[0]) for leg in nd.sheet(result).legs]
    assert carried == pytest.approx(of_sheet, rel=1e-5)
    assert carried[6:] == pytest.approx([carried[6]] * 3, rel=1e-5)
