"""A workspace: sections, its limits, and the convergence of the volume."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch, Rectangle
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.workspace import WorkspaceSlice

MOST_SECTIONS = 3
RANGE = 30.0  # times the least condition number: the colours end there

KINDS = {  # the limits by kind, in the order of the legend: beginning of the name, words, colour
    "l": ("external legs", style.EXTERNAL),
    "q": ("upper internal legs", style.UPPER),
    "r": ("lower internal legs", style.LOWER),
    "base_cone": ("joint cones of the base", "#AA3377"),
    "platform_cone": ("joint cones of the platform", "#CC79A7"),
    "leg_clearance": ("leg clearance", "#7B4B00"),
    "condition_number": ("condition number", style.INK),
    "det": ("singularity", "#CC3311"),
    "region": ("region", style.MUTED),
    "box": ("box", style.MUTED),
    "internal_point": ("no admissible O", "#999933"),
}


@dataclass(frozen=True, eq=False)
class Section:
    """One section, as `WorkspaceMap.slice` returns it, with the largest ball and box inside the workspace."""

    plane: WorkspaceSlice
    ball: tuple[ArrayLike, float] | None = None
    """Centre and radius of the section of the ball, in the two coordinates drawn."""
    box: tuple[ArrayLike, ArrayLike] | None = None
    """Low and high corner in the two coordinates drawn."""
    region: ArrayLike | None = None
    """Outline of the region of a study, points (n, 2)."""


def workspace(
    sections: Sequence[Section],
    limit_names: Sequence[str],
    shares: Mapping[str, float],
    percentiles: ArrayLike,
    levels: ArrayLike,
    unit: str = "",
) -> Figure:
    """Return a figure of a workspace: sections above, the limits, the condition number and the volume below.

    Parameters
    ----------
    sections : sequence of Section
        One to three.
    limit_names : sequence of str
        Names of the limits, indexed by the numbers in the sections.
    shares : mapping of str to float
        Share of the boundary by limit.
    percentiles : array_like, shape (101,)
        Of the condition number over the volume.
    levels : array_like, shape (n, 4)
        Cells, evaluations, volume and error after each level; none for a grid or a sample.
    unit : str
        Of the coordinates, for the labels. Those in "rad" are drawn in degrees.

    Raises
    ------
    ValueError
        If there are no sections or too many.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.plot.workspace import Section, workspace
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> found = nd.workspace(g, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (2.5, 6.5)})
    >>> section = Section(found.slice("z", 4.8))
    >>> figure = workspace([section], found.limit_names, found.limits(), found.percentiles, found.levels)

    """
    if not 0 < len(sections) <= MOST_SECTIONS:
        raise ValueError(f"sections: got {len(sections)}, expected 1 to {MOST_SECTIONS}")
    kinds = [_kind(name) for name in limit_names]
    with style.settings():
        figure = style.new_figure(width=0.9 + 3.6 * max(len(sections), 2), height=6.6)
        rows = figure.add_gridspec(
            2, 1, height_ratios=[1.55, 1.0], hspace=0.42, left=0.155, right=0.91, top=0.88, bottom=0.09
        )
        above = rows[0].subgridspec(1, len(sections), wspace=0.3)
        colours, cut = _colours(np.asarray(percentiles, dtype=np.float64), sections)
        shown: Any = None
        panels = []
        for n, section in enumerate(sections):
            axes = figure.add_subplot(above[n])
            shown = _section(axes, section, kinds, colours, unit) or shown
            panels.append(axes)
        if shown is not None:
            bar = figure.colorbar(shown, ax=panels, fraction=0.025, pad=0.02, extend="max" if cut else "neither")
            bar.set_label("condition number", size=style.SMALL_SIZE)
            bar.outline.set_visible(False)
        _legend(figure, sections, kinds)
        below = rows[1].subgridspec(1, 3, wspace=0.5)
        _shares(figure.add_subplot(below[0]), shares)
        _distribution(figure.add_subplot(below[1]), np.asarray(percentiles, dtype=np.float64))
        _levels(figure.add_subplot(below[2]), np.asarray(levels, dtype=np.float64).reshape(-1, 4))
    return figure


def _colours(percentiles: Floats, sections: Sequence[Section]) -> tuple[tuple[float, float], bool]:
    """Return the ends of the colours, the same in all sections, and whether there are values above them."""
    known = percentiles[np.isfinite(percentiles)]
    if not known.size:
        drawn = np.concatenate([section.plane.condition_number.ravel() for section in sections])
        known = drawn[np.isfinite(drawn)]
    if not known.size:
        return (1.0, 2.0), False
    low, high = float(known.min()), float(known.max())
    return (low, min(high, RANGE * low)), high > RANGE * low or bool(np.isposinf(percentiles).any())


def _kind(name: str) -> str:
    first = name.split(" ")[0]
    return first if first in KINDS else first[0]


def _section(axes: Any, section: Section, kinds: Sequence[str], colours: tuple[float, float], unit: str) -> Any:
    """Draw a section: the condition number inside, the boundary in the colour of its limit."""
    s, turn = section.plane, (np.degrees if unit == "rad" else np.asarray)
    unit = "deg" if unit == "rad" else unit
    name, at = s.plane
    s = s._replace(horizontal=turn(s.horizontal), vertical=turn(s.vertical), plane=(name, float(turn(at))))
    half = [0.5 * (c[1] - c[0]) for c in (s.horizontal, s.vertical)]
    extent = (
        s.horizontal[0] - half[0],
        s.horizontal[-1] + half[0],
        s.vertical[0] - half[1],
        s.vertical[-1] + half[1],
    )
    options: dict[str, Any] = {"origin": "lower", "extent": extent, "interpolation": "nearest"}
    shown = None
    if np.isfinite(s.condition_number).any():
        most = np.minimum(s.condition_number, 10.0 * colours[1])  # an infinite one would be left out
        shown = axes.imshow(most, cmap=style.CONDITION, vmin=colours[0], vmax=colours[1], **options)
    order = list(KINDS)
    number = np.array([order.index(kind) for kind in kinds] + [-1])[s.limit]
    boundary = np.ma.masked_where((s.state != 1) | (number < 0), number)
    axes.imshow(
        boundary, cmap=ListedColormap([c for _, c in KINDS.values()]), vmin=-0.5, vmax=len(order) - 0.5, **options
    )
    line: dict[str, Any] = {"fill": False, "lw": 1.3, "ec": "white"}
    if section.ball is not None:
        axes.add_patch(Circle(tuple(turn(section.ball[0])), float(turn(section.ball[1])), **line))
    if section.box is not None:
        low, high = (np.asarray(turn(corner), dtype=np.float64) for corner in section.box)
        axes.add_patch(Rectangle(tuple(low), *(high - low), **line, ls=(0, (4, 2))))
    if section.region is not None:
        axes.plot(*np.asarray(section.region, dtype=np.float64).T, color=style.INK, lw=1.6)
    axes.grid(visible=False)
    axes.set(xlabel=style.with_unit(s.axes[0], unit), ylabel=style.with_unit(s.axes[1], unit), aspect="equal")
    axes.set_title(f"{s.plane[0]} = {amount(f'{s.plane[1]:.4g}', unit)}")
    found = np.argwhere(s.state > 0)
    if len(found):
        # The allowed part with a margin.
        (v0, h0), (v1, h1) = found.min(axis=0), found.max(axis=0)
        room = 0.06 * max(s.horizontal[h1] - s.horizontal[h0], s.vertical[v1] - s.vertical[v0]) + half[0]
        axes.set_xlim(max(extent[0], s.horizontal[h0] - room), min(extent[1], s.horizontal[h1] + room))
        axes.set_ylim(max(extent[2], s.vertical[v0] - room), min(extent[3], s.vertical[v1] + room))
    return shown


def _legend(figure: Figure, sections: Sequence[Section], kinds: Sequence[str]) -> None:
    there = {kinds[n] for s in sections for n in np.unique(s.plane.limit[s.plane.state == 1]).tolist() if n >= 0}
    entries: list[Any] = [Patch(color=colour, label=words) for kind, (words, colour) in KINDS.items() if kind in there]
    if any(section.region is not None for section in sections):
        entries.append(Line2D([], [], color=style.INK, lw=1.6, label="region of the study"))
    if entries:
        figure.legend(
            handles=entries,
            loc="upper left",
            ncols=5,
            bbox_to_anchor=(0.02, 0.995),
            title="limits of the boundary",
            alignment="left",
        )


def _shares(axes: Any, shares: Mapping[str, float]) -> None:
    top = list(shares.items())[:9]
    axes.set_title("share of the boundary")
    if not top:
        axes.set_axis_off()
        return
    colours = [KINDS[_kind(name)][1] for name, _ in top]
    axes.barh(range(len(top)), [100.0 * share for _, share in top], color=colours, height=0.7)
    axes.set_yticks(range(len(top)), [name.replace("_", " ") for name, _ in top])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("per cent")


def _distribution(axes: Any, percentiles: Any) -> None:
    axes.set_title("condition number")
    if not np.isfinite(percentiles).any():
        axes.set_axis_off()
        return
    axes.plot(percentiles, np.arange(percentiles.size), color=style.SERIES[0], lw=1.6)
    axes.set(xlabel="at most", ylabel="per cent of the volume", ylim=(0, 100))


def _levels(axes: Any, levels: Any) -> None:
    axes.set_title("error of the volume")
    known = levels[levels[:, 3] > 0.0]
    if len(known) == 0:
        axes.set_axis_off()
        return
    axes.loglog(known[:, 1], known[:, 3] / levels[-1, 2], "o-", color=style.SERIES[0], ms=4, lw=1.4)
    axes.set_xlim(10.0 ** np.floor(np.log10(known[0, 1])), 10.0 ** np.ceil(np.log10(known[-1, 1])))
    axes.xaxis.set_major_formatter(style.power_of_ten)
    axes.yaxis.set_major_formatter(style.power_of_ten)
    axes.minorticks_off()
    axes.set(xlabel="poses evaluated", ylabel="share of the volume")
