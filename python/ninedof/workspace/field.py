"""The fields of a map on an even raster, smooth between the centres of its cells: for sections and bodies to draw."""

from __future__ import annotations

from typing import NamedTuple

from ninedof import _core
from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr
from ninedof.workspace.cells import WorkspaceCells

MOST_VOXELS = 1_300_000
Ends = tuple[Floats, Floats]


@short_repr
class WorkspaceField(NamedTuple):
    """Allowed share and condition number on an even raster about the workspace; arrays of shape (n_x, n_y, n_z)."""

    axes: tuple[Floats, Floats, Floats]
    """Positions of the raster along each coordinate."""
    fraction: Floats
    """Allowed share, smoothed over neighbours: the workspace ends where it is one half; 0 in the outermost layer."""
    condition_number: Floats
    """Interpolated between the centres of cells, outside the workspace too."""


def field_of(cells: WorkspaceCells, ends: Ends, most: int = MOST_VOXELS) -> WorkspaceField:
    """Return the fields of cells of an octree or a grid between `ends`, on at most about `most` points."""
    return WorkspaceField(*_core.workspace_field(cells, ends, most))
