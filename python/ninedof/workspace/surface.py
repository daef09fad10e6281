"""The boundary of a workspace as a surface of quadrilaterals: for figures, reports and the viewer."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr
from ninedof.workspace.field import WorkspaceField


@short_repr
class WorkspaceSurface(NamedTuple):
    """A closed surface; seen from outside the corners of a face run counterclockwise."""

    points: Floats
    """Shape (n, 3), in the coordinates of the map."""
    faces: NDArray[np.int64]
    """Rows of four numbers of points, shape (m, 4)."""

    @property
    def normals(self) -> Floats:
        """Outward unit normals of the faces, shape (m, 3)."""
        return _core.surface_normals(self)

    @property
    def volume(self) -> float:
        """Volume enclosed, by the divergence theorem."""
        return _core.enclosed_volume(self)


def surface_of(field: WorkspaceField) -> WorkspaceSurface:
    """Return the surface of a field, at the level of its allowed share that keeps the volume."""
    return WorkspaceSurface(*_core.workspace_surface(field))
