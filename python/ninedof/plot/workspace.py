"""A workspace: sections, what ends it, the condition number in it; what is certified."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from contourpy import contour_generator
from matplotlib.collections import PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.patches import Circle, Rectangle
from matplotlib.path import Path
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.robot.geometry import LEGS
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.workspace import CertifiedSection, WorkspaceMap, WorkspaceSlice

MOST_SECTIONS = 3
MOST_SHARES = 9
LOWER = 1.93  # inches, the height of the lower row
USUAL, MORE = 95, 0.5  # the colours end at this percentile, or at the greatest value if it is so little above it
BOUNDARY = 2.2  # points
DASHED = (0, (3, 1.5))
REGION = (0, (8, 2))  # in grey print the boundary of the estimate beside it is as dark

Look = tuple[str, str, Any]
"""Words, colour, dashes."""
KINDS: dict[str, Look] = {  # limits, by a part of their names; others look like OTHER
    "l": (style.LEG_WORDS["l"], style.EXTERNAL, "-"),
    "q": (style.LEG_WORDS["q"], style.UPPER, (0, (2.4, 0.8))),
    "r": (style.LEG_WORDS["r"], style.LOWER, (0, (0.9, 0.7))),
    "base_cone": ("joint cones of the base", "#AA3377", (0, (3.5, 0.7, 0.8, 0.7))),
    "platform_cone": ("joint cones of the platform", "#CC79A7", (0, (3.5, 0.7, 0.8, 0.7, 0.8, 0.7))),
    "leg_clearance": ("leg clearance", "#7B4B00", (0, (5.0, 1.0))),
    "fault_tolerant": ("condition number, one leg locked", "#117733", (0, (1.6, 0.9))),
    "force": ("leg force", "#332288", (0, (4.0, 0.8, 1.0, 0.8))),
    "rate": ("leg rate", "#661100", (0, (2.0, 0.8, 1.0, 0.8))),
    "power": ("leg power", "#DDAA33", (0, (4.0, 0.8, 2.0, 0.8))),
    "condition_number": ("condition number", style.INK, (0, (7.0, 0.8, 0.9, 0.8))),
    "det": ("singularity", "#CC3311", (0, (1.5, 0.6))),
    "region": ("region", "#000000", (0, (2.0, 1.6))),  # grey is a colour of the condition number
    "box": ("box of the map", "#000000", (0, (2.0, 1.6))),
    "internal_point": ("no admissible O", "#999933", (0, (4.0, 1.5))),
}
OTHER = "#44AA99", (0, (1.2, 0.7, 3.0, 0.7))
ALLOWED, OPEN, EDGE = "#A9CCE3", "#E8871E", "#7FB0D1"  # proved, not decided, edges of proved boxes


@dataclass(frozen=True, eq=False)
class Section:
    """A plane section of a workspace and what is marked in it, in the two coordinates drawn."""

    plane: Any
    """As `WorkspaceMap.slice` returns it (smooth for contours), or `CertifiedWorkspace.section`."""
    ball: tuple[ArrayLike, float] | None = None
    """Centre and radius of the section of the ball."""
    box: tuple[ArrayLike, ArrayLike] | None = None
    """Low and high corner."""
    region: ArrayLike | None = None
    """Outline of the region of a study, points (n, 2)."""
    home: ArrayLike | None = None
    """The home pose."""
    estimate: WorkspaceSlice | None = None
    """The same plane of a map, to draw its boundary over what is certified."""


def workspace(space: WorkspaceMap, sections: Sequence[Section], figure: Figure | None = None) -> Figure:
    """Return a figure of a workspace: sections above, what ends it and the spread of the condition number below.

    Colours are bands between contours at round values, the same in all sections. Where the condition number goes on
    beyond the last, the colour bar has an arrow and names the largest. Angles are drawn in degrees.

    Parameters
    ----------
    space : WorkspaceMap
    sections : sequence of Section
        One to three, of its slices.
    figure : matplotlib.figure.Figure, optional
        To draw in, with a constrained layout; a new one by default.

    Raises
    ------
    ValueError
        If there are no sections or too many.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> space = nd.workspace(g, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (2.5, 6.5)})
    >>> figure = nd.plot.workspace(space, [nd.plot.Section(space.slice("z", 5.4, smooth=True))])

    """
    style.counted("sections", sections, MOST_SECTIONS)
    kinds = [kind_of(name) for name in space.limit_names]
    upper = 3.37 if len(sections) < MOST_SECTIONS else 2.75  # inches
    with style.page(figure, style.TWO_COLUMNS, upper + LOWER, layout=_layout()) as figure:
        parts: Any = figure.subfigures(2, 1, height_ratios=[upper, LOWER])
        above, below = parts
        bands, most = _bands(space.percentiles, sections)
        turn, unit = (np.degrees, "deg") if space.of_angles else (np.asarray, space.unit)
        filled: Any = None
        ends: set[str] = set()
        panels = above.subplots(1, len(sections), squeeze=False)[0]
        for axes, section in zip(panels, sections, strict=True):
            filled = _fill(axes, section.plane, turn, bands, most is not None) or filled
            ends |= _boundary(axes, section.plane, turn, kinds)
            _marks(axes, section, turn, unit, style.INK)
        if filled is not None:
            more = "" if most is None else f", {most:.4g} at most" if np.isfinite(most) else ", without a bound"
            style.colour_bar(
                above,
                filled,
                "condition number" + more,
                ax=list(panels),
                ticks=bands,
                fraction=0.03,
                pad=0.02,
                aspect=28,
                panchor=False,
            )
        looks = [look_of(kind) for kind in (*KINDS, *sorted(ends - KINDS.keys())) if kind in ends]
        keys = [style.key(colour, ls=dashes, lw=BOUNDARY, label=words) for words, colour, dashes in looks]
        _legend(figure, keys, sections, style.INK, 4)
        left, right = below.subplots(1, 2)
        _shares(left, space.limits())
        _distribution(right, space.percentiles)
    return figure


def certified_workspace(sections: Sequence[Section], unit: str = "", figure: Figure | None = None) -> Figure:
    """Return a figure of a certified workspace: where poses are proved to be allowed, and where nothing is proved.

    The rest is proved to be outside. Each pixel is judged at its middle: what is thinner may be missed. Edges
    of inner boxes are drawn where they are not too many.

    Parameters
    ----------
    sections : sequence of Section
        One to three, of `CertifiedWorkspace.section`.
    unit : str
        Of the coordinates, for the labels.
    figure : matplotlib.figure.Figure, optional
        To draw in, with a constrained layout; a new one by default.

    Raises
    ------
    ValueError
        If there are no sections or too many.

    """
    style.counted("sections", sections, MOST_SECTIONS)
    tall = 3.6 if len(sections) < MOST_SECTIONS else 2.9
    with style.page(figure, style.TWO_COLUMNS, tall, layout=_layout()) as figure:
        for axes, section in zip(figure.subplots(1, len(sections), squeeze=False)[0], sections, strict=True):
            _certified(axes, section.plane)
            if section.estimate is not None:
                for line in _outline(section.estimate, np.asarray):
                    axes.plot(*line.T, color=style.INK, lw=0.9, zorder=5)
            _marks(axes, section, np.asarray, unit, style.REGION)
        square = {"ls": "", "marker": "s", "ms": 6}
        keys = [
            style.key(ALLOWED, **square, label="proved to be allowed"),
            style.key(OPEN, **square, label="not decided"),
            style.key(style.INK, **square, mfc="white", mew=0.6, label="proved not to be allowed"),
        ]
        if any(section.estimate is not None for section in sections):
            keys.append(style.key(style.INK, lw=0.9, label="boundary of the estimate"))
        _legend(figure, keys, sections, style.REGION, 3)
    return figure


def kind_of(name: str) -> str:
    """Return the key of `KINDS` of a limit, its own name for one that is not there."""
    first = name.split(" ")[0]
    if first in LEGS:
        return first[:1]
    return next((kind for kind in KINDS if len(kind) > 1 and f"_{kind}_" in f"_{first}_"), first)


def look_of(kind: str) -> Look:
    """Return the look of a kind of limits."""
    return KINDS.get(kind, (kind.replace("_", " "), *OTHER))


def _layout() -> ConstrainedLayoutEngine:
    return ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06)


def _bands(percentiles: Floats, sections: Sequence[Section]) -> tuple[Floats, float | None]:
    """Return the round values between the bands of colour, and the largest value if it is beyond them."""
    values = percentiles
    if not np.isfinite(values).any():  # the raster goes on beyond the boundary
        values = np.concatenate([section.plane.condition_number.ravel() for section in sections])
    if not np.isfinite(values).any():
        return np.array([1.0, 2.0]), None
    low, high = style.finite_range(values)
    of_volume = percentiles[np.isfinite(percentiles)]
    usual = of_volume[: USUAL + 1].max() if of_volume.size > USUAL else high
    top = high if high <= usual + MORE * (usual - low) else min(usual, style.RANGE * low)
    bands = style.round_levels(low, top)
    most = np.inf if np.isposinf(values).any() else high
    return bands, most if most > bands[-1] else None


def _fill(axes: Any, s: WorkspaceSlice, turn: Any, levels: Floats, cut: bool) -> Any:
    """Fill between contours, within the workspace alone; return the bands, None without a finite condition number."""
    if not np.isfinite(s.condition_number).any():
        return None
    x, y = turn(s.horizontal), turn(s.vertical)
    kappa = np.where(s.condition_number > 0.0, s.condition_number, np.inf)  # NaN outside too
    kappa = np.where(s.fraction > 0.0, np.minimum(kappa, 4.0 * levels[-1]), np.nan)
    extend: Any = "max" if cut else "neither"
    if not cut:
        kappa = np.clip(kappa, levels[0], levels[-1] * (1.0 - 1e-12))
    norm = BoundaryNorm(levels, 256, extend=extend)
    bands = axes.contourf(x, y, kappa, cmap=style.CONDITION, norm=norm, levels=levels, extend=extend)
    lines = axes.contour(x, y, kappa, levels=levels, colors="white", linewidths=0.4, alpha=0.7)
    outer: Any = contour_generator(x, y, s.fraction, fill_type="OuterCode").filled(0.5, np.inf)
    points, codes = outer
    path = Path(np.concatenate(points), np.concatenate(codes)) if points else Path(np.zeros((1, 2)))
    for contours in (bands, lines):
        contours.set_clip_path(path, axes.transData)
    return bands


def _outline(s: WorkspaceSlice, turn: Any) -> list[Floats]:
    """Return the boundary of a section, closed lines of points (n, 2)."""
    return [np.asarray(line) for line in contour_generator(turn(s.horizontal), turn(s.vertical), s.fraction).lines(0.5)]


def _boundary(axes: Any, s: WorkspaceSlice, turn: Any, kinds: Sequence[str]) -> set[str]:
    """Draw the boundary in stretches of one kind of limit, show the plane about it, and return the kinds."""
    names, drawn = list(dict.fromkeys(kinds)), set[str]()
    numbers = np.array([names.index(kind) for kind in kinds] + [-1])
    lines = _outline(s, turn)
    for line in lines:
        column, row = (
            np.clip(np.round((values - axis[0]) / (axis[1] - axis[0])).astype(int), 0, len(axis) - 1)
            for values, axis in zip(line.T, (turn(s.horizontal), turn(s.vertical)), strict=True)
        )
        number = numbers[s.limit[row, column]]
        for first, last in style.stretches(number):
            _, colour, dashes = look_of(names[number[first]]) if number[first] >= 0 else ("", style.MUTED, "-")
            drawn |= {names[number[first]]} if number[first] >= 0 else set()
            part = line[first : last + 1].T
            axes.plot(*part, color="white", lw=BOUNDARY, solid_capstyle="butt", zorder=4)
            axes.plot(*part, color=colour, ls=dashes, lw=BOUNDARY, dash_capstyle="butt", zorder=5)
    if lines:
        every = np.concatenate(lines)
        room = 0.06 * np.ptp(every, axis=0).max()
        low, high = every.min(axis=0) - room, every.max(axis=0) + room
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    return drawn


def _certified(axes: Any, s: CertifiedSection) -> None:
    """Draw what is proved, and show the part of the plane about it."""
    dx, dy = (0.5 * (a[1] - a[0]) for a in (s.horizontal, s.vertical))
    x0, x1, y0, y1 = s.horizontal[0] - dx, s.horizontal[-1] + dx, s.vertical[0] - dy, s.vertical[-1] + dy
    axes.imshow(
        s.state,
        cmap=ListedColormap(["white", OPEN, ALLOWED]),
        vmin=-1,
        vmax=1,
        origin="lower",
        extent=(x0, x1, y0, y1),
        interpolation="nearest",
    )
    boxes = style.corners(s.inner[:, :2], s.inner[:, 2:])
    axes.add_collection(PolyCollection(list(boxes), facecolors="none", edgecolors=EDGE, linewidths=0.25))
    ends = np.argwhere(s.state == 1 if (s.state == 1).any() else s.state >= 0)
    if len(ends):
        low, high = ends.min(axis=0), ends.max(axis=0)
        x, y = s.horizontal[[low[1], high[1]]], s.vertical[[low[0], high[0]]]
        room = 0.06 * max(np.ptp(x), np.ptp(y)) + max(dx, dy)
        # Not past the section: of what lies there it says nothing, and white is proved to be outside.
        axes.set(xlim=(max(x[0] - room, x0), min(x[1] + room, x1)), ylim=(max(y[0] - room, y0), min(y[1] + room, y1)))


def _marks(axes: Any, section: Section, turn: Any, unit: str, region: str) -> None:
    """Draw ball, box, region and home over a section, and name its axes and its plane."""
    for ink, width, dashes in (("white", 2.0, "-"), (style.INK, 0.9, DASHED)):
        line: dict[str, Any] = {"fill": False, "lw": width, "ec": ink}
        if section.ball is not None:
            axes.add_patch(Circle(turn(section.ball[0]), turn(section.ball[1]), **line))
        if section.box is not None:
            low, high = turn(section.box)
            axes.add_patch(Rectangle(low, *(high - low), **line, ls=dashes))
    if section.region is not None:
        axes.plot(*turn(section.region).T, color=region, lw=1.3, ls=REGION, path_effects=[style.rim(2.4)], zorder=6)
    if section.home is not None:
        axes.plot(*turn(section.home), **style.HOME)
    s = section.plane
    axes.grid(visible=False)
    axes.set(xlabel=style.with_unit(s.axes[0], unit), ylabel=style.with_unit(s.axes[1], unit))
    axes.set_aspect("equal", anchor="N")  # titles at one height
    axes.set_title(f"{s.plane[0]} = {amount(style.signed(turn(s.plane[1])), unit)}")


def _legend(figure: Any, keys: list[Any], sections: Sequence[Section], region: str, columns: int) -> None:
    ring = {"lw": 0.9, "marker": "o", "ms": 7, "mfc": "none", "ls": ""}
    marks = {
        "region": style.key(region, lw=1.3, ls=REGION, label="region of the study"),
        "ball": style.key(style.INK, **ring, label="largest ball"),
        "box": style.key(style.INK, lw=0.9, ls=DASHED, label="largest box"),
        "home": style.key(**style.HOME, label="home"),
    }
    keys = keys + [key for name, key in marks.items() if any(getattr(one, name) is not None for one in sections)]
    if keys:
        figure.legend(handles=keys, loc="outside upper left", ncols=min(columns, len(keys)), handlelength=3.0)


def _shares(axes: Any, shares: Mapping[str, float]) -> None:
    top = list(shares.items())[:MOST_SHARES]
    axes.set_title("what ends the workspace")
    if not top:
        axes.set_axis_off()
        return
    colours = [look_of(kind_of(name))[1] for name, _ in top]
    axes.barh(range(len(top)), [100.0 * share for _, share in top], color=colours, height=0.7)
    axes.set_yticks(range(len(top)), [_limit_words(name) for name, _ in top])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("% of the boundary")


def _limit_words(name: str) -> str:
    """Return a limit in words: "l1 at its longest" for "l1 high"."""
    leg, _, side = name.partition(" ")
    words = {"low": "at its shortest", "high": "at its longest"}.get(side) if leg in LEGS else None
    return f"{leg} {words}" if words else name.replace("_", " ")


def _distribution(axes: Any, percentiles: Floats) -> None:
    axes.set_title("condition number within it")
    finite = percentiles[np.isfinite(percentiles)]
    if not finite.size:
        axes.set_axis_off()
        return
    axes.plot(percentiles, np.arange(percentiles.size), color=style.SERIES[0])
    axes.set(xlabel="condition number", ylabel="% of the volume below", ylim=(0, 100))
    if finite.max() > 10.0 * finite.min():
        axes.set_xscale("log")
        style.one_two_five(axes.xaxis)
