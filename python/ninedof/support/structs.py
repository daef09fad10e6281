"""Structs of the core and tables of files as dataclasses; dictionaries that nobody changes."""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import MISSING, Field, field, fields, is_dataclass
from enum import StrEnum
from typing import Any, NoReturn, Self, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from ninedof.support.arguments import LARGEST, choice, flag, items, known_keys, number, shown_key, table, text, whole
from ninedof.support.units import DEG, angle_entry, in_radians

K = TypeVar("K")
T = TypeVar("T")
V = TypeVar("V")


def from_core(kind: type[T], struct: Any, **others: Any) -> T:
    """Return a dataclass or a named tuple whose fields are attributes of a struct, but for those given by name."""
    names = getattr(kind, "_fields", None) or tuple(kind.__dataclass_fields__)  # type: ignore[attr-defined]
    return kind(**{name: getattr(struct, name) for name in names if name not in others}, **others)


def options_of(function: Any, kind: type, options: Mapping[str, Any], **defaults: Any) -> Mapping[str, Any]:
    """Return options of a declared kind; those that are left out have their default, or None.

    ValueError names one that the function does not take, and all that it does.
    """
    names, code = kind.__annotations__, inspect.unwrap(function).__code__
    known_keys(function.__name__, options, [*code.co_varnames[: code.co_argcount + code.co_kwonlyargcount], *names])
    return {**dict.fromkeys(names), **defaults, **options}


class Fixed(dict[K, V]):
    """A dictionary that refuses to be changed; a copy of it, `dict(it)` or `it | {}`, does not."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError("this mapping belongs to a result and cannot be changed; dict(...) makes a copy that can")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what copies and pickles are made of: the entries."""
        return type(self), (dict(self),)


_hints = functools.cache(get_type_hints)


def entries_of(kind: type, data: Any, where: str = "", skipped: Collection[str] = ()) -> dict[str, Any]:
    """Return the entries of a table that are fields of a dataclass, lists as tuples; other entries are left out.

    The caller sees to the fields that are skipped. ValueError names an entry that is missing or of another kind, and
    where it stands: "" for the whole file.
    """
    entries = table(where or kind.__name__, data)
    out: dict[str, Any] = {}
    for one in fields(kind):
        if not one.init or one.name in skipped:
            continue
        name = f"{where}.{one.name}" if where else one.name
        if one.name in entries:
            out[one.name] = value_of(name, entries[one.name], _hints(kind)[one.name])
        elif one.default is MISSING and one.default_factory is MISSING:
            raise ValueError(f"{name}: got nothing, expected it in a whole file")
    return out


def made(kind: type[T], data: Any, where: str = "") -> T:
    """Return a dataclass made of a table."""
    return kind(**entries_of(kind, data, where))


def value_of(name: str, value: Any, kind: Any) -> Any:
    """Return a value of the declared kind; numbers stay as they are, so that they are written again as they were."""
    if kind in _SIMPLE:
        _SIMPLE[kind](name, value)
        return value
    origin, inner = get_origin(kind), [one for one in get_args(kind) if one is not type(None)]
    if origin in (types.UnionType, Union):
        return value if value is None or len(inner) > 1 else value_of(name, value, inner[0])
    if origin is np.ndarray or kind is Any:
        return value
    if origin is tuple:
        return _tuple(name, value, inner)
    if origin in (dict, Mapping):
        entries = {
            text(name, key): value_of(f"{name}.{shown_key(key)}", entry, inner[1])
            for key, entry in table(name, value).items()
        }
        return entries if origin is dict else Fixed(entries)
    if issubclass(kind, StrEnum):
        return kind(choice(name, value, kind))
    if hasattr(kind, "from_dict"):
        return kind.from_dict(value)
    if is_dataclass(kind) and isinstance(kind, type):
        return made(kind, value, name)
    if hasattr(kind, "_fields"):
        return kind(**_named(name, table(name, value), kind))
    raise AssertionError(f"{name} is declared as {kind}, of which a file has none")


def _named(name: str, entries: Mapping[str, Any], kind: Any) -> dict[str, Any]:
    for missing in (one for one in kind._fields if one not in entries):
        raise ValueError(f"{name}.{missing}: got nothing, expected it in a whole file")
    return {one: value_of(f"{name}.{one}", entries[one], _hints(kind)[one]) for one in kind._fields}


def _tuple(name: str, value: Any, inner: Sequence[Any]) -> tuple[Any, ...]:
    if inner[-1] is Ellipsis:
        return tuple(value_of(f"{name}[{k}]", entry, inner[0]) for k, entry in enumerate(items(name, value, "a list")))
    entries = zip(items(name, value, f"a list of {len(inner)}", len(inner)), inner, strict=True)
    return tuple(value_of(f"{name}[{k}]", entry, one) for k, (entry, one) in enumerate(entries))


_SIMPLE: dict[Any, Any] = {float: number, int: functools.partial(whole, least=-LARGEST), bool: flag, str: text}


Check = Callable[[str, Any], Any]
"""Takes name and value of an entry and returns its normal form, or raises ValueError naming it."""


def entry(check: Check, default: Any = MISSING, angle: bool = False) -> Any:
    """Return the field of a table. With the default None it may have no value; an angle has a second name in `_deg`."""
    metadata = {"check": check, "angle": angle}
    if isinstance(default, dict):
        return field(default_factory=default.copy, metadata=metadata)
    return field(default=default, metadata=metadata)


class Named:
    """Base of dataclasses that people make: ValueError for an argument that they do not have, with the nearest name."""

    def __new__(cls, *_: Any, **arguments: Any) -> Self:
        """Check the names; the dataclass takes the values."""
        # The type of this base says nothing of fields: those that have it are dataclasses.
        known_keys(cls.__name__, arguments, [one.name for one in fields(cls) if one.init])  # type: ignore[arg-type]
        return super().__new__(cls)


class StudyTable(Named):
    """Base of the tables: each entry has a check, a default and, for an angle, a name in degrees too.

    The class is the schema: its docstring has the sentence of each entry, from which docs/study-file.md has its tables.
    """

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


OPTIONAL = ("unit", "tool", "masses")
"""Fields that are left out where a result has none."""


def plain_fields(result: Any, *skipped: str) -> dict[str, Any]:
    """Return the fields of a dataclass as plain values, but for some, and for those that follow from others."""
    names = [one.name for one in fields(result) if one.name not in skipped and not one.metadata.get("derived")]
    values = {name: getattr(result, name) for name in names}
    return {name: plain(value) for name, value in values.items() if name not in OPTIONAL or value}


def plain(value: Any) -> Any:
    """Return a value with its parts: those with names as mappings, other tuples as lists, arrays as they are."""
    if hasattr(value, "to_dict"):
        return value.to_dict()
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if is_dataclass(value):
        return plain_fields(value)
    if isinstance(value, StrEnum):
        return str(value)
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    return [plain(one) for one in value] if isinstance(value, tuple) else value


def rows_of(columns: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the rows of a table of columns."""
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


@contextmanager
def within(where: object, mark: str = ".") -> Iterator[None]:
    """Put the place of a table, or with the mark ": " the name of a file, before messages on its entries."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{where}{mark}{error}" if where else str(error)) from None
