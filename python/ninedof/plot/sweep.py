"""Sweeps: curves over one coordinate, maps over two, slices over three."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, NullLocator

from ninedof.plot import style
from ninedof.support.angles import plain_name
from ninedof.support.arguments import shown
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

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
    >>> from ninedof import plot
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(zp=3.9828, zs=2.4435)
    >>> figure = plot.sweep(nd.sweep(g, home, {"x_p": (-1.0, 1.0, 41), "y_p": (-1.0, 1.0, 41)}))

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
        titles = [_words(name)] if labels is None else [str(x) for x in labels]
        return _maps(result, name, swept, dict(zip(titles, slices, strict=True)), note, figure)
    if labels is not None:
        values, name = values[..., 0], f"{name}, {labels[0]}"
    picks = np.unique(np.linspace(0, len(values) - 1, min(PANELS, len(values))).round().astype(int))
    first, unit = _values(result, swept[0])
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
            place: dict[str, float] = {"left": 0.085, "right": 0.985, "bottom": 0.19 * share, "top": 0.83 * share}
            panels: Any = figure.add_gridspec(1, 3, wspace=0.36, **place).subplots()
        else:
            high = 0.74 if len(names) > 1 or note else 0.8
            panels = [figure.add_axes((0.155, 0.16 * share, 0.8, high * share))]
        if note:
            figure.text(0.02, 0.99, words, size=style.SMALL_SIZE, va="top")
        x, _ = _values(result, dim)
        for k, row in enumerate(rows[:MOST_CURVES]):
            axes = panels[k // 3 if of_legs else 0]
            colour = style.LEG_COLOURS[names[k][0]] if of_legs else style.SERIES[k % len(style.SERIES)]
            dashes = style.DASHES[k % 3 if of_legs else (k + k // len(style.SERIES)) % len(style.DASHES)]
            axes.plot(x, style.without_infinite(row), ls=dashes, color=colour, label=names[k] if names else None)
        for k, axes in enumerate(panels):
            axes.set(xlabel=_axis(result, dim))
            axes.margins(x=0.0)
            axes.set_ylabel(style.with_unit(_words(name), _unit(result, name)))
            if of_legs:
                axes.set_title(tuple(style.LEG_WORDS.values())[k], size=style.TEXT_SIZE, pad=16.0)
            if names:
                axes.legend(loc="lower left", ncols=4, bbox_to_anchor=(0.0, 0.99), borderaxespad=0.0, handlelength=2.4)
        if name.startswith("condition_number"):
            _crop(panels[0], rows)
    return figure


def _crop(axes: Any, rows: Floats) -> None:
    """Cut off values of many times the least, near a singularity, and say so."""
    finite = rows[np.isfinite(rows)]
    if finite.size and finite.max() > style.RANGE * finite.min():
        axes.set_ylim(finite.min() * 0.8, style.RANGE * finite.min())
        axes.set_yscale("log")
        style.one_two_five(axes.yaxis)
        most = "without a bound" if np.isposinf(rows).any() else f"{finite.max():.4g} at most"
        axes.set_title(f"cut off; {most}", size=style.SMALL_SIZE, weight="normal", loc="right")


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
    columns = min(3, len(slices))
    rows = -(-len(slices) // 3)
    single = columns == 1
    size = (style.ONE_COLUMN, 2.8) if single else (style.TWO_COLUMNS, 0.5 + 2.0 * rows)
    coarser = [-(-n // FINEST) for n in slices.shape[1:]]
    slices = slices[:, :: coarser[0], :: coarser[1]]
    levels, beyond = _bands(slices.ravel(), name)
    norm = BoundaryNorm(levels, 256, extend="max" if beyond else "neither")
    colours = style.CONDITION if name.startswith("condition_number") else MAP
    x, y = (_values(result, d)[0][::step] for d, step in zip(dims, coarser, strict=True))
    with style.page(figure, *size, layout="constrained") as figure:
        grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        image = None
        if note:
            figure.suptitle(fill(note, NOTE[not single]), size=style.SMALL_SIZE, x=0.02, ha="left")
        for axes, title, part in zip(grid.flat, panels, slices, strict=False):
            values = np.ma.masked_invalid(part.T)
            if min(part.shape) >= SMOOTH and np.isfinite(part).all():
                clipped = np.clip(values, levels[0], None if beyond else levels[-1])
                extend = "max" if beyond else "neither"
                image = axes.contourf(x, y, clipped, levels, norm=norm, cmap=colours, extend=extend)
            else:
                image = axes.pcolormesh(x, y, values, norm=norm, cmap=colours, shading="nearest", rasterized=True)
            axes.set_facecolor(style.GRID)
            axes.grid(False)
            axes.set_title(title, size=style.TEXT_SIZE if columns > 1 else None)
            if min(part.shape) > 1 and len(levels) > 2:
                _contours(axes, x, y, values, levels)
        for axes in list(grid.flat)[len(slices) :]:
            axes.set_axis_off()
        for axes in grid[-1, :]:
            axes.set_xlabel(_axis(result, dims[0]))
        for axes in grid[:, 0]:
            axes.set_ylabel(_axis(result, dims[1]))
        if image is not None:
            bar = figure.colorbar(image, ax=list(grid.flat), pad=0.02, aspect=30, ticks=levels)
            bar.ax.yaxis.set_major_formatter("{x:g}")
            bar.ax.yaxis.set_minor_locator(NullLocator())
            bar.outline.set_linewidth(0.5)
            words = style.with_unit(_words(name), _unit(result, name))
            finite = slices[np.isfinite(slices)]
            words += f", {finite.max():.4g} at most" if beyond and np.isfinite(slices).all() else ""
            bar.set_label(words + ("; grey: infinite or none" if not np.isfinite(slices).all() else ""))
    return figure


def _contours(axes: Any, x: Any, y: Any, values: Any, levels: Floats) -> None:
    """Draw thin lines between the bands."""
    if values.count() and float(values.min()) < float(values.max()):
        axes.contour(x, y, values, levels=levels, colors="white", linewidths=0.4, alpha=0.7)


def _bands(values: Floats, name: str) -> tuple[Floats, bool]:
    """Return round values between the bands of colour, and whether there are larger ones."""
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    if high <= low + 1e-12 * abs(low):
        high = low + max(1e-6 * abs(low), 1e-12)
    top = min(high, style.RANGE * low) if name.startswith("condition_number") and low > 0.0 else high
    if not name.startswith("condition_number"):
        return np.asarray(MaxNLocator(12, steps=[1, 2, 2.5, 5, 10]).tick_values(low, top)), False
    levels = style.round_levels(low, top)
    return levels, high > float(levels[-1])


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
