"""One plane section of a workspace: contours of the condition number, the boundary in the style of its limits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from contourpy import contour_generator
from matplotlib.colors import BoundaryNorm
from matplotlib.patches import Circle, Rectangle
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.plot.arguments import number, numbers, section
from ninedof.support.arguments import pair, shown
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.workspace import WorkspaceSlice

BOUNDARY = 2.2  # points

KINDS: dict[str, tuple[str, str, Any]] = {  # limits: beginning of the name, words, colour, dashes
    "l": ("external legs", style.EXTERNAL, "-"),
    "q": ("upper internal legs", style.UPPER, (0, (2.4, 0.8))),
    "r": ("lower internal legs", style.LOWER, (0, (0.9, 0.7))),
    "base_cone": ("joint cones of the base", "#AA3377", (0, (3.5, 0.7, 0.8, 0.7))),
    "platform_cone": ("joint cones of the platform", "#CC79A7", (0, (3.5, 0.7, 0.8, 0.7, 0.8, 0.7))),
    "leg_clearance": ("leg clearance", "#7B4B00", (0, (5.0, 1.0))),
    "condition_number": ("condition number", style.INK, "-"),
    "det": ("singularity", "#CC3311", (0, (1.5, 0.6))),
    "region": ("region", style.MUTED, (0, (2.0, 1.6))),
    "box": ("box of the map", style.MUTED, (0, (2.0, 1.6))),
    "internal_point": ("no admissible O", "#999933", (0, (4.0, 1.5))),
}


@dataclass(frozen=True, eq=False)
class Section:
    """One section, as `WorkspaceMap.slice` returns it (smooth for contours), and what is marked in it."""

    plane: WorkspaceSlice
    ball: tuple[ArrayLike, float] | None = None
    """Centre and radius of the section of the ball, in the two coordinates drawn."""
    box: tuple[ArrayLike, ArrayLike] | None = None
    """Low and high corner in the two coordinates drawn."""
    region: ArrayLike | None = None
    """Outline of the region of a study, points (n, 2)."""
    home: ArrayLike | None = None
    """The home pose, in the two coordinates drawn."""

    def __post_init__(self) -> None:
        """Check the fields."""
        section("plane", self.plane, "WorkspaceSlice", "limit", "condition_number", "fraction")
        if self.ball is not None:
            centre, radius = pair("ball", self.ball, "centre and radius")
            numbers("ball", centre, 2)
            number("ball", radius, positive=True)
        if self.box is not None:
            for corner in pair("box", self.box, "low and high corner"):
                numbers("box", corner, 2)
        if self.region is not None:
            numbers("region", self.region, None, 2)
        if self.home is not None:
            numbers("home", self.home, 2)


def kind_of(name: str, where: str = "limit_names") -> str:
    """Return the key of `KINDS` of a limit."""
    first = name.split(" ")[0]
    kind = first if first in KINDS else first[:1]
    if kind not in KINDS:
        raise ValueError(f"{where}: got {shown(name)}, expected names of limits as in WorkspaceMap.limit_names")
    return kind


def draw_section(axes: Any, section: Section, kinds: Sequence[str], levels: Floats, cut: bool, unit: str) -> Any:
    """Draw a section on axes of equal scale; return the filled contours, None without a finite condition number."""
    s, turn = section.plane, (np.degrees if unit == "rad" else np.asarray)
    unit = "deg" if unit == "rad" else unit
    x, y, at = turn(s.horizontal), turn(s.vertical), float(turn(s.plane[1]))
    shown = _fill(axes, x, y, s, levels, cut) if np.isfinite(s.condition_number).any() else None
    lines = contour_generator(x, y, s.fraction).lines(0.5)
    for line in lines:
        _boundary(axes, np.asarray(line), x, y, s.limit, kinds)
    white: dict[str, Any] = {"fill": False, "lw": 1.0}
    for ink, width in (("white", 2.0), (style.INK, 0.9)):
        white |= {"ec": ink, "lw": width}
        if section.ball is not None:
            axes.add_patch(Circle(tuple(turn(section.ball[0])), float(turn(section.ball[1])), **white))
        if section.box is not None:
            low, high = (np.asarray(turn(corner), dtype=np.float64) for corner in section.box)
            axes.add_patch(Rectangle(tuple(low), *(high - low), **white, ls="-" if ink == "white" else (0, (3, 1.5))))
    if section.region is not None:
        axes.plot(*turn(np.asarray(section.region, dtype=np.float64)).T, color="white", lw=2.4)
        axes.plot(*turn(np.asarray(section.region, dtype=np.float64)).T, color=style.INK, lw=1.2)
    if section.home is not None:
        axes.plot(*turn(np.asarray(section.home, dtype=np.float64)), **home_mark())
    axes.grid(visible=False)
    axes.set(xlabel=style.with_unit(s.axes[0], unit), ylabel=style.with_unit(s.axes[1], unit), aspect="equal")
    axes.set_title(f"{s.plane[0]} = {amount(style.signed(at), unit)}")
    if lines:
        ends = np.concatenate([np.asarray(line) for line in lines])
        low, high = ends.min(axis=0), ends.max(axis=0)
        room = 0.06 * float((high - low).max())
        axes.set(xlim=(low[0] - room, high[0] + room), ylim=(low[1] - room, high[1] + room))
    return shown


def home_mark() -> dict[str, Any]:
    """Return the marker of the home pose."""
    return {"marker": "P", "ms": 6.5, "color": style.INK, "mec": "white", "mew": 0.9, "ls": "", "zorder": 8}


def _fill(axes: Any, x: Floats, y: Floats, s: WorkspaceSlice, levels: Floats, cut: bool) -> Any:
    """Fill between contours, within the workspace alone."""
    kappa = np.where(s.condition_number > 0.0, s.condition_number, np.inf)  # NaN outside too
    inside = s.fraction > 0.0
    kappa = np.where(inside, np.minimum(kappa, 4.0 * levels[-1]), np.nan)
    options: dict[str, Any] = {"levels": levels, "extend": "max" if cut else "neither"}
    norm = BoundaryNorm(levels, 256, extend=options["extend"])
    if not cut:
        kappa = np.clip(kappa, levels[0], levels[-1] * (1.0 - 1e-12))
    bands = axes.contourf(x, y, kappa, cmap=style.CONDITION, norm=norm, **options)
    lines = axes.contour(x, y, kappa, levels=levels, colors="white", linewidths=0.4, alpha=0.7)
    path = _outline_path(x, y, s.fraction)
    for drawn in (bands, lines):
        drawn.set_clip_path(path, axes.transData)
    return bands


def _outline_path(x: Floats, y: Floats, fraction: Floats) -> Any:
    from matplotlib.path import Path

    filled = contour_generator(x, y, fraction, fill_type="OuterCode").filled(0.5, np.inf)
    points = [np.asarray(p) for p in filled[0]]
    if not points:
        return Path(np.zeros((1, 2)))
    return Path(np.concatenate(points), np.concatenate([np.asarray(c) for c in filled[1]]))


def _boundary(axes: Any, line: Floats, x: Floats, y: Floats, limit: Any, kinds: Sequence[str]) -> None:
    """Draw one closed contour in stretches of one kind of limit."""
    column = np.clip(np.round((line[:, 0] - x[0]) / (x[1] - x[0])).astype(int), 0, len(x) - 1)
    row = np.clip(np.round((line[:, 1] - y[0]) / (y[1] - y[0])).astype(int), 0, len(y) - 1)
    names = list(KINDS)
    number = np.array([names.index(kind) for kind in kinds] + [-1])[limit[row, column]]
    ends = [0, *(np.flatnonzero(number[1:] != number[:-1]) + 1).tolist(), len(line) - 1]
    for first, last in pairwise(ends):
        _, colour, dashes = KINDS[names[number[first]]] if number[first] >= 0 else ("", style.MUTED, "-")
        part = line[first : last + 1].T
        axes.plot(*part, color="white", lw=BOUNDARY, solid_capstyle="butt", zorder=4)
        axes.plot(*part, color=colour, ls=dashes, lw=BOUNDARY, dash_capstyle="butt", zorder=5)
