"""O at every pose of a region, against the definition in numpy at other places of O."""

import numpy as np
import pytest

import ninedof as nd
from ninedof.design.domains.region_poses import Placing

G = nd.Geometry.hexagonal(1.0, 0.8, 0.5, 0.6)
NEUTRAL = nd.Configuration.neutral(2.0, 1.0, 0.6)
SIDES = {"a1": 1.0, "a2": 0.8, "b1": 0.5, "b2": 0.6, "zp": 2.0, "zs": 1.0, "theta_z": 0.6}
LENGTHS = np.asarray(nd.leg_lengths(G, NEUTRAL))
RANGES = tuple(zip((0.9 * LENGTHS).tolist(), (1.1 * LENGTHS).tolist(), strict=True))
OBJECTIVE = 24.0  # so that the ranges decide too


def placing(unit, ranges=RANGES, known=()):
    shift = [0.3, 0.2, 0.2] if unit == "length" else [0.15, 0.1, 0.1]
    region = {"box": shift, "tilt_deg": 15, "unit": unit, "internal_point": "best"}
    study = nd.Study(constraints={"stroke_ratio": (None, 1.3)}, objective={"region": region})
    shifts = {f"pose{k + 1}.s_{axis}": v for k, s in enumerate(known) for axis, v in zip("xyz", s, strict=True)}
    return Placing(study, NEUTRAL, SIDES | shifts, OBJECTIVE, ranges), study


def coordinates(region, count):
    return np.random.default_rng(7).uniform(-1.0, 1.0, (count, 6)) * region.reach


def worst(c):
    lengths = np.asarray(nd.leg_lengths(G, c))
    index = np.log(np.asarray(nd.condition_number(G, c)) / OBJECTIVE)
    ranges = np.log(np.concatenate([0.9 * LENGTHS / lengths, lengths / (1.1 * LENGTHS)], axis=1))
    return np.maximum(index, ranges.max(axis=1))


@pytest.mark.parametrize("unit", ["zp", "length"])
def test_no_other_place_is_better(unit):
    place, study = placing(unit)
    found, poses = place(coordinates(study.objective.region, 20))
    least = worst(found)
    rng = np.random.default_rng(3)
    for size in (1e-1, 1e-2, 1e-3):
        for _ in range(20):
            s = found.internal_point + size * rng.normal(size=found.internal_point.shape)
            other = worst(nd.Configuration(found.position, found.rotation, s))
            assert (least <= other + 1e-6).mean() > 0.97  # at a kink a direct search may stop a little early
    shifted = nd.Configuration(
        found.position, found.rotation, NEUTRAL.internal_point + found.position - NEUTRAL.position
    )
    assert (least <= worst(shifted) + 1e-9).all()
    # The poses of an objective say the same.
    fixed = nd.Study(variables=SIDES, objective={"poses": list(poses)})
    point = fixed.evaluate({})
    assert np.allclose(point.configurations.internal_point[1:], found.internal_point, atol=1e-12)
    assert np.allclose(point.configurations.position[1:], found.position, atol=1e-12)


def test_places_at_the_poses_that_ruled_are_tried_too():
    shift = (0.05, 0.02, -0.03)
    place, study = placing("zp", known=[shift])
    assert np.array_equal(place.for_core().known, [shift])
    assert np.isfinite(place(coordinates(study.objective.region, 4))[0].internal_point).all()


def test_without_limits_on_lengths_the_index_alone_decides():
    place, study = placing("zp", ranges=())
    found, _ = place(coordinates(study.objective.region, 10))
    free = nd.condition_number(G, found)
    ranged = nd.condition_number(G, placing("zp")[0](coordinates(study.objective.region, 10))[0])
    assert (free <= np.asarray(ranged) + 1e-9).all()
    assert (free < np.asarray(ranged) - 1e-3).any()
