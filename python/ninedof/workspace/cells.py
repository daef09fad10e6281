"""The cells of a workspace, plane sections of them, and the names of their limits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.design.limit_numbers import PARTS
from ninedof.support.arrays import Floats
from ninedof.support.short import short_repr

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
    return of_item[0] if of_item else "leg_limits" if name.endswith((" low", " high")) else name
