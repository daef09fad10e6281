"""`ninedof atlas`: a survey of the hexagonal family."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from ninedof.cli.request import request
from ninedof.cli.sweep_job import Job
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.design.study import Study
from ninedof.optimize.optimize import optimize
from ninedof.sweep import SweepResult
from ninedof.sweep import atlas as survey
from ninedof.sweep.sample import squared_radius_ratio

SHOWN = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0)
PLACE = 5
EXAMPLES = """[bold]Examples[/bold]

  ninedof atlas                                        a million designs

  ninedof atlas --designs 100000000 --out atlas        a hundred million; --resume after an interruption"""


@dataclass(frozen=True)
class Atlas(Job):
    """The options."""

    designs: Annotated[int, typer.Option(help="Number of designs.")] = 1_000_000
    seed: Annotated[int, typer.Option(help="Shifts the sequence of designs.")] = 0


@request(Atlas)
def atlas(job: Atlas) -> None:
    """Survey the hexagonal family: the distribution of its designs, and the best for each size of the base."""
    result, folder = job.compute(partial(survey, job.designs, job.seed), f"{job.designs:,} designs")
    rows = [
        {
            "radius_ratio": float(low),
            "condition_number": float(kappa),
            "design": dict(zip(result["variable"].tolist(), design.tolist(), strict=True)),
        }
        for low, kappa, design in zip(result["radius_ratio"], result["best"], result["design"], strict=True)
        if np.isfinite(kappa)
    ]
    data = {"atlas": {"designs": int(result["histogram"].sum()), "best": rows}}
    job.write(result, folder, data, lambda: job.screen.print(_table(result)), lambda: _figures(result))


def _figures(result: SweepResult) -> Iterator[tuple[str, Any]]:
    """Yield the figure, with the paper's optimum marked."""
    from ninedof import plot

    best = optimize(Study.paper()).best
    assert best is not None, "the paper's study has an optimum"
    sides = np.array([[best.variables[name] for name in HEXAGONAL]])
    yield "atlas", plot.atlas(result, (math.sqrt(squared_radius_ratio(sides)[0]), best.condition_number))


def _table(result: SweepResult) -> Table:
    """Return the table of the best designs up to a few sizes of the base."""
    table = Table(title="best of all designs up to a radius ratio", title_justify="left", title_style="bold")
    for head in ("radius ratio\nbelow", "condition\nnumber", *result["variable"].tolist()):
        table.add_column(head, justify="right")
    for limit in SHOWN:
        below = result["best"][: int(np.searchsorted(result["radius_ratio"], limit))]
        if np.isfinite(below).any():
            k = int(np.nanargmin(below))
            table.add_row(f"{limit:g}", f"{below[k]:.4f}", *(f"{v:.4f}" for v in result["design"][k]))
    return table
