"""A long call as it runs: its progress, and the command line behind it, which is printed again where it goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast
from warnings import catch_warnings

from ninedof.support.arguments import shown

Progress = Callable[[int, int, float | None], object]
"""Called as progress(done, total, value): the work done, the work in all as far as it is known, and the best objective
or the volume so far; None where there is no such figure."""


def phase(progress: Progress | None, words: str) -> None:
    """Tell a progress that has a method `phase` which part of the work begins."""
    say = getattr(progress, "phase", None)
    if callable(say):
        say(words)


def part_of(progress: Progress | None, part: str) -> Progress | None:
    """Return a progress whose phases begin with the name of a part of the work."""
    phase(progress, part)
    return None if progress is None else _Part(progress, part)


class _Part:
    def __init__(self, whole: Progress, name: str) -> None:
        self._whole, self._name = whole, name

    def __call__(self, done: int, total: int, value: float | None) -> object:
        return self._whole(done, total, value)

    def phase(self, words: str) -> None:
        phase(self._whole, f"{self._name}, {words}")


def notes_told() -> AbstractContextManager[Any]:
    """Leave out warnings: the notes of a study, which were told once."""
    return catch_warnings(action="ignore", category=UserWarning)


def progress_argument(progress: object) -> Progress | None:
    """Return `progress`; raise unless it is callable or None."""
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: got {shown(progress)}, expected a callable of three arguments")
    return cast("Progress | None", progress)


@dataclass
class _Command:
    words: list[str]
    again: list[str] | None = None
    why: str = ""
    goes_on: bool = False


_RUNNING: ContextVar[_Command | None] = ContextVar("command", default=None)


@contextmanager
def running(program: str, arguments: Sequence[str]) -> Iterator[None]:
    """Name the command line that runs until the end of the block."""
    token = _RUNNING.set(_Command([program, *arguments]))
    try:
        yield
    finally:
        _RUNNING.reset(token)


def command_line() -> str:
    """Return the command line as a shell takes it; "" where Python called."""
    command = _RUNNING.get()
    return "" if command is None else _typed(command.words)


def goes_on(out: Path | None = None) -> None:
    """Note that the command goes on with its run when it is typed again, with `--out` if it has such a folder.

    In a folder it goes on once something is kept there; what has none keeps what it has by itself.
    """
    if (command := _RUNNING.get()) is not None:
        has_out = out is None or any(word == "--out" or word.startswith("--out=") for word in command.words)
        command.goes_on = out is None
        command.again = command.words if has_out else [*command.words, "--out", str(out)]


def has_kept() -> None:
    """Note that a part of the work is kept: typed again, the command goes on from there."""
    if (command := _RUNNING.get()) is not None:
        command.goes_on = True


def ended_by_time(without: str = "", instead: Sequence[str] = ()) -> None:
    """Note that the time ended the run; `without` is an option that is left out where it goes on.

    `instead` are words in its place.
    """
    if (command := _RUNNING.get()) is not None and command.again is not None:
        command.why = "the time is over"
        if without:
            after = [word == without for word in ["", *command.again]]
            pairs = zip(command.again, after, strict=False)
            command.again = [w for w, value in pairs if not value and w != without and not w.startswith(f"{without}=")]
            command.again += instead


def how_to_go_on(interrupted: bool) -> str:
    """Return how a command ended, and the line to type to go on with its run; "" where it came to its end."""
    command = _RUNNING.get() or _Command([])
    why = "interrupted" if interrupted else command.why
    aim = "to go on" if command.goes_on else "to begin anew"
    return f"{why}; {aim}, type: {_typed(command.again)}" if why and command.again else why


def _typed(words: Sequence[str]) -> str:
    import shlex  # when it is needed, as it takes time to load

    return shlex.join(words)
