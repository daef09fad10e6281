"""Labelled arrays: the result of a sweep or an atlas, in memory, in a file, as an xarray.Dataset, and their tables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninedof.design.indices import INDICES, size_of
from ninedof.support.arguments import choice, items, whole
from ninedof.support.extras import optional
from ninedof.support.kept.files import Saved
from ninedof.support.text import encode, short
from ninedof.support.units import amount, degrees_of, plain_name
from ninedof.sweep.survey import RADIUS_RATIO
from ninedof.tables import Column, Table, columns
from ninedof.tables.html import notebook


@dataclass(frozen=True, eq=False)
class SweepResult(Saved):
    """Named arrays over named dimensions, with the values along each dimension and their units."""

    KIND = "sweep"

    arrays: Mapping[str, NDArray[Any]]
    """Name of an index to its values."""
    dims: Mapping[str, tuple[str, ...]]
    """Name of an index to the names of the dimensions of its array, in order."""
    coords: Mapping[str, NDArray[Any]]
    """Name of a dimension to the values along it: numbers, or words."""
    units: Mapping[str, str] = field(default_factory=dict)
    """Name of an index or a dimension to its unit: "rad", or "deg" for names that end in _deg; "mm" or another length
    unit where the sweep names one, "length" where it does not; "1" for none."""
    attributes: Mapping[str, Any] = field(default_factory=dict)
    """Arguments of the call and versions, as plain JSON values."""

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the array of an index, or the values along a dimension."""
        if name in self.arrays:
            return self.arrays[name]
        if name in self.coords:
            return self.coords[name]
        raise KeyError(f"{name!r}: expected one of {', '.join([*self.arrays, *self.coords])}")

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of the indices."""
        return iter(self.arrays)

    def __len__(self) -> int:
        """Return the number of indices."""
        return len(self.arrays)

    def __repr__(self) -> str:
        """Show names and shapes."""
        arrays = (f"{n}({', '.join(f'{d}: {len(self.coords[d])}' for d in self.dims[n])})" for n in self.arrays)
        return f"<SweepResult {', '.join(arrays)}>"

    def _repr_html_(self) -> str:
        columns = [*(Column(name) for name in ("index", "unit", "over")), Column("least", "", ".6g"), Column("at")]
        rows = []
        for name, array in self.arrays.items():
            over = " x ".join(f"{len(self.coords[d])} {d}" for d in self.dims[name])
            missing = array.dtype.kind != "f" or bool(np.isnan(array).all())
            value, where = (None, {}) if missing else self.least(name)
            at = ", ".join(f"{d} = {x if isinstance(x, str) else short(x)}" for d, x in where.items())
            rows.append((name, self.units.get(name, "1"), over, value, at))
        return notebook(Table("SweepResult", columns, rows))

    def at(self, name: str, position: tuple[Any, ...]) -> dict[str, Any]:
        """Return the values of the coordinates at a position of an array, by dimension.

        Parameters
        ----------
        name : str
            Of an index.
        position : tuple of int

        """
        shape = self.arrays[choice("name", name, self.arrays)].shape
        numbers = items("position", position, f"{len(shape)} whole numbers", len(shape))
        each = zip(self.dims[name], numbers, shape, strict=True)
        return {d: self.coords[d][whole("position", k, -size, size - 1)].item() for d, k, size in each}

    def least(self, name: str) -> tuple[float, dict[str, Any]]:
        """Return the least value of an index that is not NaN, and where it is; of a signed index that of least modulus.

        Parameters
        ----------
        name : str
            Of an index.

        Raises
        ------
        ValueError
            If all of it is NaN.

        """
        array = self.arrays[choice("name", name, self.arrays)]
        if np.isnan(array).all():
            raise ValueError(f"{name}: got NaN everywhere, expected at least one number")
        position = np.unravel_index(int(np.nanargmin(size_of(name, array))), array.shape)
        return float(array[position]), self.at(name, position)

    def to_xarray(self) -> Any:
        """Return an `xarray.Dataset` with the same arrays, labels, units and attributes.

        Raises
        ------
        ImportError
            If xarray is not installed; the message says how to install it.

        """
        xarray = optional("xarray", "sweep", "SweepResult.to_xarray")
        unit = {
            name: {"units": self.units[name]} if name in self.units else {} for name in (*self.arrays, *self.coords)
        }
        return xarray.Dataset(
            {name: (self.dims[name], array, unit[name]) for name, array in self.arrays.items()},
            {name: (name, values, unit[name]) for name, values in self.coords.items()},
            # What netCDF takes as an attribute.
            {n: x if type(x) in (str, int, float) else encode(x, indent=None) for n, x in self.attributes.items()},
        )


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
        below = [one for one in listed if one[RADIUS_RATIO] < size]
        if below:
            one = min(below, key=lambda one: one["condition_number"])
            values = (one["condition_number"], *(one["design"][name] for name in names))
            rows.append((f"{size:g}", *(f"{value:.4f}" for value in values)))
    return Table("Best of all designs up to a radius ratio", heads, rows)
