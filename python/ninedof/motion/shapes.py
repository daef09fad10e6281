"""Positions along lines, circles and spirals, relative to their start or centre."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ninedof.support.arguments import Vector, finite, shown, whole
from ninedof.support.arrays import Floats

TURNS = 3  # of a spiral
SHORTEST, LONGEST = 1e-300, 1e100  # of a motion: its times must differ, and their squares be numbers
MOST_POINTS = 10_000_000


def times(duration: Any, points: Any) -> Floats:
    """Return evenly spaced times from 0 to the duration."""
    length = finite("duration", duration)
    if not SHORTEST < length <= LONGEST:
        expected = f"expected a number above {SHORTEST:g} and at most {LONGEST:g}"
        raise ValueError(f"duration: got {shown(duration)}, {expected}")
    return np.linspace(0.0, length, whole("points", points, 3, MOST_POINTS))


def circle_positions(u: Floats, radius: float) -> Floats:
    """Return a horizontal circle about 0 for u from 0 to 1; both ends are the same point."""
    angle = 2.0 * math.pi * u
    found = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros_like(u)], axis=1)
    found[-1] = found[0]
    return found


def line_positions(u: Floats, step: Vector) -> Floats:
    """Return a line from 0 to `step`, from rest to rest."""
    found: Floats = _rest_to_rest(u)[:, None] * np.array(step)
    return found


def spiral_positions(u: Floats, radius: float, height: float) -> Floats:
    """Return a spiral from 0 outwards to the radius and up to the height, from rest to rest."""
    v = _rest_to_rest(u)
    angle = 2.0 * math.pi * TURNS * v
    found: Floats = np.stack([radius * v * np.cos(angle), radius * v * np.sin(angle), height * v], axis=1)
    return found


def _rest_to_rest(u: Floats) -> Floats:
    """Return the polynomial of degree five from 0 to 1 whose speed and acceleration are zero at both ends."""
    found: Floats = u**3 * (10.0 + u * (6.0 * u - 15.0))
    return found
