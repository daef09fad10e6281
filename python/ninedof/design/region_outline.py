"""The positions of a region of poses as lines to draw: its edges in space, and its outline in a plane."""

from __future__ import annotations

import numpy as np

from ninedof.design.region import Region
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats

ROUND = 97  # points of a round outline, the last one on the first


def region_lines(region: Region, home: Configuration) -> list[Floats]:
    """Return the outline of a region's positions in space as lines (n, 3) in base axes: edges, circles or the path.

    Nothing for a region of turns alone.
    """
    unit = region.size_at(home)
    if region.path is not None:
        return [np.asarray(home.position + unit * np.array(region.path))]
    low, high = extent(region, home)
    half = 0.5 * (high - low)
    if not half.any():
        return []
    if region.ball is None and region.cylinder is None:
        return box_lines(low, high)
    turn = np.linspace(0.0, 2.0 * np.pi, ROUND)
    circle = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(ROUND)])
    if region.ball is not None:
        return [home.position + half * np.roll(circle, k, axis=1) for k in range(3)]
    rims = [home.position + half * (circle + np.array([0.0, 0.0, z])) for z in (-1.0, 1.0)]
    return [*rims, *(np.stack([rims[0][k], rims[1][k]]) for k in range(0, ROUND - 1, ROUND // 4))]


def box_lines(low: Floats, high: Floats) -> list[Floats]:
    """Return the twelve edges of a box: its lower and its upper rim and four edges up."""
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]], [low[0], low[1]]])
    rims = [np.column_stack([corners, np.full(5, z)]) for z in (low[2], high[2])]
    return [*rims, *(np.stack([rims[0][k], rims[1][k]]) for k in range(4))]


def section_outline(region: Region, home: Configuration, fixed: int, at: float) -> Floats | None:
    """Return the outline of a region's positions in a plane, or a path seen across it; None where it misses the plane.

    Points (n, 2) in the two other coordinates, in their order.
    """
    axes = [k for k in range(3) if k != fixed]
    unit = region.size_at(home)
    if region.path is not None:
        return np.asarray((home.position + unit * np.array(region.path))[:, axes])
    low, high = extent(region, home)
    away = abs(at - float(home.position[fixed]))
    if away > 0.5 * float(high[fixed] - low[fixed]):
        return None
    half, middle = 0.5 * (high - low)[axes], home.position[axes]
    turn = np.linspace(0.0, 2.0 * np.pi, ROUND)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    if region.ball is not None:
        return np.asarray(middle + np.sqrt((unit * region.ball) ** 2 - away**2) * circle)
    if region.cylinder is not None:
        radius = unit * region.cylinder[0]
        if fixed == 2:
            return np.asarray(middle + radius * circle)
        half[0] = np.sqrt(radius**2 - away**2)
    return np.asarray(middle + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]))


def extent(region: Region, home: Configuration) -> tuple[Floats, Floats]:
    """Return the least and the greatest coordinates of a region's positions, in base axes."""
    unit = region.size_at(home)
    if region.path is not None:
        corners = np.array(region.path)
        return home.position + unit * corners.min(axis=0), home.position + unit * corners.max(axis=0)
    reach = unit * np.array(region.reach[:3])
    return home.position - reach, home.position + reach
