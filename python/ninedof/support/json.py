"""JSON text in one way: floats keep every bit, and non-finite numbers are the words "inf", "-inf" and "nan"."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

NON_FINITE = ("inf", "-inf", "nan")


def plain(value: Any) -> Any:
    """Return plain JSON values: arrays and tuples become lists, non-finite numbers words."""
    if isinstance(value, Mapping):
        return {str(key): plain(v) for key, v in value.items()}
    if isinstance(value, list | tuple):
        return [plain(v) for v in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return repr(float(value))
    return value


def encode(value: Any, *, indent: int | None = 2, sort_keys: bool = False) -> str:
    """Return JSON text of a value."""
    return json.dumps(plain(value), indent=indent, sort_keys=sort_keys, allow_nan=False)


def decode(text: str) -> Any:
    """Return the value of JSON text, numbers in place of the words for non-finite ones."""
    return _numbers(json.loads(text))


def _numbers(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _numbers(v) for key, v in value.items()}
    if isinstance(value, list):
        return [_numbers(v) for v in value]
    return float(value) if value in NON_FINITE else value
