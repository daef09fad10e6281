"""A coarse workspace for the eye: positions of the platform, in the orientation shown, that keep every limit."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ninedof.conditioning.conditioning import condition_number
from ninedof.design.leg_limits import SPREADS
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.redundancy.redundancy_map import best_internal_map
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.sheet.pose_limits import PoseLimit
from ninedof.singularity.singularity import singularity_margins
from ninedof.support.arrays import Floats
from ninedof.viewer.numbers import Yardstick, margins_at
from ninedof.viewer.shapes import Faces
from ninedof.workspace.study_criteria import EASE
from ninedof.workspace.surface import closed_surface, smoothed

COARSE, FINE = 17, 33  # points along each side: to find the body, and to draw it
COARSE_SEARCHED, FINE_SEARCHED = 9, 15  # where the best O is sought at each of them
WIDENED = 5  # times that the box of the drawing grows, where the body leaves it
REACH = 0.75  # of the size of the machine: half the side of the box first looked at


class GivenUp(Exception):
    """A search is no longer wanted."""


@dataclass(frozen=True, eq=False)
class BodyQuestion:
    """What a workspace is asked of. Immutable: it is computed while the viewer goes on."""

    yardstick: Yardstick
    geometry: Geometry
    shown: Configuration
    """Its rotation is kept, and its side of every singularity."""
    rule: str
    carried: Floats
    """O in the platform frame."""
    size: float
    condition_limit: float = math.inf

    def field(self, p: Floats, stopped: Callable[[], bool] = lambda: False) -> Floats:
        """Return the least margin at positions of shape (..., 3), between -1 and 1: positive where all limits hold.

        Raises `GivenUp` if `stopped` says so while O is searched.
        """
        flat = p.reshape(-1, 3)
        q = np.broadcast_to(self.shown.rotation, (len(flat), 3, 3))
        s = self._internal_points(p, stopped).reshape(-1, 3)
        known = ~np.isnan(s).any(axis=1)
        c = Configuration(flat[known], q[known], s[known])
        found = np.full(len(flat), -1.0)
        least = np.full(len(c.position), 1.0)
        signs = np.sign(singularity_margins(self.geometry, self.shown))
        for sign, det in zip(signs, singularity_margins(self.geometry, c), strict=True):
            least = np.minimum(least, sign * det)
        lengths = leg_lengths(self.geometry, c)
        for one in margins_at(self.yardstick, self.geometry, c):
            beside = self.yardstick.beside
            margin = one.margin
            if beside is not None and one.name in SPREADS:
                margin = _room(one, lengths, beside)
            least = np.minimum(least, margin)
        if math.isfinite(self.condition_limit):
            with np.errstate(divide="ignore"):
                kappa = np.log(condition_number(self.geometry, c, self.yardstick.length, threads=1))
            least = np.minimum(least, math.log(self.condition_limit) - kappa)
        found[known] = np.clip(np.nan_to_num(least, nan=-1.0), -1.0, 1.0)
        return found.reshape(p.shape[:-1])

    def _internal_points(self, p: Floats, stopped: Callable[[], bool]) -> Floats:
        q = self.shown.rotation
        if self.rule == "held":
            return np.broadcast_to(self.shown.internal_point, p.shape)
        carried: Floats = p + q @ self.carried
        if self.rule != "best":
            return carried

        def progress(_done: int, _of: int, _value: float | None) -> None:
            if stopped():
                raise GivenUp

        found = best_internal_map(
            self.geometry,
            p,
            q,
            limits=(self.yardstick.leg_low, self.yardstick.leg_high),
            characteristic_length=self.yardstick.length,
            start=carried,
            threads=1,
            progress=progress,
        )
        return found.configuration.internal_point


def _room(one: PoseLimit, lengths: Floats, beside: Floats) -> Floats:
    """Return how far lengths are within what a limit on their spread over the poses of the study leaves.

    It has the sign of the margin, which is flat where the poses of the study alone make the spread.
    """
    legs = [LEGS.index(one.part)] if one.part else list(range(9))
    low, high, here = float(beside[:, legs].min()), float(beside[:, legs].max()), lengths[:, legs]
    least, most = (high - one.limit, low + one.limit) if one.name == "stroke" else (high / one.limit, low * one.limit)
    least, most = least * (1.0 - EASE), most * (1.0 + EASE)
    if low < least or high > most:  # the design passes the limit by itself
        return np.full(len(lengths), -1.0)
    room = np.minimum(here.min(axis=1) - least, most - here.max(axis=1)) / most
    return np.asarray(room if one.part else np.minimum(room, one.limit - here.max(axis=1) / here.min(axis=1)))


@dataclass(frozen=True, eq=False)
class Body:
    """A closed surface, smoothed, and the volume within it before."""

    vertices: Floats
    faces: Faces
    """Triangles: three numbers of vertices each."""
    volume: float
    open: bool
    """Whether it reaches the box that was looked at, so that there is more of it."""


def body(question: BodyQuestion, stopped: Callable[[], bool] = lambda: False) -> Body | None:
    """Return the workspace; None if `stopped` says so in between."""
    searched = question.rule == "best"
    coarse, fine = (COARSE_SEARCHED, FINE_SEARCHED) if searched else (COARSE, FINE)
    centre, reach = question.yardstick.neutral.position, REACH * question.size
    whole = np.stack([centre - reach, centre + reach])
    rough = _sampled(question, whole, coarse, stopped)
    if rough is None:
        return None
    ends = _about(rough > 0.0, whole)
    if ends is None:  # it may be smaller than a cell
        small = 0.15 * np.array([[-reach], [reach]])
        ends = np.clip(question.shown.position + small, whole[0], whole[1])
    for _ in range(WIDENED):
        found = _sampled(question, ends, coarse, stopped)
        if found is None:
            return None
        field = found
        drawn, ends = ends, _widened(field > 0.0, ends, whole)
        if (ends == drawn).all():
            break
    is_open = bool(_touches(field > 0.0).any())
    tight = _about(field > 0.0, drawn)
    if tight is not None:
        found = _sampled(question, tight, fine, stopped)
        if found is None:
            return None
        field, drawn = found, tight
    surface = closed_surface(field, drawn[0], drawn[1])
    faces = np.concatenate([surface.faces[:, [0, 1, 2]], surface.faces[:, [0, 2, 3]]]).astype(np.uint32)
    return Body(smoothed(surface), faces, surface.volume, is_open)


def _about(inside: NDArray[np.bool_], whole: Floats) -> Floats | None:
    """Return a box about the points inside, with a cell more on every side; None without one."""
    if not inside.any():
        return None
    places = np.argwhere(inside)
    step = (whole[1] - whole[0]) / (len(inside) - 1)
    low, high = whole[0] + step * (places.min(axis=0) - 1), whole[0] + step * (places.max(axis=0) + 1)
    return np.stack([np.maximum(low, whole[0]), np.minimum(high, whole[1])])


def _touches(inside: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return whether points inside are on each side of the box, shape (2, 3)."""
    return np.array([[np.take(inside, end, axis=axis).any() for axis in range(3)] for end in (0, -1)])


def _widened(inside: NDArray[np.bool_], ends: Floats, whole: Floats) -> Floats:
    """Return the box, moved out by a third where the body touches a side that is not one of the whole box."""
    out = np.where(_touches(inside), (ends[1] - ends[0]) / 3.0, 0.0) * np.array([[-1.0], [1.0]])
    return np.asarray(np.clip(ends + out, whole[0], whole[1]))


def _sampled(question: BodyQuestion, ends: Floats, n: int, stopped: Callable[[], bool]) -> Floats | None:
    axes = [np.linspace(low, high, n) for low, high in ends.T]
    layers = np.array_split(np.arange(n), 1 if question.rule == "best" else max(1, n // 4))
    found = []
    for layer in layers:
        if stopped():
            return None
        grid = np.stack(np.meshgrid(axes[0][layer], axes[1], axes[2], indexing="ij"), axis=-1)
        try:
            found.append(question.field(grid, stopped))
        except GivenUp:
            return None
    return None if stopped() else np.concatenate(found)
