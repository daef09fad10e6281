"""The condition number around a design: along zs and along theta_z."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import ConnectionPatch, Patch, Rectangle
from numpy.typing import ArrayLike

from ninedof.plot import style

ALONE = ": kept at the mark alone"
THINNEST = 0.005  # of the axis: a narrower white strip at a mark is not seen
NEUTRAL: dict[str, Any] = {"color": style.MUTED, "lw": 0.9, "ls": (0, (4, 2))}


@dataclass(frozen=True, eq=False)
class DesignCurves:
    """Condition number, or the objective of a study, of one design along zs and theta_z.

    Lengths in one unit, angles in radians.
    """

    name: str
    zs: ArrayLike
    """Heights of O, shape (n,)."""
    along_zs: ArrayLike
    """Condition number there; infinite where singular."""
    theta_z: ArrayLike
    """Twists of the platform, shape (m,)."""
    along_theta_z: ArrayLike
    """Condition number there."""
    point: tuple[float, float, float]
    """The design's own zs, theta_z and condition number."""
    slope: float | None = None
    """d(condition number)/d(theta_z) at the point, per radian; the tangent is drawn if given."""
    level: float | None = None
    """A reference condition number; with `crossings`, a magnified view of the curve near it is drawn."""
    crossings: tuple[float, ...] = ()
    """The zs at which the condition number is `level`."""
    least: tuple[float, float] | None = None
    """The minimum between the crossings: zs and condition number."""
    index: str = "condition number"
    """Name of what the curves are, for the axes."""
    neutral: tuple[ArrayLike, ArrayLike] | None = None
    """Condition number at the neutral pose along both, where the curves are the worst over several poses."""
    violated: tuple[ArrayLike, ArrayLike] | None = None
    """Along both, whether a limit of the study is violated there. The ground ends at the last point where one is."""


def condition_curves(designs: Sequence[DesignCurves], unit: str = "", figure: Figure | None = None) -> Figure:
    """Return a figure of the condition number along zs and along theta_z.

    A magnified view shows the crossings of the first design that has a level and crossings: at full scale two crossings
    near the minimum look like one point.

    Parameters
    ----------
    designs : sequence of DesignCurves
        One to four, in this order of colours.
    unit : str
        Of the lengths.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> from ninedof import plot
    >>> design = plot.DesignCurves(
    ...     "mine", [2.0, 2.5, 3.0], [4.1, 3.9, 4.2], [-0.1, 0.0, 0.1], [4.0, 3.9, 3.8], point=(2.5, 0.0, 3.9)
    ... )
    >>> figure = plot.condition_curves([design], unit="m")

    """
    style.counted("designs", designs, len(style.SERIES))
    pairs = list(zip(style.SERIES, designs, strict=False))
    compared = next(((colour, d) for colour, d in pairs if d.level is not None and d.crossings), None)
    with style.page(figure, style.TWO_COLUMNS, 4.3 if compared else 3.1) as figure:
        tall = style.inches(figure)[1]
        foot, head = 0.8 / tall, 1.0 - 0.32 / tall  # room for the legend, for the titles
        bottom = foot + 0.29 if compared else foot
        left = figure.add_axes((0.085, bottom, 0.415, head - bottom))
        right = figure.add_axes((0.575, foot, 0.405, head - foot))
        for number, (colour, design) in enumerate(pairs):
            zs, theta, kappa = design.point
            _curve(left, design.zs, design.along_zs, (zs, kappa), colour, number)
            degrees = np.degrees(design.theta_z)
            _curve(right, degrees, design.along_theta_z, (np.degrees(theta), kappa), colour, number)
            if design.neutral is not None:
                for axes, x, y in zip((left, right), (design.zs, degrees), design.neutral, strict=True):
                    axes.plot(x, style.without_infinite(y), **NEUTRAL)
        left.set_title("along zs")
        left.set(xlabel=style.with_unit("zs, height of O", unit), ylabel=designs[0].index)
        right.set_title("along theta_z")
        right.set(xlabel="theta_z, twist of the platform (deg)", ylabel=designs[0].index)
        _crop(left, 1.35, [d.point[2] for d in designs])
        _crop(right, 1.2, [d.point[2] for d in designs])
        ground = [_passed(axes, d, k) for d in designs for k, axes in enumerate((left, right))]
        for design in designs:
            if design.slope is not None:
                _tangent(right, design, design.slope)
        if compared:
            box = figure.add_axes((0.085, foot, 0.415, 0.165), label="magnified")
            _magnify(left, box, *compared)
        keys: list[Any] = []
        for number, (colour, d) in enumerate(pairs):
            keys.append(
                style.key(
                    colour,
                    ls=style.DASHES[number],
                    marker=style.MARKS[number],
                    ms=5.5,
                    mec="white",
                    label=f"{d.name}: {d.point[2]:.4f}",
                )
            )
        keys += [style.key(**NEUTRAL, label="at the neutral pose")] * any(d.neutral is not None for d in designs)
        keys += [Patch(color=style.GRID, label="a limit is violated at one of these poses")] * any(ground)
        figure.legend(
            handles=keys, loc="lower center", bbox_to_anchor=(0.5, 0.0), ncols=2 if any(ground) else 4, handlelength=3.2
        )
    return figure


def _curve(axes: Any, x: ArrayLike, y: ArrayLike, own: tuple[float, float], colour: str, number: int) -> None:
    axes.plot(x, style.without_infinite(y), color=colour, ls=style.DASHES[number])
    axes.plot(*own, style.MARKS[number], color=colour, ms=5.5, mec="white", mew=0.9, zorder=5)


def _passed(axes: Any, design: DesignCurves, k: int) -> bool:
    """Draw a grey ground where a limit is violated along one of the two; return whether it is in the picture."""
    if design.violated is None:
        return False
    x = np.asarray((design.zs, np.degrees(design.theta_z))[k])
    violated, (low, high) = np.asarray(design.violated[k], dtype=bool), axes.get_xlim()
    axes.fill_between(x, 0, 1, where=violated, transform=axes.get_xaxis_transform(), color=style.GRID, lw=0, zorder=0)
    axes.set_xlim(low, high)
    own = (design.point[0], np.degrees(design.point[1]))[k]
    around = x[violated & (x >= own)].min(initial=np.inf) - x[violated & (x <= own)].max(initial=-np.inf)
    if 0.0 < around < THINNEST * (high - low):
        axes.set_title(f"{axes.get_title(loc='left').removesuffix(ALONE)}{ALONE}")
    return bool(violated[(x >= low) & (x <= high)].any())


def _crop(axes: Any, factor: float, own: Sequence[float]) -> None:
    """Show the curves up to `factor` times their least value, and the part of the x axis where one is below that."""
    x, y = np.hstack([np.array(line.get_data()) for line in axes.lines])
    if not np.isfinite(y).any():
        return
    low, high = style.finite_range(y)
    top = min(max(factor * low, 1.05 * max(own)), high) + 1e-6 * low
    inside = x[y <= top]
    axes.set_ylim(low - 0.23 * (top - low), top + 0.02 * (top - low))
    if np.ptp(inside) > 0:
        axes.set_xlim(inside.min() - 0.04 * np.ptp(inside), inside.max() + 0.04 * np.ptp(inside))


def _tangent(axes: Any, design: DesignCurves, slope: float) -> None:
    _, theta, kappa = design.point
    at, per_degree = np.degrees(theta), np.radians(slope)
    ends = at + 0.28 * np.ptp(axes.get_xlim()) * np.array([-1.0, 1.0])
    axes.plot(ends, kappa + per_degree * (ends - at), color=style.INK, lw=1.1, ls=(0, (5, 3)), zorder=4)
    text = f"dashed, {design.name}:\nslope {per_degree:+.4f} a degree,\nnot 0 as eq. (7) has it"
    side = 0.025 if slope < 0 else 0.975  # the side where the line is high
    note = axes.text(side, 0.025, text.replace("-", "\N{MINUS SIGN}"), size=style.SMALL_SIZE, transform=axes.transAxes)
    white = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
    note.set(ha="left" if slope < 0 else "right", va="bottom", linespacing=1.3, bbox=white)


def _magnify(axes: Any, box: Any, colour: str, design: DesignCurves) -> None:
    """Draw the curve near the level on separate axes, and mark the magnified part."""
    zs, kappa = np.asarray(design.zs), np.asarray(design.along_zs)
    level, first, last = design.level or 0.0, min(design.crossings), max(design.crossings)
    margin = 0.6 * max(last - first, 0.02 * abs(last))
    inside = kappa[(zs >= first - margin) & (zs <= last + margin)]
    depth = max(level - min(inside, default=level), 1e-4 * level)
    x, y = (first - margin, last + margin), (level - 1.7 * depth, level + 1.3 * depth)
    box.plot(zs, kappa, color=colour)
    box.axhline(level, color=style.INK, lw=0.9, ls=(0, (5, 3)))
    for crossing in design.crossings:
        box.plot([crossing], [level], "o", color=colour, ms=4.5, mec="white", mew=0.8, zorder=5)
    if design.least is not None:
        box.plot(*design.least, "D", color=colour, ms=3.6, mec="white", mew=0.6, zorder=5)
        words = "least {1:.4f} at {0:.4f}".format(*design.least)
        box.annotate(
            words,
            design.least,
            size=style.SMALL_SIZE,
            xytext=(0, -6),
            textcoords="offset points",
            ha="center",
            va="top",
        )
    box.set(xlim=x, ylim=y, xticks=design.crossings, yticks=[level])
    box.xaxis.set_major_formatter("{x:.4f}")
    box.yaxis.set_major_formatter("{x:.4f}")
    name = box.text(0.5, 0.93, f"{design.name}, magnified", size=style.SMALL_SIZE, transform=box.transAxes)
    name.set(ha="center", va="top")
    box.spines[["top", "right"]].set_visible(True)
    axes.add_patch(Rectangle((x[0], y[0]), x[1] - x[0], y[1] - y[0], fill=False, edgecolor=style.INK, lw=0.7, zorder=6))
    for label in axes.get_xticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 1})  # hides the connecting lines below it
    for side, corner in zip(x, (0.0, 1.0), strict=True):
        link = ConnectionPatch((side, y[0]), (corner, 1.0), axes.transData, box.transAxes, color=style.MUTED, lw=0.6)
        link.set_zorder(0)
        axes.add_artist(link)
