"""`ninedof paper`: every number of the paper beside ours."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from ninedof.cli.answer import Answer, folder_words, write_job
from ninedof.cli.options import REPORT, THREADS, Options, option, struct
from ninedof.cli.screen import Screen
from ninedof.paper.verdicts import verdicts, verdicts_table
from ninedof.records.record import Record, run_folder, write_drawn
from ninedof.support.kept.store import Store

PLACE = 7
EXAMPLES = """
  ninedof paper --json | jq '.[].verdict'
  ninedof paper --figures --out figures    Figs. 1 to 7, drawn anew"""


@struct
class _Options(Options):
    figures: bool = option("Draw the seven figures of the paper too.", False, "--figures")
    out: Path | None = option("Folder of the figures; runs/<time> by default.")
    threads: int | None = option(THREADS)
    report: bool = option(REPORT, True, "--report/--no-report")


def paper(options: _Options) -> None:
    """Print every number of the paper beside ours, and a verdict on each; with --figures, draw its figures anew."""
    screen = options.screen
    if options.out is not None and not options.figures:
        raise ValueError(f"--out: got {options.out} without --figures, expected both")
    if not options.figures:
        rows = [v._asdict() for v in verdicts(options.threads)]
        screen.print(verdicts_table(rows))
    else:
        with run_folder(options.out) as directory, Store(directory, {"kind": "paper"}):
            rows = [v._asdict() for v in verdicts(options.threads)]
            write = partial(write_drawn, Record("paper", {}, {"verdicts": rows}), directory)
            write_job(screen, Answer([verdicts_table(rows)], rows), write, partial(_draw, screen), options.report)
        screen.print(folder_words(directory))
    screen.data(rows)


def _draw(screen: Screen, directory: Path) -> list[Path]:
    from ninedof.paper.figures import draw

    return draw(directory, screen.say)
