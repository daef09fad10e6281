"""Checks of arguments: each raises ValueError naming the argument, what came and what was expected."""

from __future__ import annotations

import math
import os
import unicodedata
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ninedof.support.text import one_line

LONGEST = 200  # characters of a value that a message repeats
LONGEST_NAME, LONGEST_PATH = 255, 3500  # what systems take, with room for the names of parts in a folder
TURNING = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"  # the direction of what follows them
LARGEST = 2**63 - 1  # what the core's integers hold

Vector = tuple[float, float, float]
T = TypeVar("T")


def shown(value: Any) -> str:
    """Return the text of a value for a message: of one line, cut where it is long."""
    try:
        text = repr(value)
    except Exception:  # a number of thousands of digits, lists in lists in lists, an object whose own words fail
        return f"a {type(value).__name__}"
    text = " ".join(text.split()) if "\n" in text else text  # numpy's arrays have a line for each row
    return cleaned(text)


def cleaned(text: str) -> str:
    """Return text of a file for a message as it stands: on one line, cut where it is long."""
    text = one_line(text)
    return text if len(text) <= LONGEST else text[:LONGEST] + "..."


def shown_key(key: object) -> str:
    """Return a key for a message: as it is where it is a short name, else as `shown`."""
    return key if isinstance(key, str) and key.isidentifier() and len(key) <= LONGEST else shown(key)


def did_you_mean(slip: object, known: Iterable[str]) -> str:
    """Return a suggestion in brackets, or nothing."""
    from difflib import get_close_matches  # when it is needed, as it takes time to load

    close = get_close_matches(str(slip)[:LONGEST].lower(), list(known), n=1, cutoff=0.5)
    return f" (did you mean {close[0]!r}?)" if close else ""


def instance(name: str, value: Any, kind: type[T]) -> T:
    """Return a value that is of a class."""
    if not isinstance(value, kind):
        expected = f"{'an' if kind.__name__[0] in 'AEIO' else 'a'} {kind.__name__}"
        raise ValueError(f"{name}: got {type(value).__name__}, expected {expected}")
    return value


def text(name: str, value: Any) -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise ValueError(f"{name}: got {shown(value)}, expected text")
    return value


def known_keys(where: str, entries: Any, known: Iterable[str]) -> None:
    """Raise unless `entries` is a mapping with known keys only."""
    names = list(known)
    if not isinstance(entries, Mapping):
        raise ValueError(f"{where}: got {shown(entries)}, expected a mapping of names")
    for key in entries:
        if key not in names:
            hint = did_you_mean(key, names)
            raise ValueError(f"{where}: got the entry {shown(key)}, expected only {', '.join(names)}{hint}")


def table(name: str, value: Any) -> Mapping[str, Any]:
    """Return a table of a file."""
    if not isinstance(value, Mapping):
        raise ValueError(f"{name}: got {shown(value)}, expected a table")
    return value


def is_number(value: Any) -> bool:
    """Return whether a value is a real number, Python's or numpy's; bool does not count as a number."""
    return isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool | np.timedelta64)


def number(name: str, value: Any) -> float:
    """Return a number, infinite and NaN included."""
    if not is_number(value):
        raise ValueError(f"{name}: got {shown(value)}, expected a number")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{name}: got {shown(value)[:20]}..., expected a number of ordinary size") from None


def finite(name: str, value: Any, least: float = -math.inf, most: float = math.inf) -> float:
    """Return a finite number, within limits where they are given."""
    x = number(name, value)
    if not math.isfinite(x) or not least <= x <= most:
        limits = [f"at least {least:g}"] * math.isfinite(least) + [f"at most {most:g}"] * math.isfinite(most)
        expected = " ".join(["a finite number", " and ".join(limits)]).strip()
        raise ValueError(f"{name}: got {shown(value)}, expected {expected}")
    return x


def whole(name: str, value: Any, least: int, most: int = LARGEST) -> int:
    """Return a whole number; 3.0 does not count as one."""
    if not is_number(value) or isinstance(value, float | np.floating) or not least <= value <= most:
        to = "to 2^63 - 1" if most == LARGEST else f"to {most}"
        raise ValueError(f"{name}: got {shown(value)}, expected a whole number from {least} {to}")
    return int(value)


def flag(name: str, value: Any) -> bool:
    """Return a truth value, Python's or numpy's; 1 and 0 do not count as such."""
    if not isinstance(value, bool | np.bool_):
        raise ValueError(f"{name}: got {shown(value)}, expected True or False")
    return bool(value)


def choice(name: str, value: Any, known: Iterable[str]) -> str:
    """Return one of the known words."""
    words = list(known)
    if not isinstance(value, str) or value not in words:
        hint = did_you_mean(value, words) if isinstance(value, str) else ""
        raise ValueError(f"{name}: got {shown(value)}, expected one of {', '.join(words)}{hint}")
    return value


def path_argument(name: str, value: Any) -> Path:
    """Return a path whose name is a line of text: it stands in messages."""
    path = os.fspath(value) if isinstance(value, str | os.PathLike) else None
    if not isinstance(path, str):
        raise ValueError(f"{name}: got {shown(value)}, expected a path")
    odd = any(unicodedata.category(c) in ("Cc", "Cs", "Zl", "Zp") or c in TURNING for c in path)
    if not path or odd or len(path) > LONGEST_PATH or max(map(len, Path(path).parts), default=0) > LONGEST_NAME:
        raise ValueError(f"{name}: got {shown(path)}, expected a path of ordinary characters and length")
    return Path(path)


def executor_argument(executor: Any) -> None:
    """Raise unless `executor` is None or can run tasks."""
    if executor is not None and (isinstance(executor, type) or not callable(getattr(executor, "submit", None))):
        raise ValueError(f"executor: got {shown(executor)}, expected a concurrent.futures.Executor")


def items(name: str, value: Any, expected: str, count: int | None = None) -> tuple[Any, ...]:
    """Return the entries of a list, a tuple or an array, of whatever kind they are, `count` of them if it is given."""
    several = isinstance(value, list | tuple) or (isinstance(value, np.ndarray) and value.ndim > 0)
    if not several or count not in (None, len(value)):
        raise ValueError(f"{name}: got {shown(value)}, expected {expected}")
    return tuple(value)


def bound(name: str, value: Any) -> float | tuple[float, float]:
    """Return a finite number, or the bounds (low, high), which may be infinite."""
    if is_number(value):
        return finite(name, value)
    low, high = (number(name, end) for end in items(name, value, "a number, or (low, high)", 2))
    if not low <= high:
        raise ValueError(f"{name}: got {shown(value)}, expected low <= high")
    return low, high


def vector(name: str, value: Any, least: float = -math.inf) -> Vector:
    """Return three finite numbers."""
    expected = "three finite numbers [x, y, z]"
    three = items(name, value, expected, 3)
    if not all(map(is_number, three)):
        raise ValueError(f"{name}: got {shown(value)}, expected {expected}")
    x, y, z = (finite(name, x, least) for x in three)
    return x, y, z


def vectors(name: str, value: Any) -> tuple[Vector, ...]:
    """Return a list of three finite numbers each."""
    return tuple(vector(f"{name}[{k}]", one) for k, one in enumerate(items(name, value, "a list of [x, y, z]")))
