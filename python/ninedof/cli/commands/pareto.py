"""`ninedof pareto`: a trade-off, its table and its run folder."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from ninedof.cli.chosen_design import named_design
from ninedof.cli.job_report import report_words, told, with_report
from ninedof.cli.long_run import CHUNKS, run_folder
from ninedof.cli.options import Figures, Json, Out, Report, Resume, Starts, Threads
from ninedof.cli.remembered import given
from ninedof.cli.screen import DONE, INTERRUPTED, NO_RESULT, Screen, bold
from ninedof.design.limits import names_with_max, split_label
from ninedof.design.study import Study
from ninedof.optimize.result import Result
from ninedof.pareto import Front
from ninedof.pareto import pareto as trace_front
from ninedof.pareto.front import row_words
from ninedof.pareto.limited import with_degrees
from ninedof.runs.command_file import Input
from ninedof.runs.folder import write_run
from ninedof.runs.objects import split
from ninedof.support.arrays import thread_argument
from ninedof.support.units import with_unit

PLACE = 2
EXAMPLES = """[bold]Examples[/bold]

  ninedof pareto --against radius_ratio    the paper's optimum for several sizes of the base

  ninedof pareto study.toml --against stroke --value 0.1 --value 0.2 --value 0.4

  ninedof pareto study.toml --against base_cone_deg --value 30 --value 35

  ninedof pareto runs/20260101-120000 --points 7   the study of a run, against the limit of greatest price

  ninedof pareto study.toml --against leg_ratio --out front     --resume after an interruption"""


def pareto(
    study: Annotated[
        Path | None,
        typer.Argument(help="A study file (TOML), or a run folder: its study. The paper's study if none is given."),
    ] = None,
    against: Annotated[
        str | None,
        typer.Option(
            help='The limit that is swept: a constraint ("leg_ratio", "leg_ratio at neutral", "base_cone_deg"), or '
            "condition_limit. By default radius_ratio, of a run the limit of greatest price."
        ),
    ] = None,
    value: Annotated[
        list[float] | None,
        typer.Option(
            help="A limit to solve, angles in degrees; may be repeated. By default the command selects the limits."
        ),
    ] = None,
    points: Annotated[int, typer.Option(help="Number of limits, if the command selects them.")] = 13,
    out: Out = None,
    resume: Resume = False,
    starts: Starts = None,
    threads: Threads = None,
    figures: Figures = True,
    report: Report = True,
    json: Json = False,
) -> None:
    """Compute the least condition number for each value of a limit."""
    screen = Screen(json)
    thread_argument(threads)
    for limit in value or ():
        if not 0.0 < limit < math.inf:
            raise ValueError(f"--value: got {limit:g}, expected a finite number above 0")
    reads = Input.of(None if study is None else str(study))
    study = None if study is None else Path(given(str(study)))
    asked, run = _asked(study)
    chosen = asked.with_solver(starts)
    if against is None:
        against = "radius_ratio" if run is None else _dearest(run)
    against = with_degrees(against)  # at the terminal angles are degrees
    name = "the paper's problem" if study is None else study.name
    if chosen.length_note:
        screen.print(chosen.length_note)
    with run_folder(out, resume, reads) as directory, screen.limits(f"{name}, {against}") as bar:
        front = trace_front(
            replace(chosen), against, value or None, points, threads=threads, progress=bar.show, out=directory / CHUNKS
        )

    def words() -> None:
        if front.limits:
            screen.print(front_table(front))
        if front.interrupted:
            screen.print(bold("interrupted", f": {_count(front)} solved so far and kept in {directory}"))

    drawn = figures and not front.interrupted and any(math.isfinite(limit) for limit in front.limits)
    draw = partial(_draw, front, screen) if drawn else None
    with told(screen, words, {"front": front.to_dict()}) as once:
        record = write_run(
            front, directory, with_report(draw, figures and report and not front.interrupted, screen, once)
        )
    figure = ", figure front (PNG, SVG, PDF)" if drawn else ""
    screen.print(f"run folder {record.parent}: {record.name}{figure}{report_words(directory)}")
    screen.data({"front": front.to_dict(), "record": str(record)})
    if front.interrupted:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(DONE if any(not math.isnan(found) for found in front.objectives) else NO_RESULT)


def _count(front: Front) -> str:
    return "1 limit is" if len(front) == 1 else f"{len(front)} limits are"


def _asked(study: Path | None) -> tuple[Study, Result | None]:
    """Return the study of a file, or that of a run with its result; that of the paper without either."""
    if study is None:
        return Study.paper(), None
    place, point = split(str(study))
    if not point and not place.is_dir() and place.suffix != ".json":
        return Study.load(study), None
    run = named_design(str(study)).result
    assert run is not None  # a run folder
    return run.study, run


def _dearest(run: Result) -> str:
    """Return the limit of a run whose relaxation buys most."""
    prices = run.prices or {}
    names = [name for name in prices if split_label(name)[0] in names_with_max() or name == "condition_limit"]
    if not names:
        raise ValueError(
            "--against: got none, expected the limit to sweep: no limit with a max has a price in this run"
        )
    return max(names, key=lambda name: prices[name])


def front_table(front: Front) -> Table:
    """Return the table of a front: one limit per row, the tightest first."""
    title = f"{front.study.words} against {front.limit_name.replace('_', ' ')}"
    table = Table(title=title, title_justify="left", title_style="bold")
    limit = f"{front.limit_name}\n{with_unit('at most', 'deg' if front.unit == 'rad' else front.unit)}"
    for title in ("no.", limit, "objective", "neutral\ncondition number", "price\n% for 1 %"):
        table.add_column(title, justify="right")
    table.add_column("limits reached, or why there is no design", overflow="fold")
    for number, row in enumerate(front.table(), start=1):  # RUN#1 names the first
        reached = row_words(front, row)
        if row["objective"] is None:
            table.add_row(str(number), _limit(front, row["limit"]), "-", "-", "-", reached)
            continue
        price = "-" if row["price"] is None else f"{row['price']:.3f}"
        numbers = f"{row['objective']:.6f}", f"{row['condition_number']:.6f}", price
        table.add_row(str(number), _limit(front, row["limit"]), *numbers, reached)
    return table


def _limit(front: Front, value: float) -> str:
    return f"{math.degrees(value) if front.unit == 'rad' else value:.5g}"


def _draw(front: Front, screen: Screen, directory: Path) -> list[Path]:
    screen.say("drawing the front")
    from ninedof import plot

    return plot.save(plot.front(front), directory, "front")
