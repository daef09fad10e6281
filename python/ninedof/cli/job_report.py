"""The report at the end of a job, beside its record and its figures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from rich.markup import escape

from ninedof.cli.screen import Screen
from ninedof.report.report import report

Draw = Callable[[Path], Sequence[Path]]


def with_report(draw: Draw | None, wanted: bool, screen: Screen) -> Draw | None:
    """Return a function that draws the figures of a run, if there are any, and then writes its report, if wanted.

    A report that fails does not fail the job: the screen says why in one line.
    """
    if not wanted:
        return draw

    def drawn(folder: Path) -> list[Path]:
        files = [] if draw is None else list(draw(folder))
        screen.say("writing the report")
        try:
            files.append(report(folder))
        except Exception as error:  # whatever it is: the run is solved and kept, its report can be written again
            words = str(error) if isinstance(error, OSError | ValueError) else repr(error)
            screen.print(escape(f"the report could not be written: {' '.join(words.split())}"))
        return files

    return drawn


def report_words(directory: Path) -> str:
    """Return how a message goes on where the folder has a report."""
    return ", report.html" if (directory / "report.html").is_file() else ""
