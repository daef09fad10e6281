"""Results as plain values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import StrEnum
from typing import Any

from ninedof.robot.configuration import Configuration, arrays_of

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


def poses_of(c: Configuration) -> list[dict[str, Any]]:
    """Return a stack of poses, one after the other."""
    return rows_of(arrays_of(c))
