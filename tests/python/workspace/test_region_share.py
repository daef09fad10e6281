"""The share of a region within criteria, against random poses; its box and the legs it needs."""

from types import SimpleNamespace

import numpy as np
import pytest
from region_oracle import random_poses

import ninedof as nd
from ninedof.design.domains.region_poses import posed
from ninedof.workspace.study_question import box_about, leg_ranges_over, region_share

VARIABLES = {"a1": 0.0, "a2": 5.8, "b1": 2.9, "b2": 0.0, "zp": 4.0, "zs": 2.4, "theta_z": 0.0}


def machine(region):
    study = nd.Study(objective={"region": region}, characteristic_length=1.0)
    poses = random_poses(region, 3000, np.random.default_rng(5))
    point = posed(study, poses).evaluate(VARIABLES)
    return SimpleNamespace(g=point.geometry, home=point.configuration, c=point.configurations[1:])


REGIONS = [nd.Region(box=(0.5, 0.4, 0.3), tilt=0.1), nd.Region(ball=0.1, unit="zp", yaw=0.1, internal_point="held")]


@pytest.mark.parametrize("region", REGIONS)
def test_legs_of_a_region_are_long_enough_for_it_and_no_longer(region):
    m = machine(region)
    low, high = leg_ranges_over(region, m.g, m.home)
    lengths = nd.leg_lengths(m.g, m.c)
    assert (lengths >= low).all()
    assert (lengths <= high).all()
    assert region_share(region, m.g, m.home, {"leg_limits": (low, high)}, 1.0).share == 1.0
    idle = high < 1.001 * low  # O is held
    limits = (low, np.where(idle, high, high * (1.0 - 1e-4)))
    shorter = region_share(region, m.g, m.home, {"leg_limits": limits}, 1.0)
    assert shorter.share < 1.0 or shorter.passed == ("leg_limits",)
    assert shorter.passed == ("leg_limits",)


def test_the_share_is_that_of_the_volume():
    """A box without tilts that half its volume passes: a limit of O's height by the length of a leg above it."""
    region = nd.Region(box=(0.3, 0.3, 0.3))
    m = machine(region)
    rng = np.random.default_rng(1)
    shift = rng.uniform(-0.3, 0.3, (20_000, 3))
    q = np.broadcast_to(m.home.rotation, (20_000, 3, 3))
    c = nd.Configuration(m.home.position + shift, q, m.home.internal_point + shift)
    criteria = {
        "leg_limits": (0.0, np.median(nd.leg_lengths(m.g, c).max(axis=1))),
        "condition_number": float(np.quantile(nd.condition_number(m.g, c, 1.0), 0.8)),
    }
    kept = (nd.leg_lengths(m.g, c) <= criteria["leg_limits"][1]).all(axis=1)
    kept &= nd.condition_number(m.g, c, 1.0) <= criteria["condition_number"]
    found = region_share(region, m.g, m.home, criteria, 1.0)
    assert found.share == pytest.approx(kept.mean(), abs=0.015)
    assert found.passed == ("leg_limits", "condition_number")
    least = region_share(region, m.g, m.home, {"leg_clearance": 9.0, "base_cone": 0.001}, 1.0)
    assert (least.share, least.looked_at, least.passed) == (0.0, 20_000, ("base_cone", "leg_clearance"))
    axis = {"platform_cone": {"max": np.pi, "axis": (0, 0, 1)}, "singularity_free": True}
    assert region_share(region, m.g, m.home, axis, 1.0).share == 1.0


@pytest.mark.parametrize(
    "region",
    [*REGIONS, nd.Region(cylinder=(0.4, 0.2)), nd.Region(path=((0, 0, 0), (0.5, 0.1, 0.2), (0.5, 0.4, 0.0)))],
)
def test_the_box_holds_the_positions(region):
    m = machine(region)
    low, high = box_about(region, m.home)
    assert (m.c.position > low).all()
    assert (m.c.position < high).all()
