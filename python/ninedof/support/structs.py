"""Structs of the core and tables of files as classes of Python; dictionaries that nobody changes."""

from __future__ import annotations

import functools
import types
from collections.abc import Collection, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, NoReturn, TypeVar, Union, get_args, get_origin, get_type_hints

from ninedof.support.arguments import LARGEST, flag, items, known_keys, number, shown_key, table, text, whole

K = TypeVar("K")
T = TypeVar("T")
V = TypeVar("V")


def from_core(kind: type[T], struct: Any, **others: Any) -> T:
    """Return a dataclass or a named tuple whose fields are attributes of a struct, but for those given by name."""
    names = getattr(kind, "_fields", None) or tuple(kind.__dataclass_fields__)  # type: ignore[attr-defined]
    return kind(**{name: getattr(struct, name) for name in names if name not in others}, **others)


def options_of(where: str, kind: type, options: Mapping[str, Any], **defaults: Any) -> Mapping[str, Any]:
    """Return options of a declared kind; those that are left out have their default, or None."""
    names = kind.__annotations__
    known_keys(where, options, names)
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
    for field in fields(kind):
        if not field.init or field.name in skipped:
            continue
        name = f"{where}.{field.name}" if where else field.name
        if field.name in entries:
            out[field.name] = value_of(name, entries[field.name], _hints(kind)[field.name])
        elif field.default is MISSING and field.default_factory is MISSING:
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
    if inner[-1] is Ellipsis:
        return tuple(value_of(f"{name}[{k}]", entry, inner[0]) for k, entry in enumerate(items(name, value, "a list")))
    entries = zip(items(name, value, f"a list of {len(inner)}", len(inner)), inner, strict=True)
    return tuple(value_of(f"{name}[{k}]", entry, one) for k, (entry, one) in enumerate(entries))


def _whole(name: str, value: Any) -> int:
    return whole(name, value, -LARGEST)


_SIMPLE: dict[Any, Any] = {float: number, int: _whole, bool: flag, str: text}
