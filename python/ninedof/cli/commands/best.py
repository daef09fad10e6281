"""`ninedof best`: the best internal point at a pose, or at each pose of a study."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from typing import Annotated, Any

import numpy as np
import typer
from rich import box
from rich.table import Table

from ninedof.cli import options, posed
from ninedof.cli.chosen_design import Chosen, named_design, with_length
from ninedof.cli.screen import DONE, NO_RESULT, Screen
from ninedof.conditioning.conditioning import condition_number
from ninedof.redundancy.redundancy import InternalPoint, best_internal_point
from ninedof.redundancy.search_arguments import CRITERIA
from ninedof.robot.configuration import Configuration
from ninedof.sheet.pose_words import decimals_of, fixed, vector_words
from ninedof.singularity.singularity import singularity_margins
from ninedof.support.arrays import Floats
from ninedof.support.units import amount, unit_entry, with_unit

PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof best design.toml --position 0.8 0 3.98

  ninedof best runs/20260101-120000 --all-poses             the leg limits of the run's study

  ninedof best runs/20260101-120000#7 --criterion singularity --legs 200 650 --json | jq .value"""

WORDS = {"condition_number": "condition number", "singularity": "least |det|", "leg_centring": "leg centring"}
SHOWN = 12  # poses, the worst ones


def best(
    design: options.Design,
    criterion: Annotated[str, typer.Option(help=f"One of {', '.join(CRITERIA)}.")] = "condition_number",
    legs: Annotated[
        tuple[float, float] | None,
        typer.Option(metavar="LOW HIGH", help="Limits of all nine legs; those of the run's study by default."),
    ] = None,
    position: posed.Position = None,
    rotation_deg: posed.RotationDeg = None,
    internal_point: posed.InternalPoint = None,
    all_poses: posed.AllPoses = False,
    lc: options.Lc = None,
    json: options.Json = False,
) -> None:
    """Print the best place of O at a pose, reached from where it is without passing a singularity."""
    screen = Screen(json)
    chosen = with_length(named_design(design), lc)
    c = posed.chosen_poses(chosen, position, rotation_deg, internal_point, all_poses)
    limits: Any = chosen.leg_limits() if legs is None else legs
    length = posed.length_at_home(chosen)
    asked = {"criterion": criterion, "limits": limits, "characteristic_length": length}
    found = best_internal_point(chosen.geometry, c.position, c.rotation, **asked, start=c.internal_point)
    now = _now(chosen, c, criterion, length)
    for line in posed.pose_lines(c, chosen):
        screen.print(line)
    if len(c) == 1:
        for line in _words(c, found, now, WORDS[criterion], chosen.unit):
            screen.print(line)
    else:
        screen.print(_table(c, found, now, WORDS[criterion], criterion == "condition_number", chosen.unit))
        for line in _over_poses(found, now, WORDS[criterion], criterion == "condition_number"):
            screen.print(line)
    data = {"poses": posed.poses_data(c), "criterion": criterion, "limits": limits}
    data |= {"internal_point": found.configuration.internal_point, "value": found.value, "now": now}
    screen.data(unit_entry(chosen.unit) | data | {"status": found.status, "active": found.active})
    raise typer.Exit(DONE if np.isfinite(found.value).any() else NO_RESULT)


def _now(chosen: Chosen, c: Configuration, criterion: str, length: float) -> Floats | None:
    """Return the criterion where O is; None for one that depends on limits."""
    if criterion == "condition_number":
        return np.asarray(condition_number(chosen.geometry, c, length))
    if criterion == "singularity":
        return np.asarray(np.min(np.abs(np.stack(singularity_margins(chosen.geometry, c))), axis=0))
    return None


def _over_poses(found: InternalPoint, now: Floats | None, words: str, small: bool) -> Iterator[str]:
    """Yield the worst over all poses, and how the searches ended."""
    if len(found.value) > SHOWN:
        yield f"the {SHOWN} worst of {len(found.value)} poses"
    pick = np.max if small or now is None else np.min
    ended = [f"worst {words} now {pick(now):.6g}"] if now is not None else []
    if not np.isnan(found.value).any():
        ended.append(f"with the best O {pick(found.value):.6g}")
    statuses = Counter(str(status) for status in found.status)
    yield "; ".join([*ended, ", ".join(f"{count} {status}" for status, count in statuses.items())])


def _words(c: Configuration, found: InternalPoint, now: Floats | None, words: str, unit: str) -> Iterator[str]:
    """Yield O and the criterion at one pose, as they are and at the best."""
    if now is not None:
        yield f"O now {amount(_point(c.internal_point[0]), unit)}: {words} {now[0]:.6g}"
    if not np.isnan(found.value[0]):
        yield f"best O {amount(_point(found.configuration.internal_point[0]), unit)}: {words} {found.value[0]:.6g}"
    yield f"{found.status[0]}; limits reached: {', '.join(found.active[0]) or 'nothing'}"


def _table(c: Configuration, found: InternalPoint, now: Floats | None, words: str, small: bool, unit: str) -> Table:
    """Return O and the criterion, as it is and at the best, for the poses that are worst now."""
    order = np.arange(len(c)) if now is None else np.argsort(-now if small else now, kind="stable")
    worst, points = order[:SHOWN], found.configuration.internal_point
    why = [_why(str(found.status[k]), found.active[k]) for k in worst]
    table = Table(title=f"Best places of O by {words}", title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    table.padding = (0, 1, 0, 0)
    for head in (
        "pose",
        f"{with_unit('p', unit)}\nx",
        "\ny",
        "\nz",
        "now",
        "best",
        f"{with_unit('best O', unit)}\nx",
        "\ny",
        "\nz",
    ):
        table.add_column(head, justify="right", no_wrap=True)
    if any(why):
        table.add_column("why", overflow="fold")
    decimals = decimals_of(c.position, points)
    for k, reason in zip(worst, why, strict=True):
        p, o = (["-" if math.isnan(x) else fixed(x, decimals) for x in row] for row in (c.position[k], points[k]))
        values = ("-" if math.isnan(x) else f"{x:.4g}" for x in (math.nan if now is None else now[k], found.value[k]))
        table.add_row(str(k), *p, *values, *o, *([reason] if any(why) else []))
    return table


def _why(status: str, active: tuple[str, ...]) -> str:
    return ", ".join([*([] if status == "found" else [status]), *active])


def _point(values: Floats) -> str:
    return vector_words(float(f"{x:.4g}") for x in values)
