"""Objects made of the plain values of a file: every entry is of the kind that its field declares, or is named."""

from __future__ import annotations

import functools
import types
from collections.abc import Collection, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

from ninedof.support.arguments import LARGEST, flag, items, number, shown, shown_key, table, text, whole

T = TypeVar("T")

_hints = functools.cache(get_type_hints)


def entries_of(kind: type, data: Any, where: str = "", skipped: Collection[str] = ()) -> dict[str, Any]:
    """Return the entries of a table that are fields of a dataclass, lists as tuples; other entries are left out.

    Parameters
    ----------
    kind : type
        The dataclass.
    data : mapping
    where : str
        What the table is called in messages; "" for the whole file.
    skipped : collection of str
        Fields that the caller sees to.

    Raises
    ------
    ValueError
        Naming an entry that is missing or of another kind.

    """
    given = table(where or kind.__name__, data)
    found: dict[str, Any] = {}
    for field in fields(kind):
        if not field.init or field.name in skipped:
            continue
        name = f"{where}.{field.name}" if where else field.name
        if field.name in given:
            found[field.name] = value_of(name, given[field.name], _hints(kind)[field.name])
        elif field.default is MISSING and field.default_factory is MISSING:
            raise ValueError(f"{name}: got nothing, expected it in a whole file")
    return found


def made(kind: type[T], data: Any, where: str = "") -> T:
    """Return a dataclass made of a table."""
    return kind(**entries_of(kind, data, where))


def value_of(name: str, value: Any, kind: Any) -> Any:
    """Return a value of the declared kind; numbers stay as they are, so that they are written again as they were."""
    if kind in _SIMPLE:
        _SIMPLE[kind](name, value)
        return value
    origin, inner = get_origin(kind), get_args(kind)
    if origin in (types.UnionType, Union):
        return None if value is None else value_of(name, value, next(one for one in inner if one is not type(None)))
    if origin is tuple:
        return _tuple(name, value, inner)
    if origin in (dict, Mapping):
        return {
            text(name, key): value_of(f"{name}.{shown_key(key)}", entry, inner[1])
            for key, entry in table(name, value).items()
        }
    if is_dataclass(kind) and isinstance(kind, type):
        return made(kind, value, name)
    raise AssertionError(f"{name} is declared as {kind}, of which a file has none")


def _tuple(name: str, value: Any, inner: tuple[Any, ...]) -> tuple[Any, ...]:
    given = items(name, value, "a list")
    if inner[-1] is Ellipsis:
        return tuple(value_of(f"{name}[{k}]", entry, inner[0]) for k, entry in enumerate(given))
    if len(given) != len(inner):
        raise ValueError(f"{name}: got {shown(value)}, expected a list of {len(inner)}")
    return tuple(value_of(f"{name}[{k}]", entry, one) for k, (entry, one) in enumerate(zip(given, inner, strict=True)))


def _whole(name: str, value: Any) -> int:
    return whole(name, value, -LARGEST)


_SIMPLE: dict[Any, Any] = {float: number, int: _whole, bool: flag, str: text}
