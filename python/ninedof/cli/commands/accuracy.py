"""`ninedof accuracy`: what errors of legs and joints do to the pose."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from ninedof.cli import options, posed
from ninedof.cli.chosen_design import named_design
from ninedof.cli.screen import Screen
from ninedof.robot.configuration import Configuration
from ninedof.statics.accuracy import MOST_SAMPLES, ErrorBounds, error_bounds, error_samples
from ninedof.support.arguments import finite, whole
from ninedof.support.units import amount, unit_entry

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof accuracy design.toml --leg-error 0.01 --joint-error 0.02

  ninedof accuracy runs/20260101-120000 --leg-error 0.01 --all-poses

  ninedof accuracy runs/20260101-120000#7 --leg-error 0.01 --samples 10000 --json | jq .position"""

GROUPS = ("turn about", "p along", "O along")  # in the order of the components


def accuracy(
    design: options.Design,
    leg_error: Annotated[float, typer.Option(help="Tolerance of the leg lengths.")] = 0.0,
    joint_error: Annotated[float, typer.Option(help="Tolerance of the joint centres, a radius.")] = 0.0,
    samples: Annotated[
        int | None, typer.Option(help="Random robots within the tolerances, without linearization, at one pose.")
    ] = None,
    position: posed.Position = None,
    rotation_deg: posed.RotationDeg = None,
    internal_point: posed.InternalPoint = None,
    all_poses: posed.AllPoses = False,
    json: options.Json = False,
) -> None:
    """Print the errors of platform and O for tolerances of legs and joints, worst case and standard deviation."""
    screen = Screen(json)
    for name, value in (("--leg-error", leg_error), ("--joint-error", joint_error)):
        finite(name, value, 0.0)
    if leg_error == 0.0 and joint_error == 0.0:
        raise ValueError("accuracy: got neither --leg-error nor --joint-error, expected a tolerance")
    if samples is not None:
        whole("--samples", samples, 1, MOST_SAMPLES)
    if samples is not None and all_poses:
        raise ValueError("--samples: got it with --all-poses, expected one pose")
    chosen = named_design(design)
    c = posed.chosen_poses(chosen, position, rotation_deg, internal_point, all_poses)
    bounds = error_bounds(chosen.geometry, c, leg_error, joint_error)
    for line in posed.pose_lines(c, chosen):
        screen.print(line)
    table, used = _table(c, bounds, chosen.unit)
    screen.print(table)
    for line in posed.mentioned(c, used, chosen.unit):
        screen.print(line)
    data: dict[str, Any] = {
        "poses": posed.poses_data(c),
        "leg_error": leg_error,
        "joint_error": joint_error,
    }
    data |= {
        "position": bounds.position,
        "rotation_deg": np.degrees(bounds.rotation),
        "internal_point": bounds.internal_point,
        "covariance": bounds.covariance,
    }
    if samples is not None:
        data["samples"] = _quantiles(error_samples(chosen.geometry, c[0], leg_error, joint_error, samples), chosen.unit)
        for words in data["samples"]["words"]:
            screen.print(words)
    screen.data(unit_entry(chosen.unit) | data)


def _table(c: Configuration, bounds: ErrorBounds, unit: str) -> tuple[Table, set[int]]:
    """Return the largest error of each component over the poses and its standard deviation there; and those poses."""
    table = Table(title="Errors of first order", title_justify="left", title_style="bold")
    heads = ("", "largest", "standard deviation", *(["pose"] if len(c) > 1 else []))
    for k, head in enumerate(heads):
        table.add_column(head, justify="right" if k else "left")
    used: set[int] = set()

    def add(label: str, values: Any, deviations: Any, angle: bool, end: bool) -> None:
        value, at = posed.at_worst(values)
        used.add(at)
        shown = ["-" if x is None else _text(x, angle, unit) for x in (value, deviations and deviations[at])]
        table.add_row(label, *shown, *([str(at)] if len(c) > 1 else []), end_section=end)

    variance = np.diagonal(bounds.covariance, axis1=-2, axis2=-1)
    for k in range(9):
        label = f"{GROUPS[k // 3]} {'xyz'[k % 3]}"
        add(label, bounds.components[:, k], np.sqrt(variance[:, k]).tolist(), k < 3, k % 3 == 2)
    add("any turn", bounds.rotation, None, True, False)
    add("any displacement of p", bounds.position, None, False, False)
    add("any displacement of O", bounds.internal_point, None, False, True)
    return table, used


def _text(value: float, angle: bool, unit: str) -> str:
    return f"{np.degrees(value):.4g}°" if angle else amount(f"{value:.4g}", unit)


def _quantiles(found: Any, unit: str) -> dict[str, Any]:
    """Return how far 95 % of the random robots go, in numbers and in words."""
    lost = int(np.isnan(found).any(axis=1).sum())
    kept = found[~np.isnan(found).any(axis=1)]
    turn, p, o = (
        float(np.quantile(np.linalg.norm(kept[:, k : k + 3], axis=1), 0.95)) if len(kept) else float("inf")
        for k in (0, 3, 6)
    )
    words = [
        f"95 % of {len(kept)} random robots: p within {_text(p, False, unit)}, turned less than "
        f"{_text(turn, True, unit)}, O within {_text(o, False, unit)}"
    ]
    words += [f"{lost} more did not reach a pose near this one"] if lost else []
    return {"count": len(found), "lost": lost, "rotation_deg": np.degrees(turn), "position": p, "internal_point": o} | {
        "words": words
    }
