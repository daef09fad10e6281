"""Workspaces: which positions or orientations are allowed, how large the set is and what ends it."""

from ninedof.workspace.domain import spread_rotations
from ninedof.workspace.map import WorkspaceCells, WorkspaceMap, WorkspaceSlice, WorkspaceStatus
from ninedof.workspace.search import workspace

__all__ = ["WorkspaceCells", "WorkspaceMap", "WorkspaceSlice", "WorkspaceStatus", "spread_rotations", "workspace"]
