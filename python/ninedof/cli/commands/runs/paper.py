"""`ninedof paper`: every number of the paper beside ours."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from ninedof.cli.answer import Answer, Figures, finish_job
from ninedof.cli.options import REPORT, THREADS, Options, option, struct
from ninedof.paper.verdicts import verdicts, verdicts_table
from ninedof.records.record import Record, run_folder, write_record
from ninedof.support.kept.store import Store

EXAMPLES = """
  ninedof paper --json | jq '.[].verdict'
  ninedof paper --figures --out figures    Figs. 1 to 7, drawn anew"""


@struct
class _Options(Options):
    figures: bool = option("Draw the seven figures of the paper too.", False, "--figures")
    out: Path | None = option("Folder of the figures; runs/<time> by default.")
    threads: int | None = option(THREADS)
    report: bool = option(REPORT, True, "--report/--no-report")


def paper(options: _Options) -> Answer:
    """Print every number of the paper beside ours, and a verdict on each; with --figures, draw its figures anew."""
    if options.out is not None and not options.figures:
        raise ValueError(f"--out: got {options.out} without --figures, expected both")
    if not options.figures:
        return _answer(options)
    with run_folder(options.out) as directory, Store(directory, {"kind": "paper"}):
        answer = _answer(options)
    write = partial(write_record, Record("paper", {}, {"verdicts": answer.data}), directory)
    finish_job(options, directory, answer, write, _draw)


def _answer(options: _Options) -> Answer:
    rows = [v._asdict() for v in verdicts(options.threads)]
    return Answer([verdicts_table(rows)], rows)


def _draw() -> Figures:
    from ninedof.paper.figures import all_figures

    return all_figures()
