"""Ctrl-C, SIGTERM and SIGHUP while a command runs raise KeyboardInterrupt, and again where it was lost.

What was done so far is saved then, and the exit status is 130, 143 or 129. A second Ctrl-C ends the process at once.
"""

from __future__ import annotations

import os
import signal
import sys
from _thread import interrupt_main
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Timer, current_thread, main_thread
from time import monotonic
from typing import TYPE_CHECKING, Any

from ninedof.support.starting import SIGNALS, ending, status_of, unclaimed

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

INTERRUPTED = status_of(signal.SIGINT)
AGAIN = 0.01  # seconds: a callback has ended by then
ONE_PRESS = 0.1  # seconds: a terminal and a program in between may both hand on one Ctrl-C
SHOW_CURSOR = "\x1b[?25h"


class _Heard:
    """The handler of signals for the time of a command."""

    def __init__(self) -> None:
        self.number = 0
        """Of the signal that came first; 0 before."""
        self._at, self._lost = 0.0, False

    def __call__(self, number: int, *_: Any) -> None:
        if self._lost:
            self._lost = False
        elif not self.number:
            self.number, self._at = number, monotonic()
        elif number == signal.SIGINT and monotonic() - self._at > ONE_PRESS:
            _end_at_once(status_of(self.number))
        else:
            return  # what was done is being saved
        raise KeyboardInterrupt

    def raise_again(self) -> None:
        """Raise once more: the exception was lost in a callback."""
        self._lost = True
        interrupt_main(signal.Signals(self.number or signal.SIGINT))


@contextmanager
def interruptible() -> Iterator[None]:
    """Handle signals for the time of a command; a SystemExit with 130 gets the status of the signal that came.

    Callbacks of weak references and finalizers cannot raise: Python reports an exception there and goes on. Drawing has
    many of them.
    """
    heard = _Heard()
    handlers = {number: signal.getsignal(number) for number in SIGNALS}
    mine = [n for n in SIGNALS if unclaimed(n) or handlers[n] is ending] if current_thread() is main_thread() else []
    for number in mine:
        signal.signal(number, heard)
    before = sys.unraisablehook

    def lost(what: UnraisableHookArgs) -> None:
        if not issubclass(what.exc_type, KeyboardInterrupt):
            before(what)
            return
        again = Timer(AGAIN, heard.raise_again)
        again.daemon = True
        again.start()

    sys.unraisablehook = lost
    try:
        yield
    except SystemExit as end:
        if end.code == INTERRUPTED and heard.number:
            raise SystemExit(status_of(heard.number)) from None
        raise
    finally:
        sys.unraisablehook = before
        if ending in handlers.values():  # what is printed is out before a signal ends the end of the interpreter
            _flush()
        for number in mine:
            signal.signal(number, handlers[number])


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError, AttributeError):  # closed, or nobody reads
            continue


def _end_at_once(status: int) -> None:
    if sys.stderr is not None and sys.stderr.isatty():
        os.write(2, SHOW_CURSOR.encode())  # a bar hides it
    os._exit(status)
