"""Structs of the core as classes of Python, and options as dictionaries of a declared kind."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

from ninedof.support.arguments import known_keys

T = TypeVar("T")

_MISSING = object()


def from_core(kind: type[T], struct: Any, **others: Any) -> T:
    """Return a dataclass or a named tuple whose fields are attributes of a struct, and others by name."""
    names = getattr(kind, "_fields", None) or tuple(kind.__dataclass_fields__)  # type: ignore[attr-defined]
    values = {name: getattr(struct, name, _MISSING) for name in names if name not in others}
    return kind(**{name: value for name, value in values.items() if value is not _MISSING}, **others)


def options_of(where: str, kind: type, options: Mapping[str, Any], **defaults: Any) -> Mapping[str, Any]:
    """Return options of a declared kind; those that are left out have their default, or None.

    Raises
    ------
    ValueError
        For an unknown name.

    """
    names = kind.__annotations__
    known_keys(where, options, names)
    return {**dict.fromkeys(names), **defaults, **options}
