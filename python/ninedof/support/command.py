"""The command line that is being run: records keep it, and it is printed again where it goes on with its run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path


@dataclass
class _Command:
    words: list[str]
    again: list[str] | None = None
    why: str = ""


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
    """Note that the command goes on with its run when it is typed again, with `--out` if it has such a folder."""
    if (command := _RUNNING.get()) is not None:
        has_out = out is None or any(word == "--out" or word.startswith("--out=") for word in command.words)
        command.again = command.words if has_out else [*command.words, "--out", str(out)]


def ended_by_time(without: str = "") -> None:
    """Note that the time ended the run; `without` is an option that is left out where it goes on."""
    if (command := _RUNNING.get()) is not None and command.again is not None:
        command.why = "the time is over"
        if without:
            after = [word == without for word in ["", *command.again]]
            pairs = zip(command.again, after, strict=False)
            command.again = [w for w, value in pairs if not value and w != without and not w.startswith(f"{without}=")]


def how_to_go_on(interrupted: bool) -> str:
    """Return how a command ended, and the line to type to go on with its run; "" where it came to its end."""
    command = _RUNNING.get() or _Command([])
    why = "interrupted" if interrupted else command.why
    return f"{why}; to go on, type: {_typed(command.again)}" if why and command.again else why


def _typed(words: Sequence[str]) -> str:
    import shlex  # when it is needed, as it takes time to load

    return shlex.join(words)
