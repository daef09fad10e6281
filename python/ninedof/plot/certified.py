"""A certified workspace: plane sections of what is proved, with the boundary of an estimate on top."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from contourpy import contour_generator
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.plot.arguments import numbers, section, things
from ninedof.plot.section import home_mark
from ninedof.support.arguments import text
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.workspace import CertifiedSection, WorkspaceSlice

MOST = 3
ALLOWED, OPEN = "#A9CCE3", "#E8871E"
EDGE = "#7FB0D1"


@dataclass(frozen=True, eq=False)
class CertifiedPanel:
    """One section, as `CertifiedWorkspace.section` returns it, and what is drawn over it."""

    section: CertifiedSection
    estimate: WorkspaceSlice | None = None
    """The same plane of a map: its boundary is drawn."""
    region: ArrayLike | None = None
    """Outline of the region of a study, points (n, 2)."""
    home: ArrayLike | None = None
    """The home pose, in the two coordinates drawn."""

    def __post_init__(self) -> None:
        """Check the fields."""
        section("section", self.section, "CertifiedSection", "inner")
        if self.estimate is not None:
            section("estimate", self.estimate, "WorkspaceSlice", "fraction")
        if self.region is not None:
            numbers("region", self.region, None, 2)
        if self.home is not None:
            numbers("home", self.home, 2)


def certified_workspace(panels: Sequence[CertifiedPanel], unit: str = "") -> Figure:
    """Return a figure of a certified workspace: where poses are proved to be allowed, and where nothing is proved.

    The rest is proved to be outside. Each pixel is judged at its middle: what is thinner may be missed. Edges
    of inner boxes are drawn where they are not too many.

    Parameters
    ----------
    panels : sequence of CertifiedPanel
        One to three.
    unit : str
        Of the coordinates, for the labels.

    Raises
    ------
    ValueError
        If there are no panels or too many.

    """
    things("panels", panels, CertifiedPanel, MOST)
    text("unit", unit)
    with style.settings():
        engine = ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06)
        figure = style.new_figure(style.TWO_COLUMNS, 3.6 if len(panels) < MOST else 2.9, layout=engine)
        for axes, panel in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            _draw(axes, panel, unit)
        entries = [
            style.key(ALLOWED, ls="", marker="s", ms=6, label="proved to be allowed"),
            style.key(OPEN, ls="", marker="s", ms=6, label="not decided"),
            style.key(style.INK, lw=0.0, marker="s", ms=6, mfc="white", mew=0.6, label="proved not to be allowed"),
        ]
        if any(panel.estimate is not None for panel in panels):
            entries.append(style.key(style.INK, lw=0.9, label="boundary of the estimate"))
        if any(panel.region is not None for panel in panels):
            entries.append(style.key(style.REGION, lw=1.4, label="region of the study"))
        if any(panel.home is not None for panel in panels):
            mark = {name: value for name, value in home_mark().items() if name != "color"}
            entries.append(style.key(label="home", colour=style.INK, **mark))
        figure.legend(handles=entries, loc="outside upper left", ncols=3)
    return figure


def _draw(axes: Any, panel: CertifiedPanel, unit: str) -> None:
    s = panel.section
    dx, dy = (0.5 * float(a[1] - a[0]) for a in (s.horizontal, s.vertical))
    extent = (s.horizontal[0] - dx, s.horizontal[-1] + dx, s.vertical[0] - dy, s.vertical[-1] + dy)
    colours = ListedColormap(["white", OPEN, ALLOWED])
    axes.imshow(s.state, cmap=colours, vmin=-1, vmax=1, origin="lower", extent=extent, interpolation="nearest")
    a0, b0, a1, b1 = s.inner.T
    corners = [np.column_stack(pair) for pair in ((a0, b0), (a1, b0), (a1, b1), (a0, b1), (a0, b0))]
    axes.add_collection(LineCollection(list(np.stack(corners, axis=1)), colors=EDGE, linewidths=0.25))
    ends = np.argwhere(s.state == 1 if (s.state == 1).any() else s.state >= 0)
    if panel.estimate is not None:
        e = panel.estimate
        for line in contour_generator(e.horizontal, e.vertical, e.fraction).lines(0.5):
            axes.plot(*np.asarray(line).T, color=style.INK, lw=0.9, zorder=5)
    if panel.region is not None:
        axes.plot(*np.asarray(panel.region, dtype=np.float64).T, color="white", lw=2.4, zorder=6)
        axes.plot(*np.asarray(panel.region, dtype=np.float64).T, color=style.REGION, lw=1.4, zorder=6)
    if panel.home is not None:
        axes.plot(*np.asarray(panel.home, dtype=np.float64), **home_mark())
    if len(ends):
        low, high = ends.min(axis=0), ends.max(axis=0)
        x, y = s.horizontal[[low[1], high[1]]], s.vertical[[low[0], high[0]]]
        room = 0.06 * float(max(np.ptp(x), np.ptp(y))) + max(dx, dy)
        # Not past the section: of what lies there it says nothing, and white is proved to be outside.
        x0, x1, y0, y1 = extent
        axes.set(xlim=(max(x[0] - room, x0), min(x[1] + room, x1)), ylim=(max(y[0] - room, y0), min(y[1] + room, y1)))
    axes.grid(visible=False)
    axes.set(xlabel=style.with_unit(s.axes[0], unit), ylabel=style.with_unit(s.axes[1], unit), aspect="equal")
    axes.set_title(f"{s.plane[0]} = {amount(style.signed(float(s.plane[1])), unit)}")
