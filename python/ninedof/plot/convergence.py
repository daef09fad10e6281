"""The convergence of an optimization: the smooth minimax form beside plain SQP, from the same starts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, LogLocator, NullLocator, PercentFormatter
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.support.arrays import Floats

FLOOR, CEILING = 1e-10, 1e4  # range of gaps: smaller ones are rounding, larger ones starts far from an optimum
TICKS = FixedLocator([1, 3, 10, 30, 100, 300, 1000, 3000])


def convergence(
    minimax: Sequence[ArrayLike],
    plain: Sequence[ArrayLike],
    best: float,
    tolerance: float = 1e-6,
    figure: Figure | None = None,
) -> Figure:
    """Return a figure of the distance to the best known condition number against evaluations.

    Top: one line per start and the median; runs that end outside the tolerance have another colour. Below: the share of
    starts within the tolerance. Every start is followed to its end, those that `optimize` would give up after a short
    run too: fewer arrive than of the starts it follows.

    Parameters
    ----------
    minimax, plain : sequence of array_like
        For each start the least condition number after each evaluation, infinite before the first allowed design, as
        `ninedof.Trace.best`.
    best : float
        The best known condition number.
    tolerance : float
        Largest distance of a run that has converged.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> study = nd.Study.paper()
    >>> starts = [dict(zip(study.variables, x)) for x in study.problem().starts(4, 0)]
    >>> runs = {form: [nd.trace(study, x, form).best for x in starts] for form in ("minimax", "plain")}
    >>> figure = nd.plot.convergence(runs["minimax"], runs["plain"], best=nd.optimize(study).condition_number)

    """
    methods = {"minimax SQP": minimax, "plain SQP": plain}
    for name, runs in methods.items():
        style.counted(name, runs, 10**6)
    longest = max(np.size(run) for runs in methods.values() for run in runs)
    near = style.power_of_ten(tolerance)
    with style.page(figure, style.TWO_COLUMNS, 4.6) as figure:
        share = figure.add_axes((0.095, 0.09, 0.885, 0.235))
        for k, (name, runs) in enumerate(methods.items()):
            colour = style.SERIES[1 - k]
            gaps = [np.maximum(np.subtract(run, best), FLOOR) for run in runs]
            extended = np.array([np.pad(gap, (0, longest - gap.size), "edge") for gap in gaps])
            axes = figure.add_axes((0.095 + 0.4575 * k, 0.465, 0.4275, 0.475))
            axes.set_title(f"{name}: {sum(gap[-1] <= tolerance for gap in gaps)} of {len(gaps)} starts arrive")
            _runs(axes, gaps, extended, colour, tolerance)
            _evaluations(axes, longest)
            if k == 0:
                axes.set_ylabel("condition number\nabove the best")
            axes.tick_params(labelleft=k == 0)
            _share(share, name, (extended <= tolerance).mean(axis=0), colour, style.DASHES[k])
        _evaluations(share, longest)
        share.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.0, ncols=2, handlelength=3.0)
        share.set(ylim=(0, 1.05), ylabel=f"starts within {near}")
        share.yaxis.set_major_locator(FixedLocator([0, 0.25, 0.5, 0.75, 1]))
        share.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0, symbol=" %"))
    return figure


def _evaluations(axes: Any, longest: int) -> None:
    axes.set(xscale="log", xlim=(1, 1.1 * longest), xlabel="evaluations")
    axes.xaxis.set_major_locator(TICKS)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter("{x:.0f}")


def _runs(axes: Any, gaps: list[Floats], extended: Floats, colour: str, tolerance: float) -> None:
    """Draw one line per start, the median of all (`extended` continues each run with its last value), the tolerance."""
    there = [_steps(gap) for gap in gaps if gap[-1] <= tolerance]
    stuck = [_steps(gap) for gap in gaps if gap[-1] > tolerance]
    # An average would fail while half the runs are infinite.
    median = np.quantile(extended, 0.5, axis=0, method="lower")
    axes.add_collection(LineCollection(there, colors=colour, linewidths=0.5, alpha=0.35, zorder=2))
    axes.add_collection(LineCollection(stuck, colors=style.ALARM, linewidths=0.8, alpha=0.85, zorder=3))
    axes.add_collection(LineCollection([_steps(median)], colors=style.INK, linewidths=1.6, zorder=4))
    end = {"marker": "o", "ms": 3.5, "mec": "white", "mew": 0.6}
    for line in stuck:
        axes.plot(*line[-1:].T, color=style.ALARM, ls="", zorder=5, **end)
    axes.axhline(tolerance, color=style.INK, lw=0.8, ls=(0, (5, 3)), zorder=1)
    axes.set(yscale="log", ylim=(FLOOR, CEILING))
    axes.yaxis.set_major_locator(LogLocator(numticks=8))
    axes.yaxis.set_major_formatter(style.power_of_ten)
    axes.yaxis.set_minor_locator(NullLocator())
    keys = [style.key(colour, lw=1.2, label="one start"), style.key(style.INK, lw=1.6, label="median")]
    if stuck:
        keys.append(style.key(style.ALARM, lw=1.2, label=f"stuck above {style.power_of_ten(tolerance)}", **end))
    axes.legend(handles=keys, loc="lower left", frameon=True, framealpha=0.85, edgecolor="none")


def _steps(gap: Floats) -> Floats:
    """Return the steps of one run, shape (n, 2), from its first finite value to its end or to FLOOR.

    Steps of less than 1/25 of a decade, about the line width, are merged.
    """
    alive = np.isfinite(gap)
    alive[1:] &= gap[:-1] > FLOOR
    x = np.flatnonzero(alive)
    if not len(x):
        return np.empty((0, 2))
    level = np.round(25 * np.log10(gap[x]))
    corner = np.flatnonzero(np.append(True, level[1:] != level[:-1]))
    x = np.union1d(x[corner], x[-1:])
    y = gap[x]
    return np.column_stack([np.repeat(x + 1.0, 2)[1:], np.repeat(y, 2)[:-1]])


def _share(axes: Any, name: str, there: Floats, colour: str, dashes: Any) -> None:
    half, end = there >= 0.5, there >= there[-1]
    words = f"half by {int(np.argmax(half)) + 1}, " if half[-1] else ""
    text = f"{name}: {words}{there[-1]:.1%} by {int(np.argmax(end)) + 1}".replace(".0%", "%").replace("%", " %")
    axes.step(np.arange(1, len(there) + 1), there, where="post", color=colour, ls=dashes, label=text)
