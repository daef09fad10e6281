"""A result as a small table for notebooks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from ninedof.support.html import html_table
from ninedof.support.units import with_unit

SHOWN = 4  # candidates, side by side
MOST_FIXED = 8  # variables; of more, only the free ones are listed


def result_html(result: Any) -> str:
    """Return a table with a column for each of the best candidates; takes a Result."""
    shown = result.candidates[:SHOWN]
    head = ["", *("best" if k == 0 else f"no. {k + 1}" for k in range(len(shown)))]
    return html_table(f"{result.status}: {result.reason}", _rows(result, shown), head if shown else ())


def _rows(result: Any, shown: tuple[Any, ...]) -> Iterator[tuple[Any, ...]]:
    if not shown:
        yield "causes", ", ".join(result.causes) or "none found"
        return
    yield result.words, *(f"{c.objective:.6f}" for c in shown)
    yield "condition number, neutral pose", *(f"{c.condition_number:.6f}" for c in shown)
    for name, bound in result.study.variables.items():
        if isinstance(bound, tuple):
            angle = name in result.study.angles
            label = with_unit(name, "deg" if angle else result.study.unit)
            yield label, *(math.degrees(c.variables[name]) if angle else c.variables[name] for c in shown)
    length = with_unit("characteristic length", result.study.unit)
    yield length, *(c.characteristic_length for c in shown)
    yield "limits reached", *(", ".join(c.active) or "nothing" for c in shown)
    yield "starts that ended here", *(str(c.reached) for c in shown)
