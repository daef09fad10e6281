"""The cells of a workspace, plane sections of them, and the names of their limits."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr

LIMITS: tuple[str, ...] = tuple(_core.workspace_limits)
GROUPS = ("base_cone", "platform_cone", "leg_clearance")


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


def slice_of(
    cells: WorkspaceCells,
    ends: tuple[Floats, Floats],
    coordinates: tuple[str, str, str],
    fixed: int,
    at: float,
    pixels: int,
) -> WorkspaceSlice:
    """Return the section of cells between `ends` where coordinate number `fixed` has the value `at`.

    Cells left undecided, of which no part is known to be allowed, are outside.
    """
    low, high = ends
    h, v = (k for k in range(3) if k != fixed)
    state = np.zeros((pixels, pixels), dtype=np.uint8)
    limit = np.full((pixels, pixels), -1, dtype=np.int16)
    kappa, share = np.full((pixels, pixels), np.nan), np.zeros((pixels, pixels))
    # Half open, so that a plane between two layers belongs to one of them.
    away = (at - cells.centre[:, fixed]) / cells.size[:, fixed]
    hit = np.flatnonzero((away >= -0.5) & ((away < 0.5) | (at >= high[fixed])) & (away <= 0.5 + 1e-9))
    scale = pixels / (high - low)

    def pixel(x: Floats) -> Any:
        """Return the first pixel whose centre is not below x; rounded, so that neighbouring cells agree."""
        return np.ceil(np.round((x - low) * scale - 0.5, 6)).astype(int)

    first, last = pixel(cells.centre[hit] - 0.5 * cells.size[hit]), pixel(cells.centre[hit] + 0.5 * cells.size[hit])
    for n, a, b in zip(hit.tolist(), first, last, strict=True):
        there = (slice(a[v], b[v]), slice(a[h], b[h]))
        held = cells.state[n] if cells.fraction[n] > 0.0 else 0
        state[there], limit[there] = held, cells.limit[n]
        kappa[there] = cells.condition_number[n] if held else np.nan
        share[there] = cells.fraction[n]
    middle = (np.arange(pixels) + 0.5)[:, None] / scale + low
    axes, plane = (coordinates[h], coordinates[v]), (coordinates[fixed], at)
    return WorkspaceSlice(axes, plane, middle[:, h], middle[:, v], state, limit, kappa, share)


def group_of(name: str) -> str:
    """Return the criterion of a limit."""
    first = name.split(" ")[0]
    if first in GROUPS:
        return first
    if name.startswith("det "):
        return "singularity_free"
    return "leg_limits" if name.endswith((" low", " high")) else name
