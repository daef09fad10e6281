"""The command line that is being run: records keep it, and what it holds is given back when it ends."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from contextvars import ContextVar

_RUNNING: ContextVar[str] = ContextVar("command", default="")
_END: ContextVar[ExitStack | None] = ContextVar("end", default=None)


@contextmanager
def running(program: str, arguments: Sequence[str]) -> Iterator[None]:
    """Name the command line that runs until the end of the block; then do what `at_end` was given, the last first.

    A command that runs within another ends with it.
    """
    token = _RUNNING.set(shlex.join([program, *arguments]))
    with ExitStack() as stack:
        end = _END.set(_END.get() or stack)
        try:
            yield
        finally:
            _END.reset(end)
            _RUNNING.reset(token)


def command_line() -> str:
    """Return the command line as a shell takes it; "" where Python called."""
    return _RUNNING.get()


def at_end(call: Callable[[], object]) -> bool:
    """Call a function when the command ends, however it ends; return False where none runs, but Python called."""
    stack = _END.get()
    if stack is None:
        return False
    stack.callback(call)
    return True
