"""The share of a study's region within criteria of a workspace, and a box about the region."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ninedof import _core
from ninedof.design.region import Region, extent
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.support.structs import from_core
from ninedof.workspace.question import criteria_of

EASE = 1e-9
"""Share by which limits are eased: an optimum lies on some of them, and rounding would put its home pose outside."""
COUNT = 10_000  # even poses, and as many toward the boundary
ROOM = 2.0  # about the region in the box of a map, in its largest half edge


class RegionShare(NamedTuple):
    """The share of a region that keeps the criteria of a workspace."""

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
    question = _core.WorkspaceQuestion(g, home=home, criteria=criteria_of(criteria, characteristic_length))
    return from_core(RegionShare, _core.region_share(question, region.for_core(), COUNT))


def leg_ranges_over(region: Region, g: Geometry, home: Configuration) -> tuple[Floats, Floats]:
    """Return the shortest and longest length of each leg over a region, shapes (9,): of the legs that are built for it.

    Eased by `EASE` of themselves.
    """
    shortest, longest = _core.leg_lengths_over(g, home, region.for_core(), 2 * COUNT)
    return shortest * (1.0 - EASE), longest * (1.0 + EASE)


def box_about(region: Region, home: Configuration) -> tuple[Floats, Floats]:
    """Return the low and high corner of a box about the positions of a region, with room on every side."""
    low, high = extent(region, home)
    room = ROOM * 0.5 * float((high - low).max())
    return low - room, high + room
