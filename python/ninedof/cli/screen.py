"""Output of the commands: text, progress bars, JSON, and the exit status."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from ninedof.optimize.result import Result, Status
from ninedof.support.json import encode

DONE, NO_RESULT, INTERRUPTED = 0, 3, 130  # 2, for bad input, is set by `app`


def exit_status(result: Result) -> int:
    """Return the exit status of a command that optimizes."""
    if result.interrupted:
        return INTERRUPTED
    return DONE if result.status == Status.OPTIMAL else NO_RESULT


class Screen:
    """Text goes to standard output, or to standard error if standard output is for JSON."""

    def __init__(self, json: bool) -> None:
        """Choose the consoles."""
        self.json = json
        self.progress_console = Console(stderr=True)
        self.words = Console(stderr=True) if json else Console(highlight=False)

    def print(self, *parts: Any) -> None:
        """Print text or a table."""
        self.words.print(*parts)

    def data(self, value: Any) -> None:
        """Print the result as JSON with --json."""
        if self.json:
            print(encode(value))

    def say(self, doing: str) -> None:
        """Print the current step, such as drawing."""
        self.progress_console.print(f"  {doing}", style="dim", highlight=False)

    def progress(self, title: str) -> AbstractContextManager[Bar]:
        """Show a bar of runs with the best objective so far."""
        columns = (BarColumn(bar_width=14), MofNCompleteColumn(), "{task.fields[value]}", TimeElapsedColumn())
        return self._bar(title, columns, best_words, at_once=True)

    def limits(self, title: str) -> AbstractContextManager[Bar]:
        """Show a bar of solved limits with the last objective and the remaining time, as far as the work is known."""
        columns = (
            BarColumn(bar_width=12),
            MofNCompleteColumn(),
            "{task.fields[value]}",
            TimeRemainingColumn(),
            "to go",
        )
        return self._bar(title, columns, lambda last: "no design" if last is None else f"{last:.6f}", at_once=True)

    def points(self, title: str) -> AbstractContextManager[Bar]:
        """Show a bar of points with the remaining time."""
        percent = "{task.percentage:>3.0f} %"
        columns = (BarColumn(bar_width=24), percent, TimeRemainingColumn(), "to go", TimeElapsedColumn())
        return self._bar(title, columns, lambda _: "")

    def poses(self, title: str) -> AbstractContextManager[Bar]:
        """Show a bar of poses with the volume so far and the remaining time, estimated from the levels so far."""
        count = "{task.completed:,.0f} poses{task.fields[value]}"
        columns = (BarColumn(bar_width=12), count, TimeRemainingColumn(), "to go")
        return self._bar(title, columns, lambda volume: "" if volume is None else f", volume {volume:.4g}")

    def boxes(self, title: str) -> AbstractContextManager[Bar]:
        """Show a bar of boxes of poses, of which nobody knows how many there will be."""
        columns = (_Boxes(), TimeElapsedColumn())
        return self._bar(title, columns, lambda _: "")

    @contextmanager
    def _bar(
        self,
        title: str,
        columns: tuple[ProgressColumn | str, ...],
        words: Callable[[float | None], str],
        at_once: bool = False,
    ) -> Iterator[Bar]:
        """Show a bar from the first report on, or at once. Bad input raises before the first report: no bar then."""
        shown = Progress("{task.description}", *columns, console=self.progress_console)
        if at_once:
            shown.start()
        try:
            yield Bar(shown, title, words)
        finally:
            if shown.live.is_started:
                shown.stop()


class _Boxes(ProgressColumn):
    """How many boxes of poses were looked at; nothing before the first."""

    def render(self, task: Task) -> Text:
        return Text(f"{task.completed:,.0f} boxes of poses" if task.completed else "")


def best_words(best: float | None) -> str:
    """Return the best objective so far in words."""
    return f"best {best:.6f}" if best is not None and math.isfinite(best) else "no design yet"


class Bar:
    """A progress bar, updated by `show` or a call."""

    def __init__(self, shown: Progress, title: str, words: Callable[[float | None], str]) -> None:
        """Add a bar without a length; `words` formats the value of a report."""
        self._shown, self._title, self._words = shown, title, words
        self._task = shown.add_task(title, total=None, value="")

    def show(self, done: int, total: int, value: float | None) -> None:
        """Update the bar: the progress callback of a long call."""
        self._shown.start()
        self._shown.update(self._task, completed=done, total=total, value=self._words(value))

    __call__ = show

    def phase(self, words: str) -> None:
        """Say behind the title which part of the work is done."""
        self._shown.start()
        self._shown.update(self._task, description=f"{self._title}: {words}")
