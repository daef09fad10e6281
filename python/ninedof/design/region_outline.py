"""The positions of a region of poses as lines to draw: its edges in space, and its outline in a plane."""

from __future__ import annotations

import numpy as np

from ninedof.design.region import Region
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats

ROUND = 97  # points of a round outline, the last one on the first
SQUARE = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])


def region_lines(region: Region, home: Configuration) -> list[Floats]:
    """Return the outline of a region's positions in space as lines (n, 3) in base axes: edges, circles or the path.

    Nothing for a region of turns alone.
    """
    if region.path is not None:
        return [_corners(region, home)]
    half = _half_edges(region, home)
    if not half.any():
        return []
    if region.ball is not None:
        return [home.position + half * np.roll(circle(), k, axis=1) for k in range(3)]
    if region.cylinder is None:
        return box_lines(*extent(region, home))
    return _between_rims([home.position + half * (circle() + np.array([0.0, 0.0, z])) for z in (-1.0, 1.0)])


def box_lines(low: Floats, high: Floats) -> list[Floats]:
    """Return the twelve edges of a box: its lower and its upper rim and four edges up."""
    sides = np.where(SQUARE > 0.0, high[:2], low[:2])
    return _between_rims([np.column_stack([sides, np.full(len(sides), z)]) for z in (low[2], high[2])])


def section_outline(region: Region, home: Configuration, fixed: int, at: float) -> Floats | None:
    """Return the outline of a region's positions in a plane, or a path seen across it; None where it misses the plane.

    Points (n, 2) in the two other coordinates, in their order.
    """
    axes = [k for k in range(3) if k != fixed]
    if region.path is not None:
        return _corners(region, home)[:, axes]
    every = _half_edges(region, home)
    half, away = every[axes], abs(at - float(home.position[fixed]))
    if away > every[fixed]:
        return None
    is_round = region.ball is not None or (region.cylinder is not None and fixed == 2)
    if region.ball is not None:
        half = np.sqrt(half**2 - away**2)
    elif region.cylinder is not None and not is_round:
        half[0] = np.sqrt(half[0] ** 2 - away**2)
    return np.asarray(home.position[axes] + half * (circle()[:, :2] if is_round else SQUARE))


def extent(region: Region, home: Configuration) -> tuple[Floats, Floats]:
    """Return the least and the greatest coordinates of a region's positions, in base axes."""
    if region.path is not None:
        corners = _corners(region, home)
        return corners.min(axis=0), corners.max(axis=0)
    half = _half_edges(region, home)
    return home.position - half, home.position + half


def circle() -> Floats:
    """Return the points (n, 3) of a circle of radius 1 about z."""
    turn = np.linspace(0.0, 2.0 * np.pi, ROUND)
    return np.column_stack([np.cos(turn), np.sin(turn), np.zeros(ROUND)])


def _corners(region: Region, home: Configuration) -> Floats:
    return np.asarray(home.position + region.size_at(home) * np.array(region.path))


def _half_edges(region: Region, home: Configuration) -> Floats:
    return np.asarray(region.size_at(home) * np.array(region.reach[:3]))


def _between_rims(rims: list[Floats]) -> list[Floats]:
    """Return two closed lines, and four lines from one to the other."""
    last = len(rims[0]) - 1
    return [*rims, *(np.stack([rims[0][k], rims[1][k]]) for k in range(0, last, last // 4))]
