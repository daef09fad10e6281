"""Three-dimensional axes: equal scale, view direction, limits."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d import proj3d  # type: ignore[import-untyped]

from ninedof.plot import style
from ninedof.support.arrays import Floats

ROOM = np.array([0.14, 0.36, 0.5, 0.2])  # inches beside the box: left, below, right, above
AXES = ((4, 0.04, 0.96, -3, -3), (3, 0.04, 0.96, -3, 1), (4, -1e-9, 0.97, 0, 0))
"""Of x, y and z: most ticks, where they begin and end on the axis, and the distances of their numbers and the name."""
HALO = [style.rim(1.8)]


class View:
    """A direction of view and the directions that follow from it: towards the eye, and to the right and up."""

    def __init__(self, elevation: float, azimuth: float) -> None:
        """Take the angles in degrees."""
        self.angles = {"elev": elevation, "azim": azimuth}
        rise, turn = np.radians([elevation, azimuth])
        self.right = np.array([-np.sin(turn), np.cos(turn), 0.0])
        self.eye = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
        self.up = np.cross(self.eye, self.right)

    def seen(self, points: Floats) -> Floats:
        """Return points (..., 3) as they lie in the picture, to the right and up: shape (..., 2)."""
        return np.asarray(points @ np.column_stack([self.right, self.up]))

    def turn(self, axes: Any) -> None:
        """Look at axes from here: equal lengths stay equal at every depth, and what is drawn last is in front."""
        axes.set_proj_type("ortho")
        axes.view_init(**self.angles)
        axes.computed_zorder = False
        axes.patch.set_visible(False)


VIEW = View(17.0, -76.0)  # low enough to show the heights of base, O and platform


def corners(points: Floats) -> tuple[Floats, Floats]:
    """Return the corners of a box about the z axis that holds all points, shape (n, 3), and the origin."""
    half, heights = 1.04 * np.abs(points[:, :2]).max(), points[:, 2]
    return np.array([-half, -half, min(heights.min(), 0.0)]), np.array([half, half, max(heights.max(), 0.0)])


def box(axes: Any, names: tuple[str, str, str], unit: str, low: Floats, high: Floats) -> None:
    """Set limits from corner to corner, equal scale, view and the style of panes, ticks and labels."""
    span = high - low
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(tuple(span), zoom=1.0)
    VIEW.turn(axes)
    every = (axes.xaxis, axes.yaxis, axes.zaxis)
    # No ticks at the corners that two axes share.
    for axis, first, size, (most, least, last, pad, label_pad) in zip(every, low, span, AXES, strict=True):
        ticks = MaxNLocator(most).tick_values(first, first + size)
        axis.set_ticks([tick for tick in ticks if least < (tick - first) / size < last])
        axis.pane.set_visible(False)
        axis.line.set_color(style.MUTED)
        axis._axinfo["grid"].update(color=style.GRID, linewidth=0.5)
        axis.set_tick_params(labelsize=style.SMALL_SIZE, pad=pad)
        axis.set_rotate_label(False)
        axis.labelpad = label_pad
    text = {"size": style.TEXT_SIZE, "color": style.INK}
    axes.set_xlabel(style.with_unit(names[0], unit), **text)
    axes.set_ylabel(style.with_unit(names[1], unit), **text)
    # Above its axis at this corner: beside the axis, matplotlib puts the name on the numbers or outside the figure.
    at = (high[0], high[1], high[2] + 0.04 * span[2])
    axes.text(*at, style.with_unit(names[2], unit), ha="center", va="bottom", **text)


def fit(axes: Any, low: Floats, high: Floats, rectangle: style.Rectangle) -> None:
    """Place axes so that their box, with room for ticks and names, fills a rectangle.

    matplotlib leaves a third of the picture empty around a box.
    """
    size = style.inches(axes.figure)
    left, bottom, width, height = np.array(rectangle) * [*size, *size] + np.array([*ROOM[:2], -ROOM[0], -ROOM[1]])
    width, height = width - ROOM[2], height - ROOM[3]
    axes.set_position((0.0, 0.0, *(1.0 / size)))  # one inch each way
    axes.apply_aspect()
    flat = np.column_stack(proj3d.proj_transform(*_corners(low, high).T, axes.get_proj())[:2])
    inches = (axes.transData.transform(flat) - axes.figure.bbox.p0) / axes.figure.dpi
    first, last = inches.min(axis=0), inches.max(axis=0)
    scale = min(np.array([width, height]) / (last - first))
    start = np.array([left, bottom]) + 0.5 * (np.array([width, height]) - scale * (first + last))
    axes.set_position((*(start / size), *(scale / size)))


def height(low: Floats, high: Floats, width: float) -> float:
    """Return the height in inches that a box and its names need at a width, for `fit`."""
    across, up = np.ptp(VIEW.seen(_corners(low, high)), axis=0)
    return float((width - ROOM[0] - ROOM[2]) * up / across + ROOM[1] + ROOM[3])


def _corners(low: Floats, high: Floats) -> Floats:
    return np.array(list(product(*zip(low, high, strict=True))))
