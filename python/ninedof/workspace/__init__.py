"""Workspaces: the allowed positions or orientations, their volume, and the limits that bound them."""

from ninedof.workspace.cells import WorkspaceCells, WorkspaceSlice
from ninedof.workspace.certified import certified_workspace
from ninedof.workspace.certified_record import CertifiedSection, CertifiedWorkspace
from ninedof.workspace.domain import spread_rotations
from ninedof.workspace.field import WorkspaceField
from ninedof.workspace.map import WorkspaceMap, WorkspaceStatus
from ninedof.workspace.search import workspace
from ninedof.workspace.statistics import IndexStatistics
from ninedof.workspace.surface import WorkspaceSurface

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
