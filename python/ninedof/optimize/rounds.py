"""Progress over the rounds of a region study: one count from the first round to the last."""

from __future__ import annotations

from ninedof.support.progress import Progress, phase


class Rounds:
    """Adds up the runs of rounds whose number is not known before.

    The first round and the last have all starts, those between them one. So the starts of a last round are counted from
    the beginning.
    """

    def __init__(self, progress: Progress, starts: int) -> None:
        """Begin before the first round of a study with so many starts."""
        self._progress, self._starts = progress, starts
        self._number, self._before, self._total = 0, 0, 0

    def begin(self, starts: int, poses: int) -> Progress:
        """Return the progress of the next round, of so many starts and poses."""
        self._number += 1
        self._before += self._total
        self._total = 0
        last = self._starts == 1 or (self._number > 1 and starts == self._starts)
        ahead = 0 if last else self._starts
        phase(self._progress, f"round {self._number}, at {poses} poses")

        def report(done: int, total: int, value: float | None) -> None:
            self._total = total
            self._progress(self._before + done, self._before + total + ahead, value)

        return report
