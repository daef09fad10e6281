"""`ninedof evaluate`: the indices of one design, and of a run its poses and limits in short."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
import typer
from rich.table import Table

from ninedof.cli import options
from ninedof.cli.chosen_design import chosen_design, with_length
from ninedof.cli.screen import Screen
from ninedof.cli.sheet_tables import limits_table, poses_table
from ninedof.design.indices import computed
from ninedof.runs.design_file import indices
from ninedof.sheet.sheet import sheet
from ninedof.support.units import amount, unit_entry, with_unit

PLACE = 3
EXAMPLES = """[bold]Examples[/bold]

  ninedof evaluate --a1 0 --a2 5.8124 --b1 2.9062 --b2 0 --zp 3.9828 --zs 2.4435

  ninedof evaluate design.toml --lc optimal

  ninedof evaluate runs/20260101-120000    the best design of a run

  ninedof evaluate runs/20260101-120000#7    the design of point 7 of a front"""


def evaluate(
    design: Annotated[str | None, typer.Argument(help=f"{options.DESIGN[0].upper()}{options.DESIGN[1:]}.")] = None,
    a1: options.BaseSide1 = None,
    a2: options.BaseSide2 = None,
    b1: options.PlatformSide1 = None,
    b2: options.PlatformSide2 = None,
    zp: options.Height = None,
    zs: options.InternalHeight = None,
    theta_z_deg: options.TwistDeg = None,
    lc: options.Lc = None,
    json: options.Json = False,
) -> None:
    """Print the indices of one design and configuration; of a run also its study's poses and limits in short."""
    screen = Screen(json)
    sides = {"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs}
    given = with_length(chosen_design(design, sides, theta_z_deg), lc)
    values = unit_entry(given.unit) | indices(given.design)
    table = Table(title="Indices", title_justify="left", title_style="bold", show_header=False)
    table.add_column()
    table.add_column(justify="right")
    for name, index in computed().items():
        if name in values and name not in ("singular_values", "leg_lengths"):
            table.add_row(index.words, "  ".join(map(_digits, np.atleast_1d(values[name]))))
    length = with_unit("characteristic length", given.unit)
    table.add_row(length, _digits(values["characteristic_length"]), end_section=True)
    for k, value in enumerate(values["singular_values"]):
        table.add_row(f"singular value {k + 1} of J'", _digits(value), end_section=k == 5)
    for kind, lengths in values["leg_lengths"].items():
        table.add_row(with_unit(f"legs {kind}1 {kind}2 {kind}3", given.unit), "  ".join(map(_digits, lengths)))
    table.add_section()
    for kind, found in values["characteristic_lengths"].items():
        if math.isfinite(found["length"]):
            length = amount(_digits(found["length"]), given.unit)
            table.add_row(f"at the {kind} length {length}", f"k = {_digits(found['condition_number'])}")
    screen.print(table)
    if values["singular"]:
        screen.print("This configuration is singular: the platform or O can move with all legs locked.")
    p, o = given.configuration.position[2], given.configuration.internal_point[2]
    if not 0.0 < o < p:
        screen.print("O is not between base and platform: studies require 0 < zs < zp.")
    if given.result is not None:
        found = sheet(given.result, characteristic_length=given.characteristic_length)
        if len(found.configurations) > 1:
            screen.print(poses_table(found))
        if found.limits:
            screen.print(limits_table(found))
        values |= {"sheet": found.to_dict()}
    screen.data(values)


def _digits(value: float) -> str:
    """Return six decimals, and of what is smaller than 1e-3 six figures."""
    return f"{value:.6f}" if value == 0.0 or abs(value) >= 1e-3 else f"{value:.6g}"
