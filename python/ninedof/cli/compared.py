"""Designs beside each other, as `compare` and `evaluate --set` print and draw them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ninedof.cli.answer import FIGURES, Answer
from ninedof.sheet.comparison import Comparison


def compared(comparison: Comparison, plot: Path | None, legend: Sequence[str] = ()) -> Answer:
    """Return the answer of a comparison, with its figure, by its own names or a legend's, where one is asked for."""
    parts, data = comparison.parts(), comparison.to_dict()
    if plot is not None:
        plot_argument(plot)
        from ninedof.plot.compare import compare
        from ninedof.plot.files import save_as

        save_as(compare(replace(comparison, names=tuple(legend)) if legend else comparison), plot)
        parts.append(f"figure: {plot}")
        data["figure"] = os.fspath(plot)
    return Answer(parts, data)


def plot_argument(plot: Path | None) -> None:
    """Raise unless the file of a figure has a suffix that is known."""
    if plot is not None and plot.suffix.lower() not in FIGURES:
        raise ValueError(f"--plot: got {plot}, expected a file that ends in {', '.join(FIGURES)}")
