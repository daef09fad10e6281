"""The parts of a workspace map: cells, plane sections, the names of their limits, statistics of indices over it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.design.indices import Index
from ninedof.design.limit_numbers import PARTS
from ninedof.support.arrays import Floats
from ninedof.support.structs import from_core
from ninedof.support.text import short_repr
from ninedof.workspace.question import LEG_LIMITS, connected

LIMITS: tuple[str, ...] = tuple(_core.workspace_limits)


@short_repr
class WorkspaceCells(NamedTuple):
    """The cells of a map, those outside included; the points of a sample. All arrays have n rows."""

    centre: Floats
    """Shape (n, 3): positions, or coordinates of a region of orientations."""
    size: Floats
    """Shape (n, 3): the sides; zero for the points of a sample."""
    state: NDArray[np.uint8]
    """0 outside, 1 on the boundary, 2 inside."""
    limit: NDArray[np.int16]
    """The limit that bounds the workspace in a boundary cell, or that the centre of an outside cell violates: an index
    into `WorkspaceMap.limit_names`; -1 inside."""
    fraction: Floats
    """Allowed share of the cell."""
    condition_number: Floats
    """At the centre."""
    piece: NDArray[np.int32]
    """The connected piece, as numbered in `WorkspaceMap.pieces`; -1 outside."""


@short_repr
class WorkspaceSlice(NamedTuple):
    """A plane section of a map, on a square raster. Arrays have the shape (len(vertical), len(horizontal))."""

    axes: tuple[str, str]
    """Names of the horizontal and the vertical coordinate."""
    plane: tuple[str, float]
    """Name and value of the fixed coordinate."""
    horizontal: Floats
    vertical: Floats
    state: NDArray[np.uint8]
    limit: NDArray[np.int16]
    condition_number: Floats
    """NaN where no pose is allowed."""
    fraction: Floats
    """Allowed share; the contour at one half is the boundary."""


def group_of(name: str) -> str:
    """Return the criterion of a limit."""
    first = name.split(" ")[0]
    if first in PARTS:
        return first
    of_item = [limit for limit, parts in PARTS.items() if name in parts]
    return of_item[0] if of_item else LEG_LIMITS if name.endswith((" low", " high")) else name


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
