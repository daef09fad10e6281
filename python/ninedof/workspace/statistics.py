"""Indices over a workspace: the mean by volume, the least and the greatest value with their poses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.indices import Index
from ninedof.support.short import short_repr
from ninedof.support.structs import from_core
from ninedof.workspace.question import connected


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
    question: _core.WorkspaceQuestion, search: Any, indices: tuple[Index, ...], threads: int | None
) -> dict[str, IndexStatistics]:
    """Return the statistics of each index over a WorkspaceMap: each pose has one rotation, and O by a formula."""
    poses = _core.workspace_poses(question, search, connected(question))
    c = poses.configurations
    length = question.criteria.characteristic_length

    def over(index: Index) -> IndexStatistics:
        computed = index.values(question.geometry, c, length, threads) if len(c) else []
        values = np.asarray(computed, dtype=np.float64).reshape(len(c), *index.tail)
        if not index.tail:
            return from_core(IndexStatistics, poses.statistics(values, index.signed))
        each = [poses.statistics(one, index.signed) for one in values.T]
        return IndexStatistics(*([getattr(one, n) for one in each] for n in IndexStatistics.__dataclass_fields__))

    return {index.name: over(index) for index in indices}
