"""A proof of a workspace: its volume, the boxes inside it, and what is left open."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninedof import _core
from ninedof.proof.machine_record import outward
from ninedof.support.arguments import choice, finite, path_argument, whole
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.kept.files import Saved, write_whole
from ninedof.support.text import short_repr
from ninedof.support.units import amount
from ninedof.tables.html import Worded
from ninedof.workspace.question import SETS

AXES = ("x", "y", "z")
ENDS = {
    "gap": "the gap asked for is reached",
    "time": "the time was over",
    "boxes": "as many boxes as allowed were looked at",
    "smallest": "the boxes left cannot be divided any more",
    "stopped": "interrupted",
}

CERTIFICATE = "workspace.certificate"
"""Its file in the folder of a run."""

OF_ALL = "the gap asked for is reached by all allowed poses together"

States = NDArray[np.int8]


@short_repr
class CertifiedSection(NamedTuple):
    """A plane through a certified workspace. Arrays have the shape (len(vertical), len(horizontal))."""

    axes: tuple[str, str]
    plane: tuple[str, float]
    horizontal: Floats
    vertical: Floats
    state: States
    """As `CertifiedWorkspace.state` says."""
    inner: Floats
    """The inner boxes that the plane cuts, shape (n, 4): low and high corner in the two coordinates drawn."""


@dataclass(frozen=True, eq=False)
class CertifiedWorkspace(Worded, Saved):
    """A workspace of positions whose volume lies between proved bounds.

    The box searched consists of inner boxes, in which every pose is allowed, of open ones, and of outer ones, in which
    none is and which are not kept. Planes cut the open boxes: what they prove to be allowed and forbidden counts too.
    """

    KIND = "certified-workspace"
    COMPRESSED = True

    volume: tuple[float, float]
    """Of all allowed positions in the box: at least and at most, proved."""
    home_volume: tuple[float, float]
    """Of those connected with home by allowed positions in the box."""
    home: str
    """"allowed" or "forbidden", proved, or "unknown"; "forbidden" also outside the box."""
    beyond: str
    """The answer for the positions outside the box: "nothing" or "something" is allowed there; or "unknown"."""
    connected: bool
    """Whether only what is connected with home counts: with `singularity_free`."""
    low: Floats
    high: Floats
    """The part of the box that was divided: in the rest, limits of legs allow nothing."""
    box_low: Floats
    box_high: Floats
    """The box asked for."""
    inner_low: Floats
    inner_high: Floats
    """Every pose in these boxes is allowed, shape (n, 3)."""
    open_low: Floats
    open_high: Floats
    """All other allowed poses of the box are in these, shape (m, 3)."""
    open_volume: Floats
    """Bounds of the allowed volume in each of them, shape (m, 2)."""
    first_cut: NDArray[np.int64]
    """The planes of open box k are those from `first_cut[k]` to `first_cut[k + 1]`, shape (m + 1,)."""
    cuts: Floats
    """Planes: slope (3), a, b. With t from -1 to 1 over the sides of the box, a pose is allowed where slope . t >= a
    for every plane, and forbidden where slope . t <= b for one. Shape (c, 5)."""
    end: str
    """Why the search ended: "gap", "time", "boxes", "smallest" or "stopped"."""
    looked: int
    """Boxes looked at."""
    seconds: float
    archetype: str
    certificate: NDArray[np.uint8]
    """The bytes that `save_certificate` writes."""
    estimate: tuple[float, float] | None = None
    """Volume and estimated error of a `WorkspaceMap` of the same question, where there is one."""
    unit: str = ""

    @property
    def bounds(self) -> tuple[float, float]:
        """The bounds to compare with the volume of a map: of the part connected with home, if only that counts."""
        return self.home_volume if self.connected else self.volume

    @property
    def gap(self) -> float:
        """The distance of the bounds, relative to the upper one."""
        low, high = self.bounds
        if math.isinf(high):  # larger than any double
            return 1.0
        return (high - low) / high if high > 0.0 else 0.0

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the search."""
        return self.end == "stopped"

    def with_estimate(self, volume: float, error: float) -> CertifiedWorkspace:
        """Return the same beside the estimate of a map."""
        return replace(self, estimate=(finite("volume", volume, 0.0), finite("error", error, 0.0)))

    def __repr__(self) -> str:
        """Show the bounds."""
        low, high = self.bounds
        boxes = f"{len(self.inner_low)} inner boxes, {len(self.open_low)} open"
        return f"<CertifiedWorkspace: volume {outward(low, False)} to {outward(high, True)}, {boxes}>"

    def state(self, points: Any) -> States:
        """Return what is proved of positions.

        Parameters
        ----------
        points : array_like, shape (n, 3)

        Returns
        -------
        numpy.ndarray of int8, shape (n,)
            1 where the pose is proved to be allowed, -1 where it is proved not to be, 0 where nothing is known. It does
            not say whether the pose is connected with home.

        """
        at = as_floats("points", points, (3,)).reshape(-1, 3)
        return _core.certified_states(self, at)

    def save_certificate(self, path: str | os.PathLike[str]) -> Path:
        """Write a file that `check_certificate` and the program ninedof_check replay: the question, boxes, `volume`.

        Not in it: what is connected with home, and what lies outside the box.

        """
        return write_whole(path_argument("path", path), self.certificate.tobytes())

    def section(self, axis: str, at: float, pixels: int = 400) -> CertifiedSection:
        """Return a plane through the box that was divided, for drawing.

        Parameters
        ----------
        axis : {"x", "y", "z"}
            The coordinate that is fixed.
        at : float
            Its value.
        pixels : int
            Along the longer side.

        """
        fixed = AXES.index(choice("axis", axis, AXES))
        place = finite("at", at, float(self.low[fixed]), float(self.high[fixed]))
        h, v = axes = [k for k in range(3) if k != fixed]
        side = (self.high - self.low)[axes]
        count = np.maximum(np.round(whole("pixels", pixels, 2, 4000) * side / side.max()), 2).astype(int)
        x, y = (
            self.low[k] + (np.arange(n) + 0.5) / n * (self.high[k] - self.low[k])
            for k, n in zip(axes, count.tolist(), strict=True)
        )
        points = np.empty((len(y), len(x), 3))
        points[..., fixed], points[..., h], points[..., v] = place, x, y[:, None]
        cut = (self.inner_low[:, fixed] <= place) & (place < self.inner_high[:, fixed])
        inner = np.concatenate([self.inner_low[cut][:, axes], self.inner_high[cut][:, axes]], axis=1)
        state = self.state(points.reshape(-1, 3)).reshape(points.shape[:2])
        return CertifiedSection((AXES[h], AXES[v]), (axis, place), x, y, state, inner)

    def sentences(self) -> Iterator[str]:
        """Yield what is proved, in words."""
        cubed = f"{self.unit}³" if self.unit else ""
        where = "" if self.beyond == "nothing" else " within the box searched"
        what, of = "the workspace", where
        if self.connected:
            what, of = f"the part of the workspace that is connected with home{where}", ""
        outside = "" if self.beyond == "nothing" else " or lies outside the box searched"
        if self.volume[1] == 0.0:
            yield f"Proved: no pose{' of the box searched' * (self.beyond != 'nothing')} is allowed."
        elif self.connected and self.home == "forbidden":
            yield f"Proved: the home pose is not allowed{outside}, so that nothing is connected with it{where}."
        else:
            gap = outward(100.0 * self.gap, True, 2)
            yield f"Proved: {what} has a volume {_between(self.bounds, cubed)}{of} (gap {gap} %)."
            size = _between(self.volume, cubed)
            if self.connected and size != _between(self.bounds, cubed):
                yield f"Proved: all allowed poses on home's side of every singularity have a volume {size}{where}."
            if self.connected and self.home == "unknown":
                yield "The home pose is not proved to be allowed: the lower bound is zero."
        if self.volume[1] > 0.0:
            yield {
                "nothing": "Proved: no pose outside the box searched is allowed.",
                "something": "Proved: the workspace goes on beyond the box searched.",
                "unknown": "Beyond the box searched nothing is known.",
            }[self.beyond]
        if self.archetype in SETS:
            yield "All of this is of the rotations of the set, not of others between them."
        if self.estimate is not None and self.volume[1] > 0.0:
            volume, error = self.estimate
            low, high = self.bounds
            verdict = "lies between the bounds" if low <= volume <= high else "lies outside the bounds"
            yield f"The estimate, {volume:.6g} ± {error:.2g}, {verdict}."
        boxes = f"{len(self.inner_low)} inner boxes, {len(self.open_low)} open ones, {self.looked} looked at"
        reached = self.end == "gap" and self.connected  # by all poses; home's piece may need more
        yield f"{boxes} in {self.seconds:.3g} s; {OF_ALL if reached else ENDS[self.end]}."

    def to_dict(self) -> dict[str, Any]:
        """Return what is proved as plain values, without the boxes."""
        out = {name: value for name, value in self._saved().items() if not isinstance(value, np.ndarray)}
        for name in ("low", "high", "box_low", "box_high"):
            out[name] = getattr(self, name).tolist()
        counts = {"inner_boxes": len(self.inner_low), "open_boxes": len(self.open_low)}
        return out | counts | {"bounds": self.bounds, "gap": self.gap}


def _between(bounds: tuple[float, float], unit: str) -> str:
    low, high = bounds
    digits = 4
    if high > 0.0 and 0.0 < high - low < 1e-2 * high:  # as many as tell them apart
        digits = min(4 + math.ceil(-math.log10((high - low) / high)), 15)
    return f"between {outward(low, False, digits)} and {amount(outward(high, True, digits), unit)}"
