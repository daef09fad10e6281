"""A design of a study for the checks: joints, configurations and a characteristic length, without the solver."""

from __future__ import annotations

import math
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninedof.design.study import LENGTH, Study
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.verify.nonsmooth import differences

Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Robot:
    """A design with all configurations of its study."""

    geometry: Geometry
    neutral: Configuration
    poses: Configuration
    """Those of the objective, shape (n,)."""
    length: float
    """The characteristic length l_c."""
    apart: Indices
    """Pairs of legs (0 to 8: l, q, r) without a common joint, shape (k, 2)."""

    def joints(self, body: str) -> Floats:
        """Return the six joints of "base" or "platform" in that body's frame, external first, shape (6, 3)."""
        g = self.geometry
        both = (g.base_external, g.base_internal) if body == "base" else (g.platform_external, g.platform_internal)
        return np.vstack(both)

    def ends(self, c: Configuration) -> tuple[Floats, Floats]:
        """Return where the legs l, q, r start and end in a stack of configurations.

        Returns
        -------
        start, end : numpy.ndarray, shape (..., 9, 3)
            Base frame. l: base to platform; q: platform to O; r: base to O.

        """
        g, p, o = self.geometry, c.position[..., None, :], c.internal_point[..., None, :]
        turned = np.swapaxes(c.rotation, -1, -2)
        external, internal = p + g.platform_external @ turned, p + g.platform_internal @ turned
        base = np.broadcast_to(np.stack([g.base_external, g.base_internal]), (*c.shape, 2, 3, 3))
        centre = np.broadcast_to(o, external.shape)
        start = np.concatenate([base[..., 0, :, :], internal, base[..., 1, :, :]], axis=-2)
        return start, np.concatenate([external, centre, centre], axis=-2)


class DesignSpace:
    """Maps variables of a study to robots; has the bounds and the sizes of the variables."""

    def __init__(self, study: Study, variables: Mapping[str, float]) -> None:
        """Store the study and the design, which defines the sizes."""
        self.problem: Any = study.problem()
        self.names: list[str] = list(self.problem.names)
        self.x = np.array([variables[name] for name in self.names])
        self._fixed = None if isinstance(study.characteristic_length, str | tuple) else study.characteristic_length
        self._farthest = study.characteristic_length == "platform_radius"
        self._joint: int | None = None
        self.length = self._length(self.x.tolist())
        bounds = [_bound(study, name) for name in self.names]
        self.low = np.array([low for low, _ in bounds])
        self.high = np.array([high for _, high in bounds])
        self.free = np.flatnonzero(self.low < self.high)
        # An angle with bounds a full turn apart goes round: it has none.
        turns = self.high - self.low >= 2.0 * math.pi - 1e-9
        self.bounded = ~(turns & np.array([name in study.angles for name in self.names]))
        # The size of a length x is hypot(x, l_c); that of an angle or of a shift of O is 1.
        pure = {*study.angles, *(name for name in self.names if name.startswith("pose"))}
        relative = np.array([name in pure for name in self.names])
        self.size = np.where(relative, 1.0, np.hypot(self.x, self.length))
        self.apart = self._apart()

    def robot(self, x: Floats) -> Robot:
        """Return the robot of a full vector of variables; raise ValueError if none exists."""
        values = x.tolist()
        position, rotation, point = self.problem.configurations(values)
        every = Configuration(position, rotation, point)
        # The neutral configuration comes first. Without poses of the objective it is the only one.
        poses = every[1:] if len(every) > 1 else every
        return Robot(self.problem.geometry(values), every[0], poses, self._length(values), self.apart)

    def pieces(self) -> list[DesignSpace]:
        """Return the space once for each platform joint that ties for the largest distance, if that is l_c.

        In each, l_c is the distance of that joint, which has no kink. Itself alone for any other l_c.
        """
        if not self._farthest or not len(self.free):
            return [self]
        distances = platform_distances(self.robot(self.x))
        slopes = differences(lambda y: platform_distances(self.robot(y)), self.x, self.size, self.low, self.high)
        out: list[DesignSpace] = []
        for joint in np.flatnonzero(distances >= distances.max() * (1.0 - _TIE)):
            if any(np.allclose(slopes[:, joint], slopes[:, p._joint], rtol=0.0, atol=_TIE * self.length) for p in out):
                continue  # equal in every design
            piece = copy(self)
            piece._joint = int(joint)
            out.append(piece)
        return out

    def nearer(self, x: Floats) -> Floats:
        """Return by how much each platform joint is nearer than that of this piece, in l_c; empty if it has none."""
        if self._joint is None:
            return np.empty(0)
        distances = platform_distances(self.robot(x))
        return np.asarray(1.0 - distances / distances[self._joint])

    def _length(self, values: list[float]) -> float:
        """Return the characteristic length; it may depend on the design."""
        if self._joint is not None:
            g = self.problem.geometry(values)
            return float(np.linalg.norm(np.vstack([g.platform_external, g.platform_internal])[self._joint]))
        return float(self.problem.characteristic_length(values)) if self._fixed is None else self._fixed

    def inside(self, x: Floats) -> Floats:
        """Return variables moved to the nearest values within the bounds."""
        return np.clip(x, self.low, self.high)

    def _apart(self) -> Indices:
        """Return the pairs of legs without a common joint: one that coincides here and in a nearby design."""
        step = np.where(np.arange(len(self.x)) % 2, 0.01, 0.02) * self.size
        moved = np.where(self.x + step <= self.high, self.x + step, np.maximum(self.x - step, self.low))
        both = [self.problem.geometry(x.tolist()) for x in (self.x, np.where(self.low < self.high, moved, self.x))]
        return np.array([pair for pair in combinations(range(9), 2) if not all(_meet(g, *pair) for g in both)])


def platform_distances(robot: Robot) -> Floats:
    """Return the distances of the platform joints from the origin of their frame, shape (6,)."""
    return np.asarray(np.linalg.norm(robot.joints("platform"), axis=1))


_TIE = 1e-6  # relative difference of distances that count as equal
_SAME = 1e-9  # of the size of a body: joints nearer than that coincide


def _meet(g: Geometry, one: int, other: int) -> bool:
    """Return whether two legs share O or a joint; the first comes earlier in the order l, q, r."""
    if one >= 3:
        return True
    base, platform = (g.base_external[one], g.base_external), (g.platform_external[one], g.platform_external)
    if other < 3:
        return _same(base[0], base[1][other], base[1]) or _same(platform[0], platform[1][other], platform[1])
    if other < 6:
        return _same(platform[0], g.platform_internal[other - 3], platform[1])
    return _same(base[0], g.base_internal[other - 6], base[1])


def _same(one: Floats, other: Floats, body: Floats) -> bool:
    return float(np.linalg.norm(one - other)) <= _SAME * float(np.abs(body).max())


def _bound(study: Study, name: str) -> tuple[float, float]:
    given: Any = study.variables.get(name)
    if name == LENGTH and not isinstance(study.characteristic_length, str):
        given = study.characteristic_length
    if given is None:  # a length by its kind, or an offset of O at a pose
        return -np.inf, np.inf
    low, high = given if isinstance(given, tuple) else (given, given)
    return float(low), float(high)
