"""`ninedof workspace`: where a robot can work, its table, its run folder."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from ninedof.cli.commands.evaluation import length_option
from ninedof.cli.commands.screen import DONE, INTERRUPTED, NO_RESULT, Screen, from_first_news
from ninedof.conditioning.characteristic_length import characteristic_length
from ninedof.paper import paper
from ninedof.runs.design_file import Design, hexagonal_design, load_design
from ninedof.runs.directory import run_directory
from ninedof.runs.folder import write_run
from ninedof.support.arrays import thread_argument
from ninedof.workspace import WorkspaceMap
from ninedof.workspace import workspace as find_workspace

__all__ = ["WorkspaceOptions", "workspace"]

ANGLES = ("base_cone", "platform_cone")
SHOWN = 8  # limits in the table


@dataclass(frozen=True)
class WorkspaceOptions:
    """What the command line says about the poses: angles in degrees, None for what is not asked for."""

    archetype: str
    box: Mapping[str, tuple[float, float] | None]  # of x, y and z
    position: tuple[float, float, float] | None
    criteria: Mapping[str, Any]
    region_deg: Mapping[str, float | None]  # angle, tilt and torsion
    orientations: int | None
    internal_point: str | None  # best, or a fraction
    lc: str | None
    search: Mapping[str, Any]
    threads: int | None


def workspace(design: Path | None, options: WorkspaceOptions, out: Path | None, figures: bool, json: bool) -> int:
    """Find the workspace of a design, whose configuration is home; print, record, return the exit status.

    The published design if none is given.
    """
    screen = Screen(json)
    thread_argument(options.threads)
    given = hexagonal_design(paper.published_variables()) if design is None else load_design(design)
    if options.lc is not None:
        given = given._replace(characteristic_length=length_option(options.lc))
    search = {name: value for name, value in options.search.items() if value is not None}
    if search["method"] == "grid":
        for name in ("points", "seed"):
            if name in search:
                raise ValueError(f"--{name}: got {search[name]}, expected none with --method grid")
    asked = _arguments(given, options) | search
    with run_directory(out) as directory, _bar(screen, options.archetype.replace("_", " ")) as progress:
        found = find_workspace(
            given.geometry, **asked, home=given.configuration, threads=options.threads, progress=progress
        )
    screen.print(_table(found))
    for sentence in _sentences(found):
        screen.print(sentence)
    drawn = figures and found.volume > 0.0 and not found.interrupted and found.method != "sample"
    record = write_run(found, directory, partial(_draw, found, screen) if drawn else None, _describe(given, asked))
    screen.print(
        f"run folder {directory}: {record.name}, map.npz" + (", figure workspace (PNG and SVG)" if drawn else "")
    )
    screen.data({"workspace": found.to_dict(), "record": str(record)})
    if found.interrupted:
        return INTERRUPTED
    return DONE if found.volume > 0.0 else NO_RESULT


def _arguments(given: Design, options: WorkspaceOptions) -> dict[str, Any]:
    """Return the arguments of `ninedof.workspace`."""
    home = given.configuration
    asked: dict[str, Any] = {"archetype": options.archetype}
    wanted = {name: value for name, value in options.criteria.items() if value is not None and value is not False}
    for name in ANGLES:
        if name in wanted:
            wanted[name] = math.radians(wanted[name])
    if not wanted:
        raise ValueError("workspace: got no criterion, expected at least one of --legs, --condition, --clearance, ...")
    asked["criteria"] = wanted
    length = given.characteristic_length
    asked["characteristic_length"] = (
        float(characteristic_length(given.geometry, home, length)) if isinstance(length, str) else float(length)
    )
    region = {name: math.radians(value) for name, value in options.region_deg.items() if value is not None}
    if region:
        asked["region"] = region
    if options.orientations is not None:
        asked["orientations"] = options.orientations
    if options.internal_point is not None:
        asked["internal_point"] = _rule(options.internal_point)
    box = options.box
    if options.archetype == "orientation":
        if any(value is not None for value in box.values()):
            raise ValueError("workspace: got a box, expected none for orientations at one position")
        position = home.position if options.position is None else options.position
        return asked | {"position": position, "rotation": home.rotation}
    if options.position is not None:
        raise ValueError(f"--position: got {options.position}, expected none but for --archetype orientation")
    if options.archetype == "constant_orientation":
        asked["rotation"] = home.rotation
    reach = max(float(np.linalg.norm(home.position)), 1e-300)
    around = [
        (at - reach, at + reach) if box[k] is None else box[k] for k, at in zip("xyz", home.position, strict=True)
    ]
    return asked | {"box": tuple(zip(*around, strict=True))}


def _rule(text: str) -> str | float:
    try:
        return float(text)
    except ValueError:
        if text != "best":
            raise ValueError(f"--internal-point: got {text!r}, expected best or a fraction") from None
        return text


def _describe(given: Design, asked: Mapping[str, Any]) -> dict[str, Any]:
    g, c = given.geometry, given.configuration
    triples = ("base_external", "base_internal", "platform_external", "platform_internal")
    return {
        "geometry": {name: getattr(g, name) for name in triples},
        "home": {"position": c.position, "rotation": c.rotation, "internal_point": c.internal_point},
        **asked,
    }


@contextmanager
def _bar(screen: Screen, title: str) -> Iterator[Any]:
    """Show a bar of poses with the time to go, as far as is known from the levels before."""
    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=12),
        TextColumn("{task.completed:,.0f} poses{task.fields[volume]}"),
        TimeRemainingColumn(),
        TextColumn("to go"),
    )
    with from_first_news(Progress(*columns, console=screen.progress_console)) as shown:
        task = shown.add_task(title, total=None, volume="")

        def progress(done: int, expected: int, volume: float | None) -> None:
            words = "" if volume is None else f", volume {volume:.4g}"
            shown.start()
            shown.update(task, completed=done, total=expected, volume=words)

        yield progress


def _table(found: WorkspaceMap) -> Table:
    """Lay a workspace out for a person."""
    table = Table(title="Workspace", title_justify="left", title_style="bold", show_header=False)
    table.add_column()
    table.add_column(justify="right")
    table.add_row("volume", f"{found.volume:.6g}")
    table.add_row("  error, estimated", f"{found.error:.2g}")
    table.add_row("  share of the box or region", f"{100.0 * found.share:.3g} %")
    if found.unseen > 0.0:
        table.add_row("  too thin to be seen, at most (95 %)", f"{found.unseen:.2g}")
    if len(found.pieces) > 1:
        table.add_row("  pieces", str(len(found.pieces)))
    if found.ball_radius > 0.0:
        table.add_row("largest ball: radius", f"{found.ball_radius:.4g}")
        table.add_row("largest box: sides", "  ".join(f"{side:.4g}" for side in found.box_high - found.box_low))
    table.add_section()
    table.add_row("global conditioning index", f"{found.conditioning_index:.5f}")
    table.add_row("condition number: median", f"{found.percentiles[50]:.4f}")
    table.add_row("condition number: 95 %", f"{found.percentiles[95]:.4f}")
    table.add_row("condition number: worst", f"{found.worst_condition_number:.4f}")
    table.add_section()
    for name, share in list(found.limits().items())[:SHOWN]:
        table.add_row(f"boundary by {name.replace('_', ' ')}", f"{100.0 * share:.1f} %")
    return table


def _sentences(found: WorkspaceMap) -> Iterator[str]:
    words = {
        "limited": "the number of poses ran out before the error asked for was reached",
        "empty": "no allowed pose was found",
        "stopped": "interrupted: what was known until then is kept",
    }
    if found.status in words:
        yield f"[bold]{found.status}[/bold]: {words[found.status]}"
    if not found.home_allowed:
        yield f"the home pose is not allowed: {found.home_limit}"
    if found.box_limits:
        yield "the workspace runs to the box: in a larger one it would be larger"


def _draw(found: WorkspaceMap, screen: Screen, directory: Path) -> list[Path]:
    screen.say("drawing the workspace")
    from ninedof import plot

    middle = found.ball_centre if found.ball_radius > 0.0 else found.worst_at
    sections = []
    for fixed in (1, 2):
        drawn = [k for k in range(3) if k != fixed]
        ball = (middle[drawn], found.ball_radius) if found.ball_radius > 0.0 else None
        inner = (found.box_low[drawn], found.box_high[drawn]) if np.isfinite(found.box_low).all() else None
        plane = found.slice(found.coordinates[fixed], float(middle[fixed]))
        sections.append(plot.Section(plane, ball, inner))
    figure = plot.workspace(sections, found.limit_names, found.limits(), found.percentiles, found.levels)
    return plot.save(figure, directory, "workspace")
