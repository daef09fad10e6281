"""`ninedof atlas`: a survey of the hexagonal family."""

from __future__ import annotations

import math
from functools import partial
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from ninedof.atlas import atlas as survey
from ninedof.atlas.sample import squared_radius_ratio
from ninedof.cli.long_run import compute, run_folder, write
from ninedof.cli.options import Figures, Json, Out, Report, Resume, Scheduler
from ninedof.cli.screen import INTERRUPTED, Screen
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.design.study import Study
from ninedof.optimize.optimize import optimize
from ninedof.sweep import SweepResult

SHOWN = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0)


PLACE = 5
EXAMPLES = """[bold]Examples[/bold]

  ninedof atlas                                        a million designs

  ninedof atlas --designs 100000000 --out atlas        a hundred million; --resume after an interruption"""


def atlas(
    designs: Annotated[int, typer.Option(help="Number of designs.")] = 1_000_000,
    seed: Annotated[int, typer.Option(help="Shifts the sequence of designs.")] = 0,
    out: Out = None,
    resume: Resume = False,
    scheduler: Scheduler = None,
    figures: Figures = True,
    report: Report = True,
    json: Json = False,
) -> None:
    """Survey the hexagonal family: the distribution of its designs, and the best for each size of the base."""
    screen = Screen(json)
    asked = partial(survey, designs, seed)
    with run_folder(out, resume) as directory:
        result = compute(asked, f"{designs:,} designs", directory, scheduler, screen)
    if result is None:
        raise typer.Exit(INTERRUPTED)
    ratio, best = result["radius_ratio"], result["best"]
    rows = [
        {
            "radius_ratio": float(low),
            "condition_number": float(kappa),
            "design": dict(zip(result["variable"].tolist(), design.tolist(), strict=True)),
        }
        for low, kappa, design in zip(ratio, best, result["design"], strict=True)
        if np.isfinite(kappa)
    ]
    data = {"atlas": {"designs": int(result["histogram"].sum()), "best": rows}}

    def draw() -> list[tuple[str, Any]]:
        from ninedof import plot

        best = optimize(Study.paper()).best
        assert best is not None, "the paper's study has an optimum"
        sides = np.array([[best.variables[name] for name in HEXAGONAL]])
        return [("atlas", plot.atlas(result, (math.sqrt(squared_radius_ratio(sides)[0]), best.condition_number)))]

    words = partial(screen.print, _table(result))
    write(result, directory, "atlas", draw if figures else None, screen, data, words, report)


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
