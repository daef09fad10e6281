"""`ninedof path`: the legs of a design along a trajectory, its table and its run folder."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from ninedof.cli.chosen_design import Chosen, named_design, with_length
from ninedof.cli.job_report import report_words, told, with_report
from ninedof.cli.motion_summary import draw, legs_table, limits_table, sentences
from ninedof.cli.options import DesignOrPublished, Figures, Json, Lc, Out, Report
from ninedof.cli.screen import DONE, NO_RESULT, Screen
from ninedof.design.study import Study
from ninedof.motion import Trajectory, follow
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import arrays_of
from ninedof.robot.geometry import triples
from ninedof.runs.directory import run_directory
from ninedof.runs.motion_folder import ARRAYS_FILE, LEGS_FILE, POSES_FILE, plain, write_motion
from ninedof.sheet.path_limits import path_limits
from ninedof.sheet.weight import Weight
from ninedof.support.units import unit_entry

Three = tuple[float, float, float]
PLACE = 7
EXAMPLES = """[bold]Examples[/bold]

  ninedof path design.toml path.csv --legs 2.5 6.5

  ninedof path runs/20260101-120000 path.csv              the limits of the run's study

  ninedof path design.toml --circle 0.5 --duration 2 --internal-point best

  ninedof path runs/20260101-120000 --line 30 0 20 --mass 5 --centre 0 0 20

  ninedof path --line 0.5 0 0.2 --force 0 0 -9.81 --json | jq .motion.legs.l1"""


def path(
    design: DesignOrPublished = None,
    file: Annotated[
        Path | None,
        typer.Argument(
            help="Poses (CSV): columns t x y z, and for the rotation qw qx qy qz, rx ry rz or yaw pitch roll, in "
            "degrees as rx_deg, yaw_deg."
        ),
    ] = None,
    circle: Annotated[
        float | None, typer.Option(metavar="RADIUS", help="A horizontal circle about the neutral pose.")
    ] = None,
    line: Annotated[
        Three | None, typer.Option(metavar="X Y Z", help="A line from the neutral pose, from rest to rest.")
    ] = None,
    spiral: Annotated[
        tuple[float, float] | None,
        typer.Option(metavar="RADIUS HEIGHT", help="Three turns outwards and up, from rest to rest."),
    ] = None,
    duration: Annotated[float | None, typer.Option(help="Of a circle, line or spiral; 1 by default.")] = None,
    points: Annotated[int | None, typer.Option(help="Poses of a circle, line or spiral; 1001 by default.")] = None,
    internal_point: Annotated[
        str | None,
        typer.Option(
            help="Position of O: carried, shifted, held, best, or a fraction between the plates; by default as in the "
            "region of the run's study, else carried."
        ),
    ] = None,
    legs: Annotated[
        tuple[float, float] | None,
        typer.Option(metavar="LOW HIGH", help="Limits of all nine legs; those of the run's study by default."),
    ] = None,
    force: Annotated[Three | None, typer.Option(metavar="X Y Z", help="Force on the platform at its origin.")] = None,
    moment: Annotated[Three | None, typer.Option(metavar="X Y Z", help="Moment on the platform.")] = None,
    mass: Annotated[float | None, typer.Option(help="Mass of the platform: its weight is added to the load.")] = None,
    centre: Annotated[
        Three | None, typer.Option(metavar="X Y Z", help="Its centre in the platform frame; the origin by default.")
    ] = None,
    gravity: Annotated[
        Three | None, typer.Option(metavar="X Y Z", help="Force per mass, base axes; 0 0 -9.81 by default.")
    ] = None,
    lc: Lc = None,
    out: Out = None,
    figures: Figures = True,
    report: Report = True,
    json: Json = False,
) -> None:
    """Compute leg lengths, rates and accelerations along a path, and the limits that break.

    A run brings every limit of its study.
    """
    screen = Screen(json)
    if file is None and design is not None and design.endswith(".csv"):
        file, design = Path(design), None
    given = with_length(named_design(design), lc)
    g, home, length = given.geometry, given.configuration, given.characteristic_length
    shape = {"circle": circle, "line": line, "spiral": spiral}
    trajectory = _trajectory(given, file, shape, {"duration": duration, "points": points})
    study = given.study
    limits: Any = given.leg_limits() if legs is None else legs
    asked = {"internal_point": _rule(internal_point, study), "limits": limits, "force": force, "moment": moment}
    weight = Weight.checked(mass, centre, gravity)
    load = _with_weight(asked, weight, trajectory)
    with run_directory(out) as directory:
        found = follow(g, trajectory, home, **(asked | load), characteristic_length=length, unit=given.unit)
    of_study = path_limits(study, found, home) if study else None

    def words() -> None:
        screen.print(legs_table(found))
        if of_study is not None and of_study.limits:
            screen.print(limits_table(of_study, given.unit))
        for sentence in sentences(found, of_study):
            screen.print(sentence)

    shapes = {name: value for name, value in shape.items() if value is not None}
    question = {
        "geometry": triples(g),
        "home": arrays_of(home),
        **unit_entry(given.unit),
        **asked,
        **({} if weight is None else {"weight": weight._asdict()}),
        **({"file": str(file)} if file else {**shapes, "duration": trajectory.time[-1], "points": len(trajectory)}),
    }
    drawing = partial(draw, found, screen, of_study) if figures else None
    with told(screen, words, {"motion": plain(found, of_study)}) as once:
        drawn = with_report(drawing, figures and report, screen, once)
        record = write_motion(found, directory, drawn, question, of_study)
    figure = ", figure motion (PNG, SVG, PDF)" if figures else ""
    figure += report_words(directory)
    screen.print(f"run folder {directory}: {record.name}, {LEGS_FILE}, {POSES_FILE}, {ARRAYS_FILE}{figure}")
    screen.data({"motion": plain(found, of_study), "record": str(record)})
    broken = found.breaks or (of_study is not None and of_study.breaks)
    raise typer.Exit(DONE if found.tracked and not broken else NO_RESULT)


def _trajectory(
    given: Chosen, file: Path | None, shape: dict[str, Any], times: dict[str, float | int | None]
) -> Trajectory:
    """Return the one trajectory that was asked for."""
    home = given.configuration
    shapes = {name: value for name, value in shape.items() if value is not None}
    options = {name: value for name, value in times.items() if value is not None}
    asked = [*(["a file"] if file else []), *(f"--{name}" for name in shapes)]
    if len(asked) != 1:
        got = " and ".join(asked) or "none"
        raise ValueError(f"path: got {got}, expected one of a CSV file, --circle, --line and --spiral")
    if file is not None:
        for name, value in options.items():
            raise ValueError(f"--{name}: got {value}, expected none with a file: it has its own times")
        return Trajectory.load(file, home, given.unit)
    ((name, value),) = shapes.items()
    make = getattr(Trajectory, name)
    made: Trajectory = make(home, *(value if name == "spiral" else (value,)), **options)
    return made


def _with_weight(load: dict[str, Any], weight: Weight | None, trajectory: Trajectory) -> dict[str, Any]:
    """Return force and moment at each pose with the weight of the platform, nothing without one."""
    if weight is None:
        return {}
    own = weight.wrench(trajectory.rotation)
    given = {name: np.zeros(3) if load[name] is None else np.asarray(load[name]) for name in ("moment", "force")}
    return {"moment": own[:, :3] + given["moment"], "force": own[:, 3:] + given["force"]}


def _rule(text: str | None, study: Study | None) -> str | float:
    """Return the rule for O: that of the option, or of the region of a study."""
    if text is None:
        region = study.objective.region if study else None
        return "carried" if region is None else region.internal_point
    if text in RULES:
        return text
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"--internal-point: got {text!r}, expected {', '.join(RULES)} or a fraction") from None
