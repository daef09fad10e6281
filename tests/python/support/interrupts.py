"""SIGINT to this process while the core works: at an event, however busy the machine is."""

import os
import signal
import sys
import threading
from contextlib import contextmanager
from time import perf_counter, sleep

from ninedof import _core


class Interrupter:
    """A progress callback: when it is called first, another thread sends SIGINT. Only the core calls it."""

    def __init__(self):
        self.sent = None
        """When SIGINT was sent, by `perf_counter`; None before."""
        self._event, self._over = threading.Event(), False
        self._thread = threading.Thread(target=self._interrupt)

    def __call__(self, *_):
        self._event.set()

    def _interrupt(self):
        self._event.wait()
        if not self._over:
            self.sent = perf_counter()
            os.kill(os.getpid(), signal.SIGINT)

    def start(self):
        self._thread.start()

    def stop(self):
        self._over = True
        self._event.set()
        self._thread.join()


@contextmanager
def interrupter():
    """An `Interrupter` for the one call in the block."""
    sender = Interrupter()
    sender.start()
    try:
        yield sender
    finally:
        sender.stop()


@contextmanager
def interrupted_on_entry(name):
    """Send SIGINT as soon as the core's function `name` gives the GIL away: before it has found anything."""
    core, interval, sender = getattr(_core, name), sys.getswitchinterval(), Interrupter()

    def watched(*arguments, **options):
        sys.setswitchinterval(1000.0)  # the other thread does not run before
        sender()
        return core(*arguments, **options)

    sender.start()
    setattr(_core, name, watched)
    try:
        yield
    finally:
        setattr(_core, name, core)
        sys.setswitchinterval(interval)
        sender.stop()


class InterruptedPhase:
    """A progress callback that keeps what it is told; it sends SIGINT where a phase begins in these words, if any.

    The nth time that one does.
    """

    def __init__(self, words="no words", nth=1):
        self.phases, self.reports, self._words, self._left = [], [], words, nth

    def __call__(self, *report):
        self.reports.append(report)

    def phase(self, words):
        self.phases.append(words)
        self._left -= words.startswith(self._words)
        if self._left == 0:
            signal.raise_signal(signal.SIGINT)


def until(condition, seconds=20.0):
    """Wait until something is so."""
    end = perf_counter() + seconds
    while not condition():
        assert perf_counter() < end
        sleep(0.01)
