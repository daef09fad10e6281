"""`ninedof report`: a run as one page of HTML."""

from __future__ import annotations

from pathlib import Path

import ninedof as nd
from ninedof.cli.answer import Answer
from ninedof.cli.options import Options, argument, option, struct
from ninedof.support.kept.files import own_or_new

MARK = "Made by ninedof"  # in every report
EXAMPLES = """
  ninedof report runs/20260101-120000                 report.html in the run folder
  ninedof report runs/20260101-120000 --out mine.html
  ninedof report front#3                              point 3 of a trade-off"""


@struct
class _Options(Options):
    run: str = argument("A run folder, or RUN#7: point 7 of a front, counted from 1.")
    out: Path | None = option("File to write; report.html in the run folder, or report-7.html, by default.")


def report(options: _Options) -> Answer:
    """Write a run as one page of HTML: question, answer, the machine to turn by hand, sheet, figures, proof."""
    if options.out is not None:
        own_or_new("--out", options.out, MARK)
    if Path(options.run.partition("#")[0]).exists():
        options.screen.say("writing the report: searching and drawing")
    file = nd.report(options.run, options.out)
    size = file.stat().st_size / 1e6
    return Answer([f"report {file}, {size:.2f} MB: open it in a browser"], {"report": str(file)})
