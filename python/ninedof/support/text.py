"""Text of values: JSON, short text of objects, and text that cannot act on a terminal, a page or a figure."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

FEW = 9  # entries of an array that are printed
FEW_ITEMS = 4  # of anything else
LONGEST = 300  # characters of the text of one value
PLAIN = (bool, int, float, str, tuple, type(None))

Kind = TypeVar("Kind", bound=type)


def short_repr(kind: Kind) -> Kind:
    """Give a dataclass or a named tuple a short repr: a constructor call without fields that have their default."""
    kind.__repr__ = _call  # type: ignore[method-assign, assignment]
    return kind


def short(value: Any) -> str:
    """Return the text of one value."""
    if isinstance(value, np.ndarray) and value.ndim:
        return _array(value)
    if isinstance(value, np.ndarray | np.generic):
        return short(value.item())
    if isinstance(value, Enum):
        return repr(str(value.value))
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, Mapping):
        entries = [f"{key}: {short(one)}" for key, one in list(value.items())[:FEW]]
        return "{" + ", ".join([*entries, *_more(len(value), FEW)]) + "}"
    if isinstance(value, list | tuple) and not hasattr(value, "_fields"):
        return _sequence(value)
    text = repr(value)
    return text if len(text) <= LONGEST else f"<{type(value).__name__}>"


def _call(thing: Any) -> str:
    return f"{type(thing).__name__}({', '.join(f'{name}={short(value)}' for name, value in _fields(thing))})"


def _fields(thing: Any) -> list[tuple[str, Any]]:
    if not is_dataclass(thing):
        return [(name, getattr(thing, name)) for name in thing._fields]
    pairs = []
    for one in fields(thing):
        value = getattr(thing, one.name)
        default = one.default_factory() if one.default_factory is not MISSING else one.default
        plain = isinstance(value, PLAIN) and not isinstance(value, Enum)
        same = value is default or (plain and type(default) is type(value) and default == value)
        if one.repr and not same:
            pairs.append((one.name, value))
    return pairs


def _array(values: NDArray[Any]) -> str:
    if values.size <= FEW:
        return short(values.tolist())
    what = f"array {'x'.join(map(str, values.shape))}"
    if values.dtype.kind not in "iuf":
        return f"<{what}>"
    numbers = values[~np.isnan(values)] if values.dtype.kind == "f" else values
    missing = f", {values.size - numbers.size} NaN" if numbers.size < values.size else ""
    if not numbers.size:
        return f"<{what}, all NaN>"
    return f"<{what}, {short(numbers.min())} to {short(numbers.max())}{missing}>"


def _sequence(values: list[Any] | tuple[Any, ...]) -> str:
    left, right = ("(", ")") if isinstance(values, tuple) else ("[", "]")
    numbers = all(isinstance(one, int | float | str | np.generic) for one in values)
    most = FEW if numbers else FEW_ITEMS
    if not numbers and len(values) > most and len({type(one) for one in values}) == 1:
        return f"<{len(values)} x {type(values[0]).__name__}>"
    entries = [*(short(one) for one in values[:most]), *_more(len(values), most)]
    comma = "," if isinstance(values, tuple) and len(values) == 1 else ""
    return left + ", ".join(entries) + comma + right


def _more(count: int, most: int) -> list[str]:
    return [f"... {count - most} more"] if count > most else []


MOST = 1200  # characters of a message
HEAD, TAIL = 800, 300  # of those of a longer one that stay: its subject, and what was expected

# Control characters but tab and line feed, marks of direction and of width zero, separators of lines, lone surrogates,
# what is no character.
_UNPRINTABLE = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u00ad\u061c\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff"
    "\ufdd0-\ufdef\ufff9-\ufffb\ufffe\uffff\ud800-\udfff\U000e0000-\U000e007f]"
)


def escaped(text: str) -> str:
    """Return a text whose characters that are not to be seen are escapes as in Python, tabs and line feeds left."""
    return _UNPRINTABLE.sub(lambda match: ascii(match[0])[1:-1], text)


def one_line(text: str) -> str:
    """Return a message as one line: line feeds and tabs are escapes too, and a long one is cut in the middle."""
    if len(text) > MOST:
        text = f"{text[:HEAD]} ... {text[-TAIL:]}"
    return escaped(text).replace("\n", "\\n").replace("\t", "\\t")


NON_FINITE = ("inf", "-inf", "nan")
MARK = "'"  # before one that is a text


def json_values(value: Any) -> Any:
    """Return plain JSON values: arrays and tuples become lists, non-finite numbers words, such words have a mark."""
    if isinstance(value, Mapping):
        return {str(key): json_values(v) for key, v in value.items()}
    if isinstance(value, list | tuple):
        return [json_values(v) for v in value]
    if isinstance(value, np.ndarray | np.generic):
        return json_values(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return repr(float(value))
    return f"{MARK}{value}" if isinstance(value, str) and value.lstrip(MARK) in NON_FINITE else value


def encode(value: Any, *, indent: int | None = 2, sort_keys: bool = False) -> str:
    """Return JSON text of a value."""
    return json.dumps(json_values(value), indent=indent, sort_keys=sort_keys, allow_nan=False)


def decode(text: str) -> Any:
    """Return the value of JSON text, numbers in place of the words for non-finite ones."""
    return _numbers(json.loads(text))


def _numbers(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _numbers(v) for key, v in value.items()}
    if isinstance(value, list):
        return [_numbers(v) for v in value]
    if isinstance(value, str) and value.lstrip(MARK) in NON_FINITE:
        return value[1:] if value.startswith(MARK) else float(value)
    return value
