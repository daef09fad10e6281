"""What a sweep computes at its points: named indices, or a caller's own."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import (
    condition_number,
    isotropy_residual,
    manipulability,
    reciprocal_condition_number,
    singular_values,
)
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.singularity.singularity import singularity_margins
from ninedof.support.arguments import choice, shown
from ninedof.support.arrays import Floats

__all__ = ["INDICES", "Index", "OwnIndex", "indices_of"]

OwnIndex = Callable[[Geometry, Configuration, Any], Any]
"""A caller's own: takes a geometry, a stack of n configurations and the characteristic length; returns n numbers."""

LENGTH = "length"


@dataclass(frozen=True)
class Index:
    """A quantity at each configuration of a stack."""

    name: str
    values: Callable[[Geometry, Configuration, Any, int | None], Any]
    """Of n configurations: shape (n,), or (n, len(labels))."""
    dimension: str = ""
    """Name of the second axis."""
    labels: tuple[str, ...] = ()
    unit: str = "1"

    @property
    def tail(self) -> tuple[int, ...]:
        """Shape of what belongs to one configuration."""
        return (len(self.labels),) if self.labels else ()


LEGS = tuple(f"{kind}{i}" for kind in "lqr" for i in (1, 2, 3))
MECHANISMS = ("det_m", "det_b", "det_c")


def _condition(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return condition_number(g, c, lc, threads=threads)


def _frobenius(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return condition_number(g, c, lc, norm="frobenius", threads=threads)


def _reciprocal(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return reciprocal_condition_number(g, c, lc, threads=threads)


def _manipulability(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return manipulability(g, c, lc, threads=threads)


def _isotropy(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return isotropy_residual(g, c, lc, threads=threads)


def _singular_values(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return singular_values(g, c, lc, threads)


def _leg_lengths(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return leg_lengths(g, c, threads)


def _leg_ratio(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    legs = leg_lengths(g, c, threads)
    with np.errstate(divide="ignore", invalid="ignore"):  # a leg of no length: infinite, or NaN where all are
        return legs.max(axis=-1) / legs.min(axis=-1)


def _margins(g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Any:
    return np.stack(singularity_margins(g, c, threads), axis=-1)


INDICES = {
    index.name: index
    for index in (
        Index("condition_number", _condition),
        Index("condition_number_frobenius", _frobenius),
        Index("reciprocal_condition_number", _reciprocal),
        Index("manipulability", _manipulability),
        Index("isotropy_residual", _isotropy),
        Index("singular_values", _singular_values, "singular_value", tuple("123456")),
        Index("leg_lengths", _leg_lengths, "leg", LEGS, LENGTH),
        Index("leg_ratio", _leg_ratio),
        Index("singularity_margins", _margins, "mechanism", MECHANISMS),
    )
}
"""Those that have a name."""


@dataclass(frozen=True)
class _Own:
    """Calls a caller's index, and checks what comes back."""

    name: str
    function: OwnIndex

    def __call__(self, g: Geometry, c: Configuration, lc: Any, threads: int | None) -> Floats:
        found = np.asarray(self.function(g, c, lc))
        if found.dtype.kind not in "biuf":
            raise ValueError(f"index {self.name}: got dtype {found.dtype}, expected real numbers")
        found = found.astype(np.float64, copy=False)
        if found.shape != c.shape:
            raise ValueError(
                f"index {self.name}: got shape {found.shape}, expected {c.shape}, one number a configuration"
            )
        return found


def indices_of(index: Any) -> tuple[Index, ...]:
    """Return the indices that a caller asks for: a name, a callable, or several of them."""
    given = [index] if isinstance(index, str) or callable(index) else index
    if not isinstance(given, Iterable) or not (listed := list(given)):
        raise ValueError(f"index: got {shown(index)}, expected a name, a callable, or a sequence of them")
    found = tuple(_own(one) if callable(one) else INDICES[choice("index", one, INDICES)] for one in listed)
    names = [one.name for one in found]
    if len(set(names)) < len(names):
        raise ValueError(f"index: got {', '.join(names)}, expected different names")
    return found


def _own(function: OwnIndex) -> Index:
    name = getattr(function, "__name__", type(function).__name__)
    return Index(name, _Own(name, function))


def identity(index: Index) -> str:
    """Return what stands for an index in a record: a name that finds it again, not the code behind it.

    Raises
    ------
    ValueError
        If it is a callable that no name finds.

    """
    if not isinstance(index.values, _Own):
        return index.name
    function = index.values.function
    module, name = getattr(function, "__module__", None), getattr(function, "__qualname__", "<nameless>")
    if module is None or "<" in name.replace("<locals>.", ""):
        raise ValueError(f"index: got {shown(function)}, expected a function with a name of its own, to know it again")
    return f"{module}:{name}"
