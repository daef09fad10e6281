"""Ctrl-C, SIGTERM and SIGHUP while a command runs raise KeyboardInterrupt once: what was done so far is saved.

The exit status is 130, 143 or 129. A second Ctrl-C ends the process at once.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from time import monotonic
from typing import Any

from ninedof.support.starting import ending

SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
ONE_PRESS = 0.1  # seconds: a terminal and a program in between may both hand on one Ctrl-C


class _Handler:
    """The handler of signals for the time of a command."""

    def __init__(self) -> None:
        self.number, self._at = 0, 0.0  # of the signal that came first

    def __call__(self, number: int, *_: Any) -> None:
        if not self.number:
            self.number, self._at = number, monotonic()
            raise KeyboardInterrupt
        if number == signal.SIGINT and monotonic() - self._at > ONE_PRESS:
            os._exit(128 + self.number)


@contextmanager
def interruptible() -> Iterator[None]:
    """Handle signals for the time of a command; a SystemExit with 130 gets the status of the signal that came."""
    handler = _Handler()
    before = {number: signal.getsignal(number) for number in SIGNALS}
    ours = (signal.SIG_DFL, signal.default_int_handler, ending)  # jobs of nohup ignore some
    mine = [n for n in SIGNALS if before[n] in ours] if current_thread() is main_thread() else []
    for number in mine:
        signal.signal(number, handler)
    try:
        yield
    except SystemExit as end:
        if end.code == 128 + signal.SIGINT and handler.number:
            raise SystemExit(128 + handler.number) from None
        raise
    finally:
        for number in mine:
            signal.signal(number, before[number])
