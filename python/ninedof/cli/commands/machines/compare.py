"""`ninedof compare`: two or three machines beside each other."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import ninedof as nd
from ninedof.cli.answer import FIGURES, Answer
from ninedof.cli.options import DESIGN, PLOT, Options, argument, option, struct
from ninedof.cli.posed import named_design, searching

EXAMPLES = """
  ninedof compare runs/20260101-120000 runs/20260102-120000
  ninedof compare front#1 front#7 design.toml --plot plates.png"""


@struct
class _Options(Options):
    designs: list[str] = argument(f"Two or three of: {DESIGN}.")
    plot: Path | None = option(PLOT)


def compare(options: _Options) -> Answer:
    """Print two or three machines beside each other: numbers, limits, what differs in their studies."""
    plot_argument(options.plot)
    chosen = [named_design(name) for name in options.designs]
    with searching(options.screen, "compare", *chosen):
        comparison = nd.compare(*(one.machine for one in chosen))
    legend = [f"{letter}: {name}" for letter, name in zip(comparison.names, options.designs, strict=True)]
    answer = compared(comparison, options.plot, legend)
    data = answer.data | {"designs": list(options.designs)}
    return answer._replace(parts=[*legend, *answer.parts], data=data)


def compared(comparison: nd.Comparison, plot: Path | None, legend: Sequence[str] = ()) -> Answer:
    """Return the answer of a comparison, with its figure, by its own names or a legend's, where one is asked for."""
    parts, data = comparison.parts(), comparison.to_dict()
    if plot is not None:
        named = replace(comparison, names=tuple(legend)) if legend else comparison
        nd.plot.files.save_as(nd.plot.compare(named), plot)
        parts.append(f"figure: {plot}")
        data["figure"] = os.fspath(plot)
    return Answer(parts, data)


def plot_argument(plot: Path | None) -> None:
    """Raise unless the file of a figure has a suffix that is known."""
    if plot is not None and plot.suffix.lower() not in FIGURES:
        raise ValueError(f"--plot: got {plot}, expected a file that ends in {', '.join(FIGURES)}")
