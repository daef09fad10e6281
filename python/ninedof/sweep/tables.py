"""The tables of a sweep and of an atlas, from plain values as records have them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ninedof.design.indices import INDICES
from ninedof.support.angles import degrees_of, plain_name
from ninedof.support.units import amount
from ninedof.tables import Table, columns

SIZES = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0)  # radius ratios


def summary_table(summary: Mapping[str, Mapping[str, Any]], title: str, units: Mapping[str, str]) -> Table:
    """Return the least and the greatest value of each index, with their coordinates; angles in degrees."""
    counts = [word for word in ("infinite", "missing") if any(row[word] for row in summary.values())]
    rows = [row for name, one in summary.items() for row in _rows(name, one, units, counts)]
    return Table(title, columns("index", "", ">value", "at", *(f">{word}" for word in counts)), rows)


def _rows(
    name: str, one: Mapping[str, Any], units: Mapping[str, str], counts: Iterable[str]
) -> Iterator[tuple[Any, ...]]:
    what = " modulus" if name in INDICES and INDICES[name].signed else ""
    least, greatest = (_end(one.get(word), name, units) for word in ("least", "greatest"))
    yield name.replace("_", " "), f"least{what}", *least, *(one[word] for word in counts)
    yield "", f"greatest{what}", *greatest, *("" for _ in counts)
    yield ()


def _end(end: Mapping[str, Any] | None, name: str, units: Mapping[str, str]) -> tuple[str, str]:
    if end is None:
        return "-", "-"
    at = end["at"]
    moved = "rad" if str(at.get("coordinate", "")).startswith("theta") else "l_c"  # of Fig. 6
    units = {dim: moved if unit == "l_c or rad" else unit for dim, unit in units.items()}
    where = (
        f"{plain_name(dim)} = {_number(value, units.get(dim, ''), 5)}" if isinstance(value, float) else f"{dim} {value}"
        for dim, value in at.items()
    )
    return _number(end["value"], units.get(name, ""), 6), "\n".join(where)


def _number(value: float, unit: str, digits: int) -> str:
    if unit == "rad":
        value, unit = degrees_of(value), "deg"
    return amount(f"{value:.{digits}g}", "" if unit in ("1", "length") else unit)


def atlas_table(best: Iterable[Mapping[str, Any]]) -> Table:
    """Return the best designs up to a few sizes of the base."""
    listed = list(best)
    names = list(listed[0]["design"]) if listed else []
    heads = columns(">radius ratio\nbelow", ">condition\nnumber", *(f">{name}" for name in names))
    rows = []
    for size in SIZES:
        below = [one for one in listed if one["radius_ratio"] < size]
        if below:
            one = min(below, key=lambda one: one["condition_number"])
            values = (one["condition_number"], *(one["design"][name] for name in names))
            rows.append((f"{size:g}", *(f"{value:.4f}" for value in values)))
    return Table("Best of all designs up to a radius ratio", heads, rows)
