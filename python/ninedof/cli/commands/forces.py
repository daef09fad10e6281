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
from ninedof.sheet.duty import weight_of
from ninedof.sheet.tables import load_words, weight_words
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

    load: Annotated[list[str] | None, LOAD] = None


def forces(options: ForcesOptions) -> Answer:
    """Print the forces in the legs that balance loads on the platform, positive where a leg pushes."""
    given = [load_option(text) for text in options.load or ()]
    at = DesignAtPoses.at(options)
    weight = weight_of(at.chosen.duty, None, None, None)
    loads = np.array(given or at.chosen.duty.loads.wrenches or np.zeros((int(weight is not None), 6)))
    if not len(loads):
        raise ValueError("--load: got none, expected one, or a run whose study has [loads] or [masses]")
    own = np.zeros((len(at.c), 6)) if weight is None else weight.wrench(at.c.rotation)
    wrenches = [row + own for row in loads]
    balances = [leg_forces(at.chosen.geometry, at.c, moment=one[:, :3], force=one[:, 3:]) for one in wrenches]
    result, unbalanced = (np.stack([getattr(each, name) for each in balances]) for name in ("forces", "unbalanced"))
    columns = [Column("leg"), *(Column(f"load {k}", "", RIGHT) for k in range(1, len(loads) + 1))]
    sizes = np.abs(wrenches).max(axis=(1, 2))
    least, most, tiny = result.min(axis=1), result.max(axis=1), 1e-12 * sizes
    rows = [(leg, *map(spread, least[:, k], most[:, k], tiny)) for k, leg in enumerate(LEGS)]
    parts: list[Any] = [load_words(k, row, at.chosen.unit) for k, row in enumerate(loads, start=1)]
    if weight is not None:
        parts.append(weight_words(weight, at.chosen.duty.tool))
    if weight is not None or not given:
        parts.append(f"from the study: {', '.join(['[loads]'] * (not given) + ['[masses]'] * (weight is not None))}")
    parts.append(Table("Forces, + pushes", columns, list(grouped(rows))))
    left = np.abs(unbalanced).max(axis=(1, 2)) > BALANCED * sizes
    for k in np.flatnonzero(left).tolist():
        parts.append(bold("singular", f": at some pose no leg forces balance all of load {k + 1}"))
    with_weight = {} if weight is None else {"weight": weight._asdict()}
    return at.answer(parts, {"loads": loads, **with_weight, "legs": LEGS, "forces": result, "unbalanced": unbalanced})
