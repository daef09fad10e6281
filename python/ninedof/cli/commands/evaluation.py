"""`ninedof evaluate`: the indices of one design."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from rich.table import Table

from ninedof.cli.commands.screen import DONE, Screen
from ninedof.conditioning.characteristic_length import KINDS
from ninedof.design.indices import computed
from ninedof.runs.design_file import Design, hexagonal_design, indices, load_design


def evaluate(
    design: Path | None, sides: Mapping[str, float | None], theta_z_deg: float | None, lc: str | None, json: bool
) -> int:
    """Print the indices of a design."""
    screen = Screen(json)
    given = chosen_design(design, sides, theta_z_deg)
    if lc is not None:
        given = given._replace(characteristic_length=length_option(lc))
    values = indices(given)
    table = Table(title="Indices", title_justify="left", title_style="bold", show_header=False)
    table.add_column()
    table.add_column(justify="right")
    for name, index in computed().items():
        if name in values and name not in ("singular_values", "leg_lengths"):
            table.add_row(index.words, "  ".join(f"{value:.6f}" for value in np.atleast_1d(values[name])))
    table.add_row("characteristic length", f"{values['characteristic_length']:.6f}", end_section=True)
    for k, value in enumerate(values["singular_values"]):
        table.add_row(f"singular value {k + 1} of J'", f"{value:.6f}", end_section=k == 5)
    for kind, lengths in values["leg_lengths"].items():
        table.add_row(f"legs {kind}1 {kind}2 {kind}3", "  ".join(f"{v:.6f}" for v in lengths))
    table.add_section()
    for kind, found in values["characteristic_lengths"].items():
        if math.isfinite(found["length"]):
            table.add_row(f"at the {kind} length {found['length']:.6f}", f"k = {found['condition_number']:.6f}")
    screen.print(table)
    if values["singular"]:
        screen.print("This configuration is singular: with all legs locked, the platform or O can still move.")
    p, o = given.configuration.position[2], given.configuration.internal_point[2]
    if not 0.0 < o < p:
        screen.print("O is not between base and platform: studies keep 0 < zs < zp.")
    screen.data(values)
    return DONE


def chosen_design(design: Path | None, sides: Mapping[str, float | None], theta_z_deg: float | None) -> Design:
    """Return the design of a file, or of sides and heights."""
    named = {name: value for name, value in sides.items() if value is not None}
    if design is not None:
        if named or theta_z_deg is not None:
            raise ValueError(f"design: got a file and {', '.join(named) or '--theta-z-deg'}, expected one of the two")
        return load_design(design)
    missing = [f"--{name}" for name, value in sides.items() if value is None]
    if missing:
        raise ValueError(f"design: got no {', '.join(missing)}, expected a design file or all of a1 a2 b1 b2 zp zs")
    return hexagonal_design(named | {"theta_z": math.radians(theta_z_deg or 0.0)})


def length_option(text: str) -> float | str:
    """Return a characteristic length as --lc gives it."""
    try:
        return float(text)
    except ValueError:
        if text not in KINDS:
            raise ValueError(f"--lc: got {text!r}, expected a number or one of {', '.join(KINDS)}") from None
        return text
