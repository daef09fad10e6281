"""Modes near a singularity have all their digits: against robots that have exactly the lengths given.

O is 2^-17 above the plane of the lower joints, or the rotation 2^-17 from a double one. Rounding in the equations for O
and for the rotation would leave eleven digits.
"""

import numpy as np
import pytest

import ninedof as nd

NEAR = 2.0**-17
LEGS = np.array([[3.0, 0.0, 4.0], [0.0, 3.0, 4.0], [-3.0, 0.0, 4.0]])  # of length 5
RING = np.array([[3.0, 4.0, 0.0], [-5.0, 0.0, 0.0], [4.0, -3.0, 0.0]])  # of radius 5
PLATFORM = np.array([[3.0, 1.0, 0.0], [-2.0, 2.0, 0.0], [1.0, -2.0, 0.0]])

# (m^2 - n^2)^2 + (2 m n)^2 = (m^2 + n^2)^2 in numbers of few digits, none of them rounded: a ring, a height, a length.
M, N = 79.0 / 64.0, NEAR / 8.0
SMALL_RING, HEIGHT, LENGTH = (M**2 - N**2) * RING, 10.0 * M * N, 5.0 * (M**2 + N**2)


def near_the_base():
    s, p = np.array([0.0, 0.0, HEIGHT]), np.array([0.0, 0.0, 12.0 + HEIGHT])
    g = nd.Geometry(p + PLATFORM - LEGS, SMALL_RING, PLATFORM, RING)
    return g, nd.Configuration(p, np.eye(3), s), np.repeat([5.0, 13.0, LENGTH], 3)


def near_the_platform():
    s, p = np.array([0.0, 0.0, 12.0]), np.array([0.0, 0.0, 12.0 + HEIGHT])
    g = nd.Geometry(p + PLATFORM - LEGS, RING, PLATFORM, SMALL_RING)
    return g, nd.Configuration(p, np.eye(3), s), np.repeat([5.0, LENGTH, 13.0], 3)


def near_a_double_rotation():
    """The rows x_i cross w_i of two legs span a plane that the third row leaves by little."""
    s, p = np.array([0.0, 0.0, 12.0]), np.array([0.0, 0.0, 24.0])
    w = np.array([[1.0, 2.0, 1.0], [-2.0, 1.0, 3.0], [0.0, 0.0, 0.0]])  # from O to the platform joints
    normal = np.cross(np.cross(LEGS[0], w[0]), np.cross(LEGS[1], w[1]))
    w[2] = LEGS[2] + normal / 64.0 + NEAR * np.array([0.0, 1.0, 0.0])
    platform = w + s - p
    g = nd.Geometry(p + platform - LEGS, RING, platform, RING)
    return g, nd.Configuration(p, np.eye(3), s), np.repeat([5.0, 13.0, 13.0], 3)


def separation(g, c):
    """Whole numbers, or nearly so: no rounding to speak of."""
    d, w = g.base_external - c.internal_point, c.position + g.platform_external - c.internal_point
    rows = np.cross(w, d) / (np.linalg.norm(w, axis=1) * np.linalg.norm(d, axis=1))[:, None]
    return np.linalg.svd(rows)[1][-1]


ROBOTS = [near_the_base, near_the_platform, near_a_double_rotation]


def error(found, c):
    """Of the nearest of the configurations found, in entries of Q and in lengths."""
    arrays = ("position", "rotation", "internal_point")
    apart = [np.abs(getattr(found, a) - getattr(c, a)).reshape(*found.shape, -1).max(axis=-1) for a in arrays]
    return np.max(apart, axis=0).min()


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_robots_are_near_singular_and_exact(robot):
    g, c, lengths = robot()
    assert 1e4 < nd.condition_number(g, c) < 1e8
    np.testing.assert_allclose(nd.leg_lengths(g, c), lengths, rtol=1e-15)


@pytest.mark.parametrize("robot", ROBOTS)
def test_all_modes_have_all_digits(robot):
    g, c, lengths = robot()
    modes = nd.forward_position(g, lengths)
    assert modes.status == "found"
    assert error(modes, c) < 4e-15
    nearest = np.argmin(
        np.abs(modes.rotation - np.eye(3)).max(axis=(1, 2)) + np.abs(modes.position - c.position).max(axis=1)
    )
    np.testing.assert_allclose(modes.separation[nearest], separation(g, c), rtol=1e-9)


@pytest.mark.parametrize("robot", ROBOTS)
def test_and_so_has_a_tracked_one(robot):
    g, c, lengths = robot()
    found = nd.track(g, lengths, c.moved(NEAR / 64.0 * np.array([1.0, -1.0, 1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0])))
    assert found.status == "tracked"
    assert error(found, c) < 4e-15
    np.testing.assert_allclose(found.separation, separation(g, c), rtol=1e-9)
