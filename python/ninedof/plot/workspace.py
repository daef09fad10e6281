"""A workspace: sections, its limits, the condition number in it, and the convergence of the volume."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import NullLocator
from numpy.typing import ArrayLike

from ninedof.plot import style
from ninedof.plot.arguments import number, numbers, texts, things
from ninedof.plot.section import BOUNDARY, KINDS, Section, draw_section, home_mark, kind_of
from ninedof.support.arguments import instance, text
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.printable import escaped

MOST_SECTIONS = 3
MOST_SHARES = 9
LOWER = 1.93  # inches, the height of the lower row
USUAL, MORE = 95, 0.5  # the colours end at this percentile, or at the greatest value if it is so little above it


def workspace(
    sections: Sequence[Section],
    limit_names: Sequence[str],
    shares: Mapping[str, float],
    percentiles: ArrayLike,
    levels: ArrayLike,
    unit: str = "",
) -> Figure:
    """Return a figure of a workspace: sections above, the limits, the condition number and the volume below.

    Colours are bands between contours at round values, the same in all sections. Where the condition number goes on
    beyond the last, the colour bar has an arrow and names the largest.

    Parameters
    ----------
    sections : sequence of Section
        One to three.
    limit_names : sequence of str
        Names of the limits, indexed by the numbers in the sections.
    shares : mapping of str to float
        Share of the boundary by limit.
    percentiles : array_like, shape (101,)
        Of the condition number over the volume.
    levels : array_like, shape (n, 4)
        Cells, evaluations, volume and error after each level; none for a grid or a sample.
    unit : str
        Of the coordinates, for the labels. Those in "rad" are drawn in degrees.

    Raises
    ------
    ValueError
        If there are no sections or too many.

    Examples
    --------
    >>> import ninedof as nd
    >>> from ninedof.plot.workspace import Section, workspace
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> found = nd.workspace(g, ([-4, -4, 0], [4, 4, 8]), criteria={"leg_limits": (2.5, 6.5)})
    >>> section = Section(found.slice("z", 5.4, smooth=True))
    >>> figure = workspace([section], found.limit_names, found.limits(), found.percentiles, found.levels)

    """
    things("sections", sections, Section, MOST_SECTIONS)
    kinds = [kind_of(name) for name in texts("limit_names", limit_names)]
    if (most_known := max(int(section.plane.limit.max()) for section in sections)) >= len(kinds):
        raise ValueError(
            f"limit_names: got {len(kinds)}, expected at least {most_known + 1}: the sections have so many"
        )
    for name, share in instance("shares", shares, Mapping).items():  # type: ignore[type-abstract]
        kind_of(text("shares", name), "shares")
        number(f"shares.{name}", share)
    known = as_floats("percentiles", percentiles, ())
    if known.size:  # no pose, no numbers
        numbers("percentiles", known, 101, gaps=True, positive=True)
    steps = as_floats("levels", levels, ())
    steps = numbers("levels", steps, None, 4, gaps=True) if steps.size else np.zeros((0, 4))
    if len(steps):
        numbers("levels", steps[:, 1], None, positive=True)  # evaluations, along a logarithmic axis
    text("unit", unit)
    with style.settings():
        upper = 3.37 if len(sections) < MOST_SECTIONS else 2.75  # inches
        engine = ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06)
        figure = style.new_figure(style.TWO_COLUMNS, upper + LOWER, layout=engine)
        parts: Any = figure.subfigures(2, 1, height_ratios=[upper, LOWER])
        above, below = parts
        bands, most = _bands(known, sections)
        shown: Any = None
        panels = above.subplots(1, len(sections), squeeze=False)[0]
        for axes, section in zip(panels, sections, strict=True):
            shown = draw_section(axes, section, kinds, bands, most is not None, unit) or shown
        if shown is not None:
            bar = above.colorbar(shown, ax=list(panels), fraction=0.03, pad=0.02, aspect=28, ticks=bands)
            bar.ax.yaxis.set_major_formatter("{x:g}")
            bar.ax.yaxis.set_minor_locator(NullLocator())
            more = "" if most is None else f", {most:.4g} at most" if np.isfinite(most) else ", without a bound"
            bar.set_label("condition number" + more)
            bar.outline.set_linewidth(0.5)
        _legend(figure, sections, kinds)
        left, middle, right = below.subplots(1, 3)
        _shares(left, shares)
        _distribution(middle, known)
        _levels(right, steps)
    return figure


def _bands(percentiles: Floats, sections: Sequence[Section]) -> tuple[Floats, float | None]:
    """Return the round values between the bands of colour, and the largest value if it is beyond them."""
    drawn = np.concatenate([section.plane.condition_number.ravel() for section in sections])
    finite = [values[np.isfinite(values)] for values in (percentiles, drawn)]
    known = finite[0] if finite[0].size else finite[1]  # the raster goes on a little beyond the boundary
    if not known.size:
        return np.array([1.0, 2.0]), None
    low, high = float(known.min()), float(known.max())
    usual = float(finite[0][: USUAL + 1].max()) if finite[0].size > USUAL else high
    top = high if high <= usual + MORE * (usual - low) else min(usual, style.RANGE * low)
    bands = style.round_levels(low, top)
    most = np.inf if np.isposinf(percentiles if finite[0].size else drawn).any() else high
    return bands, most if most > bands[-1] else None


def _legend(figure: Figure, sections: Sequence[Section], kinds: Sequence[str]) -> None:
    there = {kinds[n] for s in sections for n in np.unique(s.plane.limit[s.plane.state == 1]).tolist() if n >= 0}
    entries: list[Any] = [
        style.key(colour, ls=dashes, lw=BOUNDARY, label=words)
        for kind, (words, colour, dashes) in KINDS.items()
        if kind in there
    ]
    if any(section.region is not None for section in sections):
        entries.append(style.key(style.INK, lw=1.2, label="region of the study"))
    if any(section.ball is not None for section in sections):
        entries.append(_ring(label="largest ball"))
    if any(section.box is not None for section in sections):
        entries.append(style.key(style.INK, lw=0.9, ls=(0, (3, 1.5)), label="largest box"))
    if any(section.home is not None for section in sections):
        entries.append(
            style.key(label="home", colour=style.INK, **{k: v for k, v in home_mark().items() if k != "color"})
        )
    if entries:
        figure.legend(handles=entries, loc="outside upper left", ncols=min(4, len(entries)), handlelength=3.0)


def _ring(label: str) -> Any:
    return style.key(style.INK, lw=0.9, label=label, marker="o", ms=7, mfc="none", ls="")


def _shares(axes: Any, shares: Mapping[str, float]) -> None:
    top = list(shares.items())[:MOST_SHARES]
    axes.set_title("limits of the boundary")
    if not top:
        axes.set_axis_off()
        return
    colours = [KINDS[kind_of(name)][1] for name, _ in top]
    axes.barh(range(len(top)), [100.0 * share for _, share in top], color=colours, height=0.7)
    axes.set_yticks(range(len(top)), [escaped(name.replace("_", " ")) for name, _ in top])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("% of the boundary")


def _distribution(axes: Any, percentiles: Floats) -> None:
    axes.set_title("condition number in it")
    if not np.isfinite(percentiles).any():
        axes.set_axis_off()
        return
    axes.plot(percentiles, np.arange(percentiles.size), color=style.SERIES[0])
    axes.set(xlabel="condition number", ylabel="% of the volume below", ylim=(0, 100))
    finite = percentiles[np.isfinite(percentiles)]
    if finite.max() > 10.0 * finite.min():
        axes.set_xscale("log")
        style.one_two_five(axes.xaxis)


def _levels(axes: Any, levels: Floats) -> None:
    axes.set_title("error of the volume")
    known = levels[levels[:, 3] > 0.0]
    if len(known) == 0:
        axes.set_axis_off()
        return
    axes.loglog(known[:, 1], known[:, 3] / levels[-1, 2], "o-", color=style.SERIES[0], ms=3.5)
    axes.set_xlim(10.0 ** np.floor(np.log10(known[0, 1])), 1.3 * 10.0 ** np.ceil(np.log10(known[-1, 1])))
    axes.xaxis.set_major_formatter(style.power_of_ten)
    axes.yaxis.set_major_formatter(style.power_of_ten)
    axes.minorticks_off()
    axes.set(xlabel="poses evaluated", ylabel="share of the volume")
