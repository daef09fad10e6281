"""Points of a sweep as robots: configurations of one, and designs of a family."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.conditioning.hexagonal import HEXAGONAL, hexagonal_condition_number
from ninedof.design.design_point import infinite_if_singular
from ninedof.design.indices import INDICES, Index
from ninedof.design.objective import Objective
from ninedof.design.study import Study
from ninedof.redundancy.redundancy_map import best_internal_map
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import Geometry, triples
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import Arrays
from ninedof.support.units import plain_name

ROTATION, POSITION, INTERNAL = ("theta_x", "theta_y", "theta_z"), ("x_p", "y_p", "z_p"), ("x_s", "y_s", "z_s")
COORDINATES = (*ROTATION, *POSITION, *INTERNAL)
"""In the order of `Configuration.moved`."""
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


@dataclass(frozen=True)
class Variants:
    """A family, the values of the variables that are not swept, and the characteristic length."""

    family: str
    design: Mapping[str, float]
    length: float | str

    def study(self) -> Study:
        """Return a study of the family; the swept variables are free in it."""
        return Study(self.family, variables=self.design)

    def check(self, indices: Iterable[Index]) -> None:
        """Raise for an index that the core alone has and not for this family or kind of length."""
        for index in indices:
            if index.function is None:
                if self.length == "optimal":
                    raise ValueError(f"characteristic_length: got 'optimal', expected a number for {index.name}")
                self._objective(index)

    def _objective(self, index: Index) -> Study:
        return Study(self.family, self.design, objective=Objective(index.name), characteristic_length=self.length)

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        return {
            "kind": "sweep of designs",
            "family": self.family,
            "design": dict(self.design),
            "characteristic_length": self.length,
        }

    def values(self, at: dict[str, Floats], indices: tuple[Index, ...], threads: int | None) -> Arrays:
        """Return the indices at n designs."""
        count = len(next(iter(at.values())))
        out: dict[str, Floats] = {i.name: np.empty((count, *i.tail)) for i in indices}
        one_by_one = []
        for index in indices:
            if self.has_closed_form(index, at):
                out[index.name][:] = self._closed_form(at, threads)
            else:
                one_by_one.append(index)
        if one_by_one:
            self._fill(out, at, one_by_one)
        return dict(out)

    def has_closed_form(self, index: Index, swept: Iterable[str]) -> bool:
        """Return whether the closed form gives an index: the condition number of hexagonal designs without a twist."""
        untwisted = "theta_z" not in swept and self.design.get("theta_z", 0.0) == 0.0
        own = isinstance(self.length, float) and self.family == "hexagonal" and untwisted
        return own and index == INDICES["condition_number"]  # `is` fails: it may come from another process

    def _closed_form(self, at: dict[str, Floats], threads: int | None) -> Floats:
        columns = {n: np.asarray(at.get(n, self.design.get(n, np.nan))) for n in HEXAGONAL}
        for name in HEXAGONAL[:4]:
            if columns[name].min() < 0.0:
                raise ValueError(f"{name}: got {columns[name].min():g}, expected a side of 0 at least")
        with np.errstate(over="ignore"):  # lengths beyond all numbers are refused by what follows
            a1, a2, b1, b2, zp, zs = (column / self.length for column in columns.values())
        return np.asarray(hexagonal_condition_number(a1, a2, b1, b2, zp, zs, threads=threads))

    def _fill(self, out: dict[str, Floats], at: dict[str, Floats], indices: list[Index]) -> None:
        study = self.study()
        problem = study.problem()
        by_core = {index: self._objective(index).problem() for index in indices if index.function is None}
        own = [index for index in indices if index.function is not None]
        x = study.vector({name: float(column[0]) for name, column in at.items()})
        places = [problem.names.index(name) for name in at]
        for k, point in enumerate(np.stack(list(at.values()), axis=-1).tolist()):
            for place, value in zip(places, point, strict=True):
                x[place] = value
            for index in by_core:
                out[index.name][k] = infinite_if_singular(by_core[index].evaluate(x).objective)
            geometry, neutral = problem.geometry(x), Configuration._of(*problem.configurations(x))[:1]
            for index in own:
                out[index.name][k] = np.asarray(index.values(geometry, neutral, self.length, 1))[0]
