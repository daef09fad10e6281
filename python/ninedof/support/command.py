"""The command line that is being run: records keep it."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar

_RUNNING: ContextVar[str] = ContextVar("command", default="")


@contextmanager
def running(program: str, arguments: Sequence[str]) -> Iterator[None]:
    """Name the command line that runs until the end of the block."""
    token = _RUNNING.set(shlex.join([program, *arguments]))
    try:
        yield
    finally:
        _RUNNING.reset(token)


def command_line() -> str:
    """Return the command line as a shell takes it; "" where Python called."""
    return _RUNNING.get()
