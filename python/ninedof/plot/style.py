"""The style of all figures: sizes as printed, colours, dashes, axes, and how a figure or its axes are made."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence, Sized
from contextlib import AbstractContextManager, contextmanager
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, LogLocator, MaxNLocator, NullFormatter
from numpy.typing import ArrayLike, NDArray

from ninedof.support.arrays import Floats
from ninedof.support.units import with_unit as with_unit

# Okabe and Ito's palette, which is safe for colour-blind readers.
EXTERNAL = "#0072B2"
UPPER = "#D55E00"
LOWER = "#009E73"
LEG_COLOURS = {"l": EXTERNAL, "q": UPPER, "r": LOWER}
LEG_WORDS = {"l": "external legs", "q": "upper internal legs", "r": "lower internal legs"}

BASE = "#46525E"
PLATFORM = "#A9B6C3"
INK = "#1F262D"
MUTED = "#6B7680"
GRID = "#E3E7EB"

# Paul Tol's "bright" without the colours of the legs: for designs and methods in one figure, in this order.
SERIES = ("#566370", "#AA3377", "#117799", "#B07D00")
REGION = SERIES[3]  # the outline of a region of poses, in the viewer too
ALARM = UPPER  # failures and warnings
RANGE = 30.0  # times the least condition number: larger values are cut off
CONDITION = "cividis_r"  # condition numbers, dark if large; safe for colour-blind readers

# Series in one figure differ in the dashes too: in grey print colours alone do not tell them apart.
DASHES: tuple[Any, ...] = ("-", (0, (5, 2)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))
MARKS = ("o", "s", "^", "D")

HOME = {"marker": "P", "ms": 6.5, "color": INK, "mec": "white", "mew": 0.9, "ls": "", "zorder": 8}
"""The mark of the home pose."""

# Inches: figures are made at the width they are printed at, so that these are the sizes of the text on paper.
ONE_COLUMN = 86.0 / 25.4
TWO_COLUMNS = 178.0 / 25.4

TITLE_SIZE = 8.5  # points
TEXT_SIZE = 8.0
SMALL_SIZE = 7.0
CURVE = 1.4  # points, of a line

DPI = 200

Rectangle = tuple[float, float, float, float]
"""Left, bottom, width and height, in fractions of a figure."""

_SETTINGS: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": MUTED,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.labelsize": TEXT_SIZE,
    "axes.labelpad": 2.5,
    "axes.linewidth": 0.7,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlecolor": INK,
    "axes.titlelocation": "left",
    "axes.titlepad": 4.0,
    "axes.titlesize": TITLE_SIZE,
    "axes.titleweight": "bold",
    "figure.facecolor": "white",
    "font.family": ["DejaVu Sans"],  # part of matplotlib, so that figures are the same on every machine
    "font.size": TEXT_SIZE,
    "grid.color": GRID,
    "grid.linewidth": 0.5,
    "hatch.linewidth": 0.5,
    "legend.fontsize": SMALL_SIZE,
    "legend.frameon": False,
    "lines.linewidth": CURVE,
    "pdf.fonttype": 42,  # letters stay letters: journals refuse Type 3 fonts
    "svg.fonttype": "path",
    "svg.hashsalt": "ninedof",  # ids that are not random: equal figures give equal files
    "text.color": INK,
    "text.parse_math": False,  # names come from files: a "$" in them is a dollar; symbols of our own ask for it
    "text.usetex": False,
    **{
        f"{axis}tick.{name}": value
        for axis in "xy"
        for name, value in {
            "major.pad": 2.5,
            "major.size": 2.5,
            "major.width": 0.6,
            "minor.size": 1.5,
            "minor.width": 0.4,
            "color": MUTED,
            "labelcolor": INK,
            "labelsize": SMALL_SIZE,
        }.items()
    },
}


def settings() -> AbstractContextManager[None]:
    """Apply the settings of all figures inside a `with` block, and restore those of matplotlib."""
    return rc_context(_SETTINGS)


def new_figure(width: float, height: float, layout: Any = None) -> Figure:
    """Return an empty figure of a size in inches, with its own Agg canvas."""
    figure = Figure(figsize=(width, height), dpi=DPI, layout=layout)
    FigureCanvasAgg(figure)
    return figure


@contextmanager
def page(figure: Figure | None, width: float, height: float, layout: Any = None) -> Iterator[Figure]:
    """Yield what to draw into, in the settings of all figures: the figure given, or a new one of a size in inches."""
    with settings():
        yield new_figure(width, height, layout) if figure is None else figure


@contextmanager
def panel(ax: Any, width: float, height: float, place: Rectangle, **options: Any) -> Iterator[tuple[Figure, Any]]:
    """Yield the figure and the axes given, or a new one of a size in inches and axes that fill a part of it."""
    with page(None if ax is None else ax.figure, width, height) as figure:
        yield figure, figure.add_axes(place, **options) if ax is None else ax


def inches(figure: Any) -> Floats:
    """Return width and height of a figure, or of its part."""
    return np.asarray(figure.bbox.size / figure.dpi)


def power_of_ten(value: float, position: object = None) -> str:
    """Return "10⁻⁶" for 1e-6, and other numbers unchanged; also a tick formatter, ten times as fast as mathtext."""
    exponent = math.log10(value) if value > 0 else math.nan
    if not math.isfinite(exponent) or abs(exponent - round(exponent)) > 1e-9:
        return f"{value:g}"
    return "10" + str(round(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def signed(value: float) -> str:
    """Return a number of four digits for a title, with the minus sign that axes have."""
    return f"{value:.4g}".replace("-", "\N{MINUS SIGN}")


def plain_numbers(axis: Any, ticks: Sequence[float]) -> None:
    """Label a logarithmic axis with these numbers, without powers of ten; numbers below 1 as fractions."""
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_major_formatter(lambda x, _: f"{x:g}" if x >= 1 else f"1/{1 / x:g}")
    axis.set_minor_formatter(NullFormatter())


def one_two_five(axis: Any) -> None:
    """Label a logarithmic axis with 1, 2 and 5 in each decade, without powers of ten."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def finite_range(values: Floats, otherwise: tuple[float, float] = (1.0, 1.0)) -> tuple[float, float]:
    """Return the least and the greatest finite value."""
    finite = values[np.isfinite(values)]
    return (finite.min(), finite.max()) if finite.size else otherwise


def without_infinite(values: ArrayLike) -> Floats:
    """Return the values with NaN in place of infinite ones: the curve has a gap there."""
    array = np.asarray(values, dtype=np.float64)
    return np.where(np.isfinite(array), array, np.nan)


def corners(low: Floats, high: Floats) -> Floats:
    """Return the corners of rectangles between low and high, shapes (n, 2) to (n, 4, 2)."""
    (x0, y0), (x1, y1) = low.T, high.T
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]).transpose(2, 0, 1)


def round_levels(low: float, high: float, most: int = 9) -> Floats:
    """Return round values for contours from `low` to `high`, at most about `most`: 1-2-5 in decades of a wide range."""
    if high - low <= 1e-9 * abs(low):
        room = 0.05 * abs(low) or 1.0
        low, high = low - room, high + room
    if low > 0.0 and high > 6.0 * low:
        tens = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        every = np.array([m * 10.0**k for k in tens for m in (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)])
    else:
        every = np.asarray(MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high))
    first = max(int(np.searchsorted(every, low * (1.0 + 1e-9), side="right")) - 1, 0)
    last = min(int(np.searchsorted(every, high * (1.0 - 1e-9))), len(every) - 1)
    return np.asarray(every[first : max(last, first + 1) + 1], dtype=np.float64)


def condition_lines(axes: Any, x: Floats, y: Floats, values: Floats, levels: Floats, **look: Any) -> Any:
    """Draw lines of a condition number over a grid, shape (y, x); return them, None where there is none.

    Towards a singularity the number has no bound and its lines would be those of the grid: they are drawn of its
    inverse, which goes to 0, and none so near to 0 that the grid does not resolve it.
    """
    inverse = np.ma.masked_invalid(1.0 / values)
    least = 0.0
    for pair in ((inverse[1:], inverse[:-1]), (inverse[:, 1:], inverse[:, :-1])):
        step = abs(pair[0] - pair[1])
        least = max(least, step[(np.minimum(*pair) < step).filled(False)].filled(0.0).max(initial=0.0))
    lined = 1.0 / levels[::-1]
    lined = lined[lined > least]
    return axes.contour(x, y, inverse, levels=lined, **look) if lined.size else None


def round_to(value: float, span: float) -> float:
    """Return a round value near `value`: a multiple of 1, 2 or 5 times a power of ten, of at most 1/25 of `span`."""
    power = 10.0 ** math.floor(math.log10(span / 25.0))
    step = max(m * power for m in (1.0, 2.0, 5.0) if m * power <= span / 25.0 * (1.0 + 1e-9))
    return float(f"{round(value / step) * step:.12g}") + 0.0


def colour_bar(figure: Any, image: Any, label: str, **place: Any) -> None:
    """Add a colour bar with plain numbers at its ticks."""
    bar = figure.colorbar(image, label=label, **place)
    bar.ax.yaxis.set_major_formatter("{x:g}")
    bar.ax.minorticks_off()
    bar.outline.set_linewidth(0.5)


def cut_off(axis: Any, values: Floats) -> str:
    """Show values up to RANGE times the least, on a logarithmic axis; return the greatest in words, "" if shown."""
    low, high = finite_range(values)
    if high <= RANGE * low:
        return ""
    axis.axes.set(yscale="log", ylim=(low * 0.8, RANGE * low))
    one_two_five(axis)
    return "without a bound" if np.isposinf(values).any() else f"{high:.4g} at most"


def stretches(values: NDArray[Any]) -> Iterator[tuple[int, int]]:
    """Yield the first and the last index of each stretch of one value along a curve; the next begins at the last."""
    changes = np.flatnonzero(values[1:] != values[:-1]) + 1
    return pairwise([0, *changes.tolist(), len(values) - 1])


def key(color: Any, **line: Any) -> Line2D:
    """Return a legend entry without data."""
    return Line2D([], [], color=color, **line)


def look(k: int) -> dict[str, Any]:
    """Return colour and dashes of the curve number k of any number: no two of the first sixteen are alike."""
    return {"color": SERIES[k % len(SERIES)], "ls": DASHES[(k + k // len(SERIES)) % len(DASHES)]}


def arrow(colour: str, width: float, ends: str = "-|>") -> dict[str, Any]:
    """Return the properties of an arrow from point to point."""
    return {"arrowstyle": ends, "color": colour, "lw": width, "mutation_scale": 6, "shrinkA": 0, "shrinkB": 0}


def rim(width: float) -> Any:
    """Return a path effect: a white rim about a line or letters, in points."""
    return withStroke(linewidth=width, foreground="white")


def counted(name: str, things: Sized, most: int) -> None:
    """Raise unless there are things to draw, and room for them."""
    if not 0 < len(things) <= most:
        raise ValueError(f"{name}: got {len(things)}, expected 1 to {most}")
