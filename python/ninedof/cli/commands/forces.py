"""`ninedof forces`: the leg forces that balance loads on the platform."""

from __future__ import annotations

from typing import Annotated

import numpy as np
import typer
from rich.table import Table

from ninedof.cli import options, posed
from ninedof.cli.chosen_design import named_design
from ninedof.cli.screen import Screen, bold
from ninedof.robot.leg_names import LEGS
from ninedof.sheet.pose_words import vector_words
from ninedof.statics.statics import leg_forces
from ninedof.support.arrays import Floats
from ninedof.support.units import amount, times, unit_entry

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof forces design.toml --load "0 0 0 0 0 -100"

  ninedof forces runs/20260101-120000 --load "0 0 0 0 0 -100" --load "0 5 0 0 0 -100" --all-poses

  ninedof forces runs/20260101-120000#7 --load "0 0 0 0 0 -100" --position 10 0 350 --json | jq .forces"""

BALANCED = 1e-9  # of the load


def forces(
    design: options.Design,
    load: Annotated[
        list[str],
        typer.Option(help='A load "mx my mz fx fy fz" on the platform: moment about p and force. May be repeated.'),
    ],
    position: posed.Position = None,
    rotation_deg: posed.RotationDeg = None,
    internal_point: posed.InternalPoint = None,
    all_poses: posed.AllPoses = False,
    json: options.Json = False,
) -> None:
    """Print the forces in the legs that balance loads on the platform, positive where a leg pushes."""
    screen = Screen(json)
    loads = np.array([posed.load_option(text) for text in load])
    chosen = named_design(design)
    c = posed.chosen_poses(chosen, position, rotation_deg, internal_point, all_poses)
    one = [leg_forces(chosen.geometry, c, moment=row[:3], force=row[3:]) for row in loads]
    found, unbalanced = (np.stack([getattr(each, name) for each in one]) for name in ("forces", "unbalanced"))
    for line in posed.pose_lines(c, chosen):
        screen.print(line)
    for k, row in enumerate(loads):
        moment = amount(vector_words(row[:3]), times("force", chosen.unit))
        screen.print(f"load {k + 1}: moment {moment}, force {vector_words(row[3:])}")
    screen.print(_table(loads, found))
    left = np.abs(unbalanced).max(axis=(1, 2)) > BALANCED * np.abs(loads).max(axis=1)
    for k in np.flatnonzero(left).tolist():
        screen.print(bold("singular", f": at some pose no leg forces balance all of load {k + 1}"))
    data = {"poses": posed.poses_data(c), "loads": loads, "legs": LEGS}
    screen.data(unit_entry(chosen.unit) | data | {"forces": found, "unbalanced": unbalanced})


def _table(loads: Floats, found: Floats) -> Table:
    """Return a row for each leg and a column for each load."""
    table = Table(title="Forces, + pushes", title_justify="left", title_style="bold")
    table.add_column("leg")
    for k in range(len(loads)):
        table.add_column(f"load {k + 1}", justify="right")
    tiny = 1e-12 * np.abs(loads).max(axis=1)
    for k, leg in enumerate(LEGS):
        ends = [(float(f[:, k].min()), float(f[:, k].max())) for f in found]
        cells = (_range(low, high, least) for (low, high), least in zip(ends, tiny, strict=True))
        table.add_row(leg, *cells, end_section=k % 3 == 2)
    return table


def _range(low: float, high: float, tiny: float) -> str:
    """Return one number or both ends; 0 where only rounding is left."""
    shown = ["0" if abs(x) <= tiny else f"{x:.4g}" for x in (low, high)]
    return shown[0] if shown[0] == shown[1] else f"{shown[0]} to {shown[1]}"
