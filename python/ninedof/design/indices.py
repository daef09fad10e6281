"""The table of indices: what objectives, sweeps, workspaces and `ninedof evaluate` can compute, each written once.

A new index is one row here, its words in docs/sweeps.md and its reference in the tests. An objective needs a gradient
too: the row then names the index of the core (`Index` in ninedof/problem/objective.hpp) that has it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
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
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.singularity.singularity import SingularityMargins, singularity_margins
from ninedof.support.arguments import choice, shown
from ninedof.support.arrays import as_floats
from ninedof.support.kept.files import is_plain_name


@dataclass(frozen=True)
class Index:
    """A quantity of a geometry at each configuration of a stack."""

    name: str
    function: Callable[..., Any] | None
    """Called as function(geometry, configuration, characteristic_length, threads=...), without the length where it
    needs none: shape (...), or (..., len(components)). None: the core alone has it, as an objective at the neutral pose
    of symmetric designs."""
    title: str = ""
    """In words, for reports and figures; the name with spaces by default."""
    better: str = ""
    """Which values are better: "smaller", "greater", or "" where neither is."""
    objective: str | None = None
    """The core's index that has the gradient; None without one."""
    dimension: str = ""
    """Name of the dimension of the components."""
    components: tuple[str, ...] = ()
    unit: str = "1"
    """The unit: "length" is the caller's own."""
    needs_length: bool = True
    """Whether it depends on the characteristic length."""
    signed: bool = False
    """Whether its sign is a side, and its size what counts: the least value is that of least modulus."""
    own: bool = False
    """Whether the function is the caller's: it takes no number of threads."""

    @property
    def words(self) -> str:
        """The title, or the name with spaces."""
        return self.title or self.name.replace("_", " ")

    @property
    def tail(self) -> tuple[int, ...]:
        """Shape of the values at one configuration."""
        return (len(self.components),) if self.components else ()

    def values(self, geometry: Geometry, configuration: Configuration, length: Any, threads: int | None) -> Any:
        """Return the index at every configuration."""
        assert self.function is not None, f"{self.name} is an objective only"
        if not self.own:
            operands = (geometry, configuration, length) if self.needs_length else (geometry, configuration)
            return self.function(*operands, threads=threads)
        values = as_floats(f"index {self.name}", self.function(geometry, configuration, length), ())
        if values.shape != configuration.shape:
            got, expected = values.shape, configuration.shape
            raise ValueError(f"index {self.name}: got shape {got}, expected {expected}, one number per configuration")
        return values


def _speed(g: Geometry, c: Configuration, length: Any, threads: int | None) -> Any:
    with np.errstate(divide="ignore"):
        return 1.0 / singular_values(g, c, length, threads)[..., -1]


def _leg_ratio(g: Geometry, c: Configuration, threads: int | None) -> Any:
    legs = leg_lengths(g, c, threads)
    with np.errstate(divide="ignore", invalid="ignore"):  # a leg of length 0: infinite, or NaN where all are
        return legs.max(axis=-1) / legs.min(axis=-1)


def _margins(g: Geometry, c: Configuration, threads: int | None) -> Any:
    return np.stack(singularity_margins(g, c, threads), axis=-1)


INDICES: dict[str, Index] = {
    index.name: index
    for index in (
        Index("condition_number", condition_number, better="smaller", objective="condition_number"),
        Index(
            "condition_number_frobenius",
            partial(condition_number, norm="frobenius"),
            title="Frobenius condition number",
            better="smaller",
            objective="frobenius",
        ),
        Index("reciprocal_condition_number", reciprocal_condition_number, better="greater"),
        Index("manipulability", manipulability, better="greater"),
        Index("isotropy_residual", isotropy_residual, better="smaller"),
        Index("speed", _speed, title="1 / least singular value", better="smaller", objective="speed"),
        Index(
            "six_legged",
            None,
            title="condition number of the six-legged platform",
            better="smaller",
            objective="six_legged",
        ),
        Index("singular_values", singular_values, dimension="singular_value", components=tuple("123456")),
        Index("leg_lengths", leg_lengths, dimension="leg", components=LEGS, unit="length", needs_length=False),
        Index("leg_ratio", _leg_ratio, title="longest / shortest leg", better="smaller", needs_length=False),
        Index(
            "singularity_margins",
            _margins,
            dimension="mechanism",
            components=SingularityMargins._fields,
            needs_length=False,
            signed=True,
        ),
    )
}


def size_of(name: str, values: Any) -> Any:
    """Return what the least and the greatest value of an index are judged by: the modulus of a signed one."""
    return np.abs(values) if name in INDICES and INDICES[name].signed else values


def computed() -> dict[str, Index]:
    """Return the indices that can be computed at any pose: all of sweeps and of `ninedof evaluate`."""
    return {name: index for name, index in INDICES.items() if index.function is not None}


def objectives() -> dict[str, Index]:
    """Return the indices with a gradient, by the core's word and, where it differs, by their own name too."""
    with_gradient = [index for index in INDICES.values() if index.objective is not None]
    by_core: dict[str, Index] = {}
    for index in with_gradient:
        by_core.setdefault(str(index.objective), index)
    return by_core | {index.name: index for index in with_gradient}


OwnIndex = Callable[[Geometry, Configuration, Any], Any]
"""A caller's function of a geometry, a stack of n configurations and the characteristic length: returns n numbers."""
What = str | OwnIndex | Iterable[str | OwnIndex]
"""The argument `index`."""


def indices_of(index: Any, of_designs: bool = False) -> tuple[Index, ...]:
    """Return the indices for the argument `index`: a name, a function, or several of them.

    Of designs at their neutral pose there are more: those that the core alone has, as objectives.
    """
    single = isinstance(index, str) or callable(index) or not np.iterable(index)  # an array without dimensions is not
    entries = [index] if single else list(index)
    if not entries or not all(isinstance(one, str) or callable(one) for one in entries):
        raise ValueError(f"index: got {shown(index)}, expected a name, a callable, or a sequence of them")
    table = INDICES if of_designs else computed()
    if "six_legged" in entries and not of_designs:
        raise ValueError("index: got 'six_legged', which is for the neutral pose: sweep over variables of the design")
    indices = tuple(_own(one) if callable(one) else table[choice("index", one, table)] for one in entries)
    names = [one.name for one in indices]
    if len(set(names)) < len(names):
        raise ValueError(f"index: got {', '.join(names)}, expected different names")
    return indices


def _own(function: OwnIndex) -> Index:
    name = getattr(function, "__name__", type(function).__name__)
    if not is_plain_name(name):
        raise ValueError(f"index: got a function of the name {shown(name)}, expected a name without / and \\")
    return Index(name, function, own=True)


def identity(index: Index) -> str:
    """Return the name of an index in a record; of a caller's function its module too, where it can be found by name."""
    if not index.own:
        return index.name
    function = index.function
    module, name = getattr(function, "__module__", None), getattr(function, "__qualname__", "<nameless>")
    if module is None or "<" in name.replace("<locals>.", ""):
        raise ValueError(
            f"index: got {shown(function)}, expected a function with a name of its own, which identifies it"
        )
    return f"{module}:{name}"
