"""`ninedof failure`: what is left of a machine when a leg is locked, or carries nothing."""

from __future__ import annotations

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import LOAD, ONE_DESIGN, Options, argument, loads_option, option, struct
from ninedof.cli.posed import named_design, searching
from ninedof.sheet.failure.tables import failure_parts

EXAMPLES = """
  ninedof failure runs/20260101-120000
  ninedof failure runs/20260101-120000 --condition 10 --load "0 0 0 0 0 -100"
  ninedof failure design.toml --no-pairs --json | jq .locked"""


@struct
class _Options(Options):
    design: str = argument(ONE_DESIGN)
    condition: float | None = option(
        "The condition number that shares of the region are about; twice the healthy worst."
    )
    load: list[str] | None = option(LOAD)
    pairs: bool = option("Lock each pair of legs too.", True)


def failure(options: _Options) -> Answer:
    """Print what is left when each leg, and each pair, is locked at its length, and when each leg carries nothing.

    Over the poses of the study, of a region study over its region. Loads and masses of a run's study are taken.
    """
    chosen = named_design(options.design)
    with searching(options.screen, "failure", chosen):
        result = nd.failure(
            chosen.machine,
            condition_number=options.condition,
            loads=loads_option(options.load) or None,
            pairs=options.pairs,
        )
    return Answer([*chosen.tool.remark(chosen.unit), *failure_parts(result)], result.to_dict())
