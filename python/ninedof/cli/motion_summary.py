"""The summary of a motion along a trajectory: table, remarks and figure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from rich.table import Table
from rich.text import Text

from ninedof.cli.screen import Screen, bold
from ninedof.design.limit_numbers import CONES
from ninedof.motion import Followed
from ninedof.redundancy.rules import where_o
from ninedof.sheet.path_limits import LENGTHS, PathLimits, row_words
from ninedof.support.arrays import Floats
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, heading, per

SHOWN = 12  # breaks of limits


def legs_table(found: Followed) -> Table:
    """Return the table of the nine legs."""
    legs = found.to_dict()["legs"]
    limited = any(leg["low"] > 0.0 or math.isfinite(leg["high"]) for leg in legs.values())
    table = Table(title="Legs along the path", title_justify="left", title_style="bold")
    table.add_column("leg")
    columns = {"shortest": "least", "longest": "most"}
    columns |= {"low": "low", "high": "high", "margin": "margin"} if limited else {}
    columns |= {"speed": "speed", "acceleration": "accel."}
    columns |= {"push": "push", "pull": "pull"} if found.leg_forces is not None else {}
    units = dict.fromkeys(("shortest", "longest", "low", "high"), found.unit)
    units |= {"speed": per(found.unit, "s"), "acceleration": per(found.unit, "s²")}
    for key, words in columns.items():
        table.add_column(heading(words, units.get(key, "")), justify="right")
    largest = {
        key: max((abs(x) for leg in legs.values() if math.isfinite(x := leg[key])), default=0.0) for key in columns
    }
    if found.leg_forces is not None:
        largest["push"] = largest["pull"] = max(largest["push"], largest["pull"])
    for k, (name, leg) in enumerate(legs.items()):
        cells = (
            margin_words(leg[key], "length") if key == "margin" else _text(leg[key], largest[key]) for key in columns
        )
        table.add_row(name, *cells, end_section=k % 3 == 2)
    return table


def _text(value: float, largest: float) -> str:
    """Return a number of four digits; 0 where only rounding is left of it."""
    return "0" if abs(value) < 1e-12 * largest else f"{value:.4g}"


def limits_table(of_study: PathLimits, unit: str) -> Table:
    """Return the table of the other limits of the study: where each has its least margin."""
    table = Table(title="Limits of the study along the path", title_justify="left", title_style="bold")
    for k, words in enumerate(("limit", "", "allowed", "worst", "margin", "at t")):
        table.add_column(words, justify="right" if k > 1 else "left")
    for row in of_study.worst():
        table.add_row(*row_words(row, unit))
    return table


def sentences(found: Followed, of_study: PathLimits | None) -> Iterator[str | Text]:
    """Yield remarks on the table, one sentence each."""
    about = found.to_dict()
    kappa, near = about["condition_number"], about["nearest_singularity"]
    o = where_o(about["internal_point"])
    yield f"{about['poses']} poses from t = {about['begin']:g} to {about['end']:g}; O: {o}"
    if found.idle_legs:
        yield f"never move: {', '.join(found.idle_legs)}; with --internal-point best or 0.5 they help"
    ends = f"{kappa['first']:.4f} at the start, {kappa['last']:.4f} at the end"
    yield f"condition number at worst {kappa['worst']:.4f} at t = {kappa['at']:.6g}; {ends}"
    yield f"nearest singularity: {near['determinant']} = {near['value']:.4f} at t = {near['at']:.6g}"
    turning = float(np.linalg.norm(found.velocity[:, :3], axis=1).max())
    moving = float(np.linalg.norm(found.velocity[:, 3:6], axis=1).max())
    speed, time = amount(f"{moving:.5g}", per(found.unit, "s")), "second" if found.unit else "unit of time"
    yield f"platform: speed at most {speed}, turning at most {math.degrees(turning):.5g} degrees per {time}"
    breaks = sorted((*found.breaks, *(of_study.breaks if of_study else ())), key=lambda b: (b.begin, b.limit))
    for broken in breaks[:SHOWN]:
        if broken.limit.startswith("det"):
            yield bold("singularity", f": {broken.limit} changes sign at t = {broken.begin:.6g}")
        else:
            when = f"from t = {broken.begin:.6g} to {broken.end:.6g}"
            cone = broken.limit.startswith(CONES)
            worst = f"{math.degrees(broken.worst):.5g}°" if cone else f"{broken.worst:.5g}"
            if broken in found.breaks or (broken.limit.startswith(LENGTHS) and not broken.limit.startswith("stroke_")):
                worst = amount(worst, found.unit)
            yield bold("limit breaks", f": {broken.limit}, {when}, at worst {worst} at {broken.at:.6g}")
    if len(breaks) > SHOWN:
        yield f"and {len(breaks) - SHOWN} more breaks of limits: see record.json"
    error = f"largest difference {found.tracking_error:.1e}"
    if found.tracked:
        yield f"tracked back from the leg lengths, every step proved: {error}"
    else:
        yield bold("not tracked back", f" beyond t = {found.tracked_until:.6g}: {error}")


def draw(found: Followed, screen: Screen, of_study: PathLimits | None, directory: Path) -> list[Path]:
    """Draw lengths, condition number and the margins of a study's limits; return the files."""
    screen.say("drawing the motion")
    from ninedof import plot

    margins = _margins(found) | of_study.margins if of_study else None
    return plot.save(plot.motion(found, margins), directory, "motion")


def _margins(found: Followed) -> dict[str, Floats]:
    """Return the least margin of the limits of leg lengths, relative to them; nothing without limits."""
    margin = found.leg_margins.min(axis=1)
    return {"leg lengths": margin} if np.isfinite(margin).all() else {}
