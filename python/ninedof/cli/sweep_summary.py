"""The summary of a sweep: extremes of each index, as a table and as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from rich.table import Table

from ninedof.design.indices import INDICES, size_of
from ninedof.support.angles import degrees_of, plain_name
from ninedof.support.blocks import blocks
from ninedof.support.units import amount
from ninedof.sweep import SweepResult

MOST_PRINTED = 10_000  # numbers in JSON; larger results are in the file only


def describe(result: SweepResult, name: str) -> dict[str, Any]:
    """Return the extremes of an index with their coordinates, and the numbers of infinite and missing values.

    The extremes of a signed index are those of its modulus, with their signs.
    """
    values = result[name]
    out: dict[str, Any] = {"points": int(values.size), "infinite": 0, "missing": 0}
    ends: dict[str, tuple[float, int]] = {}  # the size that is least or greatest so far, and where
    for first, piece in blocks(values):
        missing, infinite = np.isnan(piece), np.isinf(piece)
        out["infinite"] += int(infinite.sum())
        out["missing"] += int(missing.sum())
        known = np.flatnonzero(~(missing | infinite))
        if known.size:
            size = size_of(name, piece[known])
            for word, sign, pick in (("least", 1.0, np.argmin), ("greatest", -1.0, np.argmax)):
                at = int(pick(size))
                if word not in ends or sign * size[at] < sign * ends[word][0]:
                    ends[word] = float(size[at]), first + int(known[at])
    for word, (_, number) in ends.items():
        place = np.unravel_index(number, values.shape)
        out[word] = {"value": float(values[place]), "at": result.at(name, place)}
    return out


def summary_table(summary: Mapping[str, Mapping[str, Any]], title: str, units: Mapping[str, str]) -> Table:
    """Return the table of the least and the greatest value of each index, with their coordinates; angles in degrees."""
    table = Table(title=title, title_justify="left", title_style="bold")
    counts = [word for word in ("infinite", "missing") if any(row[word] for row in summary.values())]
    for head in ("index", "", "value", "at", *counts):
        table.add_column(head, justify="right" if head in ("value", *counts) else "left", overflow="fold")
    for name, row in summary.items():
        what = " modulus" if name in INDICES and INDICES[name].signed else ""
        least, greatest = (_end(row.get(word), name, units) for word in ("least", "greatest"))
        table.add_row(name.replace("_", " "), f"least{what}", *least, *(str(row[word]) for word in counts))
        table.add_row("", f"greatest{what}", *greatest, end_section=True)
    return table


def _end(end: Mapping[str, Any] | None, name: str, units: Mapping[str, str]) -> tuple[str, str]:
    if end is None:
        return "-", "-"
    at = end["at"]
    moved = "rad" if str(at.get("coordinate", "")).startswith("theta") else "l_c"  # of Fig. 6
    units = {dim: moved if unit == "l_c or rad" else unit for dim, unit in units.items()}
    where = (_place(d, v, units) if isinstance(v, float) else f"{d} {v}" for d, v in at.items())
    return _number(end["value"], units.get(name, ""), 6), "\n".join(where)


def _place(name: str, value: float, units: Mapping[str, str]) -> str:
    return f"{plain_name(name)} = {_number(value, units.get(name, ''), 5)}"


def _number(value: float, unit: str, digits: int) -> str:
    if unit == "rad":
        value, unit = degrees_of(value), "deg"
    return amount(f"{value:.{digits}g}", "" if unit in ("1", "length") else unit)


def json_data(result: SweepResult, summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of --json, with all values of a small result."""
    about = {"dims": dict(result.dims), "units": dict(result.units), "indices": summary}
    data: dict[str, Any] = {"sweep": {**about, "attributes": result.attributes}}
    if sum(a.size for a in (*result.arrays.values(), *result.coords.values())) <= MOST_PRINTED:
        data["sweep"]["coords"] = {name: values.tolist() for name, values in result.coords.items()}
        data["sweep"]["arrays"] = {name: values.tolist() for name, values in result.arrays.items()}
    return data
