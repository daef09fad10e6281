"""The summary of a motion along a trajectory: table, remarks and figure."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from rich.table import Table

from ninedof.cli.screen import Screen
from ninedof.motion import Followed
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
    units = dict.fromkeys(("shortest", "longest", "low", "high", "margin"), found.unit)
    units |= {"speed": per(found.unit, "s"), "acceleration": per(found.unit, "s²")}
    for key, words in columns.items():
        table.add_column(heading(words, units.get(key, "")), justify="right")
    largest = {key: max(abs(leg[key]) for leg in legs.values()) for key in columns}
    if found.leg_forces is not None:
        largest["push"] = largest["pull"] = max(largest["push"], largest["pull"])
    for k, (name, leg) in enumerate(legs.items()):
        table.add_row(name, *(_text(leg[key], largest[key]) for key in columns), end_section=k % 3 == 2)
    return table


def _text(value: float, largest: float) -> str:
    """Return a number of four digits; 0 where only rounding is left of it."""
    return "0" if abs(value) < 1e-12 * largest else f"{value:.4g}"


def sentences(found: Followed, unexamined: Sequence[str]) -> Iterator[str]:
    """Yield remarks on the table, one sentence each."""
    about = found.to_dict()
    kappa, near = about["condition_number"], about["nearest_singularity"]
    yield f"{about['poses']} poses from t = {about['begin']:g} to {about['end']:g}; O: {about['internal_point']}"
    if found.idle_legs:
        yield f"never move: {', '.join(found.idle_legs)}; with --internal-point best or 0.5 they help"
    ends = f"{kappa['first']:.4f} at the start, {kappa['last']:.4f} at the end"
    yield f"condition number at worst {kappa['worst']:.4f} at t = {kappa['at']:.6g}; {ends}"
    yield f"nearest singularity: {near['determinant']} = {near['value']:.4f} at t = {near['at']:.6g}"
    turning = float(np.linalg.norm(found.velocity[:, :3], axis=1).max())
    moving = float(np.linalg.norm(found.velocity[:, 3:6], axis=1).max())
    speed, time = amount(f"{moving:.5g}", per(found.unit, "s")), "second" if found.unit else "unit of time"
    yield f"platform: speed at most {speed}, turning at most {math.degrees(turning):.5g} degrees per {time}"
    for broken in found.breaks[:SHOWN]:
        if broken.limit.startswith("det"):
            yield f"[bold]singularity[/bold]: {broken.limit} changes sign at t = {broken.begin:.6g}"
        else:
            when = f"from t = {broken.begin:.6g} to {broken.end:.6g}"
            worst = amount(f"{broken.worst:.5g}", found.unit)
            yield f"[bold]limit breaks[/bold]: {broken.limit}, {when}, at worst {worst} at {broken.at:.6g}"
    if len(found.breaks) > SHOWN:
        yield f"and {len(found.breaks) - SHOWN} more breaks of limits: see record.json"
    if unexamined:
        yield f"not examined along the path: {', '.join(unexamined)}"
    error = f"largest difference {found.tracking_error:.1e}"
    if found.tracked:
        yield f"tracked back from the leg lengths, every step proved: {error}"
    else:
        yield f"[bold]not tracked back[/bold] beyond t = {found.tracked_until:.6g}: {error}"


def draw(found: Followed, screen: Screen, directory: Path) -> list[Path]:
    """Draw lengths and condition number; return the files."""
    screen.say("drawing the motion")
    from ninedof import plot

    figure = plot.motion(found.time, found.leg_lengths, found.condition_number, found.limits, found.unit)
    return plot.save(figure, directory, "motion")
