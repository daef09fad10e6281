"""A figure as PNG, SVG and PDF."""

from __future__ import annotations

import io
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from matplotlib.image import imsave
from matplotlib.text import Text

from ninedof.plot import style
from ninedof.support.arguments import instance, path_argument, shown
from ninedof.support.kept.files import write_whole
from ninedof.support.text import escaped

KINDS: dict[str, Any] = {"png": {}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}
"""Suffixes of files, with metadata that differ from day to day left out."""


def save(figure: Figure, directory: str | os.PathLike[str], stem: str) -> list[Path]:
    """Write a figure as PNG, SVG and PDF.

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
        The PNG (200 dots per inch), the SVG and the PDF.

    Raises
    ------
    OSError
        If the directory cannot be written to; no partial file is left.

    Examples
    --------
    >>> from ninedof import plot
    >>> paths = plot.save(figure, "run", "mechanism")  # doctest: +SKIP

    """
    instance("figure", figure, Figure)
    folder = path_argument("directory", directory)
    if path_argument("stem", stem).name != stem:
        raise ValueError(f"stem: got {shown(stem)}, expected a file name without folder")
    folder.mkdir(parents=True, exist_ok=True)
    return [write_whole(folder / f"{stem}.{kind}", image) for kind, image in _laid_out(figure)]


def save_as(figure: Figure, path: Path) -> Path:
    """Write a figure as one file, PNG, SVG or PDF by its suffix."""
    ((_, image),) = _laid_out(figure, [path.suffix.lower().lstrip(".")])
    return write_whole(path, image)


def picture(image: Any) -> bytes:
    """Return an array of pixels as a PNG file."""
    stream = io.BytesIO()
    imsave(stream, image, format="png")
    return stream.getvalue()


def _laid_out(figure: Figure, kinds: Iterable[str] = KINDS) -> Iterator[tuple[str, bytes]]:
    r"""Yield suffix and content of each file, in the settings of all figures; control characters of names as \x1b."""
    with style.settings():
        for text in figure.findobj(Text):
            text.set_text(escaped(text.get_text()))  # SVG has no place for them
        if (engine := figure.get_layout_engine()) is not None:
            engine.execute(figure)  # once for all files
            figure.set_layout_engine("none")
        for kind in kinds:
            image = io.BytesIO()
            figure.savefig(image, format=kind, dpi=style.DPI, metadata=KINDS[kind])
            yield kind, image.getvalue()
