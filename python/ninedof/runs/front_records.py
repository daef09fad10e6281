"""Fronts in run folders: written whole or not at all, read back as the front they were."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ninedof.optimize.result import Result, result_from
from ninedof.pareto import Front
from ninedof.pareto.limited import limited
from ninedof.runs.records import Record, describe_result, load_record, write_record

__all__ = ["load_front", "write_front"]


def write_front(front: Front, directory: str | os.PathLike[str], files: tuple[str, ...] = ()) -> Path:
    """Write the record of a front into an existing directory and return its path.

    Parameters
    ----------
    front : Front
    directory : path
    files : tuple of str
        Names of the figures beside the record.

    """
    found = {**front.to_dict(), "results": [describe_result(result) for result in front.results]}
    return write_record(Record(front.study, {"front": found}, files=files), directory)


def load_front(path: str | os.PathLike[str]) -> Front:
    """Read a front from its record or the directory of it.

    Designs are made anew from their variables; every other number is the one that was written.

    Raises
    ------
    ValueError
        If there is no record, or it holds no front; the message names the file.

    """
    record = load_record(path)
    found = record.results.get("front")
    if found is None:
        raise ValueError(f"{os.fspath(path)}: got a record without a front, expected one of `ninedof pareto`")
    try:
        against = found["against"]
        limits = tuple(float(row["limit"]) for row in found["rows"])
        results = tuple(
            _result(record, against, limit, data) for limit, data in zip(limits, found["results"], strict=True)
        )
        return Front(record.study, against, limits, results, found["interrupted"], float(found["seconds"]))
    except (KeyError, TypeError) as error:
        raise ValueError(f"{os.fspath(path)}: got a front without {error}, expected a whole one") from None


def _result(record: Record, against: str, limit: float, data: Mapping[str, Any]) -> Result:
    study = limited(record.study, against, limit if np.isfinite(limit) else None)
    candidates = [{name: _number(value) for name, value in entry.items()} for entry in data["candidates"]]
    return result_from(study, {**data, "candidates": candidates})


def _number(value: Any) -> Any:
    """Undo the spelling of numbers that JSON has not."""
    return float(value) if value in ("inf", "-inf", "nan") else value
