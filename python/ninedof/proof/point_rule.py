"""A rule for O at every pose of a region: a controller follows it, and proofs hold for it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.domains.region_poses import Placing
from ninedof.motion.rotations import from_vectors
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats, as_floats, broadcast_leading
from ninedof.support.running import Progress, phase
from ninedof.support.text import short_repr

Six = tuple[float, ...]


@short_repr
@dataclass(frozen=True)
class PointRule:
    """s is its neutral position plus a polynomial in the shift of p, the tilt and the yaw.

    With x the shift of p from its neutral position (lengths), the horizontal tilt vector and the yaw (radians), s is
    `internal_point` plus the sum over all terms of its coefficients times the product of (x_k / scale_k) ** power_k.
    """

    position: tuple[float, float, float]
    """Of the platform at the neutral pose."""
    rotation: tuple[tuple[float, float, float], ...]
    internal_point: tuple[float, float, float]
    scale: Six
    """Powers of two, so that quotients are exact."""
    powers: tuple[tuple[int, ...], ...]
    """Of the six coordinates, for each term."""
    coefficients: tuple[tuple[float, float, float], ...]
    """Lengths along the axes of the base, for each term."""

    @classmethod
    def of(cls, neutral: Configuration, rule: _core.PointRule) -> PointRule:
        """Make a rule about a neutral configuration."""
        c = neutral
        parts = (c.position, c.rotation, c.internal_point, rule.scale, rule.powers, rule.coefficients)
        return cls(*(_tuples(np.asarray(part).tolist()) for part in parts))

    def about(self, neutral: Configuration) -> bool:
        """Whether the rule begins at a neutral configuration."""
        return all(np.array_equal(array, getattr(self, name)) for name, array in arrays_of(neutral).items())

    @property
    def degree(self) -> int:
        """The highest sum of the powers of a term."""
        return max(map(sum, self.powers))

    @property
    def words(self) -> str:
        """The rule in a few words."""
        return f"a polynomial of degree {self.degree} with {len(self.powers)} terms"

    def at(self, coordinates: ArrayLike) -> Floats:
        """Return s of coordinates (shift of p, tilt about x and y, yaw), shape (..., 6)."""
        x = as_floats("coordinates", coordinates, (6,)) / np.array(self.scale)
        powers = np.stack([x**n for n in range(max(map(max, self.powers)) + 1)])
        out = np.broadcast_to(np.array(self.internal_point), (*x.shape[:-1], 3)).copy()
        for term, coefficient in zip(self.powers, self.coefficients, strict=True):
            product = np.prod(powers[list(term), ..., range(6)], axis=0)
            out += product[..., None] * np.array(coefficient)
        return out

    def __call__(self, position: ArrayLike, rotation: ArrayLike | None = None) -> Floats:
        """Return s at poses of the platform: positions, shape (..., 3), and rotation matrices, shape (..., 3, 3)."""
        p = as_floats("position", position, (3,))
        q = as_floats("rotation", self.rotation if rotation is None else rotation, (3, 3))
        tilt, yaw = tilt_and_yaw(q @ np.array(self.rotation).T)
        turn = np.concatenate([tilt, yaw[..., None]], axis=-1)
        _, parts = broadcast_leading({"position": (p - np.array(self.position), 1), "rotation": (turn, 1)})
        return self.at(np.concatenate(parts, axis=-1))

    def for_core(self) -> _core.PointRule:
        """Return the rule as the core takes it."""
        return _core.PointRule(scale=self.scale, powers=self.powers, coefficients=self.coefficients)


def _tuples(value: Any) -> Any:
    return tuple(map(_tuples, value)) if isinstance(value, list) else value


def rule_of(
    place: Placing,
    geometry: Geometry,
    configurations: Configuration,
    characteristic_length: float,
    threads: int = 0,
    progress: Progress | None = None,
) -> PointRule:
    """Fit a rule for O, and mend it where proofs of its limits fail.

    A progress with a method `phase` is told what begins. Ctrl-C raises: half a rule is none.
    """
    region = place.study.objective.region
    assert region is not None
    c, length = configurations, float(characteristic_length)
    machine = _core.PosedRobot(geometry, c, length, region.for_core(), None)
    return PointRule.of(place.neutral, _core.fit_rule(machine, place.for_core(), threads, partial(phase, progress)))


def tilt_and_yaw(turn: Floats) -> tuple[Floats, Floats]:
    """Return the tilt vectors (x, y) and the yaws of turns exp(tilt) Rz(yaw), shape (..., 3, 3)."""
    x, y, z = np.moveaxis(turn[..., :, 2], -1, 0)
    across = np.hypot(x, y)
    angle = np.arctan2(across, z)
    size = np.where(across > 0.0, angle / np.where(across > 0.0, across, 1.0), 1.0)
    tilt = np.stack([-size * y, size * x, np.zeros_like(x)], axis=-1)
    about_z = np.swapaxes(from_vectors(tilt.reshape(-1, 3)).reshape(turn.shape), -1, -2) @ turn
    return tilt[..., :2], np.arctan2(about_z[..., 1, 0], about_z[..., 0, 0])
