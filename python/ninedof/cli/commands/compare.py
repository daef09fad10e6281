"""`ninedof compare`: two or three machines beside each other."""

from __future__ import annotations

from pathlib import Path

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.chosen_design import named_design
from ninedof.cli.compared import compared, plot_argument
from ninedof.cli.options import DESIGN, PLOT, Options, argument, option, struct

PLACE = 3
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
    comparison = nd.compare(*(one.machine for one in chosen))
    legend = [f"{letter}: {name}" for letter, name in zip(comparison.names, options.designs, strict=True)]
    answer = compared(comparison, options.plot, legend)
    data = answer.data | {"designs": list(options.designs)}
    return answer._replace(parts=[*legend, *answer.parts], data=data)
