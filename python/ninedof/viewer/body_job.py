"""The search for a workspace body in a thread of its own, given up when another one begins or the viewer closes."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable

from ninedof.viewer.body import Body, BodyQuestion, body

PATIENCE = 10.0  # seconds that closing waits for a search to notice


class BodyJob:
    """At most one search that counts. Any thread may begin or cancel.

    Parameters
    ----------
    found : callable
        Called with the number of the search and the body, from the thread of the search. Who shows it asks `counts`
        when that is done: the search may be given up in between.
    failed : callable
        Called with the number of the search and a sentence where there is none.

    """

    def __init__(self, found: Callable[[int, Body], None], failed: Callable[[int, str], None]) -> None:
        self._found, self._failed = found, failed
        self._lock = threading.Lock()
        self._newest = 0
        self._closed = False
        self._threads: list[threading.Thread] = []

    def begin(self, question: BodyQuestion) -> None:
        """Search, in place of the search before; nothing once closed."""
        with self._lock:
            if self._closed:
                return
            self._newest += 1
            thread = threading.Thread(
                target=self._work, args=(self._newest, question), name="ninedof-viewer-workspace", daemon=True
            )
            self._threads = [*(one for one in self._threads if one.is_alive()), thread]
            thread.start()

    def counts(self, search: int) -> bool:
        """Return whether a search is the newest and not given up."""
        return search == self._newest

    def cancel(self) -> None:
        """Give up the search."""
        with self._lock:
            self._newest += 1

    def close(self) -> None:
        """Give up the search and wait for its threads: none is left inside the core when Python ends."""
        with self._lock:
            self._closed = True
            self._newest += 1
            threads = self._threads
        for thread in threads:
            thread.join(timeout=PATIENCE)

    def _work(self, search: int, question: BodyQuestion) -> None:
        try:
            made = body(question, lambda: not self.counts(search))
        except Exception as error:  # whatever it is, the user is waiting for an answer
            if self.counts(search):
                if not isinstance(error, ValueError):  # a mistake of the program is shown where it was started
                    traceback.print_exc()
                self._failed(search, str(error) or type(error).__name__)
            return
        if made is not None:
            self._found(search, made)
