"""The summary of a sweep: extremes of each index, as a table and as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from rich.table import Table

from ninedof.design.indices import INDICES, size_of
from ninedof.sweep import SweepResult

MOST_PRINTED = 10_000  # numbers in JSON; larger results are in the file only


def describe(result: SweepResult, name: str) -> dict[str, Any]:
    """Return the extremes of an index with their coordinates, and the numbers of infinite and missing values.

    The extremes of a signed index are those of its modulus, with their signs.
    """
    values = result[name]
    size = size_of(name, values)
    finite = np.isfinite(values)
    out: dict[str, Any] = {
        "points": int(values.size),
        "infinite": int(np.isinf(values).sum()),
        "missing": int(np.isnan(values).sum()),
    }
    if finite.any():
        for word, pick in (("least", np.argmin), ("greatest", np.argmax)):
            fill = np.inf if word == "least" else -np.inf
            at = np.unravel_index(int(pick(np.where(finite, size, fill))), values.shape)
            out[word] = {"value": float(values[at]), "at": result.at(name, at)}
    return out


def summary_table(summary: Mapping[str, Mapping[str, Any]], title: str) -> Table:
    """Return the table of the least and the greatest value of each index, with their coordinates."""
    table = Table(title=title, title_justify="left", title_style="bold")
    counts = [word for word in ("infinite", "missing") if any(row[word] for row in summary.values())]
    for head in ("index", "", "value", "at", *counts):
        table.add_column(head, justify="right" if head in ("value", *counts) else "left", overflow="fold")
    for name, row in summary.items():
        what = " modulus" if name in INDICES and INDICES[name].signed else ""
        table.add_row(
            name.replace("_", " "), f"least{what}", *_end(row.get("least")), *(str(row[word]) for word in counts)
        )
        table.add_row("", f"greatest{what}", *_end(row.get("greatest")), end_section=True)
    return table


def _end(end: Mapping[str, Any] | None) -> tuple[str, str]:
    if end is None:
        return "-", "-"
    where = (f"{name} = {v:.5g}" if isinstance(v, float) else f"{name} {v}" for name, v in end["at"].items())
    return f"{end['value']:.6g}", "\n".join(where)


def json_data(result: SweepResult, summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of --json, with all values of a small result."""
    data: dict[str, Any] = {"sweep": {"dims": dict(result.dims), "indices": summary, "attributes": result.attributes}}
    if sum(a.size for a in (*result.arrays.values(), *result.coords.values())) <= MOST_PRINTED:
        data["sweep"]["coords"] = {name: values.tolist() for name, values in result.coords.items()}
        data["sweep"]["arrays"] = {name: values.tolist() for name, values in result.arrays.items()}
    return data
