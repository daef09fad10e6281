"""The region of a study as a map: the worst condition number and the least margin at each of its places."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ninedof.plot import style
from ninedof.support.arrays import Floats
from ninedof.support.margins import TOLERANCE, margin_words

if TYPE_CHECKING:
    from ninedof.optimize.region_map import RegionMap

Ends = tuple[float, float]
MARGIN = "viridis"
RULED = {"marker": "o", "ms": 5.0, "mfc": "none", "color": style.ALARM, "mew": 1.3, "ls": ""}
TALLEST = 3.2  # inches, of the panels


def region_map(region: RegionMap, figure: Figure | None = None) -> Figure:
    """Return a figure of a map of a region: the worst condition number, and beside it the least margin of the limits.

    Circles are the poses that ruled the study. Angles are drawn in degrees.

    Parameters
    ----------
    region : RegionMap
        As `ninedof.region_map` returns it.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in, with a constrained layout; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> wanted = nd.Region(box=(0.4, 0.4, 0.2), tilt=0.1)
    >>> study = nd.Study(variables={"a1": 0.0, "b2": 0.0}, objective={"region": wanted})
    >>> figure = nd.plot.region_map(nd.region_map(nd.optimize(study, starts=4)))

    """
    turn, unit = (np.degrees, "deg") if region.of_angles else (np.asarray, region.unit)
    x, y, outline = turn(region.horizontal), turn(region.vertical), turn(region.outline)
    width, height = np.ptp(outline, axis=0)
    panels = 1 if region.margin is None else 2
    wide = style.ONE_COLUMN + 0.6 if panels == 1 else style.TWO_COLUMNS
    tall = np.clip(1.05 + 0.15 * bool(region.over) + 0.34 * style.TWO_COLUMNS * height / width, 2.2, TALLEST + 1.0)
    with style.page(figure, wide, tall, layout="constrained") as figure:
        axes: Any = figure.subplots(1, panels, squeeze=False)[0]
        over = f"\nover all {region.over}" if region.over else ""
        kappa = region.condition_number
        _fill(axes[0], x, y, kappa, style.finite_range(kappa, (0.0, 1.0)), style.CONDITION, "condition number")
        axes[0].set_title(f"worst condition number{over}")
        if region.margin is not None:
            percent, ends = _percent(region.margin)
            spans = "{:.4g} to {:.4g}".format(*style.finite_range(percent, (0.0, 0.0)))
            _fill(axes[1], x, y, percent, ends, MARGIN, f"least margin (%), {spans}")
            axes[1].set_title(f"least margin of the limits at a pose{over}")
        for panel in axes:
            panel.grid(visible=False)
            panel.plot(*outline.T, color=style.REGION, lw=1.6, clip_on=False, zorder=5)
            panel.plot(*turn(region.ruled).T, **RULED, clip_on=False, zorder=6)
            panel.plot(*turn(region.home), **style.HOME)
            names = [style.with_unit(name, unit) for name in region.axes]
            panel.set(xlabel=names[0], ylabel=names[1], aspect="equal")
            panel.margins(0.04)
        keys = [
            style.key(style.REGION, lw=1.6, label=f"region of the study, worst {region.worst:.4f}"),
            style.key(**RULED, label="poses that ruled"),
            style.key(**style.HOME, label="neutral pose"),
        ]
        below: dict[str, Any] = {"title": _left_out(region), "title_fontsize": style.SMALL_SIZE} if panels == 2 else {}
        figure.legend(handles=keys, loc="outside lower center", ncols=3 if panels == 2 else 1, **below)
    return figure


def _fill(axes: Any, x: Floats, y: Floats, values: Floats, ends: Ends, colours: str, words: str) -> None:
    """Fill between contours at round values from one end to the other, and add their bar."""
    low, high = ends
    levels = style.round_levels(low, min(high, style.RANGE * low) if low > 0.0 else high)
    norm, extend = BoundaryNorm(levels, 256, extend="max"), "max" if high > levels[-1] else "neither"
    filled = axes.contourf(x, y, values, cmap=colours, norm=norm, levels=levels, extend=extend)
    axes.contour(x, y, values, levels=levels, colors="white", linewidths=0.4, alpha=0.7)
    style.colour_bar(axes.figure, filled, words, ax=axes, fraction=0.045, pad=0.02, ticks=MaxNLocator(6))


def _percent(margin: Floats) -> tuple[Floats, Ends]:
    """Return margins in per cent and the ends of their colours, at least one apart: less would look like structure."""
    percent = np.where(np.abs(margin) < TOLERANCE, 0.0, 100.0 * margin)
    low, high = style.finite_range(percent, (0.0, 1.0))
    if high - low < 1.0:
        low = math.floor(low)
        high = max(high, low + 1.0)
    return percent, (low, high)


def _left_out(region: RegionMap) -> str | None:
    words = [
        name.replace("_", " ") + ("" if math.isnan(margin) else f" ({margin_words(margin, 'ratio')} over the region)")
        for name, margin in region.compared.items()
    ]
    return f"least margin without limits that compare poses: {', '.join(words)}" if words else None
