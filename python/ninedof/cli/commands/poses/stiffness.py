"""`ninedof stiffness`: the stiffness of the platform with locked legs."""

from __future__ import annotations

from typing import Any

import numpy as np

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import LEG_STIFFNESS, option, struct
from ninedof.cli.posed import PosesOptions
from ninedof.support.arguments import finite
from ninedof.support.arrays import Floats
from ninedof.support.units import per, times, with_unit
from ninedof.tables import Table, columns, grouped

EXAMPLES = """
  ninedof stiffness design.toml --leg-stiffness 2e4
  ninedof stiffness runs/20260101-120000 --leg-stiffness 2e4 --all-poses
  ninedof stiffness runs/20260101-120000#7 --leg-stiffness 2e4 --json | jq .least"""

COLUMNS = (">turn x", ">turn y", ">turn z", ">p x", ">p y", ">p z")
ROWS = ("mx", "my", "mz", "fx", "fy", "fz")


@struct
class _Options(PosesOptions):
    leg_stiffness: float = option(LEG_STIFFNESS, ...)


def stiffness(options: _Options) -> Answer:
    """Print the stiffness matrix of the platform, legs locked and O free to settle, and the least stiffness."""
    finite("--leg-stiffness", options.leg_stiffness, 0.0)
    at = options.at()
    unit, force = at.unit, at.duty.force_unit or "force"
    result = nd.stiffness(at.geometry, at.c, options.leg_stiffness)
    least = nd.sheet(at.geometry, at.c, leg_stiffness=options.leg_stiffness).stiffness
    assert least is not None, "a stiffness was given"
    least = least._replace(**{name: one._replace(pose=at.first(one.pose)) for name, one in least._asdict().items()})
    values = [f"{one.value:.5g}{f' (pose {one.pose})' if len(at.c) > 1 else ''}" for one in least]
    along, about = per(force, unit) or "force per displacement", times(force, unit) or "moment"
    parts: list[Any] = [_matrix(result[0], unit, force)] if len(at.c) == 1 else []
    parts += [
        f"leg stiffness {options.leg_stiffness:g} {along}, each leg",
        f"least stiffness: {values[0]} in {along}, the platform free to turn",
        f"least turning stiffness: {values[1]} in {about} per radian, the platform free to shift",
    ]
    ends = {name: one._asdict() for name, one in least._asdict().items()}
    data = {"leg_stiffness": options.leg_stiffness, "stiffness": result, "least": ends}
    return at.answer(parts, data, [one.pose for one in least])


def _matrix(k: Floats, unit: str, force: str) -> Table:
    """Return the matrix that takes (turn, displacement of p) to (moment, force), base axes."""
    tiny = 1e-12 * float(np.abs(k).max())
    rows = [(name, *("0" if abs(x) <= tiny else f"{x:.4g}" for x in row)) for name, row in zip(ROWS, k, strict=True)]
    moment, forces = with_unit("moment", times(force, unit)), "force (N)" if force == "N" else "force"
    title = f"Stiffness: {moment} and {forces} for a turn (rad) and a displacement of p"
    return Table(with_unit(title, unit), columns("", *COLUMNS), list(grouped(rows)))
