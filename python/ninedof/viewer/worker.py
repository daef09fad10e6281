"""The thread that makes the changes of a viewer, one after another, and brings the screen up to date."""

from __future__ import annotations

import threading
import time
import traceback
import warnings
from collections.abc import Callable

FRAME = 1.0 / 40.0  # seconds between two poses of a path that is played
SETTLED = 0.5  # seconds without a change after which all sliders are set to the model
PATIENCE = 10.0  # seconds that closing waits for the thread

Change = Callable[[], object]


class Worker:
    """Makes changes from `start` to `close`.

    Parameters
    ----------
    apply : callable
        Called with the changes and the seconds that a path was played.
    update : callable
        Called after them with whether all has settled.
    tell : callable
        Called with the sentence of a ValueError.
    playing : callable
        Whether a path is played.

    """

    def __init__(
        self,
        apply: Callable[[list[Change], float], None],
        update: Callable[[bool], None],
        tell: Callable[[str], None],
        playing: Callable[[], bool],
    ) -> None:
        self._apply, self._update, self._tell, self._playing = apply, update, tell, playing
        self._pending: dict[str, Change] = {"first": lambda: None}
        self._wake = threading.Condition()
        self.closed = threading.Event()
        self.thread = threading.Thread(target=self._work, name="ninedof-viewer", daemon=True)

    def start(self) -> None:
        """Begin."""
        self.thread.start()

    def submit(self, key: str, change: Change) -> None:
        """Let a change be made soon; it replaces one of the same key that still waits."""
        with self._wake:
            self._pending.pop(key, None)
            self._pending[key] = change
            self._wake.notify()

    def close(self) -> bool:
        """End the thread; return whether it was still to be ended."""
        with self._wake:
            if self.closed.is_set():
                return False
            self.closed.set()
            self._wake.notify_all()
        if threading.current_thread() is not self.thread:
            self.thread.join(timeout=PATIENCE)
            if self.thread.is_alive():
                warnings.warn(
                    f"the viewer is closed, but its thread is still at work after {PATIENCE:g} s",
                    RuntimeWarning,
                    stacklevel=3,
                )
        return True

    def _work(self) -> None:
        settled, last = True, time.monotonic()
        while not self.closed.is_set():
            playing = self._playing()
            with self._wake:  # what ends the wait changes under the same lock: no call is missed
                self._wake.wait_for(
                    lambda: bool(self._pending) or self.closed.is_set(),
                    FRAME if playing else None if settled else SETTLED,
                )
                changes, self._pending = list(self._pending.values()), {}
            now = time.monotonic()
            passed, last = now - last, now
            if self.closed.is_set() or (settled and not changes and not playing):
                continue
            try:
                self._apply(changes, passed if playing else 0.0)
                settled = not changes and not playing
                self._update(settled)
            except ValueError as error:
                self._tell(str(error))
                settled = False
            except Exception:  # the viewer goes on; a mistake of the program is shown where it was started
                traceback.print_exc()
                settled = True
