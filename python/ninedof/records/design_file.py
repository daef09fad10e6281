"""One design from a TOML file or named values, and its indices, as `ninedof evaluate` prints them."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ninedof.conditioning.characteristic_length import KINDS, characteristic_length, length_at
from ninedof.conditioning.conditioning import condition_number
from ninedof.conditioning.hexagonal import HEXAGONAL
from ninedof.design.indices import computed
from ninedof.design.tool import Tool
from ninedof.robot.configuration import Configuration, arrays_of
from ninedof.robot.geometry import TRIPLES, Geometry, triples
from ninedof.support.arguments import finite, is_number, known_keys, number, table
from ninedof.support.kept.files import read_toml, write_toml
from ninedof.support.structs import read, within
from ninedof.support.text import short_repr
from ninedof.support.units import in_radians, require_unit_at_top, unit_argument, unit_entry


@short_repr
class Design(NamedTuple):
    """A geometry, a configuration and the characteristic length to judge them by: what a design file holds.

    Functions of a geometry and a configuration take 1 for the length unless it is given: pass that of the design.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=871.9, b1=435.9, b2=0.0)
    >>> design = nd.Design(g, nd.Configuration.neutral(597.4, 366.5), 150.0, "mm")
    >>> round(design.condition_number, 3)
    3.907
    >>> print(round(nd.condition_number(design.geometry, design.configuration, design.characteristic_length), 3))
    3.907

    """

    geometry: Geometry
    configuration: Configuration
    """The neutral one."""
    characteristic_length: float | str = 1.0
    """A number, or a kind of `ninedof.characteristic_length`."""
    unit: str = ""
    """Name of the length unit; "" without one."""
    tool: Tool = Tool()
    """Whose frame geometry and configuration have as that of the platform; by default the plate's own."""

    @property
    def condition_number(self) -> float:
        """At the neutral configuration, with the characteristic length of the design; infinite where singular."""
        return float(condition_number(*self[:3]))


HEXAGON = HEXAGONAL[:4]


def hexagonal_design(values: Mapping[str, float], length: float | str = 1.0) -> Design:
    """Return the design of hexagonal variables; theta_z, in radians, is 0 unless given."""
    geometry = Geometry.hexagonal(**{name: values[name] for name in HEXAGON})
    return Design(geometry, Configuration.neutral(values["zp"], values["zs"], values.get("theta_z", 0.0)), length)


def load_design(path: str | os.PathLike[str]) -> Design:
    """Read a design file.

    It has `characteristic_length` (a number or a kind, 1.0 by default), `unit` (the name of the length unit, none by
    default) and two tables: [geometry] with a1 a2 b1 b2, or with four lists of three joints base_external,
    base_internal, platform_external, platform_internal; [configuration] with zp, zs and theta_z_deg (or theta_z in
    radians), or with position, internal_point and, optionally, rotation (three rows). With a third, [tool], as in a
    study, the two are of the plates, and the design is as the tool sees it. ValueError names the file and the entry.
    """
    data = read_toml(path)
    with within(os.fspath(path), ": "):
        return _from_tables(data)


def save_design(design: Design, path: str | os.PathLike[str]) -> Path:
    """Write a design file, its joints and its configuration as coordinates; return its path."""
    tool = design.tool
    g, c = (tool.plates(design.geometry), tool.plate(design.configuration)) if tool else design[:2]
    tables = {
        **unit_entry(design.unit),
        "characteristic_length": design.characteristic_length,
        "geometry": {name: points.tolist() for name, points in triples(g).items()},
        "configuration": {name: values.tolist() for name, values in arrays_of(c).items()},
        **({"tool": tool.to_dict()} if tool else {}),
    }
    write_toml(path, tables)
    return Path(path)


def _from_tables(data: Mapping[str, Any]) -> Design:
    if "design" in data or "variables" in data:
        raise ValueError(
            "design: got a study, expected a design with [geometry] and [configuration]; see `ninedof optimize`"
        )
    names = ("geometry", "configuration", "unit", "characteristic_length", "tool")
    geometry, configuration = (table(name, _entries("", data, [name], names)[name]) for name in names[:2])
    require_unit_at_top({"geometry": geometry, "configuration": configuration})
    if "zp" in configuration or "zs" in configuration:
        configuration = in_radians(configuration, {"theta_z": finite})
        c = Configuration.neutral(**_entries("configuration", configuration, ("zp", "zs"), ("theta_z",)))
        if c.shape:
            raise ValueError("configuration: got lists, expected one number for each of zp, zs and theta_z")
    else:
        c = Configuration(**_entries("configuration", configuration, ("position", "internal_point"), ("rotation",)))
    if any(name in geometry for name in HEXAGON):
        sides = _entries("geometry", geometry, HEXAGON)
        g = Geometry.hexagonal(**{name: number(f"geometry.{name}", value) for name, value in sides.items()})
    else:
        g = Geometry(**_entries("geometry", geometry, TRIPLES))
    length, tool = data.get("characteristic_length", 1.0), read(Tool, data.get("tool", {}), "tool")
    if not isinstance(length, str) and not is_number(length):
        raise ValueError(f"characteristic_length: got {length!r}, expected a number or a kind")
    return Design(*tool.robot(g, c), length, unit_argument(data.get("unit")), tool)


def _entries(where: str, data: Mapping[str, Any], needed: Sequence[str], others: Sequence[str] = ()) -> dict[str, Any]:
    """Return the entries of a table that has all that are needed, and no unknown ones."""
    known_keys(where or "design", data, dict.fromkeys((*needed, *others)))
    for name in needed:
        if name not in data:
            raise ValueError(f"{where}.{name}: got nothing, expected a value".removeprefix("."))
    return dict(data)


def indices(design: Design) -> dict[str, Any]:
    """Return every index of the table at a design, and the condition number under each kind of length, as plain values.

    Where a kind of length has no value, at a singular configuration, indices that depend on it are left out, but for
    the condition number and the singular values.
    """
    g, c, length = design.geometry, design.configuration, design.characteristic_length
    lc = length_at(g, c, length)
    has_length = math.isfinite(lc) or not isinstance(length, str)
    out = {
        name: np.asarray(index.values(g, c, lc, None)).tolist()
        for name, index in computed().items()
        if has_length or not index.needs_length
    }
    if not has_length:
        out |= {"condition_number": math.inf, "reciprocal_condition_number": 0.0, "singular_values": [math.inf] * 6}
    legs = out["leg_lengths"]
    kinds = {}
    for kind in KINDS:
        value = float(characteristic_length(g, c, kind))
        kappa = float(condition_number(g, c, value)) if math.isfinite(value) else math.inf
        kinds[kind] = {"length": value, "condition_number": kappa}
    return {
        "characteristic_length": lc,
        **out,
        "leg_lengths": {"l": legs[:3], "q": legs[3:6], "r": legs[6:]},
        "characteristic_lengths": kinds,
        "singular": math.isinf(out["condition_number"]),
    }
