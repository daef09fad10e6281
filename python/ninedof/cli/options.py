"""Options that several commands share, and the structs that hold those of a command."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

Two = tuple[float, float]
Three = tuple[float, float, float]

Json = Annotated[
    bool, typer.Option("--json", help="Print the result as JSON on standard output, text on standard error.")
]
Threads = Annotated[
    int | None, typer.Option(help="Threads; one per processor by default. The result does not depend on it.")
]
DESIGN = "a design file (TOML), a run folder (its best design), or RUN#7 (point 7 of a front, counted from 1)"
Design = Annotated[str, typer.Argument(help=f"{DESIGN[0].upper()}{DESIGN[1:]}.")]
DesignOrPublished = Annotated[
    str | None, typer.Argument(help=f"{DESIGN[0].upper()}{DESIGN[1:]}; the published design if none is given.")
]
Lc = Annotated[
    str | None,
    typer.Option(help="Characteristic length: a number, optimal, natural, mean_leg or platform_radius; the design's."),
]
StudyFile = Annotated[Path | None, typer.Argument(help="A study file (TOML). The paper's study if none is given.")]
Out = Annotated[
    Path | None,
    typer.Option(help="Run folder; runs/<time> by default. The same command goes on with an unfinished run there."),
]
Plot = Annotated[Path | None, typer.Option(help="Draw the plates over each other: a .png, .svg or .pdf file.")]
Starts = Annotated[int | None, typer.Option(help="Starts, in place of the study's.")]
Figures = Annotated[bool, typer.Option("--figures/--no-figures", help="Draw the figures.")]
Report = Annotated[bool, typer.Option("--report/--no-report", help="Write the report, with the figures.")]
Scheduler = Annotated[
    str | None, typer.Option(help="Address of a Dask scheduler, as tcp://host:8786; its workers compute the chunks.")
]
LOAD = typer.Option(
    help='A load "mx my mz fx fy fz" on the platform: moment about p and force; of the study. Repeatable.'
)
LEG_ERROR = typer.Option(help="Tolerance of the leg lengths; of the study.")
JOINT_ERROR = typer.Option(help="Tolerance of the joint centres, a radius; of the study.")
LEG_STIFFNESS = typer.Option(help="Stiffness of each leg, force/length.")
LegLimits = Annotated[
    Two | None, typer.Option(metavar="LOW HIGH", help="Limits of all nine legs; those of the run's study by default.")
]

BaseSide1 = Annotated[float | None, typer.Option(help="Base side (eq. 37).")]
BaseSide2 = Annotated[float | None, typer.Option(help="Base side.")]
PlatformSide1 = Annotated[float | None, typer.Option(help="Platform side (eq. 38).")]
PlatformSide2 = Annotated[float | None, typer.Option(help="Platform side.")]
Height = Annotated[float | None, typer.Option(help="Height of the platform.")]
InternalHeight = Annotated[float | None, typer.Option(help="Height of the internal point.")]
TwistDeg = Annotated[float | None, typer.Option(help="Twist of the platform, degrees; 0 by default.")]


@dataclass(frozen=True, kw_only=True)
class Options:
    """Options of a command that prints."""

    json: Json = False


@dataclass(frozen=True, kw_only=True)
class JobOptions(Options):
    """Options of a command that makes a run folder."""

    out: Out = None
    figures: Figures = True
    report: Report = True
