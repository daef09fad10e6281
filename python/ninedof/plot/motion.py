"""Lengths, rates and forces of the legs and condition number along a trajectory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from ninedof.plot import style
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.units import per

if TYPE_CHECKING:
    from ninedof.motion import Followed

MOST_DRAWN = 800  # stretches of a curve
MOST_MARGIN = 1.0  # drawn: beyond it a limit is far
LIMIT = {"color": style.INK, "lw": 1.0, "ls": (0, (6, 3)), "zorder": 1}
FORBIDDEN = {"color": style.ALARM, "alpha": 0.12, "lw": 0.0, "zorder": 0}


def motion(followed: Followed, margins: Mapping[str, ArrayLike] | None = None, figure: Figure | None = None) -> Figure:
    """Return a figure of lengths, rates and forces of the legs over time by kind, the condition number, and margins.

    Forces are drawn where the motion has loads or masses, a curve for each load; limits of lengths where it has them.
    Where the robot is singular the curve of the condition number has a gap.

    Parameters
    ----------
    followed : Followed
        As `ninedof.follow` returns it: time is in seconds where lengths have a unit, else in the unit of the path.
    margins : mapping of str to array_like of shape (n,), optional
        Relative margins of further limits by name, negative where a limit is violated; drawn up to 100 %. As
        `ninedof.PathLimits.margins`.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> figure = nd.plot.motion(nd.follow(g, nd.Trajectory.circle(home, radius=0.5), home))

    """
    t, lengths, kappa = followed.time, followed.leg_lengths, followed.condition_number
    others = {name: as_floats(f"margins.{name}", values, t.shape) for name, values in (margins or {}).items()}
    samples = _drawn(kappa)
    bands = {"length": (lengths, followed.unit), "rate": (followed.leg_rates, per(followed.unit, "s"))}
    if followed.leg_forces is not None:
        count = followed.load_count
        bands["force" if count == 1 else f"force, {count} loads"] = (followed.leg_forces, followed.force_unit)
    rows = [*([1.0] * len(bands)), 0.85, *([0.85] if others else [])]
    height = 2.15 * sum(rows)
    with style.page(figure, style.TWO_COLUMNS, height) as figure:
        grid = figure.add_gridspec(
            len(rows),
            3,
            height_ratios=rows,
            hspace=0.5,
            wspace=0.36,
            left=0.085,
            right=0.98,
            bottom=0.45 / height,
            top=1.0 - 0.28 / height,
        )
        first, panels = [], []
        for row, (what, (values, unit)) in enumerate(bands.items()):
            for k, (kind, title) in enumerate(style.LEG_WORDS.items()):
                axes, legs = figure.add_subplot(grid[row, k]), slice(3 * k, 3 * k + 3)
                _legs(axes, t[samples], values[..., samples, legs], kind)
                if what == "length":
                    _limits(axes, followed.limits[0][legs], followed.limits[1][legs], lengths[:, legs])
                    axes.set_title(title, size=style.TEXT_SIZE)
                axes.set_ylabel(style.with_unit(what, unit))
                panels.append(axes)
            first.append(panels[-3])
        below = [figure.add_subplot(grid[row, :]) for row in range(len(bands), len(rows))]
        _condition(below[0], t[samples], kappa[samples])
        if others:
            _margins(below[1], t, others)
        for axes in (*panels, *below):
            axes.set_xlabel("time (s)" if followed.unit else "time (in the unit of the path)")
            axes.set_xlim(t[0], t[-1])
        figure.align_ylabels([*first, *below])
    return figure


def _drawn(kappa: Floats) -> NDArray[np.intp]:
    """Return the samples to draw: the first of each stretch, its greatest value, and the last of all."""
    step = -(-len(kappa) // MOST_DRAWN)
    begins = np.arange(0, len(kappa), step)
    padded = np.full(step * len(begins), -np.inf)
    padded[: len(kappa)] = kappa
    return np.unique(np.concatenate([begins, begins + padded.reshape(-1, step).argmax(axis=1), [len(kappa) - 1]]))


def _legs(axes: Any, t: Floats, lengths: Floats, kind: str) -> None:
    for j, dashes in enumerate(style.DASHES[:3]):
        for k, values in enumerate(lengths.reshape(-1, len(t), 3)):
            axes.plot(t, values[:, j], color=style.LEG_COLOURS[kind], ls=dashes, label=None if k else f"{kind}{j + 1}")
    least, most = lengths.min(), lengths.max()
    room = max(0.08 * (most - least), 0.01 * max(abs(least), abs(most))) or 1.0
    axes.set_ylim(least - room, most + 3.0 * room)
    axes.legend(loc="upper center", ncols=3, handlelength=2.2, columnspacing=1.0)


def _limits(axes: Any, low: Floats, high: Floats, lengths: Floats) -> None:
    """Draw limits that the legs come near: all of them would squeeze the curves."""
    least, most = axes.get_ylim()
    reach = 0.5 * (most - least)
    for value in np.unique(np.concatenate([low[low > 0.0], high[np.isfinite(high)]])).tolist():
        if least - reach <= value <= most + reach:
            axes.axhline(value, **LIMIT)
            bottom, top = axes.get_ylim()
            axes.set_ylim(min(bottom, value - 0.1 * reach), max(top, value + 0.6 * reach))
    bottom, top = axes.get_ylim()
    if (lengths < low).any():  # the forbidden side, where a leg enters it
        axes.axhspan(bottom, low.max(), **FORBIDDEN)
    if (lengths > high).any():
        axes.axhspan(high.min(), top, **FORBIDDEN)
    axes.set_ylim(bottom, top)


def _condition(axes: Any, t: Floats, kappa: Floats) -> None:
    axes.plot(t, style.without_infinite(kappa), color=style.SERIES[0])
    axes.set_ylabel("condition number")
    if most := style.cut_off(axes.yaxis, kappa):
        axes.set_title(f"cut off at {axes.get_ylim()[1]:.3g}; {most}", size=style.TEXT_SIZE, weight="normal")
    else:
        low, high = style.finite_range(kappa)
        room = max(0.08 * (high - low), 0.005 * high)
        axes.set_ylim(low - room, high + room)


def _margins(axes: Any, t: Floats, margins: Mapping[str, Floats]) -> None:
    for k, (name, values) in enumerate(margins.items()):
        samples = _drawn(-values)
        percent = 100.0 * np.minimum(values[samples], MOST_MARGIN)
        axes.plot(t[samples], percent, **style.look(k), label=name.replace("_", " "))
    axes.axhline(0.0, **LIMIT)
    low, high = axes.get_ylim()
    if min(values.min() for values in margins.values()) < 0.0:
        axes.axhspan(low, 0.0, **FORBIDDEN)
    columns = min(5, len(margins))
    room = 0.04 + 0.12 * -(-len(margins) // columns)  # of the axes, for the legend
    axes.set_ylim(low, high + room / (1.0 - room) * (high - low))
    words = f"least margin of each limit, drawn up to {100.0 * MOST_MARGIN:g} % of it"
    axes.set_title(words, size=style.TEXT_SIZE, weight="normal")
    axes.set_ylabel("margin (%)")
    axes.legend(loc="upper center", ncols=columns, handlelength=2.2, columnspacing=1.0)
