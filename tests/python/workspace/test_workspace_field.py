"""Smooth fields and bodies of a map against the functions they stand for, and against shapes known in closed form."""

from collections import Counter

import numpy as np
import pytest

import ninedof as nd
from ninedof.workspace import WorkspaceField

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


def test_the_boundary_has_the_limit_that_is_reached_there(found):
    s = found.slice("y", 0.2, smooth=True)
    lengths = nd.leg_lengths(G, places(s))
    worst = np.concatenate([lengths - LOW, HIGH - lengths], axis=1).argmin(axis=1).reshape(s.fraction.shape)
    legs = [f"{kind}{k}" for kind in "lqr" for k in (1, 2, 3)]
    expected = [f"{leg} {side}" for side in ("low", "high") for leg in legs]
    middle = (s.fraction > 0.4) & (s.fraction < 0.6)
    middle[:2] = False  # the face of the box
    names = [found.limit_names[n] == expected[k] for n, k in zip(s.limit[middle], worst[middle], strict=True)]
    assert np.mean(names) > 0.9


def test_field_and_body_have_the_volume_of_the_map(found):
    cell = np.prod([axis[1] - axis[0] for axis in found.field.axes])
    assert found.field.fraction.sum() * cell == pytest.approx(found.volume, rel=1e-3)
    assert found.surface().volume == pytest.approx(found.volume, rel=0.02)


def ball(n, radius=0.8):
    axis = np.linspace(-1.0, 1.0, n)
    x = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
    share = np.clip(0.5 + (radius - np.linalg.norm(x, axis=-1)) / (axis[1] - axis[0]) / 2.0, 0.0, 1.0)
    return WorkspaceField((axis, axis, axis), share, np.ones_like(share))


def test_a_ball_has_a_closed_surface_that_faces_outward():
    surface = ball(41).surface()
    assert np.linalg.norm(surface.points, axis=1) == pytest.approx(0.8, abs=0.02)
    assert surface.volume == pytest.approx(4.0 / 3.0 * np.pi * 0.8**3, rel=0.02)
    edges = Counter(pair for face in surface.faces.tolist() for pair in zip(face, face[1:] + face[:1], strict=True))
    assert set(edges.values()) == {1}
    assert all(edges[b, a] == 1 for a, b in edges)
    middle = surface.points[surface.faces].mean(axis=1)
    outward = np.einsum("ij,ij->i", surface.normals, middle / np.linalg.norm(middle, axis=1, keepdims=True))
    assert outward.min() >= 0.0  # 0 of a face without area
    assert np.quantile(outward, 0.01) > 0.9
    assert len(surface.points) - len(edges) // 2 + len(surface.faces) == 2  # Euler


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
