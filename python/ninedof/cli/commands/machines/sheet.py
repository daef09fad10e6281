"""`ninedof sheet`: the engineering sheet of a run or a design."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import ninedof as nd
from ninedof.cli.options import (
    CENTRE,
    GRAVITY,
    JOINT_ERROR,
    LEG_ERROR,
    LEG_STIFFNESS,
    LOAD,
    MASS,
    ONE_DESIGN,
    Options,
    Three,
    argument,
    loads_option,
    option,
    several,
    struct,
    triple,
    typed,
)
from ninedof.cli.posed import named_design, searching
from ninedof.design.duty import INTERNAL
from ninedof.sheet.tables import sheet_parts
from ninedof.support.arguments import finite
from ninedof.support.kept.files import own_or_new, write_whole

MARK = "leg,shortest"  # begins a table of legs
EXAMPLES = """
  ninedof sheet runs/20260101-120000 --csv legs.csv
  ninedof sheet runs/20260101-120000 --load "0 0 0 0 0 -100" --leg-error 0.01 --leg-stiffness 2e4
  ninedof sheet runs/20260101-120000 --mass 5 --centre 0 0 20 --twist "0 0 1 200 0 0"
  ninedof sheet design.toml --speed 200 --turn-deg 30 --json"""

VECTORS = {"twist": "wx wy wz vx vy vz", "twist_rate": "ax ay az ax ay az"}


@struct
class _Options(Options):
    design: str = argument(ONE_DESIGN)
    speed: float | None = option("Platform speed for the leg speeds, length/time; of the study, or 1.")
    turn_deg: float | None = option("Angular speed beside it, degrees/time; of the study, or 0.")
    internal: str | None = option(
        "How O moves: least, held, shifted or carried; as in the poses by default.", values=INTERNAL
    )
    twist: str | None = option(
        'A motion "wx wy wz vx vy vz": angular velocity (rad/time) and velocity of the platform.'
    )
    twist_rate: str | None = option("Its time derivative, 0 by default.")
    load: list[str] | None = option(LOAD)
    mass: float | None = option(MASS)
    centre: Three | None = triple(CENTRE)
    gravity: Three | None = triple(GRAVITY)
    leg_error: float | None = option(LEG_ERROR)
    joint_error: float | None = option(JOINT_ERROR)
    leg_stiffness: float | None = option(LEG_STIFFNESS)
    csv: Path | None = option("Write the table of the legs to this file.")


def sheet(options: _Options) -> None:
    """Print the engineering sheet: joints, legs, clearance, singularities and limits over the poses."""
    screen = options.screen
    if options.csv is not None:
        own_or_new("--csv", options.csv, MARK)
    chosen = named_design(options.design)
    vectors: dict[str, Any] = {
        name: several(typed(name), text, VECTORS[name]) for name, text in options.values_of(*VECTORS).items()
    }
    turn = options.turn_deg
    with searching(screen, "sheet", chosen):
        result = nd.sheet(
            chosen.machine,
            linear_speed=options.speed,
            angular_speed=None if turn is None else math.radians(finite("--turn-deg", turn, 0.0)),
            internal=options.internal,
            loads=loads_option(options.load) or None,
            mass=options.mass,
            centre=options.centre,
            gravity=options.gravity,
            leg_errors=options.leg_error,
            joint_errors=options.joint_error,
            leg_stiffness=options.leg_stiffness,
            **vectors,
        )
    screen.print(*sheet_parts(result))
    screen.data(result.to_dict())
    if options.csv is not None:  # last: a full disk does not lose the rest
        write_whole(options.csv, result.to_csv().encode())
        screen.print(f"legs {options.csv}")
