"""Where words, bars and machine-readable results go, and what the shell is told."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from ninedof.optimize.result import Result, Status
from ninedof.support.json import encode

DONE, NO_RESULT, INTERRUPTED = 0, 3, 130  # 2, bad input, is the command line's


def exit_status(result: Result) -> int:
    """Return what the shell is told."""
    if result.interrupted:
        return INTERRUPTED
    return DONE if result.status == Status.OPTIMAL else NO_RESULT


class Screen:
    """Where words go: standard output, or standard error where standard output is for JSON."""

    def __init__(self, json: bool) -> None:
        """Choose the consoles."""
        self.json = json
        self.progress_console = Console(stderr=True)
        self.words = Console(stderr=True) if json else Console(highlight=False)

    def print(self, *parts: Any) -> None:
        """Print words or a table for a person."""
        self.words.print(*parts)

    def data(self, value: Any) -> None:
        """Print the machine-readable result, if it was asked for."""
        if self.json:
            print(encode(value))

    def say(self, doing: str) -> None:
        """Say what is being done besides solving."""
        self.progress_console.print(f"  {doing}", style="dim", highlight=False)

    @contextmanager
    def progress(self, title: str) -> Iterator[Bar]:
        """Show a bar of starts while solving, then what else is done."""
        columns = (
            TextColumn("{task.description}"),
            BarColumn(bar_width=24),
            MofNCompleteColumn(),
            TextColumn("{task.fields[best]}"),
            TimeElapsedColumn(),
        )
        with Progress(*columns, console=self.progress_console) as shown:
            yield Bar(shown, title)

    @contextmanager
    def points(self, title: str) -> Iterator[PointBar]:
        """Show a bar of points with the time to go."""
        columns = (
            TextColumn("{task.description}"),
            BarColumn(bar_width=24),
            TextColumn("{task.percentage:>3.0f} %"),
            TimeRemainingColumn(),
            TextColumn("to go"),
            TimeElapsedColumn(),
        )
        with started_by_first_report(Progress(*columns, console=self.progress_console)) as shown:
            yield PointBar(shown, title)


@contextmanager
def started_by_first_report(shown: Progress) -> Iterator[Progress]:
    """Let the first report start the bar: input that is refused before that shows none."""
    try:
        yield shown
    finally:
        if shown.live.is_started:
            shown.stop()


class PointBar:
    """A bar of points."""

    def __init__(self, shown: Progress, title: str) -> None:
        """Begin at nothing."""
        self._shown = shown
        self._task = shown.add_task(title, total=None)

    def show(self, done: int, total: int, _: float | None) -> None:
        """Show the progress of a sweep."""
        self._shown.start()
        self._shown.update(self._task, completed=done, total=total)


class Bar:
    """A bar of starts."""

    def __init__(self, shown: Progress, title: str) -> None:
        """Begin at nothing."""
        self._shown = shown
        self._task = shown.add_task(title, total=None, best="")

    def starts(self, done: int, total: int, best: float | None) -> None:
        """Take the progress of an optimization."""
        words = "no design" if best is None else f"best {best:.6f}"
        self._shown.update(self._task, completed=done, total=total, best=words)
