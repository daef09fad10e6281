"""The report at the end of a job, beside its record and its figures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from ninedof.cli.screen import Screen
from ninedof.report.report import report

Draw = Callable[[Path], Sequence[Path]]


def with_report(draw: Draw | None, wanted: bool, screen: Screen) -> Draw | None:
    """Return a function that draws the figures of a run, if there are any, and then writes its report, if wanted."""
    if not wanted:
        return draw

    def drawn(folder: Path) -> list[Path]:
        files = [] if draw is None else list(draw(folder))
        screen.say("writing the report")
        return [*files, report(folder)]

    return drawn


def report_words(directory: Path) -> str:
    """Return how a message goes on where the folder has a report."""
    return ", report.html" if (directory / "report.html").is_file() else ""
