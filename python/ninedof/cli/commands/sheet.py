"""`ninedof sheet`: the engineering sheet of a run or a design."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer

from ninedof.cli import options
from ninedof.cli.chosen_design import named_design
from ninedof.cli.posed import load_option, several
from ninedof.cli.screen import Screen
from ninedof.cli.sheet_tables import sheet_tables
from ninedof.sheet.sheet import sheet as sheet_of
from ninedof.support.arguments import finite
from ninedof.support.files import own_or_new, write_whole

PLACE = 3
MARK = "leg,shortest"  # begins a table of legs
EXAMPLES = """[bold]Examples[/bold]

  ninedof sheet runs/20260101-120000 --csv legs.csv

  ninedof sheet runs/20260101-120000 --load "0 0 0 0 0 -100" --leg-error 0.01 --leg-stiffness 2e4

  ninedof sheet runs/20260101-120000 --mass 5 --centre "0 0 20" --twist "0 0 1 200 0 0"

  ninedof sheet design.toml --speed 200 --turn-deg 30 --json"""


def sheet(
    design: options.Design,
    speed: Annotated[float, typer.Option(help="Platform speed for the leg speeds, length/time.")] = 1.0,
    turn_deg: Annotated[float, typer.Option(help="Angular speed beside it, degrees/time.")] = 0.0,
    internal: Annotated[
        str | None, typer.Option(help="How O moves: least, held, shifted or carried; as in the poses by default.")
    ] = None,
    twist: Annotated[
        str | None,
        typer.Option(help='A motion "wx wy wz vx vy vz": angular velocity (rad/time) and velocity of the platform.'),
    ] = None,
    twist_rate: Annotated[str | None, typer.Option(help="Its time derivative, 0 by default.")] = None,
    load: Annotated[
        list[str] | None,
        typer.Option(help='A load "mx my mz fx fy fz" on the platform: moment about p and force. May be repeated.'),
    ] = None,
    mass: Annotated[float | None, typer.Option(help="Mass of the platform: its weight is added to each load.")] = None,
    centre: Annotated[
        str | None, typer.Option(help='Its centre "x y z" in the platform frame; the origin by default.')
    ] = None,
    gravity: Annotated[
        str | None, typer.Option(help='Force per mass "x y z", base axes; "0 0 -9.81" by default: newtons for kg.')
    ] = None,
    leg_error: Annotated[float | None, typer.Option(help="Tolerance of the leg lengths.")] = None,
    joint_error: Annotated[float | None, typer.Option(help="Tolerance of the joint centres, a radius.")] = None,
    leg_stiffness: Annotated[float | None, typer.Option(help="Stiffness of each leg, force/length.")] = None,
    csv: Annotated[Path | None, typer.Option(help="Write the table of the legs to this file.")] = None,
    json: options.Json = False,
) -> None:
    """Print the engineering sheet: joints, legs, clearance, singularities and limits over the poses."""
    screen = Screen(json)
    if csv is not None and not csv.absolute().parent.is_dir():
        raise ValueError(f"--csv: got {csv}, expected a file in a folder that exists")
    if csv is not None:
        own_or_new("--csv", csv, MARK)
    chosen = named_design(design)
    found = sheet_of(
        chosen.result or chosen.design,
        linear_speed=speed,
        angular_speed=math.radians(finite("--turn-deg", turn_deg, 0.0)),
        internal=internal,
        twist=_given("twist", twist, "wx wy wz vx vy vz"),
        twist_rate=_given("twist-rate", twist_rate, "ax ay az ax ay az"),
        loads=[load_option(text) for text in load] if load else None,
        mass=mass,
        centre=_given("centre", centre, "x y z"),
        gravity=_given("gravity", gravity, "x y z"),
        leg_errors=leg_error,
        joint_errors=joint_error,
        leg_stiffness=leg_stiffness,
    )
    for part in sheet_tables(found):
        screen.print(part)
    screen.data(found.to_dict())
    if csv is not None:  # last: a full disk does not lose the rest
        write_whole(csv, found.to_csv().encode())


def _given(option: str, text: str | None, expected: str) -> list[float] | None:
    return None if text is None else several(f"--{option}", text, len(expected.split()), expected)
