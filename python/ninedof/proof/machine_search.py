"""Searches for the worst condition number over the poses of a machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any

from ninedof.proof.machine_limits import met_at
from ninedof.proof.machine_record import MachineCertificate, Met

SLICE = 20.0  # seconds between two states that are kept
LEAST = 0.1  # seconds of a search, also where the time is over
SHARE = 20  # a slice takes so many times what keeping the last state took
STEPS = (0.3, 0.1)  # bounds on the way to the gap, relative to the worst condition number met


class ConditionSearch:
    """Searches for the worst condition number, one after another.

    With `keep`, which is called when there is a state worth keeping, they are cut into slices. Outside of the boxes of
    `left` the condition number is proved to be at most `target`.
    """

    def __init__(
        self,
        search: Callable[[dict[str, Any], Any], Any],
        how: dict[str, Any],
        end: float,
        only_neutral: bool,
        keep: Callable[[], object] | None = None,
    ) -> None:
        self._search, self._how, self._end, self._only_neutral, self._keep = search, how, end, only_neutral, keep
        self.low, self.high, self.target, self.boxes = 0.0, math.inf, math.inf, 0
        self.left: list[tuple[float, ...]] = []
        self.at = Met()
        """Where `low` was met."""
        self.interrupted, self.left_count = False, 0

    def enclose(self, wanted: Sequence[float], tolerance: float) -> None:
        """Enclose it; then prove bounds that lie inside, or what still counts as keeping them."""
        self._run([], 0.0)
        self._narrow()
        self._prove(wanted, tolerance)

    def _narrow(self) -> None:
        """Prove lower bounds up to the gap: slices and earlier certificates end with the bound that they began with."""
        gap = self._how["gap"]
        while not self._within(gap) and (poses := self._all_poses()) and not self._within(gap):
            wide = self.high / self.low - 1.0
            step = next((step for step in STEPS if gap < step < 0.9 * wide), gap)
            self._run(poses, min(self.low * (1.0 + step), self.high))

    def _prove(self, wanted: Sequence[float], tolerance: float) -> None:
        for bound in sorted(wanted, reverse=True):
            goal = bound if self.low < bound else bound * (1.0 + tolerance)
            if self.low < goal < self.high and (poses := self._all_poses()):
                self._run(poses, goal)

    def _within(self, gap: float) -> bool:
        return self.high <= self.low * (1.0 + gap) * (1.0 + 1e-9)

    def _all_poses(self) -> list[tuple[float, ...]]:
        """Return all poses as boxes, and see what is met at once; none where a search was interrupted or left boxes."""
        if self.left_count or self.interrupted:
            return []
        before = self.left, self.left_count, self.target
        self._search_for([], 0.0, 0.0)  # looks at no box
        poses = self.left
        self.left, self.left_count, self.target = before
        return [] if self.interrupted else poses

    def go_on(self, earlier: MachineCertificate, wanted: Sequence[float], tolerance: float) -> None:
        """Go on with the boxes of an earlier certificate; without any, below its bound or from the beginning."""
        (self.low, self.high), self.at, self.boxes = earlier.condition, earlier.condition_at, earlier.condition_boxes
        if not earlier.left and math.isinf(self.high):
            self.enclose(wanted, tolerance)
            return
        if earlier.left and self.low < earlier.target:
            self._run(list(earlier.left), earlier.target)
        self._narrow()
        self._prove(wanted, tolerance)

    def _run(self, boxes: list[tuple[float, ...]], target: float) -> None:
        """Search until the time is over, in slices where their states are to be kept."""
        longest = SLICE if self._keep else math.inf
        while True:
            begin, before = perf_counter(), self.boxes
            seconds = max(min(self._end - begin, longest), LEAST)
            self._search_for(boxes, target, seconds)
            now = perf_counter()
            if not self.left_count or self.interrupted or now - begin < seconds or now >= self._end:
                if self.left_count and not self.left and boxes:  # more than are handed out: those that this began with
                    self.left, self.left_count, self.target = boxes, len(boxes), target
                return
            if self._keep and self.left:
                self._keep()
                # A slice in which nothing was done is too short.
                longest = max(longest * (1 + (self.boxes == before)), SHARE * (perf_counter() - now))
                boxes, target = self.left, self.target
            else:  # more boxes than are handed out: once more from where the slice began, and to the end
                longest = math.inf

    def _search_for(self, boxes: list[tuple[float, ...]], target: float, seconds: float) -> None:
        # A bound within the gap is tried at once, another after wider ones.
        gap = min(self._how["gap"], target / self.low - 1.0) if target and self.low else self._how["gap"]
        low, high, at, boxes_done, left, count, tried, stopped = self._search(
            self._how | {"seconds": seconds, "condition": target, "gap": gap}, boxes
        )
        if not self.low or low > self.low:
            self.low, self.at = low, met_at(at, self._only_neutral)
        self.high = min(self.high, high)
        self.boxes += boxes_done
        self.left, self.left_count, self.target, self.interrupted = left, count, tried, stopped
