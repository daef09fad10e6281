"""`ninedof failure`: what is left of a machine when a leg is locked, or carries nothing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import typer

from ninedof.cli.answer import Answer
from ninedof.cli.chosen_design import named_design
from ninedof.cli.options import LOAD, Design, Options
from ninedof.cli.posed import load_option
from ninedof.sheet.failure.failure import failure as failure_of
from ninedof.sheet.failure.tables import failure_parts
from ninedof.support.arguments import finite

PLACE = 3
EXAMPLES = """[bold]Examples[/bold]

  ninedof failure runs/20260101-120000

  ninedof failure runs/20260101-120000 --condition 10 --load "0 0 0 0 0 -100"

  ninedof failure design.toml --no-pairs --json | jq .locked"""


@dataclass(frozen=True, kw_only=True)
class FailureOptions(Options):
    """The options."""

    design: Design
    condition: Annotated[
        float | None,
        typer.Option(help="The condition number that shares of the region are about; twice the healthy worst."),
    ] = None
    load: Annotated[list[str] | None, LOAD] = None
    pairs: Annotated[bool, typer.Option(help="Lock each pair of legs too.")] = True


def failure(options: FailureOptions) -> Answer:
    """Print what is left when each leg, and each pair, is locked at its length, and when each leg carries nothing.

    Over the poses of the study, of a region study over its region. Loads and masses of a run's study are taken.
    """
    chosen = named_design(options.design)
    bound = None if options.condition is None else finite("--condition", options.condition, 1.0)
    result = failure_of(
        chosen.result or chosen.design,
        condition_number=bound,
        loads=[load_option(text) for text in options.load] if options.load else None,
        pairs=options.pairs,
    )
    return Answer(failure_parts(result), result.to_dict())
