"""What a workspace turned out to be: numbers, cells, slices, files."""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass, fields
from enum import StrEnum
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.chunks import Arrays
from ninedof.chunks.npz import read_npz, write_npz
from ninedof.redundancy.redundancy_map import MapAudit
from ninedof.support.arguments import choice, finite, whole
from ninedof.support.arrays import Floats

__all__ = ["WorkspaceCells", "WorkspaceMap", "WorkspaceSlice", "WorkspaceStatus"]

FORMAT = "ninedof-workspace-2"
LIMITS: tuple[str, ...] = tuple(_core.workspace_limits)
GROUPS = ("base_cone", "platform_cone", "leg_clearance")


class WorkspaceStatus(StrEnum):
    """How the search for a workspace ended."""

    CONVERGED = "converged"
    """The error asked for is reached; always so for a grid or a sample, whose error is what it is."""
    LIMITED = "limited"
    """`most_evaluations` came first: `error` says how far it got."""
    EMPTY = "empty"
    """No allowed pose was found, or none connected with home where that is asked for; `unseen` says how sure."""
    STOPPED = "stopped"
    """Interrupted: what was known after the last whole level, NaN if there was none."""


class WorkspaceCells(NamedTuple):
    """The cells a map is made of, those outside included; of a sample its points. All of n rows."""

    centre: Floats
    """Shape (n, 3): positions, or coordinates of a region of orientations."""
    size: Floats
    """Shape (n, 3): the sides; zero for the points of a sample."""
    state: NDArray[np.uint8]
    """0 outside, 1 on the boundary, 2 inside."""
    limit: NDArray[np.int16]
    """What ends the workspace in a boundary cell, what forbids the middle of one outside: index into
    `WorkspaceMap.limit_names`; -1 inside."""
    fraction: Floats
    """Share of the cell that is allowed."""
    condition_number: Floats
    """At the centre."""
    piece: NDArray[np.int32]
    """Which connected piece it belongs to, as numbered in `WorkspaceMap.pieces`; -1 outside."""


class WorkspaceSlice(NamedTuple):
    """A plane through a map, on a square raster. Arrays have the shape (len(vertical), len(horizontal))."""

    axes: tuple[str, str]
    """Names of the horizontal and the vertical coordinate."""
    plane: tuple[str, float]
    """Name and value of the coordinate that is fixed."""
    horizontal: Floats
    vertical: Floats
    state: NDArray[np.uint8]
    limit: NDArray[np.int16]
    condition_number: Floats
    """NaN where no allowed pose is."""


@dataclass(frozen=True, eq=False)
class WorkspaceMap:
    """A workspace, its volume, its boundary and what limits it."""

    status: WorkspaceStatus
    volume: float
    """Length unit cubed; of orientations by Haar's measure, radians cubed, 8 pi^2 being all of SO(3)."""
    error: float
    """Estimate of the error of the volume. Octree: by comparing levels. Grid: as if each boundary cell were right by
    chance. Sample: the standard error of the shifts."""
    unseen: float
    """Bound, at 95 % confidence, for the volume of what the octree did not see: features too thin for every cell and
    every audit pose. Zero where lengths of legs alone prove everything."""
    chart_volume: float
    """Of the whole box or region."""
    box_limits: bool
    """The workspace runs to the box or the region asked for: in a larger one it would be larger."""
    home_allowed: bool
    """Whether the home pose is allowed and in the box."""
    home_limit: str
    """What forbids the home pose; "" where nothing does."""
    pieces: Floats
    """Volumes of the connected pieces, the largest first; with "singularity_free" the one of home first."""
    ball_centre: Floats
    ball_radius: float
    """The largest ball inside, in the coordinates of the map; radius 0 and centre NaN where there is none."""
    box_low: Floats
    box_high: Floats
    """The largest box inside with edges along the axes (a local optimum of its six faces)."""
    conditioning_index: float
    """Mean of 1 / condition number over the workspace (Gosselin and Angeles, 1991), 1 at best."""
    conditioning_index_error: float
    worst_condition_number: float
    worst_at: Floats
    """The largest condition number at any allowed pose looked at, and where."""
    percentiles: Floats
    """Of the condition number over the volume: at 0, 1, ..., 100 per cent, shape (101,)."""
    boundary_area: float
    """In the coordinates of the map."""
    limit_area: Floats
    """The part of it that each of `limit_names` makes; none is known for a sample."""
    levels: Floats
    """What an octree knew after each level, shape (n, 4): cells, evaluations, volume, error."""
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
    """Of the best O: how often continuing it from nearby poses missed a better one. A miss at a pose audited is mended,
    elsewhere it stands: the workspace is then too small there. No poses where O is by a rule, or each is searched."""

    limit_names = LIMITS

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the search."""
        return self.status == WorkspaceStatus.STOPPED

    @property
    def share(self) -> float:
        """Volume over that of the box or region."""
        return self.volume / self.chart_volume

    def limits(self, grouped: bool = False) -> dict[str, float]:
        """Return the share of the boundary that each limit makes, the largest first.

        Parameters
        ----------
        grouped : bool
            One entry for all limits of legs, for each kind of cone and for all clearances.

        Returns
        -------
        dict of str to float
            Shares that sum to one; "box" is where the workspace runs to the box. Empty for a sample.

        """
        total = float(self.limit_area.sum())
        found: dict[str, float] = {}
        for name, area in zip(LIMITS, self.limit_area.tolist(), strict=True):
            if area > 0.0:
                key = _group(name) if grouped else name
                found[key] = found.get(key, 0.0) + area / total
        return dict(sorted(found.items(), key=lambda entry: -entry[1]))

    def slice(self, axis: str, at: float, pixels: int = 240) -> WorkspaceSlice:
        """Return a plane through the map for drawing.

        Parameters
        ----------
        axis : str
            Which of `coordinates` is fixed.
        at : float
            Its value.
        pixels : int
            Along each side.

        Returns
        -------
        WorkspaceSlice

        Raises
        ------
        ValueError
            If there is no such coordinate, the value is beyond the box, or the map is a sample.

        """
        fixed = self.coordinates.index(choice("axis", axis, self.coordinates))
        finite("at", at, float(self.low[fixed]), float(self.high[fixed]))
        whole("pixels", pixels, 2, 10_000)
        if self.method == "sample":
            raise ValueError("slice: got a sample, expected a map of cells")
        h, v = (k for k in range(3) if k != fixed)
        state = np.zeros((pixels, pixels), dtype=np.uint8)
        limit = np.full((pixels, pixels), -1, dtype=np.int16)
        kappa = np.full((pixels, pixels), np.nan)
        c = self.cells
        # Half open, so that a plane between two layers belongs to one of them.
        away = (at - c.centre[:, fixed]) / c.size[:, fixed]
        hit = np.flatnonzero((away >= -0.5) & ((away < 0.5) | (at >= self.high[fixed])) & (away <= 0.5 + 1e-9))
        scale = pixels / (self.high - self.low)

        def pixel(x: Floats) -> Any:
            """Return the first pixel whose middle is not below x; neighbours must agree, whatever the rounding."""
            return np.ceil(np.round((x - self.low) * scale - 0.5, 6)).astype(int)

        first, last = pixel(c.centre[hit] - 0.5 * c.size[hit]), pixel(c.centre[hit] + 0.5 * c.size[hit])
        for n, a, b in zip(hit.tolist(), first, last, strict=True):
            there = (slice(a[v], b[v]), slice(a[h], b[h]))
            state[there], limit[there] = c.state[n], c.limit[n]
            kappa[there] = c.condition_number[n] if c.state[n] else np.nan
        middle = (np.arange(pixels) + 0.5)[:, None] / scale + self.low
        return WorkspaceSlice(
            (self.coordinates[h], self.coordinates[v]),
            (axis, float(at)),
            middle[:, h],
            middle[:, v],
            state,
            limit,
            kappa,
        )

    def to_dict(self) -> dict[str, Any]:
        """Return every number but the cells, as plain values."""
        out: dict[str, Any] = {}
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in ("cells", "limit_area"):
                continue
            if field.name == "levels":
                names = ("cells", "evaluations", "volume", "error")
                out["levels"] = [dict(zip(names, row, strict=True)) for row in value.tolist()]
                continue
            out[field.name] = value.tolist() if isinstance(value, np.ndarray) else value
        out["status"] = str(self.status)
        out["internal_point_audit"] = asdict(self.internal_point_audit)
        out["coordinates"] = list(self.coordinates)
        out["limits"] = self.limits()
        out["share"] = self.share
        return out

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the map to a file of numpy arrays (.npz), whole or not at all.

        Parameters
        ----------
        path : path
            numpy's own suffix .npz is added if it is missing.

        Returns
        -------
        pathlib.Path

        """
        arrays = {f"cells_{name}": value for name, value in self.cells._asdict().items()}
        words: dict[str, Any] = {"format": FORMAT, "limit_names": list(LIMITS)}
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, np.ndarray):
                arrays[field.name] = value
            elif field.name == "internal_point_audit":
                words[field.name] = asdict(value)
            elif field.name != "cells":
                words[field.name] = value
        return write_npz(path, {"words": np.array(json.dumps(words)), **arrays}, compressed=True)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> WorkspaceMap:
        """Read a map that `save` has written.

        Parameters
        ----------
        path : path

        Raises
        ------
        ValueError
            If there is no such file or it holds no map; the message names it.

        """
        return read_npz(path, repr(FORMAT), cls._made)

    @classmethod
    def _made(cls, contents: Arrays) -> WorkspaceMap:
        """Return the map that arrays of a file make; those of another file lack something."""
        data: dict[str, Any] = dict(contents)
        words = json.loads(str(data.pop("words")))
        if words.pop("format") != FORMAT or tuple(words.pop("limit_names")) != LIMITS:
            raise ValueError
        cells = WorkspaceCells(*(data.pop(f"cells_{name}") for name in WorkspaceCells._fields))
        words["status"] = WorkspaceStatus(words["status"])
        words["coordinates"] = tuple(words["coordinates"])
        words["internal_point_audit"] = MapAudit(**words["internal_point_audit"])
        return cls(cells=cells, **words, **data)


def _group(name: str) -> str:
    """Return the criterion that a limit belongs to."""
    first = name.split(" ")[0]
    if first in GROUPS:
        return first
    if name.startswith("det "):
        return "singularity_free"
    return "leg_limits" if name.endswith((" low", " high")) else name
