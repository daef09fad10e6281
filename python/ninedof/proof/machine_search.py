"""Searches over the poses of a machine: extreme values of its limits, and the worst condition number."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any

from ninedof import _core
from ninedof.proof.machine_limits import Extreme, Key, Plan
from ninedof.proof.machine_record import MachineCertificate, Met
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry


def extremes(
    plan: Plan,
    keys: Sequence[Key],
    geometry: Geometry,
    configurations: Configuration,
    shape: dict[str, Any] | None,
    how: dict[str, Any],
) -> dict[Key, Extreme]:
    """Return the extreme values that a plan asks for."""
    found: dict[Key, Extreme] = {}
    alone = configurations[[0, 0]]
    only_neutral = shape is None and len(configurations) == 1
    for where, posed, of in (("poses", alone if only_neutral else configurations, shape), ("neutral", alone, None)):
        here = [key for key in keys if key[0] == where]
        wanted = [plan.requests[key] for key in here]
        arrays = (posed.position, posed.rotation, posed.internal_point)
        ends = _core.pose_extremes(geometry, *arrays, of, wanted, how) if here else []
        at_neutral = only_neutral or where == "neutral"
        found |= {k: Extreme(end[:2], met_at(end, at_neutral), end[6]) for k, end in zip(here, ends, strict=True)}
    return found


def met_at(end: Any, neutral: bool) -> Met:
    """Return the pose of an extreme value; listed ones are counted from 1, and the neutral one alone is 0."""
    _, _, shift, tilt, yaw, listed, _ = end
    return Met(shift, tilt, yaw, None if listed < 0 else 0 if neutral else listed + 1)


class ConditionSearch:
    """Searches for the worst condition number, one after another."""

    def __init__(self, search: Callable[[dict[str, Any], Any], Any], how: dict[str, Any], end: float) -> None:
        self._search, self._how, self._end = search, how, end
        self.low, self.high, self.target, self.boxes = 0.0, math.inf, math.inf, 0
        self.left: list[tuple[float, ...]] = []
        self.end: Any = None
        self.interrupted, self.left_count = False, 0

    def enclose(self, wanted: Sequence[float], tolerance: float) -> None:
        """Enclose it; then prove bounds that lie inside, or what still counts as keeping them."""
        self._run([], 0.0)
        self._prove(wanted, tolerance)

    def _prove(self, wanted: Sequence[float], tolerance: float) -> None:
        for bound in sorted(wanted, reverse=True):
            goal = bound if self.low < bound else bound * (1.0 + tolerance)
            if not self.left_count and not self.interrupted and self.low < goal < self.high:
                self._run([], goal)

    def go_on(self, earlier: MachineCertificate, wanted: Sequence[float], tolerance: float) -> None:
        """Go on with the boxes of an earlier certificate; from the beginning where it has none, keeping its bound."""
        self.high, self.boxes = earlier.condition[1], earlier.condition_boxes
        if earlier.left:
            self._run(list(earlier.left), earlier.target)
            self._prove(wanted, tolerance)
        else:
            self.enclose(wanted, tolerance)

    def _run(self, boxes: list[tuple[float, ...]], target: float) -> None:
        seconds = max(self._end - perf_counter(), 0.1)
        # A bound within the gap is tried at once, another after wider ones.
        gap = min(self._how["gap"], target / self.low - 1.0) if target and self.low else self._how["gap"]
        end, left, count, tried, stopped = self._search(
            self._how | {"seconds": seconds, "condition": target, "gap": gap}, boxes
        )
        if self.end is None or end[0] > self.low:
            self.low, self.end = end[0], end
        self.high = min(self.high, end[1])
        self.boxes += end[6]
        self.left, self.left_count, self.target, self.interrupted = left, count, tried, stopped
