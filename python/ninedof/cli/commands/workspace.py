"""`ninedof workspace`: where a robot can work, its table, its run folder."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from ninedof.cli.chosen_design import length_option
from ninedof.cli.options import Figures, Json, Out, Threads
from ninedof.cli.screen import DONE, INTERRUPTED, NO_RESULT, Screen
from ninedof.cli.workspace_summary import draw, pose_bar, sentences, workspace_table
from ninedof.conditioning.characteristic_length import characteristic_length
from ninedof.paper.published import published_variables
from ninedof.robot.configuration import arrays_of
from ninedof.robot.geometry import triples
from ninedof.runs.design_file import Design, hexagonal_design, load_design
from ninedof.runs.directory import run_directory
from ninedof.runs.folder import write_run
from ninedof.support.arrays import thread_argument
from ninedof.workspace import workspace as find_workspace

ANGLES = ("base_cone", "platform_cone")


Ends = Annotated[tuple[float, float] | None, typer.Option(metavar="LOW HIGH")]
PLACE = 6
EXAMPLES = """[bold]Examples[/bold]

  ninedof workspace --legs 2.5 6.5 --condition 5 --singularity-free

  ninedof workspace design.toml --legs 2.5 6.5 --x -2 2 --y -2 2 --z 3 7 --out run1

  ninedof workspace --archetype orientation --angle-deg 60 --legs 2.5 6.5 --json | jq .workspace.volume"""


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


def workspace(
    design: Annotated[
        Path | None, typer.Argument(help="A design file (TOML) or a run folder; the published design if none is given.")
    ] = None,
    archetype: Annotated[
        str, typer.Option(help="constant_orientation, orientation, reachable, inclusive or dexterous.")
    ] = "constant_orientation",
    x: Ends = None,
    y: Ends = None,
    z: Ends = None,
    legs: Annotated[
        tuple[float, float] | None, typer.Option(metavar="LOW HIGH", help="Limits of all nine legs.")
    ] = None,
    condition: Annotated[float | None, typer.Option(help="Greatest condition number.")] = None,
    base_cone_deg: Annotated[float | None, typer.Option(help="Greatest angle at a base joint from home.")] = None,
    platform_cone_deg: Annotated[float | None, typer.Option(help="The same at a platform joint.")] = None,
    clearance: Annotated[float | None, typer.Option(help="Least distance of legs that share no joint.")] = None,
    singularity_free: Annotated[
        bool, typer.Option("--singularity-free", help="Connected with home, on its side of every singularity.")
    ] = False,
    angle_deg: Annotated[float | None, typer.Option(help="Region: rotations of at most this angle.")] = None,
    tilt_deg: Annotated[float | None, typer.Option(help="Region: tilts of at most this angle.")] = None,
    torsion_deg: Annotated[float | None, typer.Option(help="Region: torsions of at most this angle.")] = None,
    orientations: Annotated[int | None, typer.Option(help="How many rotations make a set.")] = None,
    position: Annotated[
        tuple[float, float, float] | None,
        typer.Option(metavar="X Y Z", help="Of orientation: where the platform is; the home position by default."),
    ] = None,
    internal_point: Annotated[
        str | None, typer.Option(help="Where O is: best, or a fraction between the plates; 0.5 by default.")
    ] = None,
    lc: Annotated[str | None, typer.Option(help="Characteristic length: a number, or a kind taken at home.")] = None,
    method: Annotated[str, typer.Option(help="octree, grid or sample.")] = "octree",
    tolerance: Annotated[float, typer.Option(help="Error wanted, as a share of the volume.")] = 1e-3,
    resolution: Annotated[int | None, typer.Option(help="Cells along each side before any is divided.")] = None,
    points: Annotated[int | None, typer.Option(help="Poses of the audit, or of each shift of a sample.")] = None,
    seed: Annotated[int | None, typer.Option(help="Of the audit and of a sample; 0 by default.")] = None,
    out: Out = None,
    threads: Threads = None,
    figures: Figures = True,
    json: Json = False,
) -> None:
    """Find where a robot can work: the volume, its boundary and what limits it."""
    criteria = {
        "leg_limits": legs,
        "condition_number": condition,
        "base_cone": base_cone_deg,
        "platform_cone": platform_cone_deg,
        "leg_clearance": clearance,
        "singularity_free": singularity_free,
    }
    options = WorkspaceOptions(
        archetype=archetype,
        box={"x": x, "y": y, "z": z},
        position=position,
        criteria=criteria,
        region_deg={"angle": angle_deg, "tilt": tilt_deg, "torsion": torsion_deg},
        orientations=orientations,
        internal_point=internal_point,
        lc=lc,
        search={"method": method, "tolerance": tolerance, "resolution": resolution, "points": points, "seed": seed},
        threads=threads,
    )
    screen = Screen(json)
    thread_argument(options.threads)
    given = hexagonal_design(published_variables()) if design is None else load_design(design)
    if options.lc is not None:
        given = given._replace(characteristic_length=length_option(options.lc))
    search = {name: value for name, value in options.search.items() if value is not None}
    if search["method"] == "grid":
        for name in ("points", "seed"):
            if name in search:
                raise ValueError(f"--{name}: got {search[name]}, expected none with --method grid")
    asked = _arguments(given, options) | search
    with run_directory(out) as directory, pose_bar(screen, options.archetype.replace("_", " ")) as progress:
        found = find_workspace(
            given.geometry, **asked, home=given.configuration, threads=options.threads, progress=progress
        )
    screen.print(workspace_table(found))
    for sentence in sentences(found):
        screen.print(sentence)
    drawn = figures and found.volume > 0.0 and not found.interrupted and found.method != "sample"
    record = write_run(found, directory, partial(draw, found, screen) if drawn else None, _describe(given, asked))
    figure = ", figure workspace (PNG and SVG)" if drawn else ""
    screen.print(f"run folder {directory}: {record.name}, map.npz{figure}")
    screen.data({"workspace": found.to_dict(), "record": str(record)})
    if found.interrupted:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(DONE if found.volume > 0.0 else NO_RESULT)


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
    return {"geometry": triples(given.geometry), "home": arrays_of(given.configuration), **asked}
