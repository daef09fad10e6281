"""Smooth fields and bodies of a map against the functions they stand for, and against shapes known in closed form."""

import pickle

import numpy as np
import pytest

import ninedof as nd

G = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
HOME = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
LOW, HIGH = 1.5, 6.5
SHARE = 0.6  # of the way to the platform: the place of O


@pytest.fixture(scope="module")
def found():
    criteria = {"leg_limits": (LOW, HIGH)}
    return nd.workspace(G, ([-4, -4, 1], [4, 4, 8]), criteria=criteria, home=HOME, internal_point=SHARE, tolerance=2e-3)


def places(s):
    h, v = np.meshgrid(s.horizontal, s.vertical)
    at = np.stack([h, np.full_like(h, s.plane[1]), v], axis=-1).reshape(-1, 3)
    return nd.Configuration(at, np.broadcast_to(np.eye(3), (len(at), 3, 3)), SHARE * at)


def test_a_smooth_section_is_the_field_of_the_robot(found):
    """Against poses evaluated one by one: the condition number, and where the workspace ends, to part of a cell."""
    s = found.slice("y", 0.2, smooth=True)
    c = places(s)
    lengths = nd.leg_lengths(G, c)
    margin = np.minimum(lengths - LOW, HIGH - lengths).min(axis=1).reshape(s.fraction.shape)
    margin[s.vertical < 1.3] = 0.0  # at and below the face of the box
    step = s.horizontal[1] - s.horizontal[0]
    assert np.all(s.fraction[margin > 2.0 * step] > 0.5)
    assert np.all(s.fraction[margin < -2.0 * step] < 0.5)
    inside = s.fraction == 1.0
    kappa = nd.condition_number(G, c).reshape(s.fraction.shape)
    error = np.abs(s.condition_number / kappa - 1.0)[inside]
    assert np.median(error) < 0.015
    assert np.quantile(error, 0.95) < 0.06
    assert np.isnan(s.condition_number[s.fraction == 0.0]).all()


def test_a_map_is_copied_without_the_field_it_has_computed(found):
    fraction = found.field.fraction
    assert np.array_equal(pickle.loads(pickle.dumps(found)).field.fraction, fraction)


def test_field_and_body_have_the_volume_of_the_map(found):
    cell = np.prod([axis[1] - axis[0] for axis in found.field.axes])
    assert found.field.fraction.sum() * cell == pytest.approx(found.volume, rel=1e-3)
    assert found.surface().volume == pytest.approx(found.volume, rel=0.02)


def test_a_grid_and_orientations_have_fields_too():
    grid = nd.workspace(
        G, ([-3, -3, 2], [3, 3, 7]), criteria={"leg_limits": (LOW, HIGH)}, home=HOME, method="grid", resolution=24
    )
    assert grid.surface().volume == pytest.approx(grid.volume, rel=0.1)
    sample = nd.workspace(
        G, ([-3, -3, 2], [3, 3, 7]), criteria={"leg_limits": (LOW, HIGH)}, home=HOME, method="sample", points=64
    )
    for ask in (sample.surface, lambda: sample.field, lambda: sample.slice("z", 4.0, smooth=True)):
        with pytest.raises(ValueError, match="got a sample, expected a map of cells"):
            ask()
