"""`ninedof paper`: every number of the paper beside ours."""

from __future__ import annotations

from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from ninedof.cli.job_report import report_words, told, with_report
from ninedof.cli.options import Json, Report, Threads
from ninedof.cli.screen import Screen
from ninedof.paper.verdicts import verdicts
from ninedof.runs.directory import new_directory
from ninedof.runs.folder import Record, write_drawn
from ninedof.support.arrays import thread_argument

PLACE = 7
EXAMPLES = """[bold]Examples[/bold]

  ninedof paper --json | jq '.[].verdict'

  ninedof paper --figures --out figures    Figs. 1 to 7, drawn anew"""


def paper(
    figures: Annotated[bool, typer.Option("--figures", help="Draw the seven figures of the paper too.")] = False,
    out: Annotated[Path | None, typer.Option(help="Folder of the figures; runs/<time> by default.")] = None,
    threads: Threads = None,
    report: Report = True,
    json: Json = False,
) -> None:
    """Print every number of the paper beside ours, and a verdict on each; with --figures, draw its figures anew."""
    screen = Screen(json)
    thread_argument(threads)
    if out is not None and not figures:
        raise ValueError(f"--out: got {out} without --figures, expected both")
    directory = new_directory(out) if figures else None
    found = verdicts(threads)
    table = Table(
        title="The paper's numbers and ours, lengths in units of l_c", title_justify="left", title_style="bold"
    )
    for title, ratio in (("where", 3), ("printed", 6), ("ours", 9), ("verdict", 8)):
        table.add_column(title, ratio=ratio, overflow="fold")
    for v in found:
        table.add_row(v.where, v.printed, v.ours, v.verdict, end_section=True)
    rows = [asdict(v) for v in found]
    words = partial(screen.print, table)
    if directory is None:
        words()
    else:
        record = Record("paper", {}, {"verdicts": rows})
        with told(screen, words, rows) as once:
            drawing = with_report(partial(_draw, screen), report, screen, once)
            path = write_drawn(record, directory, drawing)
        made = f"{path.name}, figure_1 to figure_7 (PNG, SVG, PDF){report_words(directory)}"
        screen.print(f"run folder {directory}: {made}")
    screen.data(rows)


def _draw(screen: Screen, directory: Path) -> list[Path]:
    from ninedof.paper.figures import draw

    return draw(directory, screen.say)
