"""The argument `index` of sweeps and workspaces: names of the table of indices, or functions of the caller."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from ninedof.design.indices import INDICES, Index, computed
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import choice, shown
from ninedof.support.files import is_plain_name

OwnIndex = Callable[[Geometry, Configuration, Any], Any]
"""A caller's function of a geometry, a stack of n configurations and the characteristic length: returns n numbers."""
What = str | OwnIndex | Iterable[str | OwnIndex]
"""The argument `index`."""


def indices_of(index: Any, of_designs: bool = False) -> tuple[Index, ...]:
    """Return the indices for the argument `index`: a name, a function, or several of them.

    Of designs at their neutral pose there are more: those that the core alone has, as objectives.
    """
    single = isinstance(index, str) or callable(index) or not isinstance(index, Iterable)
    listed = [index] if single else list(index)
    if not listed or not all(isinstance(one, str) or callable(one) for one in listed):
        raise ValueError(f"index: got {shown(index)}, expected a name, a callable, or a sequence of them")
    known = INDICES if of_designs else computed()
    if "six_legged" in listed and not of_designs:
        raise ValueError("index: got 'six_legged', which is for the neutral pose: sweep over variables of the design")
    indices = tuple(_own(one) if callable(one) else known[choice("index", one, known)] for one in listed)
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
    """Return the name of an index in a record. A caller's function is identified by its module and name, not its code.

    Raises
    ------
    ValueError
        If it is a function that cannot be found by name.

    """
    if not index.own:
        return index.name
    function = index.function
    module, name = getattr(function, "__module__", None), getattr(function, "__qualname__", "<nameless>")
    if module is None or "<" in name.replace("<locals>.", ""):
        raise ValueError(
            f"index: got {shown(function)}, expected a function with a name of its own, which identifies it"
        )
    return f"{module}:{name}"
