"""Output of the commands: text, progress bars, JSON, and the exit status.

No string is markup here, whoever wrote it, and characters that would move the cursor are shown as escapes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from datetime import timedelta
from functools import partial
from typing import Any

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeRemainingColumn,
)
from rich.table import Column
from rich.text import Text

from ninedof.optimize.result import Result, Status
from ninedof.support.text import encode, escaped, one_line
from ninedof.tables.terminal import terminal

DONE = 0
REFUSED = 1  # by the system: a file, the disk; of `ninedof check`, a certificate
BAD_INPUT = 2
NO_RESULT = 3  # the work is done, and nothing acceptable was found
FAILED = 4  # not by the user: memory, an error of a library, a cluster
INTERRUPTED = 130  # by Ctrl-C; 128 + the number of another signal


def status_of(code: object) -> int:
    """Return the exit status for what a command, or a SystemExit, leaves behind."""
    return code if isinstance(code, int) else DONE if code is None else FAILED


def exit_status(result: Result, timed: bool = False) -> int:
    """Return the exit status of a command that optimizes, within a time limit where it is `timed`.

    A design with which the time ended is a result if it keeps its limits in all of the region.
    """
    if result.interrupted:
        return INTERRUPTED
    if timed and result.region is not None and result.region.keeps_limits:
        return DONE
    return DONE if result.status == Status.OPTIMAL else NO_RESULT


class _Plain(Console):
    """A console to which all strings are text."""

    def __init__(self, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, markup=False, emoji=False, highlight=False)

    def on_broken_pipe(self) -> None:
        """Print no more where the reader went away; the run goes on."""
        self.quiet = True

    def render_str(self, text: str, **options: Any) -> Text:
        return super().render_str(escaped(text), **options)


def bold(words: str, rest: str = "") -> Text:
    """Return text that begins with bold words."""
    return Text.assemble((escaped(words), "bold"), escaped(rest))


class Screen:
    """Text goes to standard output, or to standard error if standard output is for JSON."""

    def __init__(self, json: bool) -> None:
        """Choose the consoles."""
        self.json = json
        self.progress_console = _Plain(stderr=True)
        self.words = _Plain(stderr=True) if json else _Plain()

    def print(self, *parts: Any) -> None:
        """Print sentences and tables, each on lines of its own."""
        for part in parts:
            self.words.print(terminal(part, self.words.width))

    def data(self, value: Any) -> None:
        """Print the result as JSON with --json."""
        if self.json:
            with suppress(BrokenPipeError):
                print(encode(value))

    def say(self, doing: str) -> None:
        """Print the current step, such as drawing."""
        self.progress_console.print(f"  {doing}", style="dim")

    @contextmanager
    def bar(self, kind: str, title: str) -> Iterator[Bar]:
        """Show a progress bar, one of BARS, at once or from the first report on.

        Bad input raises before the first report: a bar that waits for it is then not shown.
        """
        bar = Bar(self.progress_console, kind, title)
        try:
            yield bar
        except ValueError:
            if not bar.reported:  # bad input: nothing was done that the bar could show
                bar.live.transient = True
                bar.live.stop()
            raise
        finally:
            if bar.live.is_started:
                bar.stop()


def best_words(best: float | None) -> str:
    """Return the best objective so far in words."""
    return f"best {best:.6f}" if best is not None and math.isfinite(best) else "no design yet"


class _Boxes(ProgressColumn):
    """The number of boxes so far; nothing before the first."""

    def render(self, task: Task) -> Text:
        return Text(f"{task.completed:,.0f} boxes" if task.completed else "")


FIRST_LINE, LONGEST_SILENCE = 10.0, 300.0  # seconds: in a log lines at 10, 20, 40 ... s, then every five minutes
NARROW = partial(BarColumn, bar_width=12)
VALUE = "{task.fields[value]}"


class _Elapsed(ProgressColumn):
    """The time so far, also where all that is known of is done: boxes are counted, and what follows has no number."""

    def render(self, task: Task) -> Text:
        return Text(str(timedelta(seconds=int(task.elapsed or 0.0))), style="progress.elapsed")


class _ToGo(TimeRemainingColumn):
    """The time that is left; nothing before it is known and when all is done: of the starts rounds may follow."""

    def render(self, task: Task) -> Text:
        known = not task.finished and task.time_remaining is not None
        return Text.assemble(super().render(task), " to go") if known else Text("")


# What a bar shows behind its title, the words for the value of a report, and whether it is shown at once.
BARS: dict[str, tuple[Sequence[Callable[[], ProgressColumn] | str], Callable[[float | None], str], bool]] = {
    "starts": ((NARROW, MofNCompleteColumn, VALUE, _Elapsed, _ToGo), best_words, True),
    "limits": (
        (NARROW, MofNCompleteColumn, VALUE, _ToGo),
        lambda last: "no design" if last is None else f"{last:.6f}",
        True,
    ),
    "points": ((NARROW, "{task.percentage:>3.0f} %", _ToGo, _Elapsed), lambda _: "", False),
    "poses": (
        (NARROW, "{task.completed:,.0f} poses" + VALUE, _ToGo),
        lambda volume: "" if volume is None else f", volume {volume:.4g}",
        False,
    ),
    "boxes": ((_Boxes, _Elapsed), lambda _: "", False),
}


class Bar(Progress):
    """A progress bar, updated by `show` or a call; in a pipe or log a plain line now and then."""

    def __init__(self, console: Console, kind: str, title: str) -> None:
        """Add a task without a length."""
        columns, self._words, at_once = BARS[kind]
        self._title, self.reported, self._next_line = one_line(title), False, FIRST_LINE
        # What the work is at may take several lines; the rest is short.
        first = TextColumn("{task.description}", markup=False, table_column=Column(overflow="fold"))
        parts = (TextColumn(one, markup=False) if isinstance(one, str) else one() for one in columns)
        super().__init__(first, *parts, console=console)
        self._task = self.add_task(self._title, total=None, value="")
        if at_once:
            self.start()

    def show(self, done: int, total: int, value: float | None) -> None:
        """Update the bar: the progress callback of a long call."""
        self.reported = True
        of_proof = not total and self._words is best_words  # boxes, of no known number, and another value
        words = "" if of_proof else self._words(value)
        self.update(self._task, completed=done, total=total or None, value=words)
        self.start()
        self._line()

    __call__ = show

    def phase(self, words: str) -> None:
        """Say behind the title which part of the work is done; the value was that of the part before it."""
        self.update(self._task, description=one_line(f"{self._title}: {words}"), value="")
        self.start()
        self._line()

    def get_renderable(self) -> Any:
        """Return what is drawn; rich calls this ten times a second, also where nothing is reported or drawn."""
        self._line()
        return super().get_renderable()

    def _line(self) -> None:
        """Print what the bar says as a plain line where no bar can be drawn, if the time of the next line has come."""
        with self._lock:
            if not self.tasks or not self.live.is_started or self.console.is_interactive:
                return
            seconds = self.tasks[0].elapsed or 0.0
            if seconds < self._next_line:
                return
            self._next_line = seconds + min(seconds, LONGEST_SILENCE)
            shown = [column(self.tasks[0]) for column in self.columns if isinstance(column, ProgressColumn)]
            words = [part.plain.strip() for part in shown if isinstance(part, Text)]
            with suppress(OSError):  # a pipe that has been closed
                self.console.print("  ".join(filter(None, words)), soft_wrap=True)
