"""Workspaces: the allowed positions or orientations, their volume, and the limits that bound them."""

from ninedof.workspace.cells import WorkspaceCells, WorkspaceSlice
from ninedof.workspace.domain import spread_rotations
from ninedof.workspace.map import WorkspaceMap, WorkspaceStatus
from ninedof.workspace.search import workspace
from ninedof.workspace.statistics import IndexStatistics

__all__ = [
    "IndexStatistics",
    "WorkspaceCells",
    "WorkspaceMap",
    "WorkspaceSlice",
    "WorkspaceStatus",
    "spread_rotations",
    "workspace",
]
