"""A set of admissible designs: a box, divided into what is proved inside, what is proved outside, and the rest."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof import _core
from ninedof.design.study import Study
from ninedof.design.variables import angles_in_radians
from ninedof.proof.design_range import DesignRange, HasDesign, design_values
from ninedof.proof.machine_record import ProofPose, outward
from ninedof.support.arguments import finite, path_argument, shown, table
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.kept.files import Saved, write_whole
from ninedof.support.running import Progress, progress_argument
from ninedof.support.units import amount
from ninedof.tables.html import Worded

INSIDE, OUTSIDE, UNDECIDED = "inside", "outside", "undecided"
STATES = (INSIDE, OUTSIDE, UNDECIDED)
AROUND_BOXES = 1_000_000  # of poses: no time, so that the answer is the same on every machine
ON_LIMIT, EASED_BOXES = 1e-6, AROUND_BOXES // 4  # of a limit: what the optimizer's designs on it may pass it by
WIDER = 1e-3  # of each limit, where a design on one is asked how far it may go


class NoRoom(ValueError):
    """No box around a design is proved."""

    def __init__(self, design: str, reason: str) -> None:
        """Say why, where that is known."""
        expected = f"one that is inside: {reason}" if reason else "one around which a box is proved to be inside"
        super().__init__(f"design: got {design}, expected {expected}")
        self.design, self.reason = design, reason

    def __reduce__(self) -> tuple[type[NoRoom], tuple[str, str]]:
        """Come back whole from another process."""
        return NoRoom, (self.design, self.reason)


class Reason(NamedTuple):
    """Reason why no design of a box is admissible."""

    limit: str
    """As in `Study.constraints`; "no singularity" and "condition_number" too."""
    part: str
    """The leg, pair of legs or determinant; "" where the limit has none."""
    pose: ProofPose
    """The pose at which all designs of the box break it; of a spread of lengths where the leg is longest."""


class Room(dict[str, tuple[float, float]]):
    """The two ends of each variable to which all may go at once."""

    ended_by: dict[str, tuple[str, str]]
    """In words: a bound, a limit that designs just beyond break and at which pose, or how far the search came."""


@dataclass(frozen=True, eq=False)
class AdmissibleSet(Worded, Saved):
    """A box of designs, divided into pieces. Lengths in the unit of the study, angles in radians."""

    KIND = "admissible"

    of: DesignRange
    low: Floats
    """The lower ends of the pieces, shape (n, d); they are a partition of the box."""
    high: Floats
    """The upper ends."""
    state: NDArray[np.int8]
    """0 inside, 1 outside, 2 undecided, shape (n,)."""
    demand: NDArray[np.int32]
    """Of those outside the index into `demands`, else -1."""
    demands: tuple[tuple[str, str], ...]
    """All limits with their parts."""
    poses: Floats
    """The poses at which it is broken: the number of a listed pose or -1, then shift, tilt about x and y, and yaw. The
    same again where the leg is shortest, of a spread of lengths. Shape (n, 14)."""
    shares: Mapping[str, float]
    """The shares of the volume: "inside", "outside", "undecided"."""
    designs: int
    """Boxes of designs that were looked at."""
    boxes: int
    """Boxes of poses, for a box of designs each."""
    seconds: float
    interrupted: bool = False

    @property
    def study(self) -> Study:
        """The study."""
        return self.of.study

    @property
    def vary(self) -> tuple[str, ...]:
        """The variables that vary."""
        return self.of.vary

    @property
    def inside(self) -> Floats:
        """Boxes of designs that keep every limit at every pose, proved, shape (n, d, 2)."""
        return self._boxes(0)

    @property
    def outside(self) -> Floats:
        """Boxes all designs of which break a limit at a pose, proved: see `reasons`."""
        return self._boxes(1)

    @property
    def undecided(self) -> Floats:
        """The other boxes."""
        return self._boxes(2)

    @cached_property
    def reasons(self) -> tuple[Reason, ...]:
        """Why each box outside is outside."""
        chosen = self.state == 1
        return tuple(
            Reason(self.demands[demand][0], self.demands[demand][1], _pose(row))
            for demand, row in zip(self.demand[chosen].tolist(), self.poses[chosen].tolist(), strict=True)
        )

    @cached_property
    def excluded(self) -> dict[str, float]:
        """The share of the volume that each limit excludes, the greatest first; a design counts for one limit only."""
        volume = np.prod(self.high - self.low, axis=1) / math.prod(high - low for low, high in self.of.ranges)
        out: dict[str, float] = {}
        for n, (limit, _) in enumerate(self.demands):
            share = float(volume[(self.state == 1) & (self.demand == n)].sum())
            if share > 0.0:
                out[limit] = out.get(limit, 0.0) + share
        return dict(sorted(out.items(), key=lambda item: -item[1]))

    def state_of(self, designs: ArrayLike) -> list[str]:
        """Return "inside", "outside" or "undecided" for designs of the box, shape (k, d) in the order of `vary`."""
        x = as_floats("designs", designs, (len(self.vary),))
        if x.ndim != 2:
            raise ValueError(f"designs: got shape {x.shape}, expected (k, {len(self.vary)})")
        out = []
        for row in x:
            there = np.flatnonzero(((self.low <= row) & (row <= self.high)).all(axis=1))
            if not there.size:
                raise ValueError(f"designs: got {shown(row.tolist())}, expected designs within the box")
            out.append(STATES[min(self.state[there])])
        return out

    def around(
        self,
        design: HasDesign | Mapping[str, float] | None = None,
        proportions: Mapping[str, float] | None = None,
        progress: Progress | None = None,
    ) -> Room:
        """Return how far each variable may go at once: the largest box around a design that is proved inside.

        Parameters
        ----------
        design : Result or mapping, optional
            The design; `at` by default.
        proportions : mapping, optional
            The half widths of the box by variable, up to a factor: tolerances of manufacture; angles in radians, or in
            degrees with _deg behind the name. By default the box for which the product of the room to all sides is
            greatest: there is room to each.
        progress : callable, optional
            Called as progress(boxes of poses, the most of them, None).

        Returns
        -------
        Room
            The ends by variable; `ended_by` has what each is at, in words.

        Raises
        ------
        ValueError
            If the design is not inside: the message names the limit that it breaks, if that is proved, or the limit
            that it is on: an optimum has no room on that side. It then says how far each variable may go with limits
            that are 0.1 % wider, if that is proved.

        """
        values = self.of.at if design is None else design_values(design)
        for name in set(self.study.variables) - set(self.vary):
            if name in values and abs(values[name] - self.of.at[name]) > 1e-9 * abs(self.of.at[name]):
                raise ValueError(f"design.{name}: got {values[name]:g}, expected {self.of.at[name]:g}, as in the set")
        missing = [name for name in self.vary if name not in values]
        if missing:
            raise ValueError(f"design: got no {missing[0]}, expected a value of {', '.join(self.vary)}")
        x = [finite(name, values[name]) for name in self.vary]
        half = [] if proportions is None else half_widths(self.of, proportions)
        progress_argument(progress)

        def room(of: DesignRange, boxes: int) -> tuple[Room, int]:
            answer = _core.room_around(of.for_core(), x, half, boxes=boxes, progress=progress)
            ends = list(zip(answer.low, answer.high, strict=True))
            out = Room({name: ends[k] for k, name in enumerate(self.vary)} if answer.found else {})
            last = "the other sides: the proportions are kept" if half else "what could be proved: more may be there"
            if answer.boxes >= boxes:
                last = f"the search, after {boxes:,} boxes of poses: more may be there"

            def words(k: int, side: int) -> str:
                beyond = answer.beyond[k][side]
                return self._bound(k, ends[k][side]) or (self._breaks(beyond) if beyond.demand >= 0 else last)

            out.ended_by = {name: (words(k, 0), words(k, 1)) for k, name in enumerate(out)}
            return out, answer.demand

        box, broken = room(self.of, AROUND_BOXES)
        if box:
            return box
        words = ", ".join(f"{name} = {value:g}" for name, value in zip(self.vary, x, strict=True))
        share = ON_LIMIT if broken >= 0 else -ON_LIMIT  # a design that breaks none may be within a limit by rounding
        on, breaks = room(self.of.eased(share), EASED_BOXES)
        if max(broken, breaks) < 0:
            raise NoRoom(words, "")
        limit = self._limit(broken if broken >= 0 else breaks)
        if broken >= 0 and not on:
            raise NoRoom(words, f"it breaks {limit}" if breaks >= 0 else f"it is on the limit {limit}, or breaks it")
        wide, _ = room(self.of.eased(WIDER), AROUND_BOXES)
        more = f"; with every limit {WIDER:.1%} wider {room_words(self.of, wide)}" if wide else ""
        raise NoRoom(words, f"it is on the limit {limit} (within {ON_LIMIT:g} of it): no room on that side{more}")

    def __repr__(self) -> str:
        """Show the shares."""
        shares = ", ".join(f"{self.shares[name]:.2%} {name}" for name in STATES)
        return f"<AdmissibleSet of {', '.join(self.vary)}: {shares}>"

    def sentences(self) -> list[str]:
        """Return what is proved, in words."""
        most = self.of.condition_number
        bound = "" if most is None else f" and a condition number of at most {most:g}"
        held = f", at {self.of.held}" if self.of.held else ""
        inside, outside, undecided = (f"{self.shares[name]:.3%}" for name in STATES)
        out = [
            f"Proved, of all designs with {self.of.words}{held}: {inside} keep every limit{bound} at every pose, "
            f"{outside} break one; {undecided} are not decided."
        ]
        out += self.study.tolerances.remark()
        if self.of.moved:
            out.append(f"The design's {' and '.join(self.of.moved)} is outside of the range: the middle is marked.")
        if self.excluded:
            by = ", ".join(f"{name.replace('_', ' ')} {share:.2%}" for name, share in self.excluded.items())
            out.append(f"Excluded by: {by}.")
        return out

    def save_certificate(self, path: str | os.PathLike[str]) -> Path:
        """Write a file that `check_certificate` and the program ninedof_check replay: the question, boxes, reasons."""
        return write_whole(path_argument("path", path), _core.design_certificate(self.of.for_core(), self))

    def _bound(self, k: int, end: float) -> str:
        """Return the words for an end of a range; "" for another value."""
        own = self.of.ranges[k] == self.study.variables[self.vary[k]]
        return "" if end not in self.of.ranges[k] else "a bound of the study" if own else "an end of the range"

    def _breaks(self, beyond: _core.BeyondSide) -> str:
        at = beyond.at
        pose = _pose([at.pose, *at.shift, *at.tilt[:2], at.yaw])
        return f"{self._limit(beyond.demand)}, at {pose.worded(self.study.unit)}"

    def _limit(self, demand: int) -> str:
        return " ".join(self.demands[demand]).strip().replace("_", " ")

    def _boxes(self, state: int) -> Floats:
        chosen = self.state == state
        return np.stack([self.low[chosen], self.high[chosen]], axis=-1)


def half_widths(of: DesignRange, proportions: Mapping[str, float]) -> list[float]:
    """Return the half widths of a box in the order of the variables that vary; raise unless each has one."""
    widths = angles_in_radians(
        of.study, table("proportions", proportions), lambda name, x: finite(f"proportions.{name}", x)
    )
    if set(widths) != set(of.vary):
        raise ValueError(f"proportions: got {shown(list(proportions))}, expected {', '.join(of.vary)}")
    if not min(widths.values()) > 0.0:
        raise ValueError(f"proportions: got {min(widths.values()):g}, expected numbers above 0")
    return [widths[name] for name in of.vary]


def room_words(of: DesignRange, room: Mapping[str, tuple[float, float]]) -> str:
    """Return how far each variable may go at once, as `AdmissibleSet.around` has it; rounded to the safe side."""
    parts = []
    for name, ends in room.items():
        low, high = (of.study.shown(name, end) for end in ends)
        upper = amount(outward(high, up=False), of.study.unit_of(name))
        parts.append(f"{name} may be {outward(low, up=True)} to {upper}")
    return f"{', '.join(parts)}{', all at once' if len(parts) > 1 else ''}"


def _pose(row: Sequence[float]) -> ProofPose:
    listed, x, y, z, tilt_x, tilt_y, yaw = row[:7]
    if listed >= 0:
        return ProofPose(listed=int(listed))
    return ProofPose((x, y, z), (tilt_x, tilt_y, 0.0), yaw)
