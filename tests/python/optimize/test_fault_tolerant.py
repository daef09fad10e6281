"""The limit `fault_tolerant` in studies: at the neutral pose, at poses, over a region, and where no design keeps it."""

import numpy as np
import pytest

import ninedof as nd

PAIRED = {"a1": 0.0, "b2": 0.0}


def worst_of(g, c, length):
    """The worst condition number with one internal leg locked, by numpy's singular values of eight columns."""
    j = nd.jacobian(g, c, length)
    sigma = [np.linalg.svd(np.delete(j, leg, axis=-1), compute_uv=False) for leg in range(3, 9)]
    return max(float((s[..., 0] / s[..., 5]).max()) for s in sigma)


def optimum(limit, starts=8, **options):
    constraints = {"leg_ratio": (None, 3.0)} | ({} if limit is None else {"fault_tolerant": limit})
    return nd.optimize(
        nd.Study(variables=PAIRED, constraints=constraints, characteristic_length=1.0, **options), starts=starts, seed=0
    )


@pytest.mark.slow
@pytest.mark.parametrize("poses", [None, nd.poses.box((0.2, 0.2, 0.2))])
def test_an_optimum_keeps_it_and_pays_its_price(poses):
    objective = {} if poses is None else {"poses": poses}
    at = "poses" if poses else "neutral"
    free = optimum(None, objective=objective)
    results = [optimum({"max": most, "at": at}, objective=objective) for most in (4.0, 4.04)]
    for result, most in zip(results, (4.0, 4.04), strict=True):
        c = result.best.configuration if poses is None else result.best.configurations[1:]
        assert worst_of(result.best.geometry, c, 1.0) == pytest.approx(most, rel=1e-6)
        assert result.objective > free.objective
    label = "fault_tolerant" if poses else "fault_tolerant at neutral"
    price = np.log(results[0].objective / results[1].objective) / np.log(4.04 / 4.0)
    assert results[0].prices[label] == pytest.approx(price, rel=0.1)


def test_the_characteristic_length_reaches_it():
    study = {"variables": PAIRED, "constraints": {"leg_ratio": (None, 3.0), "fault_tolerant": (None, 4.0)}}
    for length in ("natural", (0.5, 4.0)):
        result = nd.optimize(nd.Study(**study, characteristic_length=length), starts=8, seed=0)
        best = result.best
        assert worst_of(best.geometry, best.configuration, best.characteristic_length) <= 4.0 + 1e-6
        assert result.status == "optimal"


def test_no_design_keeps_it():
    result = optimum({"max": 3.0, "at": "neutral"})
    assert result.status == "infeasible"
    assert "fault_tolerant at neutral <= 3" in result.reason


@pytest.mark.slow  # a proof over a region: seconds, and a minute under sanitizers
def test_a_region():
    objective = {"region": nd.Region(box=[0.2, 0.2, 0.1], tilt=0.05)}
    result = optimum((None, 4.0), 2, objective=objective)
    failing = nd.failure(result, pairs=False, samples=2000)
    assert max(one.condition_number for one in failing.locked[3:]) == pytest.approx(4.0, rel=1e-6)
    (row,) = [one for one in nd.sheet(result, samples=500).limits if one.name == "fault_tolerant"]
    assert row.value == pytest.approx(4.0, rel=1e-6)
    certificate = result.certify(gap=0.5)
    (proof,) = [one for one in certificate.limits if one.name == "fault_tolerant"]
    assert proof.answer == "proved"
    assert proof.value == pytest.approx((4.0, 4.0), rel=2e-6)
    assert proof.which == failing.worst.legs[0]


@pytest.mark.slow
def test_a_workspace():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    home = nd.Configuration.neutral(3.9828, 2.4432)
    box = ((-2.0, -2.0, 3.0), (2.0, 2.0, 5.0))
    question = {"criteria": {"fault_tolerant": 4.5}, "internal_point": {"platform": [0.0, 0.0, -1.5396]}, "home": home}
    found = nd.workspace(g, box, **question, method="sample", points=6_000)
    p = np.random.default_rng(1).uniform(*box, size=(6_000, 3))
    j = nd.jacobian(g, nd.Configuration(p, np.eye(3), p - [0.0, 0.0, 1.5396]), 1.0)
    sigma = np.stack([np.linalg.svd(np.delete(j, leg, axis=-1), compute_uv=False) for leg in range(3, 9)])
    share = ((sigma[..., 0] / sigma[..., 5]).max(axis=0) <= 4.5).mean()
    assert 0.05 < share < 0.95
    assert found.volume == pytest.approx(share * 32.0, rel=0.05)
    proved = nd.certified_workspace(g, box, **question, gap=0.3)
    low, high = proved.volume
    assert low <= share * 32.0 * 1.03
    assert high >= share * 32.0 * 0.97
    assert high - low <= 0.3 * high
