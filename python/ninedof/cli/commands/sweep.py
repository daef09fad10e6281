"""`ninedof sweep`: what is asked for, and a few words about what came out."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from ninedof.cli.chosen_design import chosen_design, length_option
from ninedof.cli.long_run import compute, run_folder, write
from ninedof.cli.options import (
    BaseSide1,
    BaseSide2,
    Figures,
    Height,
    InternalHeight,
    Json,
    Out,
    PlatformSide1,
    PlatformSide2,
    Resume,
    Scheduler,
    Threads,
    TwistDeg,
)
from ninedof.cli.screen import INTERRUPTED, Screen
from ninedof.cli.sweep_summary import describe, json_data, summary_table
from ninedof.design.indices import computed
from ninedof.paper.published import published_variables
from ninedof.runs.design_file import Design, hexagonal_design
from ninedof.support.arguments import shown
from ninedof.support.arrays import thread_argument
from ninedof.sweep import SweepResult, sweep_designs, sweep_figure
from ninedof.sweep import sweep as sweep_poses
from ninedof.sweep.axis import Values
from ninedof.sweep.poses import COORDINATES

FIGURES = ("figure-6", "figure-7")
HEIGHTS = ("zp", "zs")


PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof sweep figure-6                   the condition number against displacement, as in the paper's Fig. 6

  ninedof sweep --over x_p=-1:1:201 --over theta_z_deg=-60:60:121

  ninedof sweep design.toml --over z_s=-1:1:401 --index singular_values --index leg_lengths

  ninedof sweep --over a1=0:3:31 --over b2=0:3:31      designs in place of configurations"""


@dataclass(frozen=True)
class SweepOptions:
    """What the command line says about the points."""

    over: Sequence[str]
    index: Sequence[str]
    absolute: bool
    internal_point: str | None
    lc: str | None
    points: int | None
    chunk: int | None
    threads: int | None


def sweep(
    what: Annotated[
        str | None,
        typer.Argument(
            help="figure-6, figure-7, or a design: a file (TOML), a run folder or its record.json. The published "
            "design at its best zs if none is given."
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        typer.Option(
            help="NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,..., up to three times. Names: x_p y_p z_p theta_x theta_y "
            "theta_z x_s y_s z_s, or a1 a2 b1 b2 zp zs of designs. Angles in radians, or in degrees with _deg behind "
            "the name."
        ),
    ] = None,
    index: Annotated[
        list[str] | None,
        typer.Option(
            help=f"What is computed, condition_number by default; may be repeated. One of {', '.join(computed())}."
        ),
    ] = None,
    absolute: Annotated[
        bool, typer.Option("--absolute", help="Values are the coordinates themselves, not displacements.")
    ] = False,
    internal_point: Annotated[
        str | None, typer.Option(help="Where O is while the platform moves: held (default), carried or best.")
    ] = None,
    a1: BaseSide1 = None,
    a2: BaseSide2 = None,
    b1: PlatformSide1 = None,
    b2: PlatformSide2 = None,
    zp: Height = None,
    zs: InternalHeight = None,
    theta_z_deg: TwistDeg = None,
    lc: Annotated[str | None, typer.Option(help="Characteristic length: a number or a kind.")] = None,
    points: Annotated[int | None, typer.Option(help="Points of each curve of a figure.")] = None,
    chunk: Annotated[int | None, typer.Option(help="Points a chunk. The result does not depend on it.")] = None,
    out: Out = None,
    resume: Resume = False,
    scheduler: Scheduler = None,
    threads: Threads = None,
    figures: Figures = True,
    json: Json = False,
) -> None:
    """Compute an index over one to three coordinates of the configuration, or variables of the design."""
    sides = {"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs}
    options = SweepOptions(over or (), index or (), absolute, internal_point, lc, points, chunk, threads)
    screen = Screen(json)
    thread_argument(options.threads)
    if what in FIGURES:
        _expect_none(f"with {what}", vars(options) | dict(sides) | {"theta_z_deg": theta_z_deg, "points": None})
        asked: Callable[..., SweepResult] = partial(sweep_figure, what.removeprefix("figure-"), options.points)
        title = what.replace("figure-", "Fig. ")
    else:
        asked, title = _asked(what, sides, theta_z_deg, options)
    with run_folder(out, resume) as directory:
        result = compute(asked, title, directory, scheduler, screen)
    if result is None:
        raise typer.Exit(INTERRUPTED)
    summary = {name: describe(result, name) for name in result if result[name].dtype.kind == "f"}
    screen.print(summary_table(summary, title))
    draw = (lambda: _figure(result, what)) if figures else None
    write(result, directory, "sweep", draw, screen, json_data(result, summary))


def _asked(
    what: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None, options: SweepOptions
) -> tuple[Callable[..., SweepResult], str]:
    """Return the sweep of the options, and its title."""
    if what is not None and what.startswith("figure-") and not Path(what).exists():
        raise ValueError(f"sweep: got {what}, expected one of {', '.join(FIGURES)}, or a design")
    if not options.over:
        raise ValueError(f"sweep: got no --over, expected --over NAME=LOW:HIGH:COUNT, or one of {', '.join(FIGURES)}")
    _expect_none("with --over", {"points": options.points})
    over = dict(parse_over(text) for text in options.over)
    if len(over) < len(options.over):
        raise ValueError(f"--over: got {', '.join(options.over)}, expected different names")
    index = tuple(options.index) or ("condition_number",)
    title = f"over {', '.join(over)}"
    length = None if options.lc is None else length_option(options.lc)
    if any(name not in COORDINATES for name in over):
        unheard = {name: getattr(options, name) for name in ("absolute", "internal_point", "threads")}
        _expect_none("in a sweep over designs", unheard)
        held = _variables(what, sides, theta_z_deg, over)
        length = 1.0 if length is None else length
        return partial(sweep_designs, held, over, index, characteristic_length=length, chunk=options.chunk), title
    design = _design(what, sides, theta_z_deg)
    return partial(
        sweep_poses,
        design.geometry,
        design.configuration,
        over,
        index,
        relative=not options.absolute,
        internal_point=options.internal_point or "held",
        characteristic_length=design.characteristic_length if length is None else length,
        chunk=options.chunk,
        threads=options.threads,
    ), title


def _expect_none(where: str, given: Mapping[str, Any]) -> None:
    """Refuse options that nothing would read."""
    for name, value in given.items():
        if value is not None and value is not False and value != ():
            text = " ".join(value) if isinstance(value, list) else value
            got = "it" if value is True else text
            raise ValueError(f"--{name.replace('_', '-')}: got {got}, expected none {where}")


def parse_over(text: str) -> tuple[str, Values]:
    """Read NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,...; an angle's name may end in _deg."""
    expected = "NAME=LOW:HIGH:COUNT, or NAME=VALUE,VALUE,..."
    name, equals, rest = text.partition("=")
    parts = rest.split(":")
    try:
        if not equals or len(parts) not in (1, 3):
            raise ValueError
        in_degrees = name.startswith("theta") and name.endswith("_deg")
        unit = math.radians if in_degrees else float
        name = name.removesuffix("_deg") if in_degrees else name
        if len(parts) == 1:
            return name, np.array([unit(float(value)) for value in rest.split(",")])
        return name, (unit(float(parts[0])), unit(float(parts[1])), int(parts[2]))
    except ValueError:
        raise ValueError(f"--over: got {text!r}, expected {expected}") from None


def _design(what: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None) -> Design:
    """Return the design that is moved: the published one at its best zs where none is given."""
    if what is None and theta_z_deg is None and all(v is None for v in sides.values()):
        return hexagonal_design(published_variables())
    return chosen_design(None if what is None else Path(what), sides, theta_z_deg)


def _variables(
    what: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None, over: Mapping[str, Values]
) -> dict[str, float]:
    """Return the variables that a sweep over designs holds: the published ones where none is given."""
    if what is not None:
        raise ValueError(f"sweep: got {shown(what)} and --over {', '.join(over)}, expected a design by --a1 ... --zs")
    given = {name: value for name, value in sides.items() if value is not None}
    if both := sorted(set(given) & set(over)):
        raise ValueError(f"--over: got {both[0]}, which --{both[0]} holds, expected one of the two")
    values = given or published_variables()
    if theta_z_deg is not None:
        values["theta_z"] = math.radians(theta_z_deg)
    return {name: value for name, value in values.items() if name not in over}


def _figure(result: SweepResult, what: str | None) -> Any:
    from ninedof import plot

    named = {"figure-6": plot.figure_6, "figure-7": plot.figure_7}
    return named[what](result) if what in named else plot.sweep(result)
