"""`ninedof modes`: the assembly modes of nine leg lengths."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
import typer
from rich import box
from rich.table import Table

from ninedof.cli import options, posed
from ninedof.cli.chosen_design import named_design
from ninedof.cli.screen import DONE, NO_RESULT, Screen
from ninedof.conditioning.conditioning import condition_number
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.position.forward_position import AssemblyModes, forward_position
from ninedof.robot.configuration import Configuration
from ninedof.sheet.pose_words import decimals_of, fixed
from ninedof.support.arrays import Floats
from ninedof.support.units import unit_entry, with_unit

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof modes design.toml                          all modes with the leg lengths of the neutral pose

  ninedof modes runs/20260101-120000 --position 10 0 350 --rotation-deg 0 5 0

  ninedof modes design.toml --lengths "5 5 5 3 3 3 4 4 4" --json | jq .count"""

SAME = 1e-6  # of Q, and of p and O over the longest leg


def modes(
    design: options.Design,
    lengths: Annotated[
        str | None, typer.Option(help='Nine leg lengths "l1 l2 l3 q1 q2 q3 r1 r2 r3", in place of those of a pose.')
    ] = None,
    position: posed.Position = None,
    rotation_deg: posed.RotationDeg = None,
    internal_point: posed.InternalPoint = None,
    json: options.Json = False,
) -> None:
    """Print every configuration with the leg lengths of a pose: the assembly modes."""
    screen = Screen(json)
    if lengths is not None and any(x is not None for x in (position, rotation_deg, internal_point)):
        raise ValueError("--lengths: got a pose beside it, expected one of the two")
    chosen = named_design(design)
    c = posed.chosen_poses(chosen, position, rotation_deg, internal_point, False)
    given = leg_lengths(chosen.geometry, c)[0]
    if lengths is not None:
        given = np.array(posed.several("--lengths", lengths, 9, "l1 l2 l3 q1 q2 q3 r1 r2 r3"))
    found = forward_position(chosen.geometry, given)
    kappa = condition_number(chosen.geometry, found, posed.length_at_home(chosen)) if found.count else np.zeros(0)
    if lengths is None:
        for line in posed.pose_lines(c, chosen):
            screen.print(line)
    screen.print(f"{found.count} assembly modes: {found.status}" + ("" if found.certain else ", the count is not sure"))
    if found.reason:
        screen.print(found.reason)
    this = _this(found, float(given.max()), c) if lengths is None else -1
    if found.count:
        screen.print(_table(found, kappa, this, chosen.configuration.rotation, chosen.unit))
    if this >= 0:
        screen.print("* the given pose")
    data = {"lengths": given, "status": found.status, "reason": found.reason, "count": found.count}
    data |= {"certain": found.certain, "given_pose": this + 1 if this >= 0 else None}
    screen.data(unit_entry(chosen.unit) | data | {"modes": posed.poses_data(found), "condition_number": kappa})
    raise typer.Exit(DONE if found.count else NO_RESULT)


def _this(found: AssemblyModes, size: float, c: Configuration) -> int:
    """Return the number of the mode that is the given pose, -1 without one."""
    moved = (found.position - c.position[0]) / size, (found.internal_point - c.internal_point[0]) / size
    apart = (*moved, (found.rotation - c.rotation[0]).reshape(-1, 9))
    near = np.flatnonzero(np.abs(np.concatenate(apart, axis=1)).max(axis=1, initial=0.0) <= SAME)
    return int(near[0]) if len(near) == 1 else -1


def _table(found: AssemblyModes, kappa: Floats, this: int, neutral: Floats, unit: str) -> Table:
    """Return a row for each mode: p, the rotation vector from the neutral orientation, O, the condition number."""
    table = Table(box=box.SIMPLE_HEAD, padding=0)
    p, o = (f"{with_unit(name, unit)}\nx" for name in ("p", "O"))
    for name in ("", p, "\ny", "\nz", "turn °\nx", "\ny", "\nz", o, "\ny", "\nz", "cond.\nno."):
        table.add_column(name, justify="right", no_wrap=True)
    decimals = decimals_of(found.position, found.internal_point)
    for k in range(len(found)):
        at, centre = ([fixed(x, decimals) for x in row] for row in (found.position[k], found.internal_point[k]))
        turn = [fixed(x, 1) for x in np.degrees(_rotation_vector(found.rotation[k] @ neutral.T))]
        table.add_row(f"{k + 1}{'*' if k == this else ''}", *at, *turn, *centre, f"{kappa[k]:.4g}")
    return table


def _rotation_vector(q: Floats) -> Floats:
    skew = 0.5 * np.array([q[2, 1] - q[1, 2], q[0, 2] - q[2, 0], q[1, 0] - q[0, 1]])
    angle = math.atan2(float(np.linalg.norm(skew)), 0.5 * (float(np.trace(q)) - 1.0))
    values, vectors = np.linalg.eigh(0.5 * (q + q.T))  # the axis, up to half a turn too
    axis = vectors[:, int(np.argmax(values))]
    return np.asarray(angle * (axis if axis @ skew >= 0.0 else -axis))
