"""The search for a workspace body in a thread of its own, given up when another one begins or the viewer closes."""

from __future__ import annotations

import threading
from collections.abc import Callable

from ninedof.viewer.body import Body, BodyQuestion, body

PATIENCE = 10.0  # seconds that closing waits for a search to notice


class BodyJob:
    """At most one search that counts.

    Parameters
    ----------
    found : callable
        Called with the body, from the thread of the search.
    failed : callable
        Called with a sentence where there is none.

    """

    def __init__(self, found: Callable[[Body], None], failed: Callable[[str], None]) -> None:
        self._found, self._failed = found, failed
        self._stop = threading.Event()
        self._threads: list[threading.Thread] = []

    def begin(self, question: BodyQuestion) -> None:
        """Search, in place of the search before."""
        self.cancel()
        stop = self._stop = threading.Event()

        def work() -> None:
            try:
                made = body(question, stop.is_set)
            except ValueError as error:
                if not stop.is_set():
                    self._failed(str(error))
                return
            if made is not None and not stop.is_set():
                self._found(made)

        thread = threading.Thread(target=work, name="ninedof-viewer-workspace", daemon=True)
        self._threads = [*(one for one in self._threads if one.is_alive()), thread]
        thread.start()

    def cancel(self) -> None:
        """Give up the search."""
        self._stop.set()

    def close(self) -> None:
        """Give up the search and wait for its threads: none is left inside the core when Python ends."""
        self.cancel()
        for thread in self._threads:
            thread.join(timeout=PATIENCE)
