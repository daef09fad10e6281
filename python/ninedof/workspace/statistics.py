"""Indices over a workspace: the mean by volume, the least and the greatest value with their poses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.indices import Index
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr
from ninedof.workspace.cells import WorkspaceCells


@short_repr
@dataclass(frozen=True, eq=False)
class IndexStatistics:
    """An index over a workspace; lists have one entry for each component of an index of several numbers.

    Values are taken at the centres of the cells, so that the error is of the order of a cell. The mean weights each
    cell by its allowed volume; the extremes use cells of which at least half is allowed. Poses where the index is
    unknown (NaN) do not count. Of singularity margins, which are signed, the extremes are those of the modulus.
    """

    mean: Any
    least: Any
    least_at: Any
    """Coordinates of the map."""
    greatest: Any
    greatest_at: Any


def statistics_of(
    geometry: Geometry,
    domain: Mapping[str, Any],
    rule: tuple[str, float, Floats],
    criteria: Mapping[str, Any],
    cells: WorkspaceCells,
    ends: tuple[Floats, Floats],
    indices: tuple[Index, ...],
    threads: int | None,
) -> dict[str, IndexStatistics]:
    """Return the statistics of each index. Each pose has one rotation, and O by a rule that is a formula."""
    poses = _core.workspace_poses(geometry, domain, *rule, cells, ends, criteria["singularity_free"])
    c = Configuration(poses.position, poses.rotation, poses.internal_point)

    def over(index: Index) -> IndexStatistics:
        given = index.values(geometry, c, criteria["characteristic_length"], threads) if len(c.position) else []
        values = np.asarray(given, dtype=np.float64).reshape(len(c.position), *index.tail)
        if not index.tail:
            return IndexStatistics(*poses.statistics(values, index.signed))
        return IndexStatistics(*map(list, zip(*(poses.statistics(one, index.signed) for one in values.T), strict=True)))

    return {index.name: over(index) for index in indices}
