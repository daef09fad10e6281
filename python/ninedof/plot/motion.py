"""Leg lengths and condition number along a trajectory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from ninedof.plot import style
from ninedof.plot.arguments import numbers
from ninedof.support.arguments import instance, pair, text
from ninedof.support.arrays import Floats

KINDS = (("l", "external legs"), ("q", "upper internal legs"), ("r", "lower internal legs"))
MOST_DRAWN = 800  # stretches of a curve
MOST_MARGIN = 1.0  # drawn: beyond it a limit is far


def motion(
    time: ArrayLike,
    leg_lengths: ArrayLike,
    conditions: ArrayLike,
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    unit: str = "",
    margins: Mapping[str, ArrayLike] | None = None,
) -> Figure:
    """Return a figure of the leg lengths by kind over time, their limits, the condition number below, and margins.

    Parameters
    ----------
    time : array_like, shape (n,)
        In seconds where lengths have a unit, as in `ninedof.follow`; else in any unit.
    leg_lengths : array_like, shape (n, 9)
        In the order of `ninedof.leg_lengths`.
    conditions : array_like, shape (n,)
        Condition number; infinite where singular: the curve has a gap there.
    limits : (low, high), optional
        Least and greatest lengths, each of shape (9,); 0 and infinity are no limits. None by default.
    unit : str
        Of lengths.
    margins : mapping of str to array_like of shape (n,), optional
        Relative margins of further limits by name, negative where a limit is passed; drawn up to 100 %.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof import plot
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> found = nd.follow(g, nd.Trajectory.circle(home, radius=0.5), home)
    >>> figure = plot.motion(found.time, found.leg_lengths, found.condition_number)

    """
    t = numbers("time", time, None)
    lengths = numbers("leg_lengths", leg_lengths, len(t), 9)
    kappa = numbers("conditions", conditions, len(t), gaps=True, positive=True)
    low, high = np.zeros(9), np.full(9, np.inf)
    if limits is not None:
        both = pair("limits", limits, "least and greatest lengths, each of shape (9,)")
        low, high = numbers("limits", both[0], 9), numbers("limits", both[1], 9, gaps=True)
    text("unit", unit)
    given = {
        text("margins", name): numbers(f"margins.{name}", values, len(t))
        for name, values in instance("margins", margins or {}, Mapping).items()  # type: ignore[type-abstract]
    }
    shown = _drawn(kappa)
    time_words = "time (s)" if unit else "time (in the unit of the path)"
    with style.settings():
        rows = (1.0, 0.85, 0.85) if margins else (1.0, 0.85)
        figure = style.new_figure(style.TWO_COLUMNS, 2.15 * sum(rows))
        grid = figure.add_gridspec(len(rows), 3, height_ratios=rows)
        for k, (kind, title) in enumerate(KINDS):
            axes = figure.add_subplot(grid[0, k])
            these = slice(3 * k, 3 * k + 3)
            _legs(axes, t[shown], lengths[shown, these], kind)
            _limits(axes, low[these], high[these], lengths[:, these])
            axes.set_title(title, size=style.TEXT_SIZE)
            _along(axes, t)
            axes.set_xlabel(time_words)
            axes.set_ylabel(style.with_unit("length", unit))
        _condition(figure.add_subplot(grid[1, :]), t[shown], kappa[shown])
        figure.axes[3].set_xlabel(time_words)
        if margins:
            _margins(figure.add_subplot(grid[2, :]), t, given)
            figure.axes[4].set_xlabel(time_words)
        bottom, top = (0.1, 0.94) if not margins else (0.07, 0.96)
        figure.subplots_adjust(left=0.085, right=0.98, bottom=bottom, top=top, hspace=0.5, wspace=0.36)
        figure.align_ylabels([figure.axes[0], *figure.axes[3:]])
    return figure


def _along(axes: Any, t: Floats) -> None:
    if t[0] < t[-1]:
        axes.set_xlim(t[0], t[-1])


def _drawn(kappa: Floats) -> NDArray[np.intp]:
    """Return the samples to draw: the first of each stretch, its greatest value, and the last of all."""
    step = -(-len(kappa) // MOST_DRAWN)
    begins = np.arange(0, len(kappa), step)
    padded = np.full(step * len(begins), -np.inf)
    padded[: len(kappa)] = kappa
    return np.unique(np.concatenate([begins, begins + padded.reshape(-1, step).argmax(axis=1), [len(kappa) - 1]]))


def _legs(axes: Any, t: Floats, lengths: Floats, kind: str) -> None:
    for j, dashes in enumerate(style.DASHES[:3]):
        axes.plot(t, lengths[:, j], color=style.LEG_COLOURS[kind], ls=dashes, label=f"{kind}{j + 1}")
    least, most = float(np.nanmin(lengths)), float(np.nanmax(lengths))
    room = max(0.08 * (most - least), 0.01 * most) or 1.0
    axes.set_ylim(least - room, most + 3.0 * room)
    axes.legend(loc="upper center", ncols=3, handlelength=2.2, columnspacing=1.0)


def _limits(axes: Any, low: Floats, high: Floats, lengths: Floats) -> None:
    """Draw limits that the legs come near: all of them would squeeze the curves."""
    least, most = axes.get_ylim()
    reach = 0.5 * (most - least)
    for value in np.unique(np.concatenate([low[low > 0.0], high[np.isfinite(high)]])).tolist():
        if least - reach <= value <= most + reach:
            axes.axhline(value, color=style.INK, lw=1.0, ls=(0, (6, 3)), zorder=1)
            bottom, top = axes.get_ylim()
            axes.set_ylim(min(bottom, value - 0.1 * reach), max(top, value + 0.6 * reach))
    for bound, side in ((low, lengths < low), (high, lengths > high)):
        if side.any():  # the forbidden side, where a leg enters it
            bottom, top = axes.get_ylim()
            ends = (bottom, float(bound.max())) if bound is low else (float(bound.min()), top)
            axes.axhspan(*ends, color=style.ALARM, alpha=0.12, lw=0.0, zorder=0)
            axes.set_ylim(bottom, top)


def _condition(axes: Any, t: Floats, kappa: Floats) -> None:
    axes.plot(t, style.without_infinite(kappa), color=style.SERIES[0])
    axes.set(ylabel="condition number")
    _along(axes, t)
    finite = kappa[np.isfinite(kappa)]
    if finite.size and finite.max() > style.RANGE * finite.min():
        axes.set_yscale("log")
        axes.set_ylim(finite.min() * 0.8, style.RANGE * finite.min())
        style.one_two_five(axes.yaxis)
        most = "without a bound" if np.isinf(kappa).any() else f"{finite.max():.4g} at most"
        axes.set_title(f"cut off at {style.RANGE * finite.min():.3g}; {most}", size=style.TEXT_SIZE, weight="normal")
    elif finite.size:
        room = max(0.08 * float(np.ptp(finite)), 0.005 * float(finite.max()))
        axes.set_ylim(finite.min() - room, finite.max() + room)


def _margins(axes: Any, t: Floats, margins: Mapping[str, Floats]) -> None:
    for k, (name, values) in enumerate(margins.items()):
        shown = _drawn(-values)
        percent = 100.0 * np.minimum(values[shown], MOST_MARGIN)
        colour, dashes = (
            style.SERIES[k % len(style.SERIES)],
            style.DASHES[(k + k // len(style.SERIES)) % len(style.DASHES)],
        )
        axes.plot(t[shown], percent, color=colour, ls=dashes, label=name.replace("_", " "))
    axes.axhline(0.0, color=style.INK, lw=1.0, ls=(0, (6, 3)), zorder=1)
    low, high = axes.get_ylim()
    if low < 0.0 and min(float(values.min()) for values in margins.values()) < 0.0:
        axes.axhspan(low, 0.0, color=style.ALARM, alpha=0.12, lw=0.0, zorder=0)
    axes.set_ylim(low, high + 0.22 * (high - low))
    _along(axes, t)
    words = f"least margin of each limit, drawn up to {100.0 * MOST_MARGIN:g} % of it"
    axes.set_title(words, size=style.TEXT_SIZE, weight="normal")
    axes.set(ylabel="margin (%)")
    axes.legend(loc="upper center", ncols=min(5, len(margins)), handlelength=2.2, columnspacing=1.0)
