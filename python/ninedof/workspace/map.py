"""The result of a search for a workspace."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.redundancy.redundancy_map import MapAudit
from ninedof.support.arguments import choice, finite, flag, whole
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import Saved
from ninedof.support.structs import from_core, made, plain_fields
from ninedof.tables.html import notebook
from ninedof.workspace.cells import LIMITS, IndexStatistics, WorkspaceCells, WorkspaceSlice, group_of
from ninedof.workspace.certified_record import CertifiedWorkspace
from ninedof.workspace.tables import workspace_table

MOST_VOXELS = 1_300_000


class WorkspaceStatus(StrEnum):
    """End of the search for a workspace."""

    CONVERGED = "converged"
    """The error is below the tolerance; also the status of every grid or sample, whose error is not controlled."""
    LIMITED = "limited"
    """`most_evaluations` or the smallest cells were reached first; see `error`."""
    EMPTY = "empty"
    """No allowed pose was found, or none connected with home under `singularity_free`; see `error`."""
    STOPPED = "stopped"
    """Interrupted: the state after the last complete level, NaN if there was none."""


@dataclass(frozen=True, eq=False)
class WorkspaceMap(Saved):
    """A workspace, its volume, its boundary and what limits it."""

    KIND = "workspace"
    COMPRESSED = True

    status: WorkspaceStatus
    volume: float
    """Length unit cubed; of orientations by Haar's measure, radians cubed, 8 pi^2 being all of SO(3)."""
    error: float
    """Estimate of the error of the volume. Octree: from the differences of levels, plus `unseen`. Grid: from random
    errors of the boundary cells. Sample: the standard error over the shifts. Of both at least `unseen` where all points
    are allowed or none is; points of a grid all miss a slab at a face thinner than half a cell. With
    `singularity_free` it does not include a part that only a neck thinner than the smallest cell connects with home."""
    unseen: float
    """Upper bound, at 95 % confidence, of the volume of a feature that neither corners of cells nor the poses that
    audit them show: a part of `error` of an octree. Many separate ones, of which some were found, may be larger.
    Zero if leg lengths alone prove every cell that corners do not cut."""
    chart_volume: float
    """Volume of the whole box or region."""
    box_limits: bool
    """Whether the workspace reaches the faces of the box or region; it would then be larger in a larger one. False for
    a sample, which has no faces."""
    home_allowed: bool
    """Whether the home pose is allowed and in the box."""
    home_limit: str
    """The limit that the home pose violates; "" without one."""
    pieces: Floats
    """Volumes of the connected pieces, the largest first; with `singularity_free` the one of home first."""
    ball_centre: Floats
    ball_radius: float
    """The largest ball inside, in the coordinates of the map; radius 0 and centre NaN where there is none. Leg limits
    of positions are proved in it, other criteria sampled; see docs/workspace.md."""
    box_low: Floats
    box_high: Floats
    """The largest box inside with edges along the axes (a local optimum of its six faces), checked like the ball."""
    conditioning_index: float
    """Mean of 1 / condition number over the workspace (Gosselin and Angeles, 1991), 1 at best."""
    conditioning_index_error: float
    worst_condition_number: float
    worst_at: Floats
    """The largest condition number at an allowed pose evaluated, and where."""
    percentiles: Floats
    """Of the condition number over the volume: at 0, 1, ..., 100 per cent, shape (101,)."""
    boundary_area: float
    """In the coordinates of the map."""
    limit_area: Floats
    """The part of it due to each of `limit_names`; unknown for a sample."""
    levels: Floats
    """After each level of an octree, shape (n, 4): cells, evaluations, volume, error."""
    cells: WorkspaceCells
    low: Floats
    high: Floats
    """Ends of the coordinates."""
    coordinates: tuple[str, str, str]
    """Their names: x y z, or the components of a rotation vector or of tilt and torsion."""
    archetype: str
    method: str
    evaluations: int
    seconds: float
    internal_point_audit: MapAudit
    """Of the best O: how often continuation from nearby poses missed a better one. An audited pose takes the better O;
    at other poses a miss makes the workspace too small. No poses if O follows a rule or every pose is searched."""
    indices: dict[str, IndexStatistics] = field(default_factory=dict)
    """Of the indices asked for, by name."""
    unit: str = ""
    """Name of the length unit; "" without one."""
    certified: CertifiedWorkspace | None = None
    """The proof of the same question, of a run folder with `ninedof workspace --certify`. In a file of its own."""

    limit_names = LIMITS

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the search."""
        return self.status == WorkspaceStatus.STOPPED

    @property
    def of_angles(self) -> bool:
        """Whether the coordinates are angles: in radians here, in degrees on screens and in figures."""
        return self.archetype == "orientation"

    @property
    def share(self) -> float:
        """Volume over that of the box or region."""
        return self.volume / self.chart_volume

    def __repr__(self) -> str:
        """Show the status and the volume."""
        index = f"conditioning index {self.conditioning_index:.4g}"
        return f"<WorkspaceMap: {self.archetype}, {self.status}, volume {self.volume:.6g} +- {self.error:.1g}, {index}>"

    def _repr_html_(self) -> str:
        return notebook(f"{self.archetype.replace('_', ' ')} workspace, {self.status}", workspace_table(self))

    def limits(self, grouped: bool = False) -> dict[str, float]:
        """Return the share of the boundary due to each limit, the largest first.

        Parameters
        ----------
        grouped : bool
            One entry for all limits of legs, for each kind of cone and for all clearances.

        Returns
        -------
        dict of str to float
            Shares that sum to one; "box" is the part on the faces of the box. Empty for a sample.

        """
        limits: Counter[str] = Counter()
        key = group_of if flag("grouped", grouped) else str
        for name, area in zip(LIMITS, self.limit_area.tolist(), strict=True):
            if area > 0.0:
                limits[key(name)] += area / float(self.limit_area.sum())
        return dict(limits.most_common())

    def slice(self, axis: str, at: float, pixels: int = 240, smooth: bool = False) -> WorkspaceSlice:
        """Return a plane section of the map: its cells, or smooth fields for drawing.

        Parameters
        ----------
        axis : str
            The fixed coordinate, one of `coordinates`.
        at : float
            Its value.
        pixels : int
            Number along each side of the box; a smooth section selects its own.
        smooth : bool
            Interpolate between the centres of cells, on a raster about the workspace alone: contours instead of blocks.
            Between large cells it is linear: about 1 % off in the published robot, more where the field is steep.
            By default each pixel has the values of the cell that holds it.

        Returns
        -------
        WorkspaceSlice

        Raises
        ------
        ValueError
            If there is no such coordinate, the value is outside the box, or the map is a sample.

        """
        fixed = self.coordinates.index(choice("axis", axis, self.coordinates))
        finite("at", at, float(self.low[fixed]), float(self.high[fixed]))
        whole("pixels", pixels, 2, 10_000)
        is_smooth = flag("smooth", smooth)
        self._require_cells("slice")
        if is_smooth:
            section = _core.field_section(self, self.field, fixed, at)
        else:
            section = _core.cell_section(self, fixed, at, pixels)
        axes = tuple(name for name in self.coordinates if name != axis)
        return from_core(WorkspaceSlice, section, axes=axes, plane=(axis, float(at)))

    def _require_cells(self, name: str) -> None:
        if self.method == "sample":
            raise ValueError(f"{name}: got a sample, expected a map of cells")

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the field, which is computed when it is used."""
        return {name: value for name, value in vars(self).items() if name != "field"}

    @cached_property
    def field(self) -> _core.WorkspaceField:
        """Allowed share and condition number on an even raster about the workspace, smooth between the cells.

        Computed when first used. ValueError for a sample, which has no cells.
        """
        self._require_cells("field")
        return _core.workspace_field(self, MOST_VOXELS)

    def surface(self, most: int = 300_000) -> _core.WorkspaceSurface:
        """Return the body of the workspace as a smooth surface for drawing.

        Parameters
        ----------
        most : int
            About the greatest number of points of the raster behind it; its faces are fewer.

        Returns
        -------
        WorkspaceSurface
            Without faces where no pose is allowed.

        Raises
        ------
        ValueError
            If the map is a sample.

        """
        self._require_cells("surface")
        whole("most", most, 1_000, 10_000_000)
        return _core.workspace_field(self, most).surface()

    def to_dict(self) -> dict[str, Any]:
        """Return all fields except the cells as plain values."""
        entries = plain_fields(self, "cells", "certified", "limit_area")
        out = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in entries.items()}
        names = ("cells", "evaluations", "volume", "error")
        out["levels"] = [dict(zip(names, row, strict=True)) for row in out["levels"]]
        out |= {"limits": self.limits(), "share": self.share}
        return out if self.certified is None else out | {"certified": self.certified.to_dict()}

    def _saved(self) -> dict[str, Any]:
        return {"limit_names": list(LIMITS), **plain_fields(self, "certified")}

    @classmethod
    def _restored(cls, entries: dict[str, Any]) -> WorkspaceMap:
        if tuple(entries["limit_names"]) != LIMITS:
            raise ValueError
        return made(cls, entries)
