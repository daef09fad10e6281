"""An atlas of designs: the best for each size of the base, and the distribution of all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from ninedof.plot import style

if TYPE_CHECKING:
    from ninedof.sweep import SweepResult

MAP = "cividis"
SHARE = 1e-3  # of all designs: sizes of the base with fewer designs are left out at both ends
TOP = 300.0  # condition numbers shown


def atlas(result: SweepResult, optimum: tuple[float, float] | None = None, figure: Figure | None = None) -> Figure:
    """Return a figure of an atlas: designs over radius ratio and condition number, and the best of each bin.

    Parameters
    ----------
    result : SweepResult
        The result of `ninedof.atlas`.
    optimum : tuple of float, optional
        Radius ratio and condition number of a known optimum, which is marked. Without it none is.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> from ninedof import plot
    >>> figure = plot.atlas(nd.atlas(10**6), optimum=(2.0, 3.762659))  # doctest: +SKIP

    """
    ratio, kappa = result["radius_ratio"], result["condition_number"]
    counts = result["histogram"]
    total = int(counts.sum())
    inner = counts[1:-1, :-1]  # without the open bins
    used = np.flatnonzero(counts[1:-1].sum(axis=1) >= SHARE * total / len(ratio))
    first, last = (int(used[0]), int(used[-1]) + 1) if used.size else (0, len(inner))
    x = ratio[1:][first : last + 1]
    with style.page(figure, style.TWO_COLUMNS, 3.3) as figure:
        left = figure.add_axes((0.075, 0.14, 0.49, 0.77))
        right = figure.add_axes((0.735, 0.14, 0.25, 0.77))
        shown = np.ma.masked_equal(inner[first:last], 0)
        if shown.count():
            norm = LogNorm(max(1, int(shown.min())), max(2, int(shown.max())))
            mesh = left.pcolormesh(x, kappa, shown.T, norm=norm, cmap=MAP, rasterized=True)
            bar = figure.colorbar(mesh, cax=figure.add_axes((0.58, 0.14, 0.012, 0.77)), format=style.power_of_ten)
            bar.set_label("designs in a bin")
            bar.outline.set_linewidth(0.5)
        best = result["best"][1:-1][first:last]
        middle = np.sqrt(x[1:] * x[:-1])
        left.plot(middle, best, color=style.ALARM, lw=1.2, label="best in each bin")
        left.set(xscale="log", yscale="log", xlim=(x[0], x[-1]), ylim=(max(1.0, 0.8 * np.nanmin(best)), TOP))
        left.set(xlabel="radius ratio, base / platform", ylabel="condition number", title=f"{total:,} designs")
        style.plain_numbers(left.xaxis, [2.0**k for k in range(-4, 5)])
        style.plain_numbers(left.yaxis, [1, 2, 3, 5, 10, 20, 50, 100, 200, 500])
        left.grid(False)
        if optimum is not None:
            left.plot(
                *optimum, "*", ms=9, color=style.ALARM, mec="white", mew=0.7, zorder=6, label="optimum up to ratio 2"
            )
        left.legend(loc="upper right", frameon=True, framealpha=0.9, edgecolor="none")
        share = counts.sum(axis=0) / total * 100.0
        right.stairs(share[:-1], kappa, color=style.SERIES[0], fill=True, alpha=0.75)
        right.set(xscale="log", xlim=(kappa[0], kappa[-1]), title="all sizes of the base")
        right.set(xlabel="condition number", ylabel="% of designs")
        right.xaxis.set_major_formatter(style.power_of_ten)
        note = right.text(0.97, 0.96, f"{share[-1]:.2g} % above", size=style.SMALL_SIZE, transform=right.transAxes)
        note.set(ha="right", va="top")
    return figure
