"""The style of all figures: colours, sizes, axes, and how a figure is created and saved."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter
from numpy.typing import ArrayLike

from ninedof.support.arrays import Floats
from ninedof.support.files import write_whole
from ninedof.support.units import with_unit as with_unit

# Okabe and Ito's palette, which is safe for colour-blind readers.
EXTERNAL = "#0072B2"
UPPER = "#D55E00"
LOWER = "#009E73"
LEG_COLOURS = {"l": EXTERNAL, "q": UPPER, "r": LOWER}

BASE = "#46525E"
PLATFORM = "#A9B6C3"
INK = "#1F262D"
MUTED = "#6B7680"
GRID = "#E3E7EB"

# Paul Tol's "bright" without the colours of the legs: for designs and methods in one figure, in this order.
SERIES = ("#566370", "#AA3377", "#117799", "#B07D00")
ALARM = UPPER  # failures and warnings
CONDITION = "cividis_r"  # condition numbers, dark if large; safe for colour-blind readers

TITLE_SIZE = 10.5
TEXT_SIZE = 9.0
SMALL_SIZE = 8.0

DPI = 150

_SETTINGS: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": MUTED,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.labelsize": TEXT_SIZE,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlecolor": INK,
    "axes.titlelocation": "left",
    "axes.titlesize": TITLE_SIZE,
    "axes.titleweight": "bold",
    "figure.facecolor": "white",
    "font.family": ["DejaVu Sans"],  # part of matplotlib, so that figures are the same on every machine
    "font.size": TEXT_SIZE,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "legend.fontsize": SMALL_SIZE,
    "legend.frameon": False,
    "svg.fonttype": "path",
    "svg.hashsalt": "ninedof",  # ids that are not random: equal figures give equal files
    "text.color": INK,
    "text.usetex": False,
    "xtick.color": MUTED,
    "xtick.labelcolor": INK,
    "xtick.labelsize": SMALL_SIZE,
    "ytick.color": MUTED,
    "ytick.labelcolor": INK,
    "ytick.labelsize": SMALL_SIZE,
}


@contextmanager
def settings() -> Iterator[None]:
    """Apply the settings of all figures inside a `with` block, and restore those of matplotlib."""
    with rc_context(_SETTINGS):
        yield


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of the given size in inches, with its own Agg canvas."""
    figure = Figure(figsize=(width, height), dpi=DPI)
    FigureCanvasAgg(figure)
    return figure


def power_of_ten(value: float, position: object = None) -> str:
    """Return "10⁻⁶" for 1e-6, and other numbers unchanged; also a tick formatter, ten times as fast as mathtext."""
    exponent = math.log10(value) if value > 0 else math.nan
    if not math.isfinite(exponent) or abs(exponent - round(exponent)) > 1e-9:
        return f"{value:g}"
    return "10" + str(round(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


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


def without_infinite(values: ArrayLike) -> Floats:
    """Return the values with NaN in place of infinite ones: the curve has a gap there."""
    array = np.asarray(values, dtype=np.float64)
    return np.where(np.isfinite(array), array, np.nan)


def key(colour: str, **line: Any) -> Line2D:
    """Return a legend entry without data."""
    return Line2D([], [], color=colour, **line)


def save(figure: Figure, directory: str | os.PathLike[str], stem: str) -> list[Path]:
    """Write a figure as PNG and SVG.

    Each file appears whole or not at all, and equal figures give equal bytes.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    directory : path
        Created if it does not exist.
    stem : str
        File name without suffix.

    Returns
    -------
    list of pathlib.Path
        The PNG (150 dots per inch) and the SVG.

    Raises
    ------
    OSError
        If the directory cannot be written to; no partial file is left.

    Examples
    --------
    >>> from ninedof import plot
    >>> paths = plot.save(figure, "run", "mechanism")  # doctest: +SKIP

    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    metadata: dict[str, dict[str, Any]] = {"png": {}, "svg": {"Date": None}}
    paths = []
    with settings():
        for kind, entries in metadata.items():
            image = io.BytesIO()
            figure.savefig(image, format=kind, dpi=DPI, metadata=entries)
            paths.append(write_whole(folder / f"{stem}.{kind}", image.getvalue()))
    return paths
