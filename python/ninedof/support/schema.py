"""Tables of a file as frozen dataclasses: each entry has a check, a default and, for an angle, a name in degrees too.

The class is the schema: its docstring has the sentence of each entry, from which docs/study-file.md has its tables.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import MISSING, Field, field, fields
from typing import Any, Self, TypeVar

from ninedof.support.angles import DEG, angle_entry, in_radians
from ninedof.support.arguments import known_keys

T = TypeVar("T")
Check = Callable[[str, Any], Any]
"""Takes name and value of an entry and returns its normal form, or raises ValueError naming it."""


def entry(check: Check, default: Any = MISSING, angle: bool = False) -> Any:
    """Return the field of a table. With the default None it may have no value; an angle has a second name in `_deg`."""
    metadata = {"check": check, "angle": angle}
    if isinstance(default, dict):
        return field(default_factory=default.copy, metadata=metadata)
    return field(default=default, metadata=metadata)


class Table:
    """Base of the tables."""

    def __post_init__(self) -> None:
        """Check and normalize every entry."""
        check_entries(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Self:
        """Make one from the table of a study file; angles may be in degrees, with `_deg` behind the name."""
        return read(cls, data)

    def to_dict(self) -> dict[str, Any]:
        """Return the table of a study file: what differs from the defaults, angles in degrees where that is exact."""
        out: dict[str, Any] = {}
        for one in entries(type(self)):
            if (value := getattr(self, one.name)) != one.default:
                name, value = angle_entry(one.name, value) if one.metadata["angle"] else (one.name, value)
                out[name] = plain(value)
        return out


def read(kind: type[T], data: Any, where: str = "", **defaults: Any) -> T:
    """Return a table made of the mapping of a file, which stands `where` in it; entries it lacks have the defaults."""
    name = where or kind.__name__.lower()
    known_keys(name, data, keys(kind))
    needed = [one.name for one in entries(kind) if one.default is MISSING and one.default_factory is MISSING]
    for missing in (one for one in needed if one not in data and one not in defaults):
        raise ValueError(f"{name}: got no {missing}, expected {', '.join(needed)}")
    with within(where):
        angles = {one.name: one.metadata["check"] for one in entries(kind) if one.metadata["angle"]}
        return kind(**(defaults | in_radians(data, angles)))


def check_entries(thing: Any) -> None:
    """Put the normal form of every entry in its place."""
    for one in entries(type(thing)):
        value = getattr(thing, one.name)
        if value is not None or one.default is not None:
            object.__setattr__(thing, one.name, one.metadata["check"](one.name, value))


def entries(kind: type) -> tuple[Field[Any], ...]:
    """Return the fields of a dataclass that are entries."""
    return tuple(one for one in fields(kind) if one.metadata)


def keys(kind: type) -> list[str]:
    """Return the keys of a table in a file: those of its entries, and of angles in degrees."""
    return [name for one in entries(kind) for name in (one.name, one.name + DEG)[: 1 + one.metadata["angle"]]]


def plain(value: Any) -> Any:
    """Return a value as a file has it: tables as mappings, tuples as lists."""
    if isinstance(value, Table):
        return value.to_dict()
    return [plain(one) for one in value] if isinstance(value, tuple) else value


@contextmanager
def within(where: object, mark: str = ".") -> Iterator[None]:
    """Put the place of a table, or with the mark ": " the name of a file, before messages on its entries."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{where}{mark}{error}" if where else str(error)) from None
