"""The one look of all figures: colours, sizes, how a figure is made and written."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ninedof.support.files import write_whole

# Okabe and Ito's set: told apart with every common kind of colour vision.
EXTERNAL = "#0072B2"
UPPER = "#D55E00"
LOWER = "#009E73"
LEG_COLOURS = {"l": EXTERNAL, "q": UPPER, "r": LOWER}

BASE = "#46525E"
PLATFORM = "#A9B6C3"
INK = "#1F262D"
MUTED = "#6B7680"
GRID = "#E3E7EB"

# Paul Tol's "bright", without what the legs have: for designs and methods beside each other, in this order.
SERIES = ("#566370", "#AA3377", "#117799", "#B07D00")
ALARM = UPPER  # what went wrong
CONDITION = "cividis_r"  # condition numbers, dark where large; told apart with every common kind of colour vision

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
    "font.family": ["DejaVu Sans"],  # comes with matplotlib, so a figure is the same everywhere
    "font.size": TEXT_SIZE,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "legend.fontsize": SMALL_SIZE,
    "legend.frameon": False,
    "svg.fonttype": "path",
    "svg.hashsalt": "ninedof",  # ids from content, not from chance: equal figures are equal files
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
def look() -> Iterator[None]:
    """Apply the settings of all figures inside a `with`, and leave matplotlib as it was."""
    with rc_context(_SETTINGS):
        yield


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of the given size in inches, with its own Agg canvas."""
    figure = Figure(figsize=(width, height), dpi=DPI)
    FigureCanvasAgg(figure)
    return figure


def with_unit(name: str, unit: str) -> str:
    """Return an axis label: "zs (m)", or the bare name where lengths have no unit."""
    return f"{name} ({unit})" if unit else name


def power_of_ten(value: float, position: object = None) -> str:
    """Return "10⁻⁶" for 1e-6, and other numbers as they are; also a tick formatter, ten times as fast as mathtext."""
    exponent = math.log10(value) if value > 0 else math.nan
    if not math.isfinite(exponent) or abs(exponent - round(exponent)) > 1e-9:
        return f"{value:g}"
    return "10" + str(round(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


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
        Made where it is missing.
    stem : str
        File name without suffix.

    Returns
    -------
    list of pathlib.Path
        The PNG (150 dots an inch) and the SVG.

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
    with look():
        for kind, entries in metadata.items():
            image = io.BytesIO()
            figure.savefig(image, format=kind, dpi=DPI, metadata=entries)
            paths.append(write_whole(folder / f"{stem}.{kind}", image.getvalue()))
    return paths
