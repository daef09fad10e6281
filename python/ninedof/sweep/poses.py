"""Points of a sweep over the nine configuration coordinates, as configurations."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.design.indices import Index
from ninedof.redundancy.redundancy_map import best_internal_map
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import Geometry, triples
from ninedof.support.angles import plain_name
from ninedof.support.arrays import Floats
from ninedof.support.files import Arrays

ROTATION, POSITION, INTERNAL = ("theta_x", "theta_y", "theta_z"), ("x_p", "y_p", "z_p"), ("x_s", "y_s", "z_s")
COORDINATES = (*ROTATION, *POSITION, *INTERNAL)
"""In the order of `Configuration.moved`."""
RULES = ("held", "carried", "shifted", "best")
"""Position of O while the platform moves."""
FOLLOWING = ("carried", "shifted")
"""With these O is swept by displacements only."""

BLOCK = 2048
"""Approximate number of points whose O is searched together, in a tenth of a second: each continues its neighbours."""


@dataclass(frozen=True, eq=False)
class Poses:
    """A robot, and how points of a grid become its configurations."""

    geometry: Geometry
    home: Configuration
    relative: bool
    rule: str
    length: float | str
    block: tuple[int, ...] = (1,)
    """With "best": the sides of the blocks of the grid in which O is placed. A chunk consists of whole blocks."""

    def values(self, at: dict[str, Floats], indices: tuple[Index, ...], threads: int | None) -> Arrays:
        """Return the indices at n points."""
        c = self.configurations(at, threads)
        return {i.name: i.values(self.geometry, c, self.length, threads) for i in indices}

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        block = {"block": list(self.block)} if self.rule == "best" else {}
        return {
            "kind": "sweep",
            "geometry": triples(self.geometry),
            "home": arrays_of(self.home),
            "relative": self.relative,
            "internal_point": self.rule,
            "characteristic_length": self.length,
            **block,
        }

    def configurations(self, values: dict[str, Floats], threads: int | None = None) -> Configuration:
        """Return n configurations for n values of each swept coordinate."""
        count = len(next(iter(values.values())))
        p, q, s = self.home.position, self.home.rotation, self.home.internal_point
        turned = any(name in values for name in ROTATION)
        if not self.relative:  # what is swept begins at zero
            p, s = (np.where([name in values for name in names], 0.0, x) for names, x in ((POSITION, p), (INTERNAL, s)))
            q = np.eye(3) if turned else q
        s = np.zeros(3) if self.rule in FOLLOWING else s
        p, s = (_shifted(names, x, values) for names, x in ((POSITION, p), (INTERNAL, s)))
        c = Configuration._of(p, np.broadcast_to(q, (count, 3, 3)), s)
        if turned:
            tangent = np.zeros((count, len(COORDINATES)))
            tangent[:, :3] = _shifted(ROTATION, np.zeros(3), values)
            c = c.moved(tangent)
        if self.rule == "held":
            return c
        p, q = c.position, c.rotation
        return Configuration._of(p, q, self._following(c) if self.rule in FOLLOWING else self._best(p, q, threads))

    def _best(self, p: Floats, q: Floats, threads: int | None) -> Floats:
        assert not isinstance(self.length, str), "checked by sweep"
        s = np.empty_like(p)
        size = math.prod(self.block)
        for first in range(0, len(p), size):
            part = slice(first, first + size)
            sides = (-1, *self.block[1:])
            poses = p[part].reshape(*sides, 3), q[part].reshape(*sides, 3, 3)
            best = best_internal_map(self.geometry, *poses, characteristic_length=self.length, threads=threads)
            s[part] = best.configuration.internal_point.reshape(-1, 3)
        return s

    def _following(self, c: Configuration) -> Floats:
        """Return the positions of O when it is fixed to the platform or shifts with it, and displaced from there."""
        p, q = c.position, c.rotation
        arm = self.home.internal_point - self.home.position
        if self.rule == "shifted":
            return np.asarray(c.internal_point + (p + arm))
        x, y, z = self.home.rotation.T @ arm
        # Not by matrix multiplication: BLAS may round differently in a chunk of another size.
        return np.asarray(c.internal_point + (p + (q[:, :, 0] * x + q[:, :, 1] * y + q[:, :, 2] * z)))


def rule_of_study(design: Any, over: Iterable[str]) -> str:
    """Return where O is by default: as in the region of a design's study, "held" for others and where O is swept."""
    study = getattr(design, "study", None)
    if study is None or study.objective.region is None or set(map(plain_name, over)) & set(INTERNAL):
        return "held"
    return str(study.objective.region.internal_point)


def _shifted(names: tuple[str, ...], start: Floats, values: dict[str, Floats]) -> Floats:
    """Return n triples: the start, with the values of each coordinate that is swept added."""
    none = np.zeros_like(next(iter(values.values())))
    return start + np.stack([values.get(name, none) for name in names], axis=1)


def best_block(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Return the sides of the blocks of a grid in which the best O is placed; they depend on the grid's shape alone.

    A block has the last axes whole, as far as they fit, and a part of the axis before them. Its points are consecutive,
    so that values do not depend on the chunks, which consist of whole blocks. Where a block continues into the next row
    or plane, some neighbours in it are far apart: that costs time, not accuracy.
    """
    whole: tuple[int, ...] = ()
    for count in reversed(shape):
        size = math.prod(whole)
        if count * size > BLOCK:
            return (BLOCK // size, *whole)
        whole = (count, *whole)
    return whole
