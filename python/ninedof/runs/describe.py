"""Results as plain values, as records and `--json` hold them, and back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ninedof.design.study import Study
from ninedof.optimize.result import result_from
from ninedof.paper import published
from ninedof.paper.comparison import Comparison, Row
from ninedof.pareto import Front
from ninedof.pareto.limited import limited, without_degrees
from ninedof.support.arguments import items, number, table
from ninedof.support.fields import entries_of


def describe_front(front: Front) -> dict[str, Any]:
    """Return a front as plain values, with all its results."""
    return {**front.to_dict(), "results": [result.to_dict() for result in front.results]}


def front_from(study: Study, data: Mapping[str, Any]) -> Front:
    """Return the front of a study."""
    rows = items("rows", table("front", data).get("rows"), "a list of rows")
    given = items("results", data.get("results"), "a list of results")
    if len(given) != len(rows):
        raise ValueError(f"results: got {len(given)} of them and {len(rows)} rows, expected as many of both")
    limits = tuple(number(f"rows[{k}].limit", table(f"rows[{k}]", row).get("limit")) for k, row in enumerate(rows))
    known = entries_of(Front, data, skipped=["study", "limits", "results"])
    plain, degrees = without_degrees(known["against"])
    results = []
    for k, (limit, found) in enumerate(zip(limits, given, strict=True)):
        value = math.radians(limit) if degrees else limit
        try:
            results.append(result_from(limited(study, plain, value if np.isfinite(value) else None), found))
        except ValueError as error:
            raise ValueError(f"results[{k}]: {error}") from None
    return Front(study, **known, limits=limits, results=tuple(results))


def describe_comparison(c: Comparison) -> dict[str, Any]:
    """Return the comparison with the published optimum as plain values."""
    return {
        "published": {"a1": published.A1, "b1": published.B1, "zp": published.ZP, "condition_number": published.KAPPA},
        "as_printed": c.as_printed,
        "why": c.why,
        "designs": [_row(row) for row in c.rows()],
        "optimization": c.result.to_dict(),
    }


def _row(row: Row) -> dict[str, Any]:
    return {
        "title": row.title,
        "variables": row.variables,
        "condition_number": row.condition_number,
        "leg_lengths": dict(zip(("l", "q", "r"), row.legs, strict=True)),
        "radius_ratio": row.radius_ratio,
        "gain_percent": row.gain,
        "active": list(row.active),
    }
