"""Three-dimensional axes: equal scale, view direction, limits."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from ninedof.plot import style
from ninedof.support.arrays import Floats

ELEVATION, AZIMUTH = 17.0, -76.0  # degrees: low enough to show the heights of base, O and platform

Limits = tuple[float, float, float]
"""Half width in x and y, lowest and highest z."""


def limits(points: Floats) -> Limits:
    """Return limits that hold all points, shape (n, 3), and the origin."""
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    return 1.04 * float(np.abs(points[:, :2]).max()), min(low, 0.0), max(high, 0.0)


def frame(axes: Any, unit: str, extent: Limits) -> None:
    """Set limits, scale, view and the style of panes, ticks and labels."""
    half, low, high = extent
    axes.set(xlim=(-half, half), ylim=(-half, half), zlim=(low, high))
    axes.set_box_aspect((2 * half, 2 * half, high - low), zoom=1.06)
    axes.set_proj_type("ortho")  # equal lengths stay equal at every depth
    axes.view_init(elev=ELEVATION, azim=AZIMUTH)
    axes.computed_zorder = False  # seen from above: base, then legs, then platform
    axes.patch.set_visible(False)
    for name, axis in zip("xyz", (axes.xaxis, axes.yaxis, axes.zaxis), strict=True):
        axis.pane.set_visible(False)
        axis.line.set_color(style.MUTED)
        axis._axinfo["grid"].update(color=style.GRID, linewidth=0.6)
        axis.set_tick_params(labelsize=style.SMALL_SIZE, pad=2 if name == "z" else -1)
        axis.set_rotate_label(False)
        axis.labelpad = {"x": 0, "y": 3}.get(name, 0)
    # No ticks at the corners that two axes share.
    level = [tick for tick in MaxNLocator(4).tick_values(-half, half) if abs(tick) < 0.93 * half]
    axes.set(xticks=level, yticks=level)
    axes.zaxis.set_major_locator(MaxNLocator(4))
    text: dict[str, Any] = {"size": style.TEXT_SIZE, "color": style.INK}
    axes.set_xlabel(style.with_unit("x", unit), **text)
    axes.set_ylabel(style.with_unit("y", unit), **text)
    # Above its axis at this corner: beside the axis, matplotlib puts the name on the numbers or outside the figure.
    axes.text(half, half, high + 0.04 * (high - low), style.with_unit("z", unit), ha="center", va="bottom", **text)


def towards_eye(elevation: float = ELEVATION, azimuth: float = AZIMUTH) -> Floats:
    """Return the unit vector from the scene to the viewer; angles in degrees."""
    rise, turn = np.radians([elevation, azimuth])
    flat = np.array([np.cos(turn), np.sin(turn), 0.0])
    return np.asarray(np.cos(rise) * flat + np.array([0.0, 0.0, np.sin(rise)]))


def to_the_left() -> Floats:
    """Return the unit vector that points to the left of the figure."""
    azimuth = np.radians(AZIMUTH)
    return np.array([np.sin(azimuth), -np.cos(azimuth), 0.0])
