"""Designs beside each other, as `compare` and `evaluate --set` print and draw them."""

from __future__ import annotations

import os
from pathlib import Path

from ninedof.cli.answer import FIGURES, Answer
from ninedof.sheet.comparison import Comparison


def compared(comparison: Comparison, plot: Path | None) -> Answer:
    """Return the answer of a comparison, with its figure where one is asked for."""
    parts, data = comparison.parts(), comparison.to_dict()
    if plot is not None:
        plot_argument(plot)
        from ninedof.plot.compare import compare
        from ninedof.plot.files import save_as

        save_as(compare(comparison), plot)
        parts.append(f"figure: {plot}")
        data["figure"] = os.fspath(plot)
    return Answer(parts, data)


def plot_argument(plot: Path | None) -> None:
    """Raise unless the file of a figure has a suffix that is known."""
    if plot is not None and plot.suffix.lower() not in FIGURES:
        raise ValueError(f"--plot: got {plot}, expected a file that ends in {', '.join(FIGURES)}")
