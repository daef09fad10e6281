"""How much of the region of a study lies within criteria of a workspace, and the region as a box and as an outline."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.design.region import Region
from ninedof.design.region_stack import configurations_at, samples
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.clearance import clearances
from ninedof.sheet.pose_limits import CONES, cone_angles
from ninedof.sheet.region_search import Numbers, extreme_poses
from ninedof.singularity.singularity import singularity_margins
from ninedof.support.arrays import Floats
from ninedof.workspace.study_criteria import EASE

COUNT = 10_000  # even poses, and as many toward the boundary
ROOM = 2.0  # about the region in the box of a map, in its largest half edge
OUTLINE = 96  # points of a round outline


class RegionShare(NamedTuple):
    """What `region_share` returns."""

    share: float
    """Of the even poses of the region that keep all criteria, 0 to 1."""
    looked_at: int
    """Even poses, and as many drawn toward the boundary."""
    passed: tuple[str, ...]
    """Criteria that some pose passes, on the boundary or inside."""


def region_share(
    region: Region, g: Geometry, home: Configuration, criteria: Mapping[str, Any], characteristic_length: float
) -> RegionShare:
    """Return how much of a region keeps the criteria of a workspace, with its tilts, O as the region has it."""
    c = configurations_at(region, home, samples(region, COUNT))[1]
    allowed, passed = np.ones(len(c.position), dtype=bool), []
    for name, keeps in _kept(g, c, home, criteria, characteristic_length):
        allowed &= keeps
        if not keeps.all():
            passed.append(name)
    return RegionShare(float(allowed[:COUNT].mean()), len(allowed), tuple(passed))


def _kept(
    g: Geometry, c: Configuration, home: Configuration, criteria: Mapping[str, Any], length: float
) -> Iterator[tuple[str, Any]]:
    for name, limit in criteria.items():
        if name == "leg_limits":
            lengths = leg_lengths(g, c)
            yield name, ((lengths >= limit[0]) & (lengths <= limit[1])).all(axis=1)
        elif name in CONES:
            most, axis = (limit["max"], limit["axis"]) if isinstance(limit, Mapping) else (limit, ())
            yield name, (cone_angles(g, c, home, name, axis) <= most).all(axis=1)
        elif name == "leg_clearance":
            yield name, clearances(g, c).min(axis=1) >= limit
        elif name == "condition_number":
            yield name, condition_number(g, c, length) <= limit
        elif name == "singularity_free" and limit:
            signs = np.sign(singularity_margins(g, home))
            yield name, (np.stack(singularity_margins(g, c), axis=1) * signs > 0.0).all(axis=1)


def leg_ranges_over(region: Region, g: Geometry, home: Configuration) -> tuple[Floats, Floats]:
    """Return the shortest and longest length of each leg over a region, shapes (9,): of the legs that are built for it.

    Eased by `EASE` of themselves.
    """
    extremes, _ = extreme_poses(region, home, samples(region, COUNT), [_ends_of_legs(g)])
    lengths = leg_lengths(g, configurations_at(region, home, extremes)[1])
    return lengths.min(axis=0) * (1.0 - EASE), lengths.max(axis=0) * (1.0 + EASE)


def _ends_of_legs(g: Geometry) -> Numbers:
    def ends(c: Configuration) -> Floats:
        lengths = leg_lengths(g, c)
        return np.concatenate([lengths, -lengths], axis=1)

    return ends


def box_about(region: Region, home: Configuration) -> tuple[Floats, Floats]:
    """Return the low and high corner of a box about the positions of a region, with room on every side."""
    low, high = _extent(region, home)
    room = ROOM * 0.5 * float((high - low).max())
    return low - room, high + room


def _extent(region: Region, home: Configuration) -> tuple[Floats, Floats]:
    unit = float(home.position[2]) if region.unit == "zp" else 1.0
    if region.path is not None:
        corners = np.array(region.path)
        return home.position + unit * corners.min(axis=0), home.position + unit * corners.max(axis=0)
    reach = unit * np.array(region.reach[:3])
    return home.position - reach, home.position + reach


def outline(region: Region, home: Configuration, fixed: int, at: float) -> Floats | None:
    """Return the outline of a region's positions in a plane, or a path seen across it; None where it misses the plane.

    Points (n, 2) in the two other coordinates, in their order.
    """
    drawn = [k for k in range(3) if k != fixed]
    unit = float(home.position[2]) if region.unit == "zp" else 1.0
    if region.path is not None:
        return np.asarray((home.position + unit * np.array(region.path))[:, drawn])
    low, high = _extent(region, home)
    away = abs(at - float(home.position[fixed]))
    if away > 0.5 * float(high[fixed] - low[fixed]):
        return None
    half, middle = 0.5 * (high - low)[drawn], home.position[drawn]
    turn = np.linspace(0.0, 2.0 * np.pi, OUTLINE)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    if region.ball is not None:
        return np.asarray(middle + np.sqrt((unit * region.ball) ** 2 - away**2) * circle)
    if region.cylinder is not None:
        radius = unit * region.cylinder[0]
        if fixed == 2:
            return np.asarray(middle + radius * circle)
        half[0] = np.sqrt(radius**2 - away**2)
    return np.asarray(middle + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]))


def region_lines(region: Region, home: Configuration) -> list[Floats]:
    """Return the outline of a region's positions in space as lines (n, 3): edges, circles or the path."""
    unit = float(home.position[2]) if region.unit == "zp" else 1.0
    if region.path is not None:
        return [np.asarray(home.position + unit * np.array(region.path))]
    low, high = _extent(region, home)
    half = 0.5 * (high - low)
    turn = np.linspace(0.0, 2.0 * np.pi, OUTLINE)
    circle = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(OUTLINE)])
    if region.ball is not None:
        return [home.position + half * np.roll(circle, k, axis=1) for k in range(3)]
    ups = [np.array([0.0, 0.0, z]) for z in (-1.0, 1.0)]
    if region.cylinder is not None:
        rims = [home.position + half * (circle + up) for up in ups]
        return [*rims, *(np.stack([rims[0][k], rims[1][k]]) for k in range(0, OUTLINE - 1, OUTLINE // 4))]
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [-1, -1, 0]], dtype=np.float64)
    rims = [home.position + half * (square + up) for up in ups]
    return [*rims, *(np.stack([rims[0][k], rims[1][k]]) for k in range(4))]
