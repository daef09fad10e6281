"""`ninedof stiffness`: the stiffness of the platform with locked legs."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import typer
from rich import box
from rich.table import Table

from ninedof.cli import options, posed
from ninedof.cli.chosen_design import named_design
from ninedof.cli.screen import Screen
from ninedof.sheet.sheet import Extreme, sheet
from ninedof.statics.statics import stiffness as stiffness_of
from ninedof.support.arguments import finite
from ninedof.support.arrays import Floats
from ninedof.support.units import per, times, unit_entry

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof stiffness design.toml --leg-stiffness 2e4

  ninedof stiffness runs/20260101-120000 --leg-stiffness 2e4 --all-poses

  ninedof stiffness runs/20260101-120000#7 --leg-stiffness 2e4 --json | jq .least"""

ROWS = ("turn x", "turn y", "turn z", "p x", "p y", "p z")


def stiffness(
    design: options.Design,
    leg_stiffness: Annotated[float, typer.Option(help="Stiffness of each leg, force/length.")],
    position: posed.Position = None,
    rotation_deg: posed.RotationDeg = None,
    internal_point: posed.InternalPoint = None,
    all_poses: posed.AllPoses = False,
    json: options.Json = False,
) -> None:
    """Print the stiffness matrix of the platform, legs locked and O free to settle, and the least stiffness."""
    screen = Screen(json)
    finite("--leg-stiffness", leg_stiffness, 0.0)
    chosen = named_design(design)
    c = posed.chosen_poses(chosen, position, rotation_deg, internal_point, all_poses)
    found = stiffness_of(chosen.geometry, c, leg_stiffness)
    least = sheet(chosen.geometry, c, leg_stiffness=leg_stiffness).stiffness
    assert least is not None, "a stiffness was given"
    for line in posed.pose_lines(c, chosen):
        screen.print(line)
    if len(c) == 1:
        screen.print(_matrix(found[0]))
    at, turning = (_least(one, len(c)) for one in least)
    along = per("force", chosen.unit) or "force per displacement"
    about = times("force", chosen.unit) or "moment"
    screen.print(f"least stiffness: {at} in {along}, the platform free to turn")
    screen.print(f"least turning stiffness: {turning} in {about} per radian, the platform free to shift")
    for line in posed.mentioned(c, [one.pose for one in least], chosen.unit):
        screen.print(line)
    data: dict[str, Any] = {"poses": posed.poses_data(c), "leg_stiffness": leg_stiffness, "stiffness": found}
    data["least"] = {name: one._asdict() for name, one in least._asdict().items()}
    screen.data(unit_entry(chosen.unit) | data)


def _least(one: Extreme, count: int) -> str:
    return f"{one.value:.5g}" + (f" (pose {one.pose})" if count > 1 else "")


def _matrix(k: Floats) -> Table:
    """Return the matrix that takes (turn, displacement of p) to (moment, force), base axes."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), title_justify="left", title_style="bold")
    table.title = "Stiffness: moment and force for a turn (rad) and a displacement of p"
    for name in ("", *ROWS):
        table.add_column(name, justify="right" if name else "left")
    tiny = 1e-12 * float(np.abs(k).max())
    for j, (name, row) in enumerate(zip(("mx", "my", "mz", "fx", "fy", "fz"), k, strict=True)):
        table.add_row(name, *("0" if abs(x) <= tiny else f"{x:.4g}" for x in row), end_section=j == 2)
    return table
