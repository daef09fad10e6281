"""Points of a sweep over the variables of a design family, as robots."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.arrays import Floats
from ninedof.chunks import Arrays
from ninedof.configuration import Configuration
from ninedof.study import Study
from ninedof.sweep.index import Index

__all__ = ["Variants"]


@dataclass(frozen=True)
class Variants:
    """A family, the values of the variables that are not swept, and the characteristic length."""

    family: str
    design: Mapping[str, float]
    length: float | str

    def study(self) -> Study:
        """Return a study that knows the family; the swept variables are free in it."""
        return Study(self.family, variables=self.design)

    def question(self) -> dict[str, Any]:
        """Return what the values depend on."""
        return {
            "kind": "sweep of designs",
            "family": self.family,
            "design": dict(self.design),
            "characteristic_length": self.length,
        }

    def values(self, at: dict[str, Floats], count: int, indices: tuple[Index, ...], threads: int | None) -> Arrays:
        """Return the indices at n designs."""
        study = self.study()
        problem = study.problem()
        out: dict[str, Floats] = {i.name: np.empty((count, *i.tail)) for i in indices}
        for k in range(count):
            x = study.vector({name: float(column[k]) for name, column in at.items()})
            geometry, neutral = problem.geometry(x), Configuration._of(*problem.configurations(x))[:1]
            for index in indices:
                out[index.name][k] = np.asarray(index.values(geometry, neutral, self.length, 1))[0]
        return dict(out)
