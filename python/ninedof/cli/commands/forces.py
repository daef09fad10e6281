"""`ninedof forces`: the leg forces that balance loads on the platform."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from ninedof.cli.answer import Answer
from ninedof.cli.options import LOAD
from ninedof.cli.posed import DesignAtPoses, PosesOptions, load_option
from ninedof.cli.screen import bold
from ninedof.robot.leg_names import LEGS
from ninedof.sheet.tables import load_words
from ninedof.statics.statics import leg_forces
from ninedof.tables import RIGHT, Column, Table, grouped
from ninedof.tables.numbers import spread

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof forces design.toml --load "0 0 0 0 0 -100"

  ninedof forces runs/20260101-120000 --load "0 0 0 0 0 -100" --load "0 5 0 0 0 -100" --all-poses

  ninedof forces runs/20260101-120000#7 --load "0 0 0 0 0 -100" --position 10 0 350 --json | jq .forces"""

BALANCED = 1e-9  # of the load


@dataclass(frozen=True, kw_only=True)
class ForcesOptions(PosesOptions):
    """The options."""

    load: Annotated[list[str], LOAD]


def forces(options: ForcesOptions) -> Answer:
    """Print the forces in the legs that balance loads on the platform, positive where a leg pushes."""
    loads = np.array([load_option(text) for text in options.load])
    at = DesignAtPoses.at(options)
    balances = [leg_forces(at.chosen.geometry, at.c, moment=row[:3], force=row[3:]) for row in loads]
    result, unbalanced = (np.stack([getattr(each, name) for each in balances]) for name in ("forces", "unbalanced"))
    columns = [Column("leg"), *(Column(f"load {k}", "", RIGHT) for k in range(1, len(loads) + 1))]
    least, most, tiny = result.min(axis=1), result.max(axis=1), 1e-12 * np.abs(loads).max(axis=1)
    rows = [(leg, *map(spread, least[:, k], most[:, k], tiny)) for k, leg in enumerate(LEGS)]
    parts: list[Any] = [load_words(k, row, at.chosen.unit) for k, row in enumerate(loads, start=1)]
    parts.append(Table("Forces, + pushes", columns, list(grouped(rows))))
    left = np.abs(unbalanced).max(axis=(1, 2)) > BALANCED * np.abs(loads).max(axis=1)
    for k in np.flatnonzero(left).tolist():
        parts.append(bold("singular", f": at some pose no leg forces balance all of load {k + 1}"))
    return at.answer(parts, {"loads": loads, "legs": LEGS, "forces": result, "unbalanced": unbalanced})
