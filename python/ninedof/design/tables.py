"""The tables of a study: its variables and its limits; `study` is a Study."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ninedof.design.limits import Limit
from ninedof.support.units import amount, degrees_of
from ninedof.tables import Line, Table, columns

MOST_FIXED = 8  # variables; of more, only the free ones are listed


def listed_variables(study: Any) -> Sequence[str]:
    """Return the names of the variables that are listed: the fixed ones where they are few."""
    names, free = tuple(study.variables), study.free_variables
    return names if len(names) - len(free) <= MOST_FIXED else free


def variables_table(study: Any) -> Table:
    """Return the variables with their bounds."""
    rows = []
    for name in listed_variables(study):
        bound = study.variables[name]
        low, *high = (end_text(study.shown(name, end)) for end in (bound if isinstance(bound, tuple) else (bound,)))
        rows.append(Line(name, [low, *(high or ["fixed"])], unit=study.unit_of(name)))
    return Table("Variables", columns("variable", ">least", ">greatest"), rows)


def limits_table(study: Any) -> Table:
    """Return the limits; a note where there is none."""
    several = bool(study.objective.poses) or study.objective.region is not None
    rows = [_limit_row(limit, limit.unit(study.unit, study.force_unit), several) for limit in study.limits]
    heads = columns("limit", ">least", ">greatest", "how")
    if not any(row[-1] for row in rows):
        rows, heads = [row[:-1] for row in rows], heads[:-1]
    notes = [] if rows else ["No limit is set beside these bounds and 0 < zs < zp."]
    if any(limit.name.endswith(("force", "power")) for limit in study.limits):
        in_newtons = "" if study.force_unit else "; in N where masses are in kg"
        notes.append(f"Forces: of each leg under every load{in_newtons}.")
    return Table("Limits", heads, rows, notes)


def _limit_row(limit: Limit, unit: str, several: bool) -> tuple[str, ...]:
    sides = {side: amount(end_text(degrees_of(x) if unit == "deg" else x), unit) for side, x in limit.sides.items()}
    words = ["at the neutral pose" if limit.at == "neutral" else "at every pose"] * (several or limit.at == "neutral")
    words += [f"{key} {_option(value)}" for key, value in limit.options.items() if key != "at"]
    return limit.name.replace("_", " "), sides.get("min", ""), sides.get("max", ""), ", ".join(words)


def _option(value: object) -> str:
    return f"({', '.join(f'{x:g}' for x in value)})" if isinstance(value, list | tuple) else f"{value}"


def end_text(value: float) -> str:
    """Return the end of a range, "none" where it is open."""
    return f"{value:.6g}" if math.isfinite(value) else "none"
