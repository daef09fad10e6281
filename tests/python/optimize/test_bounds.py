"""Lower bounds: the printed digits, the equations they come from, and designs that come near them."""

import math
import re
from fractions import Fraction

import numpy as np
import pytest
from height_bound import least_by_height

import ninedof as nd
from ninedof.optimize.bounds import (
    HEXAGONAL_LIMIT,
    HEXAGONAL_TWIST_LIMIT,
    _symmetric,
    applicable_bounds,
    kappa_star,
    planar_leg_ratio_bound,
)

# rho and kappa* as the theory note prints them.
PRINTED = {
    0.25: 2.7790237093,
    0.5: 2.2864210951,
    1.0: 1.7081835426,
    2.0: 1.2793810843,
    3.0: 1.1427511612,
    5.0: 1.0563165572,
    10.0: 1.0147468760,
    20.0: 1.0037337467,
    1.5396: 1.4117982731,
}


@pytest.mark.parametrize("rho", PRINTED)
def test_kappa_star_has_the_printed_digits(rho):
    assert kappa_star(rho) == pytest.approx(PRINTED[rho], abs=6e-11)


@pytest.mark.parametrize("rho", [0.51, 0.7, 1.5396, 4.0, 30.0])
def test_kappa_star_is_the_smallest_root(rho):
    assert kappa_star(rho) == pytest.approx(least_by_height(rho), rel=1e-9)


def test_kappa_star_decreases_between_its_end_values():
    rho = np.concatenate([[0.0], np.geomspace(1e-9, 1e9, 2001), [math.inf]])
    values = np.array([kappa_star(float(r)) for r in rho])
    assert values[0] == pytest.approx(math.sqrt(12.0), rel=1e-15)
    assert values[-1] == 1.0
    assert np.all(np.diff(values) <= 1e-12)
    assert np.abs(np.diff(values)).max() < 0.03  # no jump where one branch hands over to the next
    assert kappa_star(1e3) == pytest.approx(1.0 + 1.5e-6, abs=1e-11)


def test_planar_bound_holds_for_random_planar_designs():
    rng = np.random.default_rng(3)
    nearest = math.inf
    for _ in range(300):
        radius, angle = rng.uniform(0.2, 4.0, 4), rng.uniform(-math.pi, math.pi, 4)
        g = nd.Geometry.symmetric(*((r, a, 0.0) for r, a in zip(radius, angle, strict=True)))
        zp = rng.uniform(0.5, 5.0)
        c = nd.Configuration.neutral(zp, zp * rng.uniform(0.05, 0.95))
        legs = nd.leg_lengths(g, c)
        above = float(nd.condition_number(g, c)) / planar_leg_ratio_bound(float(legs.max() / legs.min()))
        nearest = min(nearest, above)
    assert 1.0 - 1e-9 <= nearest < 2.5


@pytest.mark.parametrize(
    ("theta_z", "limit"), [(0.0, HEXAGONAL_LIMIT), ((-1.0, 1.0), HEXAGONAL_TWIST_LIMIT), (0.2, HEXAGONAL_TWIST_LIMIT)]
)
def test_hexagonal_designs_stay_above_their_limit(theta_z, limit):
    sides = {name: (0.0, 1e5) for name in ("a1", "a2", "b1", "b2")}
    heights = {"zp": (0.05, 1e5), "zs": (0.05, 1e5)}
    result = nd.optimize(nd.Study(variables={**sides, **heights, "theta_z": theta_z}))
    (bound,) = [b for b in applicable_bounds(result) if b.name == "hexagonal"]
    assert bound.value == limit
    assert not bound.proved
    assert limit < result.condition_number


def test_bounds_of_a_result_are_sorted_and_state_their_value():
    result = nd.optimize(nd.Study.paper())
    bounds = applicable_bounds(result)
    assert [b.name for b in bounds] == ["leg ratio", "hexagonal", "distance of O", "isotropy"]
    assert all(b.value <= result.condition_number for b in bounds)
    assert "1.326261" in bounds[2].sentence
    assert bounds[2].value == pytest.approx(kappa_star(result.variables["zp"] - result.variables["zs"]))


def test_bounds_scale_with_the_characteristic_length():
    scaled = {name: (0.0, 60e3) for name in ("a1", "a2", "b1", "b2")} | {"zp": (50.0, 80e3), "zs": (50.0, 80e3)}
    in_mm = nd.Study(variables=scaled, constraints={"radius_ratio": (None, 2.0)}, characteristic_length=1000.0)
    values = [b.value for b in applicable_bounds(nd.optimize(in_mm))]
    assert values == pytest.approx([b.value for b in applicable_bounds(nd.optimize(nd.Study.paper()))], rel=1e-6)


@pytest.mark.parametrize("rho", [-1.0, math.nan, -math.inf])
def test_bad_distance_is_named(rho):
    with pytest.raises(ValueError, match=r"^rho: got .*, expected a number of at least 0"):
        kappa_star(rho)


@pytest.mark.parametrize("ratio", [0.5, math.nan, -2.0])
def test_bad_ratio_is_named(ratio):
    with pytest.raises(ValueError, match=r"^ratio: got .*, expected a number of at least 1"):
        planar_leg_ratio_bound(ratio)


def test_the_distance_bound_is_omitted_where_it_does_not_hold():
    """Below |s - p| = 0.5 l_c two threefold singular values do better than the family kappa_star is the least of."""
    near = nd.optimize(nd.Study(variables={"zp": 1.0, "zs": 0.8}), starts=4)
    far = nd.optimize(nd.Study(variables={"zp": 2.0, "zs": 0.8}), starts=4)
    assert "distance of O" not in [bound.name for bound in applicable_bounds(near)]
    assert "distance of O" in [bound.name for bound in applicable_bounds(far)]


def test_the_words_of_the_leg_ratio_are_a_bound_of_what_they_say():
    rng = np.random.default_rng(8)
    for _ in range(50):
        sides = dict(zip(("a1", "a2", "b1", "b2"), rng.uniform(0.5, 6.0, 4).tolist(), strict=True))
        g, c = nd.Geometry.hexagonal(**sides), nd.Configuration.neutral(4.0, 2.0)
        (bound,) = [b for b in _symmetric(g, c, 1.0) if b.name == "leg ratio"]
        ratio, value = re.fullmatch(
            r"no three-fold symmetric design with flat plates and legs within (.*) : 1 can be under (.*)",
            bound.sentence,
        ).groups()
        assert Fraction(value) <= bound.value < planar_leg_ratio_bound(float(ratio))
        legs = nd.leg_lengths(g, c)
        assert float(ratio) <= legs.max() / legs.min() < float(ratio) + 2e-3
