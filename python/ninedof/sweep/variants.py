"""Points of a sweep over the variables of a design family, as robots."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.conditioning.hexagonal import HEXAGONAL, hexagonal_condition_number
from ninedof.design.design_point import infinite_if_singular
from ninedof.design.indices import INDICES, Index
from ninedof.design.objective import Objective
from ninedof.design.study import Study
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.support.files import Arrays


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
        """Return a study that has an index as its objective."""
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
                out[index.name][k] = infinite_if_singular(by_core[index].evaluate(x)["objective"])
            geometry, neutral = problem.geometry(x), Configuration._of(*problem.configurations(x))[:1]
            for index in own:
                out[index.name][k] = np.asarray(index.values(geometry, neutral, self.length, 1))[0]
