"""Figures 6 and 7 of the paper: the condition number against displacements, and against the ratio of sides."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from ninedof.plot import style
from ninedof.plot.arguments import swept
from ninedof.support.arguments import text
from ninedof.support.arrays import Floats

if TYPE_CHECKING:
    from ninedof.sweep import SweepResult

TURNS = (-50.0, -25.0, 0.0, 25.0, 50.0)  # degrees: ticks of Fig. 6, which goes to one radian


def figure_6(result: SweepResult, unit: str = "l_c") -> Figure:
    """Return a figure of the condition number against displacements of p, rotations, and displacements of O.

    Parameters
    ----------
    result : SweepResult
        The result of `ninedof.sweep_figure("6")`.
    unit : str
        Of lengths.

    Examples
    --------
    >>> import ninedof as nd
    >>> figure = nd.plot.figure_6(nd.sweep_figure("6", points=11))

    """
    swept(result, ("coordinate", "displacement", "condition_number"), 'ninedof.sweep_figure("6")')
    text("unit", unit)
    names, x, rows = (result[key] for key in ("coordinate", "displacement", "condition_number"))
    ends = [x[0], 0.5 * x[0], 0.0, 0.5 * x[-1], x[-1]]
    groups = (
        (0, x, ends, f"platform moved ({unit})"),
        (3, np.degrees(x), TURNS, "platform turned (deg)"),
        (6, x, ends, f"O moved ({unit})"),
    )
    with style.settings():
        figure = style.new_figure(style.TWO_COLUMNS, 2.7)
        panels = figure.subplots(1, 3, sharey=True)
        top = min(float(rows[np.isfinite(rows)].max()), 2.4 * float(rows.min()))
        for axes, (first, x, ticks, title) in zip(panels, groups, strict=True):
            for k, dashes in zip(range(first, first + 3), style.DASHES, strict=False):
                colour = style.SERIES[k - first]
                axes.plot(x, style.without_infinite(rows[k]), color=colour, ls=dashes, label=names[k])
            axes.set(xlabel=title, xlim=(x[0], x[-1]), ylim=(0.96 * float(rows.min()), top))
            if words := _cut_off(names[first : first + 3].tolist(), rows[first : first + 3], top):
                note = axes.text(0.98, 0.98, words, transform=axes.transAxes, size=style.SMALL_SIZE)
                note.set(ha="right", va="top", bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0})
            axes.set_xticks(ticks)
            axes.legend(loc="upper center", ncols=3, bbox_to_anchor=(0.5, 1.14), handlelength=2.2, columnspacing=1.0)
        panels[0].set_ylabel("condition number")
        figure.subplots_adjust(left=0.07, right=0.98, bottom=0.16, top=0.88, wspace=0.12)
    return figure


def _cut_off(names: Sequence[str], rows: Floats, top: float) -> str:
    """Return which curves go on above the figure, and how far."""
    highest = [(name, float(row[~np.isnan(row)].max(initial=0.0))) for name, row in zip(names, rows, strict=True)]
    return "\n".join(f"{name} is cut off: it reaches {most:.4g}" for name, most in highest if most > top)


def figure_7(result: SweepResult) -> Figure:
    """Return a figure of the least condition number against the two ratios of sides.

    Parameters
    ----------
    result : SweepResult
        The result of `ninedof.sweep_figure("7")`.

    Examples
    --------
    >>> import ninedof as nd
    >>> figure = nd.plot.figure_7(nd.sweep_figure("7", points=3))

    """
    swept(result, ("sides", "ratio", "condition_number"), 'ninedof.sweep_figure("7")')
    names, x, rows = (result[key] for key in ("sides", "ratio", "condition_number"))
    with style.settings():
        figure = style.new_figure(style.ONE_COLUMN, 2.5)
        axes = figure.add_axes((0.135, 0.155, 0.84, 0.8))
        axes.plot(x, rows[0], color=style.SERIES[0], label=names[0])
        axes.plot(x, rows[1], "o", color=style.SERIES[1], ms=3.5, mfc="white", mew=1.0, label=names[1])
        axes.set_xscale("log", base=2)
        ticks = [t for t in 2.0 ** np.arange(-10, 11) if x[0] <= t <= x[-1]]
        style.plain_numbers(axes.xaxis, ticks)
        axes.set(xlabel="ratio of the sides", ylabel="least condition number")
        axes.legend(loc="upper right")
    return figure
