"""Ctrl-C while a command runs raises KeyboardInterrupt, and is raised again where it was lost."""

from __future__ import annotations

import signal
import sys
from _thread import interrupt_main
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Timer
from typing import TYPE_CHECKING

from ninedof.support.starting import ending

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

AGAIN = 0.01  # seconds: a callback has ended by then


@contextmanager
def interruptible() -> Iterator[None]:
    """Handle Ctrl-C for the time of a command.

    Callbacks of weak references and finalizers cannot raise: Python reports an exception there and goes on. Drawing has
    many of them.
    """
    if signal.getsignal(signal.SIGINT) is ending:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    before = sys.unraisablehook

    def lost(what: UnraisableHookArgs) -> None:
        if not issubclass(what.exc_type, KeyboardInterrupt):
            before(what)
            return
        again = Timer(AGAIN, interrupt_main)
        again.daemon = True
        again.start()

    sys.unraisablehook = lost
    try:
        yield
    finally:
        sys.unraisablehook = before
