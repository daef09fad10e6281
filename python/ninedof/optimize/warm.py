"""Additional starts from results, candidates or named values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ninedof.design.study import LENGTH, Study
from ninedof.optimize.candidate import Candidate
from ninedof.optimize.result import Result
from ninedof.support.angles import in_radians
from ninedof.support.arguments import finite, shown
from ninedof.support.arrays import Floats

Warm = Result | Candidate | Mapping[str, float]
"""A start: a result stands for its best candidates."""

MOST_OF_A_RESULT = 4  # candidates, so that most starts remain the low-discrepancy ones


def warm_starts(study: Study, warm: Warm | Iterable[Warm] | None) -> Floats | None:
    """Return additional starts as rows of full vectors, or None without any.

    Fixed variables keep the study's value. A characteristic length or an offset of O that is not free in this study is
    ignored, so that the result of one study may start another.
    """
    starts = warm_variables(warm)
    names = set(study.problem().names)
    rows = [_row(study, names, start) for start in starts]
    return np.array(rows) if rows else None


def warm_variables(warm: Warm | Iterable[Warm] | None) -> list[Mapping[str, float]]:
    """Return the values of each start by name: a result stands for its best candidates."""
    if warm is None:
        return []
    expected = "a Result, a Candidate, a mapping of names to values, or a sequence of them"
    entries = [warm] if isinstance(warm, Result | Candidate | Mapping) else warm
    if isinstance(entries, str) or not isinstance(entries, Iterable):
        raise ValueError(f"warm: got {shown(warm)}, expected {expected}")
    starts: list[Mapping[str, float]] = []
    for item in entries:
        if isinstance(item, Result):
            starts.extend(c.variables for c in item.candidates[:MOST_OF_A_RESULT])
        elif isinstance(item, Candidate):
            starts.append(item.variables)
        elif isinstance(item, Mapping):
            starts.append(item)
        else:
            raise ValueError(f"warm: got {shown(item)}, expected {expected}")
    return starts


def _row(study: Study, names: set[str], start: Mapping[str, Any]) -> list[float]:
    fixed = {name: bound for name, bound in study.variables.items() if not isinstance(bound, tuple)}
    try:
        start = in_radians(start, dict.fromkeys(study.angles, finite))
        values = {n: v for n, v in start.items() if n in names or not (n == LENGTH or str(n).startswith("pose"))}
        return study.vector(values | {name: value for name, value in fixed.items() if name in values})
    except ValueError as error:
        raise ValueError(f"warm: {error}") from None
