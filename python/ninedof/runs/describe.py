"""Results as plain values, as records and `--json` hold them, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from types import SimpleNamespace
from typing import Any

import numpy as np

from ninedof.design.study import Study
from ninedof.optimize.result import Candidate, Result, Status, candidate_of
from ninedof.paper import published
from ninedof.paper.comparison import Comparison, Row
from ninedof.pareto import Front
from ninedof.pareto.limited import limited

__all__ = ["describe_comparison", "describe_front", "describe_result", "front_from", "result_from"]

ROBOT = ("geometry", "configuration", "configurations")  # follow from the variables


def describe_result(result: Result) -> dict[str, Any]:
    """Return a result as plain values, without its study."""
    candidates = [_values(candidate, ROBOT) for candidate in result.candidates]
    return {**_values(result, ("study", "candidates")), "confidence": result.confidence, "candidates": candidates}


def result_from(study: Study, data: Mapping[str, Any]) -> Result:
    """Return the result of a study. Robots are made anew from their variables; all other numbers are those written."""
    problem = study.problem()
    candidates = []
    for entry in data["candidates"]:
        x = np.array([entry["variables"][name] for name in problem.names], dtype=np.float64)
        numbers: Any = SimpleNamespace(**{**entry, "variables": x})
        candidates.append(candidate_of(problem, numbers))
    known = {f.name: data[f.name] for f in fields(Result) if f.name in data}
    own = {"status": Status(data["status"]), "causes": tuple(data["causes"]), "candidates": tuple(candidates)}
    return Result(**{**known, **own, "study": study})


def describe_front(front: Front) -> dict[str, Any]:
    """Return a front as plain values, with all its results."""
    return {**front.to_dict(), "results": [describe_result(result) for result in front.results]}


def front_from(study: Study, data: Mapping[str, Any]) -> Front:
    """Return the front of a study."""
    against = data["against"]
    limits = tuple(float(row["limit"]) for row in data["rows"])
    studies = (limited(study, against, limit if np.isfinite(limit) else None) for limit in limits)
    results = tuple(result_from(each, found) for each, found in zip(studies, data["results"], strict=True))
    return Front(study, against, limits, results, data["interrupted"], float(data["seconds"]))


def describe_comparison(c: Comparison) -> dict[str, Any]:
    """Return the comparison with the published optimum as plain values."""
    return {
        "published": {"a1": published.A1, "b1": published.B1, "zp": published.ZP, "condition_number": published.KAPPA},
        "as_printed": c.as_printed,
        "why": c.why,
        "designs": [_row(row) for row in c.rows()],
        "optimization": describe_result(c.result),
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


def _values(thing: Candidate | Result, without: tuple[str, ...]) -> dict[str, Any]:
    return {f.name: getattr(thing, f.name) for f in fields(thing) if f.name not in without}
