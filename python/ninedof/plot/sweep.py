"""Sweeps: curves over one coordinate, maps over two, slices over three; an atlas of designs."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import BoundaryNorm, LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ninedof.plot import style
from ninedof.support.arguments import shown
from ninedof.support.arrays import Floats
from ninedof.support.units import amount, plain_name

if TYPE_CHECKING:
    from ninedof.sweep import SweepResult


PANELS = 6  # slices shown of a sweep over three coordinates
MOST_CURVES = 9
FINEST = 600  # values along an axis that a map can show
MAP = "viridis"
NOTE, LINE = (58, 110), 0.14  # letters of a line of the note in one column and in two, and its height in inches
SMOOTH = 8  # values each way from which a map without gaps is drawn as bands between contours, else as cells


def sweep(result: SweepResult, name: str = "", note: str = "", figure: Figure | None = None) -> Figure:
    """Return a figure of one index of a sweep.

    One coordinate gives a curve for each component of the index. Two give a map for each component, with the first
    coordinate along x. Three give maps of the first component at up to six values of the first coordinate.

    Parameters
    ----------
    result : SweepResult
    name : str
        Of the index; the first by default.
    note : str
        Words above the figure, such as where the design is evaluated.
    figure : matplotlib.figure.Figure or SubFigure, optional
        To draw in, with a constrained layout for maps; a new one by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
    >>> figure = nd.plot.sweep(nd.sweep(g, home, {"x_p": (-1.0, 1.0, 41), "y_p": (-1.0, 1.0, 41)}))

    """
    name = name or next(iter(result))
    if name not in result.arrays:
        raise ValueError(f"name: got {shown(name)}, expected one of {', '.join(result)}")
    dims, values = result.dims[name], result.arrays[name]
    labels = result.coords[dims[-1]] if values.shape and result.coords[dims[-1]].dtype.kind == "U" else None
    swept = dims if labels is None else dims[:-1]
    if len(swept) == 1:
        return _curves(result, name, swept[0], np.atleast_2d(np.asarray(values).T), labels, note, figure)
    if len(swept) == 2:
        slices = values[None] if labels is None else np.moveaxis(values, -1, 0)[:MOST_CURVES]
        titles = [name.replace("_", " ")] if labels is None else [str(x) for x in labels]
        return _maps(result, name, swept, dict(zip(titles, slices, strict=True)), note, figure)
    if labels is not None:
        values, name = values[..., 0], f"{name}, {labels[0]}"
    picks = np.unique(np.linspace(0, len(values) - 1, min(PANELS, len(values))).round().astype(int))
    first, unit = _values(result, swept[0]), _unit(result, swept[0])
    titles = [f"{plain_name(swept[0])} = {amount(style.signed(first[k]), unit)}" for k in picks]
    return _maps(result, name, swept[1:], dict(zip(titles, values[picks], strict=True)), note, figure)


def _curves(
    result: SweepResult, name: str, dim: str, rows: Floats, labels: Any, note: str, figure: Figure | None
) -> Figure:
    names = [] if labels is None else [str(label) for label in labels[:MOST_CURVES]]
    of_legs = len(names) == 9 and [label[0] for label in names] == list("lllqqqrrr")
    words = fill(note, NOTE[of_legs])
    above = LINE * len(words.splitlines())
    width, tall = (style.TWO_COLUMNS, 2.3) if of_legs else (style.ONE_COLUMN, 2.5)
    with style.page(figure, width, tall + above) as figure:
        share = tall / (tall + above)  # for the panels, below the note
        if of_legs:
            panels: Any = figure.add_gridspec(
                1, 3, wspace=0.36, left=0.085, right=0.985, bottom=0.19 * share, top=0.83 * share
            ).subplots()
        else:
            high = 0.74 if len(names) > 1 or note else 0.8
            panels = [figure.add_axes((0.155, 0.16 * share, 0.8, high * share))]
        if note:
            figure.text(0.02, 0.99, words, size=style.SMALL_SIZE, va="top")
        x = _values(result, dim)
        for k, row in enumerate(rows[:MOST_CURVES]):
            axes, look = panels[0], style.look(k)
            if of_legs:
                axes, look = panels[k // 3], {"color": style.LEG_COLOURS[names[k][0]], "ls": style.DASHES[k % 3]}
            axes.plot(x, style.without_infinite(row), **look, label=names[k] if names else None)
        for k, axes in enumerate(panels):
            axes.set(xlabel=_axis(result, dim), ylabel=_label(result, name))
            axes.margins(x=0.0)
            if of_legs:
                axes.set_title(tuple(style.LEG_WORDS.values())[k], size=style.TEXT_SIZE, pad=16.0)
            if names:
                axes.legend(loc="lower left", ncols=4, bbox_to_anchor=(0.0, 0.99), borderaxespad=0.0, handlelength=2.4)
        if name.startswith("condition_number") and (most := style.cut_off(panels[0].yaxis, rows)):
            panels[0].set_title(f"cut off; {most}", size=style.SMALL_SIZE, weight="normal", loc="right")
    return figure


def _maps(
    result: SweepResult,
    name: str,
    dims: tuple[str, ...],
    panels: Mapping[str, Floats],
    note: str,
    figure: Figure | None,
) -> Figure:
    """Draw maps over two coordinates, by title, with a common colour scale."""
    slices = np.stack(list(panels.values()))
    columns, rows = min(3, len(slices)), -(-len(slices) // 3)
    single = columns == 1
    size = (style.ONE_COLUMN, 2.8) if single else (style.TWO_COLUMNS, 0.5 + 2.0 * rows)
    coarser = [-(-n // FINEST) for n in slices.shape[1:]]
    slices = slices[:, :: coarser[0], :: coarser[1]]
    levels, beyond = _bands(slices.ravel(), name)
    extend: Any = "max" if beyond else "neither"
    norm = BoundaryNorm(levels, 256, extend=extend)
    colours = style.CONDITION if name.startswith("condition_number") else MAP
    x, y = (_values(result, d)[::step] for d, step in zip(dims, coarser, strict=True))
    with style.page(figure, *size, layout="constrained") as figure:
        grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        if note:
            figure.suptitle(fill(note, NOTE[not single]), size=style.SMALL_SIZE, x=0.02, ha="left")
        for axes, title, part in zip(grid.flat, panels, slices, strict=False):
            values = np.ma.masked_invalid(part.T)
            if min(part.shape) >= SMOOTH and np.isfinite(part).all():
                clipped = np.clip(values, levels[0], None if beyond else levels[-1])
                image = axes.contourf(x, y, clipped, levels, norm=norm, cmap=colours, extend=extend)
            else:
                image = axes.pcolormesh(x, y, values, norm=norm, cmap=colours, shading="nearest", rasterized=True)
            axes.set(facecolor=style.GRID, xlabel=_axis(result, dims[0]), ylabel=_axis(result, dims[1]))
            axes.label_outer()
            axes.grid(False)
            axes.set_title(title, size=None if single else style.TEXT_SIZE)
            if min(part.shape) > 1 and len(levels) > 2 and values.min() < values.max():
                line: dict[str, Any] = {"colors": "white", "linewidths": 0.4, "alpha": 0.7}
                if colours == style.CONDITION:
                    style.condition_lines(axes, x, y, part.T, levels, **line)
                else:
                    axes.contour(x, y, values, levels=levels, **line)
        for axes in list(grid.flat)[len(slices) :]:
            axes.set_axis_off()
        words = _label(result, name)
        if not np.isfinite(slices).all():
            words += "; grey: infinite or none"
        elif beyond:
            words += f", {slices.max():.4g} at most"
        style.colour_bar(figure, image, words, ax=list(grid.flat), pad=0.02, aspect=30, ticks=levels)
    return figure


def _bands(values: Floats, name: str) -> tuple[Floats, bool]:
    """Return round values between the bands of colour, and whether there are larger ones."""
    low, high = style.finite_range(values, (0.0, 1.0))
    if high <= low + 1e-12 * abs(low):
        high = low + max(1e-6 * abs(low), 1e-12)
    if not name.startswith("condition_number"):
        return np.asarray(MaxNLocator(12, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)), False
    levels = style.round_levels(low, min(high, style.RANGE * low) if low > 0.0 else high)
    return levels, high > levels[-1]


def _unit(result: SweepResult, name: str) -> str:
    unit = result.units.get(name, "1")
    return "deg" if unit == "rad" else "" if unit in ("1", "length") else unit


def _values(result: SweepResult, dim: str) -> Any:
    """Return the values along a dimension in the unit that is drawn."""
    values = result.coords[dim]
    return np.degrees(values) if result.units.get(dim) == "rad" else values


def _label(result: SweepResult, name: str) -> str:
    return style.with_unit(name.replace("_", " "), _unit(result, name))


def _axis(result: SweepResult, dim: str) -> str:
    return style.with_unit(plain_name(dim), _unit(result, dim))


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
    ratio, kappa = (result[name] for name in result.dims["histogram"])
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
            mesh = left.pcolormesh(x, kappa, shown.T, norm=norm, cmap="cividis", rasterized=True)
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
