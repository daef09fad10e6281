"""Workspaces: the allowed positions or orientations, their volume, and the limits that bound them."""

from ninedof._core import WorkspaceField, WorkspaceSurface
from ninedof.workspace.cells import IndexStatistics, WorkspaceCells, WorkspaceSlice
from ninedof.workspace.certified import certified_workspace
from ninedof.workspace.certified_record import CertifiedSection, CertifiedWorkspace
from ninedof.workspace.map import WorkspaceMap, WorkspaceStatus
from ninedof.workspace.question import spread_rotations
from ninedof.workspace.search import workspace

__all__ = [
    "CertifiedSection",
    "CertifiedWorkspace",
    "IndexStatistics",
    "WorkspaceCells",
    "WorkspaceField",
    "WorkspaceMap",
    "WorkspaceSlice",
    "WorkspaceStatus",
    "WorkspaceSurface",
    "certified_workspace",
    "spread_rotations",
    "workspace",
]
