"""Sweeps: curves over one coordinate, maps over two, slices over three, and the two figures of the paper."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from ninedof.plot import style
from ninedof.support.angles import plain_name
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

if TYPE_CHECKING:
    from ninedof.sweep import SweepResult

PANELS = 6  # slices shown of a sweep over three coordinates
MOST_CURVES = 9
RANGE = 30.0  # times the least: larger values are cut off
FINEST = 600  # values along an axis that a map can show
MAP = "viridis"
TURNS = (-50.0, -25.0, 0.0, 25.0, 50.0)  # degrees: ticks of Fig. 6, which goes to one radian


def sweep(result: SweepResult, name: str = "") -> Figure:
    """Return a figure of one index of a sweep.

    One coordinate gives a curve for each component of the index. Two give a map for each component, with the first
    coordinate along x. Three give maps of the first component at up to six values of the first coordinate.

    Parameters
    ----------
    result : SweepResult
    name : str
        Of the index; the first by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof import plot
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
    >>> figure = plot.sweep(nd.sweep(g, home, {"x_p": (-1.0, 1.0, 41), "y_p": (-1.0, 1.0, 41)}))

    """
    name = name or next(iter(result))
    if name not in result.arrays:
        raise ValueError(f"name: got {name!r}, expected one of {', '.join(result)}")
    dims, values = result.dims[name], result.arrays[name]
    labels = result.coords[dims[-1]] if values.shape and result.coords[dims[-1]].dtype.kind == "U" else None
    swept = dims if labels is None else dims[:-1]
    with style.settings():
        if len(swept) == 1:
            return _curves(result, name, swept[0], np.atleast_2d(np.asarray(values).T), labels)
        if len(swept) == 2:
            slices = values[None] if labels is None else np.moveaxis(values, -1, 0)[:MOST_CURVES]
            return _maps(result, name, swept, slices, [_words(name)] if labels is None else [str(x) for x in labels])
        if labels is not None:
            values, name = values[..., 0], f"{name}, {labels[0]}"
        picks = np.unique(np.linspace(0, len(values) - 1, min(PANELS, len(values))).round().astype(int))
        first, unit = _values(result, swept[0])
        titles = [f"{plain_name(swept[0])} = {amount(f'{first[k]:.4g}', unit)}" for k in picks]
        return _maps(result, name, swept[1:], values[picks], titles)


def _curves(result: SweepResult, name: str, dim: str, rows: Floats, labels: Any) -> Figure:
    figure = style.new_figure(7.0, 4.2)
    axes = figure.add_axes((0.1, 0.13, 0.87, 0.79))
    x, _ = _values(result, dim)
    for k, row in enumerate(rows[:MOST_CURVES]):
        colour = style.SERIES[k % len(style.SERIES)]
        label = None if labels is None else str(labels[k])
        dashes = ("-", "--", ":")[k // len(style.SERIES) % 3]
        axes.plot(x, style.without_infinite(row), ls=dashes, color=colour, lw=2.0, label=label)
    axes.set_title(_words(name))
    axes.set(xlabel=_axis(result, dim), ylabel=style.with_unit(_words(name), _unit(result, name)))
    if name.startswith("condition_number"):
        _crop(axes, rows)
    if labels is not None:
        axes.legend(loc="best", ncols=3)
    return figure


def _crop(axes: Any, rows: Floats) -> None:
    """Cut off values of many times the least, near a singularity."""
    finite = rows[np.isfinite(rows)]
    if finite.size and finite.max() > RANGE * finite.min():
        axes.set_ylim(finite.min() * 0.8, RANGE * finite.min())
        axes.set_yscale("log")


def _maps(result: SweepResult, name: str, dims: tuple[str, ...], slices: Floats, titles: Sequence[str]) -> Figure:
    """Draw maps over two coordinates with a common colour scale."""
    columns = min(3, len(slices))
    rows = -(-len(slices) // 3)
    figure = style.new_figure(5.4 if columns == 1 else 9.0, 4.4 if columns == 1 else 0.9 + 2.9 * rows)
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    coarser = [-(-n // FINEST) for n in slices.shape[1:]]
    slices = slices[:, :: coarser[0], :: coarser[1]]
    norm = _norm(slices.ravel(), name)
    colours = style.CONDITION if name.startswith("condition_number") else MAP
    x, y = (_values(result, d)[0][::step] for d, step in zip(dims, coarser, strict=True))
    drawn = None
    for axes, title, part in zip(grid.flat, titles, slices, strict=False):
        drawn = axes.pcolormesh(
            x, y, np.ma.masked_invalid(part.T), norm=norm, cmap=colours, shading="nearest", rasterized=True
        )
        axes.set_facecolor(style.GRID)
        axes.grid(False)
        axes.set_title(title, size=style.TEXT_SIZE if columns > 1 else None)
    for axes in list(grid.flat)[len(slices) :]:
        axes.set_axis_off()
    for axes in grid[-1, :]:
        axes.set_xlabel(_axis(result, dims[0]))
    for axes in grid[:, 0]:
        axes.set_ylabel(_axis(result, dims[1]))
    figure.subplots_adjust(left=0.1 if columns > 1 else 0.14, right=0.97, bottom=0.12 if rows == 1 else 0.09, top=0.91)
    if drawn is not None:
        bar = figure.colorbar(drawn, ax=list(grid.flat), pad=0.03, aspect=30)
        if isinstance(norm, LogNorm):
            low, high = bar.ax.get_ylim()
            tens = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
            bar.set_ticks([t for k in tens for m in (1, 2, 5) if low <= (t := m * 10.0**k) <= high])
            bar.ax.yaxis.set_major_formatter("{x:g}")
            bar.ax.yaxis.set_minor_formatter(NullFormatter())
        words = style.with_unit(_words(name), _unit(result, name))
        bar.set_label(words + ("; grey: infinite or none" if not np.isfinite(slices).all() else ""))
    return figure


def _norm(values: Floats, name: str) -> Normalize:
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    if name.startswith("condition_number") and high > 3.0 * low > 0.0:
        return LogNorm(low, min(high, RANGE * low))
    return Normalize(low, high if high > low else low + 1.0)


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
    names, x, rows = (result[key] for key in ("coordinate", "displacement", "condition_number"))
    ends = [x[0], 0.5 * x[0], 0.0, 0.5 * x[-1], x[-1]]
    groups = (
        (0, x, ends, f"platform moved ({unit})"),
        (3, np.degrees(x), TURNS, "platform turned (deg)"),
        (6, x, ends, f"O moved ({unit})"),
    )
    with style.settings():
        figure = style.new_figure(9.0, 3.9)
        panels = figure.subplots(1, 3, sharey=True)
        top = min(float(rows[np.isfinite(rows)].max()), 2.4 * float(rows.min()))
        for axes, (first, x, ticks, title) in zip(panels, groups, strict=True):
            for k, dashes in zip(range(first, first + 3), ("-", (0, (5, 2)), (0, (1.2, 1.2))), strict=True):
                colour = style.SERIES[k - first]
                axes.plot(x, style.without_infinite(rows[k]), color=colour, ls=dashes, lw=2.0, label=names[k])
            axes.set(xlabel=title, xlim=(x[0], x[-1]), ylim=(0.96 * float(rows.min()), top))
            if words := _cut_off(names[first : first + 3].tolist(), rows[first : first + 3], top):
                axes.text(0.5, 0.975, words, transform=axes.transAxes, ha="center", va="top", size=style.SMALL_SIZE)
            axes.set_xticks(ticks)
            axes.legend(loc="upper center", ncols=3, bbox_to_anchor=(0.5, 1.13), handlelength=2.6, columnspacing=1.2)
        panels[0].set_ylabel("condition number")
        figure.subplots_adjust(left=0.07, right=0.985, bottom=0.13, top=0.88, wspace=0.12)
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
    names, x, rows = (result[key] for key in ("sides", "ratio", "condition_number"))
    with style.settings():
        figure = style.new_figure(7.0, 4.2)
        axes = figure.add_axes((0.09, 0.13, 0.88, 0.77))
        axes.plot(x, rows[0], color=style.SERIES[0], lw=2.4, label=names[0])
        axes.plot(x, rows[1], "o", color=style.SERIES[1], ms=4.5, mfc="white", mew=1.3, label=names[1])
        axes.set_xscale("log", base=2)
        ticks = [t for t in 2.0 ** np.arange(-10, 11) if x[0] <= t <= x[-1]]
        style.plain_numbers(axes.xaxis, ticks)
        axes.set_title("least condition number, all else re-optimized")
        axes.set(xlabel="ratio of the sides", ylabel="condition number")
        axes.legend(loc="upper right")
    return figure


def _words(name: str) -> str:
    return name.replace("_", " ")


def _unit(result: SweepResult, name: str) -> str:
    """Return the unit that is drawn: degrees in the place of radians."""
    unit = result.units.get(name, "1")
    return "deg" if unit == "rad" else "" if unit in ("1", "length") else unit


def _values(result: SweepResult, dim: str) -> tuple[Any, str]:
    """Return the values along a dimension in the unit that is drawn, and that unit."""
    values = result.coords[dim]
    return np.degrees(values) if result.units.get(dim) == "rad" else values, _unit(result, dim)


def _axis(result: SweepResult, dim: str) -> str:
    return style.with_unit(plain_name(dim), _unit(result, dim))
