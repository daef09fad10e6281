"""`ninedof sweep`: an index over a grid of configurations or designs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from ninedof.cli import options
from ninedof.cli.chosen_design import Chosen, chosen_design, named_design, with_length
from ninedof.cli.long_run import compute, run_folder, write
from ninedof.cli.remembered import given
from ninedof.cli.screen import INTERRUPTED, Screen
from ninedof.cli.sweep_summary import describe, json_data, summary_table
from ninedof.cli.swept_variables import FAMILIES, VARIABLES, swept_design
from ninedof.design.indices import computed
from ninedof.paper.sweeps import sweep_figure
from ninedof.runs.command_file import Input
from ninedof.support.angles import DEG, plain_name
from ninedof.support.arguments import choice
from ninedof.support.arrays import thread_argument
from ninedof.sweep import SweepResult, sweep_designs
from ninedof.sweep import sweep as sweep_poses
from ninedof.sweep.axis import Values
from ninedof.sweep.poses import COORDINATES, ROTATION

FIGURES = ("figure-6", "figure-7")
ANGLES_DEG = tuple(name + DEG for name in ROTATION)
PLACE = 4
EXAMPLES = """[bold]Examples[/bold]

  ninedof sweep figure-6                   the condition number against displacement, as in the paper's Fig. 6

  ninedof sweep --over x_p=-1:1:201 --over theta_z_deg=-60:60:121

  ninedof sweep design.toml --over z_s=-1:1:401 --index singular_values --index leg_lengths

  ninedof sweep --over a1=0:3:31 --over b2=0:3:31      designs in place of configurations

  ninedof sweep runs/20260101-120000 --over platform_internal_angle_deg=-60:60:121 --index leg_ratio"""


def sweep(
    what: Annotated[
        str | None,
        typer.Argument(
            help=f"figure-6, figure-7, or {options.DESIGN}. By default the published design at its best zs."
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        typer.Option(
            help="NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,..., up to three times. Names: x_p y_p z_p theta_x theta_y "
            "theta_z x_s y_s z_s, or variables of the design's family, as a1 a2 b1 b2 zp zs. Angles in radians, or in "
            "degrees with _deg behind the name."
        ),
    ] = None,
    index: Annotated[
        list[str] | None,
        typer.Option(
            help=f"The index, condition_number by default; may be repeated. One of "
            f"{', '.join(computed())}; over designs also six_legged."
        ),
    ] = None,
    absolute: Annotated[
        bool, typer.Option("--absolute", help="Values are the coordinates themselves, not displacements.")
    ] = False,
    internal_point: Annotated[
        str | None, typer.Option(help="Position of O while the platform moves: held (default), carried or best.")
    ] = None,
    a1: options.BaseSide1 = None,
    a2: options.BaseSide2 = None,
    b1: options.PlatformSide1 = None,
    b2: options.PlatformSide2 = None,
    zp: options.Height = None,
    zs: options.InternalHeight = None,
    theta_z_deg: options.TwistDeg = None,
    lc: options.Lc = None,
    points: Annotated[int | None, typer.Option(help="Points of each curve of a figure.")] = None,
    chunk: Annotated[int | None, typer.Option(help="Points per chunk. The result does not depend on it.")] = None,
    out: options.Out = None,
    resume: options.Resume = False,
    scheduler: options.Scheduler = None,
    threads: options.Threads = None,
    figures: options.Figures = True,
    report: options.Report = True,
    json: options.Json = False,
) -> None:
    """Compute an index over one to three coordinates of the configuration, or variables of the design."""
    screen = Screen(json)
    thread_argument(threads)
    reads = Input.of(what)
    what = what and given(what)
    sides = {"a1": a1, "a2": a2, "b1": b1, "b2": b2, "zp": zp, "zs": zs}
    of_poses = {"absolute": absolute, "internal_point": internal_point, "threads": threads}
    if what in FIGURES:
        others = {"over": over, "index": index, **of_poses, "lc": lc, "chunk": chunk, "theta_z_deg": theta_z_deg}
        _expect_none(f"with {what}", others | sides)
        asked: Callable[..., SweepResult] = partial(sweep_figure, what.removeprefix("figure-"), points)
        title = what.replace("figure-", "Fig. ")
    else:
        grid, indices = _grid(what, over or [], points), index or ("condition_number",)
        title = f"over {', '.join(grid)}"
        if all(plain_name(name) in COORDINATES for name in grid):
            title += "" if absolute else ", from the neutral pose"
            design = with_length(_design(what, sides, theta_z_deg), lc)
            asked = partial(
                sweep_poses,
                design.geometry,
                design.configuration,
                grid,
                indices,
                relative=not absolute,
                internal_point=internal_point or "held",
                characteristic_length=design.characteristic_length,
                unit=design.unit,
                chunk=chunk,
                threads=threads,
            )
        else:
            _expect_none("in a sweep over designs", of_poses)
            family, held, length, unit = swept_design(what, sides, theta_z_deg, grid, lc)
            of_family = partial(sweep_designs, family=family, characteristic_length=length, unit=unit)
            asked = partial(of_family, held, grid, indices, chunk=chunk)
    with run_folder(out, resume, reads) as directory:
        result = compute(asked, title, directory, scheduler, screen)
    if result is None:
        raise typer.Exit(INTERRUPTED)
    summary = {name: describe(result, name) for name in result if result[name].dtype.kind == "f"}
    words = partial(screen.print, summary_table(summary, title, result.units))
    draw = (lambda: _figures(result, what)) if figures else None
    write(result, directory, "sweep", draw, screen, json_data(result, summary), words, report)


def _grid(what: str | None, over: Sequence[str], points: int | None) -> dict[str, Values]:
    """Return the axes given by --over."""
    if what is not None and what.startswith("figure-") and not Path(what).exists():
        raise ValueError(f"sweep: got {what}, expected one of {', '.join(FIGURES)}, or a design")
    if not over:
        raise ValueError(f"sweep: got no --over, expected --over NAME=LOW:HIGH:COUNT, or one of {', '.join(FIGURES)}")
    _expect_none("with --over", {"points": points})
    grid = dict(parse_over(text) for text in over)
    for name in grid:
        if plain_name(name) not in VARIABLES:
            hexagonal = (n for n in FAMILIES["hexagonal"] if n not in COORDINATES)
            choice("--over", name, (*COORDINATES, *ANGLES_DEG, *hexagonal))
    plain = {plain_name(name) for name in grid}
    if not plain <= set(COORDINATES) and not plain <= VARIABLES:  # theta_z is both
        got = ", ".join(grid)
        raise ValueError(f"--over: got {got}, expected coordinates of the configuration or variables of the design")
    if len(grid) < len(over):
        raise ValueError(f"--over: got {', '.join(over)}, expected different names")
    return grid


def _expect_none(where: str, given: Mapping[str, Any]) -> None:
    """Raise for options that have no effect here."""
    for name, value in given.items():
        if value is not None and value is not False:
            text = " ".join(value) if isinstance(value, list) else value
            got = "it" if value is True else text
            raise ValueError(f"--{name.replace('_', '-')}: got {got}, expected none {where}")


def parse_over(text: str) -> tuple[str, Values]:
    """Read NAME=LOW:HIGH:COUNT or NAME=VALUE,VALUE,...; the name of an angle in degrees ends in _deg."""
    expected = "NAME=LOW:HIGH:COUNT, or NAME=VALUE,VALUE,..."
    name, equals, rest = text.partition("=")
    parts = rest.split(":")
    try:
        if not equals or len(parts) not in (1, 3):
            raise ValueError
        if len(parts) == 1:
            return name, np.array([float(value) for value in rest.split(",")])
        return name, (float(parts[0]), float(parts[1]), int(parts[2]))
    except ValueError:
        raise ValueError(f"--over: got {text!r}, expected {expected}") from None


def _design(what: str | None, sides: Mapping[str, float | None], theta_z_deg: float | None) -> Chosen:
    """Return the given design, or the published one at its best zs."""
    if what is None and theta_z_deg is None and all(v is None for v in sides.values()):
        return named_design(None)
    return chosen_design(what, sides, theta_z_deg)


def _figures(result: SweepResult, what: str | None) -> Iterator[tuple[str, Any]]:
    """Yield the name of each figure with the figure: one for each index."""
    from ninedof import plot
    from ninedof.paper import figures

    named: dict[str, Any] = {"figure-6": figures.figure_6, "figure-7": figures.figure_7}
    if what in named:
        yield "sweep", named[what](result)
        return
    indices = list(result)
    for name in indices:
        yield ("sweep" if len(indices) == 1 else f"sweep_{name}"), plot.sweep(result, name)
